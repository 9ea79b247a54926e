# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What ./tools/compare says of two reports of `terracut eval`."""

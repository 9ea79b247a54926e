# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The page that ./tools/report draws of what `terracut eval --report` counted."""

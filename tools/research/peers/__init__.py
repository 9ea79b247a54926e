# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Other ground segmenters, fetched, built and measured beside terracut."""

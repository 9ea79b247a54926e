# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Compares two reports of `terracut eval` for ./tools/compare."""

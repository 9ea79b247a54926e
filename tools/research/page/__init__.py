# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Draws the page of ./tools/report from the counts of `terracut eval --report`."""

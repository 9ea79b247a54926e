# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Builds the web site of the documents."""

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Measures the method on all data at hand, whole and with every parameter taken back."""

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Measures what terracut costs, part by part, and prints docs/reference/benchmark.md."""

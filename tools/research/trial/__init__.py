# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Trials of `terracut live`: what ./tools/live_trial runs. Standard library only."""

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Blocks of code in a document."""

import re
from pathlib import Path

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks_of(page: Path) -> list[tuple[str, str]]:
    """(language, text) of every fenced block."""
    return BLOCK.findall(page.read_text())

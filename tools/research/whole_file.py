# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Writes files whole or not at all, like the program (rt/files/whole_file.hpp)."""


def write_whole_file(path, text):
    """Writes `text` to `path`, making a missing folder. Raises OSError; an existing file is then
    left unchanged."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".part")
    try:
        unfinished.write_text(text, encoding="utf-8")
        unfinished.replace(path)
    except OSError:
        unfinished.unlink(missing_ok=True)
        raise

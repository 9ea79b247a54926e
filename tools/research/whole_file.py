# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Files that are there whole or not at all, as the program writes its own (rt/files/whole_file.hpp)."""


def write_whole_file(path, text):
    """Makes the folder where it is missing. Raises OSError; a file that was there before is left as it was then."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".part")
    try:
        unfinished.write_text(text, encoding="utf-8")
        unfinished.replace(path)
    except OSError:
        unfinished.unlink(missing_ok=True)
        raise

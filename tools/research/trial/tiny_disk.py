# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A disk that is soon full, without filling a real one."""

from __future__ import annotations

import subprocess
from pathlib import Path


class TinyDisk:
    """A file system in a limited amount of memory."""

    def __init__(self, folder: Path, kibibytes: int):
        folder.mkdir(exist_ok=True)
        self.folder = folder
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "trial", str(folder)], check=True)

    def __enter__(self) -> Path:
        return self.folder

    def __exit__(self, *_: object) -> None:
        subprocess.run(["umount", str(self.folder)], check=False)

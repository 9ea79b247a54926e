#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The order of the house (docs/design.md): what includes what, what is named how, how full a folder is.

house_test.py REPOSITORY
"""

import re
import sys
from collections import Counter
from pathlib import Path

# Lowest first: a room includes itself and the rooms before it.
ROOMS = ("rt", "calib", "firmware_io", "pipeline", "tools")
# Within a room: what is a library of its own includes nothing of the rest of its room.
ALONE = {
    "firmware_io/frame": (),
    "pipeline": ("ground", "stage", "elevation", "random_field", "min_cut", "road", "remembered", "baselines"),
}
# One program each, and so one namespace each, however many folders it has.
PROGRAMS = {"tools/cli": "cli", "tools/doctor": "doctor"}
MOST_FILES = 25
# What rt knows nothing of: it would serve any program with deadlines.
PRODUCT_WORDS = re.compile(r"\b(lidar|azimuth|ground|obstacle|calibration|hdl64e|ruby128)\b", re.IGNORECASE)


def sources(repository: Path):
    for room in ROOMS:
        for path in sorted((repository / room).rglob("*.[ch]pp")):
            yield path.relative_to(repository)


def included(repository: Path, path: Path):
    for name in re.findall(r'^#include "([^"]+)"', (repository / path).read_text(), re.MULTILINE):
        target = Path(name) if (repository / name).exists() else path.parent / name
        if (repository / target).exists():
            yield target


def is_method(path: Path) -> bool:
    return path.parts[0] == "pipeline" and path.parts[1] in ALONE["pipeline"]


def upward_includes(repository: Path):
    for path in sources(repository):
        for target in included(repository, path):
            if ROOMS.index(target.parts[0]) > ROOMS.index(path.parts[0]):
                yield f"{path} includes {target}, which lies in a room above"
            if path.parts[:2] == ("firmware_io", "frame") and target.parts[0] == "firmware_io" and target.parts[1] != "frame":
                yield f"{path} includes {target}: frames stand alone"
            if is_method(path) and (
                (target.parts[0] == "pipeline" and not is_method(target))
                or (target.parts[0] == "firmware_io" and target.parts[1] != "frame")
            ):
                yield f"{path} includes {target}: the method needs frames and nothing that reads or writes"


def namespace_of(path: Path) -> str:
    for folder, name in PROGRAMS.items():
        if path.is_relative_to(folder):
            return name
    return path.parent.name


def misnamed(repository: Path):
    for path in sources(repository):
        found = re.search(r"^namespace terracut(?:::(\w+))?", (repository / path).read_text(), re.MULTILINE)
        if found and found.group(1) not in (namespace_of(path), None):
            yield f"{path} is in namespace {found.group(1)}, its folder says {namespace_of(path)}"


def overfull(repository: Path):
    files = Counter(path.parent for path in sources(repository))
    for folder, count in files.items():
        if count > MOST_FILES:
            yield f"{folder} holds {count} files"


def product_words(repository: Path):
    for path in sources(repository):
        if path.parts[0] == "rt" and path.stem != "error":  # every room's errors, in namespace terracut
            for word in PRODUCT_WORDS.findall((repository / path).read_text()):
                yield f"{path} says '{word}', of which rt knows nothing"


def main() -> int:
    repository = Path(sys.argv[1])
    faults = [
        fault for check in (upward_includes, misnamed, overfull, product_words) for fault in check(repository)
    ]
    print("\n".join(faults) or "the house is in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The order of the house (docs/design.md): what includes what, what is named how, how full a folder is.

house_test.py REPOSITORY
"""

import re
import sys
from collections import defaultdict
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

# Lowest first: a room includes itself and the rooms before it.
ROOMS = ("rt", "calib", "firmware_io", "pipeline", "tools")
# Within a room: what is a library of its own includes nothing of the rest of its room.
ALONE = {
    "firmware_io/frame": (),
    "pipeline": ("ground", "stage", "elevation", "random_field", "min_cut", "road"),
}
# One program each, and so one namespace each, however many folders it has.
PROGRAMS = {"tools/cli": "cli", "tools/doctor": "doctor"}
# A header and its source are one concept. Commands are many by nature, a file each.
MOST_CONCEPTS = 16
ROWS_OF_A_TABLE = {Path("tools/cli/commands")}
# The public headers of a room (`#include <terracut/...>`), however few.
PUBLIC = "terracut"
# What rt knows nothing of: it would serve any program with deadlines.
PRODUCT_WORDS = re.compile(r"\b(lidar|azimuth|ground|obstacle|calibration|hdl64e|ruby128)\b", re.IGNORECASE)


def sources(repository: Path):
    for room in ROOMS:
        for path in sorted((repository / room).rglob("*.[ch]pp")):
            yield path.relative_to(repository)


def included(repository: Path, path: Path):
    for name in re.findall(r'^#include "([^"]+)"', (repository / path).read_text(), re.MULTILINE):
        places = [Path(name), path.parent / name, *(Path(room) / name for room in ROOMS)]
        yield from [place for place in places if (repository / place).exists()][:1]


def is_method(path: Path) -> bool:
    return path.parts[0] == "pipeline" and path.parts[1] in ALONE["pipeline"]


def is_frame(path: Path) -> bool:
    return path.parts[1] in ("frame", PUBLIC)


def upward_includes(repository: Path):
    for path in sources(repository):
        for target in included(repository, path):
            if ROOMS.index(target.parts[0]) > ROOMS.index(path.parts[0]):
                yield f"{path} includes {target}, which lies in a room above"
            if path.parts[:2] == ("firmware_io", "frame") and target.parts[0] == "firmware_io" and not is_frame(target):
                yield f"{path} includes {target}: frames stand alone"
            if is_method(path) and (
                (target.parts[0] == "pipeline" and not is_method(target))
                or (target.parts[0] == "firmware_io" and not is_frame(target))
            ):
                yield f"{path} includes {target}: the method needs frames and nothing that reads or writes"


def namespace_of(path: Path, named: str) -> str:
    """A file of a program is in its namespace, any other in its folder's, unless its name begins with another one:
    packet/hdl64e_wire.hpp is in hdl64e."""
    for folder, name in PROGRAMS.items():
        if path.is_relative_to(folder):
            return name
    return named if path.name.startswith(f"{named}_") else path.parent.name


def misnamed(repository: Path):
    for path in sources(repository):
        found = re.search(r"^namespace terracut(?:::(\w+))?", (repository / path).read_text(), re.MULTILINE)
        if found and found.group(1) and found.group(1) != namespace_of(path, found.group(1)):
            yield f"{path} is in namespace {found.group(1)}, its folder says {path.parent.name}"


def crowded_or_lonely(repository: Path):
    files = defaultdict(list)
    for path in sources(repository):
        files[path.parent].append(path)
    for folder, paths in files.items():
        concepts = len({path.stem for path in paths})
        if concepts > MOST_CONCEPTS and folder not in ROWS_OF_A_TABLE:
            yield f"{folder} holds {concepts} concepts, more than {MOST_CONCEPTS}"
        if len(paths) == 1 and len(folder.parts) > 1 and folder.name != PUBLIC:
            yield f"{folder} is a folder for one file, {paths[0].name}"


def circles(repository: Path, place_of):
    """Places that include each other, be it by way of others; place_of() says what a file belongs to."""
    includes = defaultdict(set)
    for path in sources(repository):
        for target in included(repository, path):
            if place_of(path) != place_of(target):
                includes[place_of(path)].add(place_of(target))
    try:
        TopologicalSorter(includes).prepare()
    except CycleError as error:
        yield "a circle of includes: " + " <- ".join(str(place) for place in error.args[1])


def circles_of_files(repository: Path):
    return circles(repository, lambda path: path)


def circles_of_folders(repository: Path):
    return circles(repository, lambda path: path.parent)


def product_words(repository: Path):
    for path in sources(repository):
        if path.parts[0] == "rt" and path.stem != "error":  # every room's errors, in namespace terracut
            for word in PRODUCT_WORDS.findall((repository / path).read_text()):
                yield f"{path} says '{word}', of which rt knows nothing"


def main() -> int:
    repository = Path(sys.argv[1])
    faults = [
        fault for check in (
            upward_includes, misnamed, crowded_or_lonely, circles_of_files, circles_of_folders, product_words
        ) for fault in check(repository)
    ]
    print("\n".join(faults) or "the house is in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

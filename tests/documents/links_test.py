#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The documents hold together: links lead somewhere, files they name exist, each is in the index, and a guide types what
README's table does.

links_test.py REPOSITORY
"""

import re
import sys
from pathlib import Path

from blocks import blocks_of

LINK = re.compile(r"\]\(([^()\s#]*)(?:#([^()\s]*))?\)")
ROOMS = ("rt", "calib", "firmware_io", "pipeline", "tools", "tests", "docs")
# `pipeline/live/packet_gate.hpp`, `tools/lab`: what begins as a room does.
PLACE = re.compile(rf"`((?:{'|'.join(ROOMS)})/[\w./-]+)`")
# `packet_gate.hpp`, `packet_gate.*`, `run/packet_gate.*`: a source, wherever it lies.
SOURCE = re.compile(r"`([\w./-]+\.(?:[ch]pp|py|\*))`")
PAST = ("CHANGELOG.md",)  # names what was
TYPED = re.compile(r"`(terracut [^`]+)`")


def documents(repository: Path) -> list[Path]:
    return [*repository.glob("*.md"), *sorted((repository / "docs").rglob("*.md"))]


def anchors_of(text: str) -> set[str]:
    """As hosting sites name headings: lower case, blanks to hyphens, other marks gone."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(document: Path):
    for target, anchor in LINK.findall(document.read_text()):
        if target.startswith(("http:", "https:")):
            continue
        place = document.parent / target if target else document
        if not place.exists():
            yield f"links to {target}, which is not there"
        elif anchor and anchor not in anchors_of(place.read_text()):
            yield f"links to {target}#{anchor}; no heading there is called that"


def sources(repository: Path) -> set[str]:
    """Every file of the rooms, with and without its ending: /rt/error.hpp, /rt/error.*"""
    files = [path.relative_to(repository) for room in ROOMS for path in (repository / room).rglob("*.*")]
    return {f"/{name}" for path in files for name in (path, path.with_suffix(".*"))}


def missing_files(repository: Path, document: Path, known: set[str]):
    text = document.read_text()
    for name in PLACE.findall(text):
        if not (repository / name).exists():
            yield f"names {name}, which is not there"
    for name in SOURCE.findall(text):
        if not any(path.endswith(f"/{name}") for path in known):
            yield f"names {name}, and no source is called that"


def unlisted(repository: Path):
    index = (repository / "docs/README.md").read_text()
    for folder in ("guide", "reference"):
        for page in sorted((repository / "docs" / folder).glob("*.md")):
            if f"({folder}/{page.name})" not in index:
                yield f"docs/README.md does not list {folder}/{page.name}"


def untyped(repository: Path):
    """Commands of README's table begin lines of the guide's blocks, which other tests run."""
    guide = [text for page in (repository / "docs/guide").glob("*.md") for _, text in blocks_of(page)]
    lines = "".join(guide).splitlines()
    rows = [line for line in (repository / "README.md").read_text().splitlines() if line.startswith("| ")]
    for command in TYPED.findall("\n".join(rows)):
        if not any(f"{line} ".startswith(f"{command} ") for line in lines):
            yield f"README.md: no block of the guide has {command}"


def main() -> int:
    repository = Path(sys.argv[1])
    faults = [*unlisted(repository), *untyped(repository)]
    known = sources(repository)
    for document in documents(repository):
        said = [*broken_links(document)]
        if document.name not in PAST:
            said += missing_files(repository, document, known)
        faults += [f"{document.relative_to(repository)} {fault}" for fault in said]
    print("\n".join(faults) or "the documents hold together")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

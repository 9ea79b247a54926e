#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The documents hold together: links lead somewhere, files they name exist, each is in the index.

links_test.py REPOSITORY
"""

import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^()\s#]*)(?:#([^()\s]*))?\)")
ROOMS = ("rt", "calib", "firmware_io", "pipeline", "tools", "tests", "docs")
# `pipeline/live/packet_gate.hpp`, `tools/lab`: what begins as a room does.
PLACE = re.compile(rf"`((?:{'|'.join(ROOMS)})/[\w./-]+)`")
# `packet_gate.hpp`, `packet_gate.*`, `run/packet_gate.*`: a source, wherever it lies.
SOURCE = re.compile(r"`([\w./-]+\.(?:[ch]pp|py|\*))`")
PAST = ("CHANGELOG.md",)  # names what was


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


def main() -> int:
    repository = Path(sys.argv[1])
    faults = list(unlisted(repository))
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

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The pages of the site, laid out in a folder as in the repository, so that their links stay as they are."""

import json
import re
import shutil
from pathlib import Path

LINK = re.compile(r"\]\(([^()\s#:]+)((?:#[^()\s]*)?)\)")
ENTRY = re.compile(r"^\| \[[^]]*\]\((\w+/\w+\.md)\)", re.MULTILINE)
DECISIONS = "docs/decisions/README.md"
CPP, PYTHON = "docs/api/cpp", "docs/api/python.md"


def title_of(page: Path):
    return page.read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ")


def stage(repository: Path, folder: Path):
    """Copies every document and what it links to, and writes an index of the decisions."""
    for document in [*repository.glob("*.md"), *sorted((repository / "docs").rglob("*.md"))]:
        copied = folder / document.relative_to(repository)
        copied.parent.mkdir(parents=True, exist_ok=True)
        copied.write_text(LINK.sub(lambda link: staged(link, document, repository, folder), document.read_text(encoding="utf-8")))
    decisions = sorted((folder / "docs/decisions").glob("*.md"))
    rows = "".join(f"| [{title_of(page)}]({page.name}) |\n" for page in decisions)
    (folder / DECISIONS).write_text(f"# Decisions\n\nWhy terracut is as it is.\n\n| decision |\n|---|\n{rows}")


def staged(link, document, repository, folder):
    """Returns a link of a document as it is in the site; what it leads to is copied there."""
    target = document.parent / link[1]
    if target.is_dir():  # a code host lists it
        return f"]({link[1]}/README.md)"
    if target.suffix != ".md" and target.is_file():
        copied = folder / target.resolve().relative_to(repository)
        copied.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(target, copied)
    return link[0]


def navigation(folder: Path):
    """Returns mkdocs' `nav` in JSON: the pages in the order of docs/README.md."""
    entries = [f"docs/{page}" for page in ENTRY.findall((folder / "docs/README.md").read_text(encoding="utf-8"))]
    decisions = sorted(str(page.relative_to(folder)) for page in (folder / "docs/decisions").glob("[0-9]*.md"))
    return json.dumps([
        {"Start": "README.md"},
        {"Guide": [page for page in entries if page.startswith("docs/guide/")]},
        {"Reference": [page for page in entries if page.startswith("docs/reference/")]},
        {"API": [{"Python": PYTHON}, {"C++": f"{CPP}/annotated.html"}]},
        {"Why": ["docs/design.md", {"Decisions": [{"All": DECISIONS}, *decisions]}]},
        {"All pages": "docs/README.md"},
        {"Contributing": "CONTRIBUTING.md"},
        {"Changes": "CHANGELOG.md"},
    ])  # fmt: skip

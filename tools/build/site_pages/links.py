# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Links of a built site: the names of headings, and what leads nowhere."""

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


def anchor_of(heading, _separator="-"):
    """Returns a heading's anchor as code hosts name it, so that a link works in both."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


class Page(HTMLParser):
    """The names in a page, and where its links go."""

    def __init__(self, file):
        super().__init__()
        self.names, self.targets = set(), []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names |= {given[key] for key in ("id", "name") if given.get(key)}
        self.targets += [given[key] for key in ("href", "src") if given.get(key)]

    handle_startendtag = handle_starttag


def broken_links(site: Path):
    """Yields "PAGE links to TARGET" for every link within the site that leads to no file, or to no name in one."""
    pages = {file: Page(file) for file in sorted(site.rglob("*.html"))}
    for file, page in pages.items():
        for target in dict.fromkeys(page.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            base = site if parts.path.startswith("/") else file.parent
            place = (base / unquote(parts.path).lstrip("/")).resolve() if parts.path else file
            found = place / "index.html" if place.is_dir() else place
            name = unquote(parts.fragment)
            if not found.is_file() or (name and found in pages and name not in pages[found].names):
                yield f"{file.relative_to(site)} links to {target}"

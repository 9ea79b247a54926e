#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The web site of the documents can be built, and every link in it leads somewhere.

site_test.py REPOSITORY
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(sys.argv.pop()).resolve()
sys.path.insert(0, str(REPOSITORY / "tools/build"))

from site_pages.links import anchor_of, broken_links  # noqa: E402
from site_pages.main import NOT_INSTALLED  # noqa: E402
from site_pages.python_reference import python_page  # noqa: E402


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, **files):
        for name, text in files.items():
            (self.folder / name.replace("_html", ".html")).write_text(text)


class Site(Folder):
    def test_it_is_built_without_a_broken_link_and_has_both_references(self):
        ran = subprocess.run([REPOSITORY / "tools/site", "-o", self.folder / "site"], capture_output=True, text=True)
        if ran.returncode == NOT_INSTALLED:
            print(f"skipped: {ran.stderr}", end="")
            self.skipTest(ran.stderr)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        for page in ("index.html", "docs/guide/first_steps.html", "docs/decisions/index.html", "docs/api/python.html",
                     "docs/api/cpp/classterracut_1_1Segmenter.html"):  # fmt: skip
            self.assertTrue((self.folder / "site" / page).is_file(), page)


class Links(Folder):
    def test_anchors_are_those_of_code_hosts(self):
        self.assertEqual(anchor_of("Found, or not: `IoU_g` & more"), "found-or-not-iou_g--more")

    def test_what_leads_nowhere_is_named(self):
        self.write(a_html='<h2 id="x"></h2><a href="b.html#y"></a><a href="c.html"></a><a href="#x"></a><a href="https://c.d/e"></a>',
                   b_html='<img src="/a.html"><a href="a.html#z"></a>')  # fmt: skip
        self.assertEqual(list(broken_links(self.folder)),
                         ["a.html links to b.html#y", "a.html links to c.html", "b.html links to a.html#z"])  # fmt: skip


class PythonReference(Folder):
    def test_public_names_are_described_and_others_are_not(self):
        (self.folder / "__init__.py").write_text('''"""Text, see docs/guide/a.md."""
__all__ = ["ONE", "Frame", "read"]
ONE, TWO = 1, 2
def read(path: str, *, every: dict[str, int] = {}) -> Frame:
    """Reads."""
def _hidden(): """Not this."""
''')
        (self.folder / "errors.py").write_text("class Other: ...\n")
        (self.folder / "_terracut.pyi").write_text('''
class Frame:
    """A frame."""
    def __init__(self, words: list[str]) -> None: ...
    @property
    def ring(self) -> int | None:
        """0 is the
        lowest."""
    def end(self) -> None: ...
''')
        page = "\n\n".join(python_page(self.folder))
        for shown in ("[guide/a.md](../guide/a.md)", "| `ONE` | `1` |", "read(path: str, *, every: dict[str, int]={}) -> Frame\n",
                      "### Frame", "| `ring` | `int | None` | 0 is the lowest. |", "end() -> None"):  # fmt: skip
            self.assertIn(shown, page)
        for hidden in ("TWO", "_hidden", "Other", "words"):
            self.assertNotIn(hidden, page)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Makes README, docs/ and the API reference of C++ and Python one web site.

    ./tools/site                                # into build/site, for any browser: build/site/index.html
    python3 -m http.server -d build/site        # with the search, which needs a server

./tools/setup --site installs what it needs: mkdocs, its theme material, doxygen. Exit codes: 1 if a link within the site leads
nowhere (it is named), 3 if something is not installed.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .links import broken_links
from .pages import CPP, PYTHON, navigation, stage
from .python_reference import python_page

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[2]
NOT_INSTALLED = 3


def missing():
    """Returns the packages that are needed and not there."""
    packages = [name for name in ("doxygen",) if shutil.which(name) is None]
    try:
        from mkdocs.utils import get_theme_names
    except ImportError:
        return [*packages, "mkdocs", "mkdocs-material"]
    return packages + ([] if "material" in get_theme_names() else ["mkdocs-material"])


def reference_of_cpp(folder):
    """Writes Doxygen's pages of the public headers."""
    headers = [str(header.relative_to(REPOSITORY)) for header in sorted(REPOSITORY.glob("*/terracut/*.hpp"))]
    settings = {"INPUT": [HERE / "cpp.md", *headers], "USE_MDFILE_AS_MAINPAGE": [HERE / "cpp.md"], "OUTPUT_DIRECTORY": [folder],
                "STRIP_FROM_PATH": sorted({header.split("/")[0] for header in headers})}  # fmt: skip
    lines = [f"{key} = " + " ".join(f'"{value}"' for value in values) for key, values in settings.items()]
    folder.mkdir(parents=True)
    subprocess.run(["doxygen", "-"], check=True, cwd=REPOSITORY, text=True, input="\n".join([(HERE / "Doxyfile").read_text(), *lines]))


def build(site):
    with tempfile.TemporaryDirectory() as scratch:
        pages, configuration = Path(scratch) / "pages", Path(scratch) / "mkdocs.yml"
        stage(REPOSITORY, pages)
        reference_of_cpp(pages / CPP)
        (pages / PYTHON).write_text("\n\n".join(python_page(REPOSITORY / "tools/python/terracut")))
        shutil.copy(HERE / "style.css", pages)
        folders = f'docs_dir: "{pages}"\nsite_dir: "{site}"\nnav: {navigation(pages)}\n'
        configuration.write_text(f"{(HERE / 'mkdocs.yml').read_text()}{folders}")
        subprocess.run([sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--clean", "--config-file", configuration],
                       check=True, env=os.environ | {"PYTHONPATH": str(HERE.parent)})  # fmt: skip


def main(given):
    parser = argparse.ArgumentParser(prog="site", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", type=Path, metavar="FOLDER", help="a new folder instead of build/site, which is written anew")
    asked = parser.parse_args(given).o
    site = (asked or REPOSITORY / "build/site").resolve()
    if asked and site.exists():
        return f"error: {asked} exists"
    if needed := missing():
        print(f"error: not installed: {', '.join(needed)}; ./tools/setup --site installs them", file=sys.stderr)
        return NOT_INSTALLED
    try:
        build(site)
    except subprocess.CalledProcessError as failed:
        return f"error: {failed}"
    broken = list(broken_links(site))
    print("\n".join(broken) or f"look at it: {os.path.relpath(site / 'index.html')}")
    return 1 if broken else 0

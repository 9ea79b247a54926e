# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""`pip install .` where the distribution has what it takes: the module works from where it was put.

pip_test.py REPOSITORY DRIVE COMPILER
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

REPOSITORY, DRIVE, COMPILER = sys.argv[1:4]
# Built as the tests' own build is, and as deep below the repository, so that a compiler cache knows most of it.
SETTINGS = ("TERRACUT_DEVELOPER_MODE=ON", "CMAKE_UNITY_BUILD_BATCH_SIZE=16")


def main() -> int:
    for package in ("pip", "scikit_build_core"):
        if importlib.util.find_spec(package) is None:
            print(f"skipped: this distribution's Python has no {package}")
            return 0
    environment = dict(os.environ)
    environment.pop("PYTHONPATH", None)
    environment["CXX"] = COMPILER
    if shutil.which("ccache"):
        environment["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    with tempfile.TemporaryDirectory(prefix="pip-", dir=Path(REPOSITORY) / "build") as folder:
        site = Path(folder) / "site"
        settings = [word for setting in SETTINGS for word in ("--config-settings", f"cmake.define.{setting}")]
        subprocess.run(
            [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index", "--target", site,
             "--config-settings", f"build-dir={folder}", *settings, REPOSITORY],
            check=True, env=environment,
        )  # fmt: skip
        said = subprocess.run(
            [sys.executable, "-c", "import sys, terracut; print(terracut.__file__, next(terracut.replay(sys.argv[1])))", DRIVE],
            check=True, env=environment | {"PYTHONPATH": str(site)}, capture_output=True, text=True, cwd=folder,
        ).stdout  # fmt: skip
        print(said, *sorted(path.name for path in site.glob("**/*")), sep="\n")
        assert said.startswith(str(site)) and "returns" in said, said
        assert (site / "terracut/py.typed").exists()
    return 0


sys.exit(main())

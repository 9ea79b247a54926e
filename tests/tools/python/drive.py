# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The program and the drive that the tests of the module read, and what the program says of it."""

import os
import subprocess
import sys
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy of this interpreter")
    sys.exit(0)

PROGRAM = os.environ["TERRACUT_PROGRAM"]
CAPTURE = Path(os.environ["TERRACUT_DRIVE"])
CALIBRATION = CAPTURE.with_suffix(".calibration.xml")


def program(*arguments) -> subprocess.CompletedProcess:
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    words = [PROGRAM, *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, timeout=250, env=environment)


def error_of(*arguments) -> str:
    """What the program says on its error stream when it refuses."""
    outcome = program(*arguments)
    assert outcome.returncode != 0, outcome
    return next(line for line in outcome.stderr.splitlines() if line.startswith("error: "))[len("error: ") :]


def labels_of_files(folder: Path) -> list:
    return [np.fromfile(file, np.uint32) for file in sorted(folder.glob("*.label"))]


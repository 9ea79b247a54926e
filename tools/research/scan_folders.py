# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Several folders of SemanticKITTI's layout as one."""

import sys


def gather(roots, folder):
    """Makes a dataset of links: every sequence of the roots with all its frames."""
    for root in roots:
        sequences = sorted((root / "sequences").glob("*/velodyne"))
        if not sequences:
            sys.exit(f"expected {root}/sequences/NN with velodyne/ and labels/, found no such folder")
        for sequence in (path.parent for path in sequences):
            place = folder / "sequences" / sequence.name
            for kind in ("velodyne", "labels"):
                (place / kind).mkdir(parents=True, exist_ok=True)
                for file in (sequence / kind).glob("*"):
                    link(file, place / kind / file.name)
            for name in ("poses.txt", "times.txt", "calib.txt"):
                if (sequence / name).is_file():
                    link(sequence / name, place / name)
    return folder


def link(file, place):
    if not place.is_symlink():
        place.symlink_to(file.resolve())

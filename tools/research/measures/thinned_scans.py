# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Recorded scans as a sensor of fewer rows would have them."""

from array import array

RINGS = 64


def ring_starts(x, y):
    """Where the rings of a KITTI scan begin: counter-clockwise, each from straight ahead."""
    return [0, *(at for at in range(1, len(x)) if x[at] > 0 and y[at - 1] < 0 <= y[at])]


def thinned(scan, labels, one_in):
    """(PCD with rings, labels) of one row in so many of a scan's bytes, from the middle of the first ones on."""
    points, classes = array("f", scan), array("I", labels)
    starts = ring_starts(points[0::4], points[1::4])
    if len(starts) != RINGS:
        raise ValueError(f"expected a scan of {RINGS} rings, each from straight ahead, found {len(starts)}")
    ends = [*starts[1:], len(classes)]
    kept, kept_classes = array("f"), array("I")
    for ring, row in enumerate(range(one_in // 2, RINGS, one_in)):
        begin, end = starts[row], ends[row]
        fields = array("f", bytes(4 * 5 * (end - begin)))
        for field in range(4):
            fields[field::5] = points[4 * begin + field : 4 * end : 4]
        fields[4::5] = array("f", [ring]) * (end - begin)
        kept += fields
        kept_classes += classes[begin:end]
    header = "\n".join(("# .PCD v0.7", "VERSION 0.7", "FIELDS x y z intensity ring", "SIZE 4 4 4 4 4", "TYPE F F F F F",
                        "COUNT 1 1 1 1 1", f"WIDTH {len(kept_classes)}", "HEIGHT 1", "VIEWPOINT 0 0 0 1 0 0 0",
                        f"POINTS {len(kept_classes)}", "DATA binary", ""))  # fmt: skip
    return header.encode() + kept.tobytes(), kept_classes.tobytes()


def thin_folder(root, one_in, folder):
    """Writes every scan of SemanticKITTI's layout: folder/NN/velodyne/NNNNNN.pcd and labels/."""
    for scan in sorted((root / "sequences").glob("*/velodyne/*.bin")):
        sequence = scan.parent.parent
        cloud, labels = thinned(scan.read_bytes(), (sequence / "labels" / f"{scan.stem}.label").read_bytes(), one_in)
        for kind, name, content in (("velodyne", f"{scan.stem}.pcd", cloud), ("labels", f"{scan.stem}.label", labels)):
            place = folder / sequence.name / kind
            place.mkdir(parents=True, exist_ok=True)
            (place / name).write_bytes(content)
    return folder

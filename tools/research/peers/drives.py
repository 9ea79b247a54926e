# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Drives for all programs: packets for terracut, and for its peers the points decoded from them."""

import re
import struct
import sys
from array import array
from pathlib import Path

SENSOR_HEIGHT_M = 1.73  # KITTI's height, expected by all peers
CLASSES = Path(__file__).resolve().parents[1] / "datasets/semantickitti_classes.yaml"


def roles():
    """Returns {class id: ground, ordinary, key or ignored}, with every physical ground as ground."""
    entries = re.findall(r"id: (\d+),.*?\ball: (\w+)", CLASSES.read_text(encoding="utf-8"))
    return {int(number): role for number, role in entries}


def kitti_scan(pcd):
    """Returns the points of a binary PCD of `terracut replay --pcd`, in the sensor's frame, as in KITTI's .bin."""
    header, _, content = pcd.partition(b"DATA binary\n")
    if not content or b"FIELDS x y z intensity ring label\nSIZE 4 4 4 4 2 2\n" not in header:
        sys.exit("expected a binary cloud of x y z intensity ring label, as `terracut replay --pcd` writes")
    scan = array("f")
    for x_m, y_m, z_m, intensity in struct.iter_unpack("<4f4x", content):
        scan.extend((x_m, y_m, z_m - SENSOR_HEIGHT_M, intensity / 255))
    return scan.tobytes()


# The mount of every drive: the peers are told the same height.
MOUNT = ["--mount-height", SENSOR_HEIGHT_M, "--mount-roll", 0, "--mount-pitch", 0]


class Drive:
    """A capture, the truth of its returns, and its frames as scans, all in a scratch folder."""

    def __init__(self, group, name, folder):
        self.group, self.name, self.folder = group, name, folder
        self.capture = folder / "drive.pcap"
        self.calibration = folder / "drive.calibration.xml"
        self.scans, self.truth = [], []

    def take(self, program):
        """Decodes the drive once to get its points."""
        program.run("replay", self.capture, "--calibration", self.calibration, "--pcd", self.folder / "pcd",
                    *MOUNT)  # fmt: skip
        for pcd in sorted((self.folder / "pcd").glob("*.pcd")):
            scan = self.folder / f"{pcd.stem}.bin"
            scan.write_bytes(kitti_scan(pcd.read_bytes()))
            pcd.unlink()
            self.scans.append(scan)
            self.truth.append(self.folder / "drive.truth" / f"{pcd.stem}.label")

    def score(self, labels, role_of):
        """Returns (IoU_g, Recall_o) of the labels NNNNNN.label in a folder; None if a label is missing."""
        counts = {}
        for number, truth_file in enumerate(self.truth):
            written = labels / f"{number:06}.label"
            if not written.is_file():
                return (None, None)
            truth, found = array("I", truth_file.read_bytes()), array("I", written.read_bytes())
            if len(truth) != len(found):
                sys.exit(f"{written}: {len(found)} labels for the {len(truth)} points of {truth_file}")
            for true, label in zip(truth, found):
                counts[true & 0xFFFF, label & 0xFFFF] = counts.get((true & 0xFFFF, label & 0xFFFF), 0) + 1
        return score_of(counts, role_of)


def score_of(counts, role_of):
    """Returns (IoU_g, Recall_o) of {(true class, label): points}; None without ground or key obstacles."""
    def points(wanted, called_ground):
        return sum(number for (true, label), number in counts.items()
                   if role_of.get(true, "ignored") in wanted and (role_of.get(label) == "ground") == called_ground)  # fmt: skip

    called = points(("ground", "ordinary", "key"), True)
    met = called + points(("ground",), False)
    found, key = points(("key",), False), points(("key",), True)
    key += found
    return (points(("ground",), True) / met if met else None, found / key if key else None)


def recorded(program, root, scratch):
    """Returns the sequences below a SemanticKITTI root, encoded as packets with their motion restored."""
    drives = []
    for sequence in sorted((root / "sequences").glob("*")):
        if not any((sequence / "labels").glob("*.label")):
            continue
        drive = Drive("recorded", f"{root.name}/{sequence.name}", scratch / root.name / sequence.name)
        drive.folder.mkdir(parents=True)
        program.run("encode", sequence, "-o", drive.capture)
        drive.take(program)
        drives.append(drive)
    if not drives:
        sys.exit(f"expected {root}/sequences/NN with velodyne/ and labels/, found no such folder")
    return drives


def simulated(program, scene, duration_s, scratch):
    drive = Drive("simulated", scene, scratch / "simulated" / scene)
    drive.folder.mkdir(parents=True)
    program.run("simulate", "--scene", scene, "--seed", 1, "--duration", duration_s, "-o", drive.capture)
    drive.take(program)
    return drive

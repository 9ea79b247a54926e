# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Labelled scans as SemanticKITTI has them, of flat ground with cars close by and walls around it."""

import math
import struct
from pathlib import Path

GROUND, CAR, WALL = 40, 10, 50  # SemanticKITTI's classes
HEIGHT_M = 1.73
POINTS_A_RING = 1500
SCANS = 10  # a second


def rings():
    """(elevation, height of its origin) of an HDL-64E's lasers, from the top; radians, metres."""
    for ring in range(64):
        elevation_deg = 2.0 - ring / 3.0 if ring < 32 else -8.9 - (ring - 32) * 0.51
        yield math.radians(elevation_deg), 0.2 if ring < 32 else 0.12


def scan() -> tuple[bytes, bytes]:
    """One revolution: points and labels, in KITTI's order."""
    points, labels = bytearray(), bytearray()
    for elevation_rad, origin_m in rings():
        slope = math.tan(elevation_rad)
        ground_m = (-HEIGHT_M - origin_m) / slope if slope < 0 else math.inf
        for i in range(POINTS_A_RING):
            azimuth = math.radians(0.05 + 360 * i / POINTS_A_RING)
            wall_m = 27 + 21 * math.sin(5 * azimuth) * math.cos(2 * azimuth)
            car_m = 3.1 if math.sin(11 * azimuth) > 0.6 else math.inf  # so that every laser sees several distances
            away_m, label = min((ground_m, GROUND), (car_m, CAR), (wall_m, WALL))
            points += struct.pack("<4f", away_m * math.cos(azimuth), away_m * math.sin(azimuth), origin_m + away_m * slope, 0.3)
            labels += struct.pack("<I", label)
    return bytes(points), bytes(labels)


def write_sequence(folder: Path):
    """`folder` as sequences/NN of SemanticKITTI."""
    points, labels = scan()
    for name, ending, data in (("velodyne", "bin", points), ("labels", "label", labels)):
        (folder / name).mkdir(parents=True)
        for number in range(SCANS):
            (folder / name / f"{number:06}.{ending}").write_bytes(data)

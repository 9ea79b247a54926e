# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A frame of write_pcd() as a KITTI scan: rings from the top, each counter-clockwise from straight ahead.

scan_of_pcd.py FRAME.pcd SCAN.bin
"""

import math
import struct
import sys

MOUNT_HEIGHT_M = 1.73  # of the simulator and of the consumer programs


def main() -> None:
    content = open(sys.argv[1], "rb").read()
    records = content[content.index(b"DATA binary\n") + len(b"DATA binary\n") :]
    points = list(struct.iter_unpack("<ffffHH", records))
    points.sort(key=lambda p: (-p[4], math.atan2(p[1], p[0]) % (2 * math.pi)))
    with open(sys.argv[2], "wb") as scan:
        for x_m, y_m, z_m, intensity, _, _ in points:
            scan.write(struct.pack("<ffff", x_m, y_m, z_m - MOUNT_HEIGHT_M, intensity / 255))


main()

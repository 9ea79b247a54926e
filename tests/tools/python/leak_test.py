# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Ten thousand frames leave nothing behind: neither memory of C++ nor objects of Python. Reports the speed, too."""

import gc
import sys
import tempfile
import time
import unittest
from pathlib import Path

from drive import CALIBRATION, CAPTURE, program

import terracut

FRAMES = 10_000


def resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def replay_once(capture: Path) -> int:
    count = 0
    for frame in terracut.replay(capture, mount_height=1.73, mount_roll=0, mount_pitch=0):
        count += len(frame.points) > 0
        _ = frame.labels.sum(), frame.report["losses"]
    return count


class Memory(unittest.TestCase):
    def test_ten_thousand_frames_leave_nothing_behind(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        capture = Path(folder.name) / "vlp16.pcap"  # small frames: an HDL-64E's took minutes
        self.assertEqual(program("simulate", "--sensor", "vlp16", "-o", capture).returncode, 0)
        frames = 0
        while frames < FRAMES // 20:
            frames += replay_once(capture)
        gc.collect()
        resident, blocks = resident_bytes(), sys.getallocatedblocks()
        while frames < FRAMES:
            frames += replay_once(capture)
        gc.collect()
        grown_bytes, grown_blocks = resident_bytes() - resident, sys.getallocatedblocks() - blocks
        print(f"{frames} frames: {grown_bytes / 1e6:+.1f} MB resident, {grown_blocks:+d} blocks of Python's")
        self.assertLess(grown_bytes, 20_000_000)  # a frame has 0.35 MB, and a hundredth of one each would be 35
        self.assertLess(grown_blocks, 1000)

    def test_speed_beside_the_program(self):
        ours, programs = [], []
        for _ in range(5):
            begun = time.perf_counter()
            for _ in terracut.replay(CAPTURE, CALIBRATION):
                pass
            ours.append(time.perf_counter() - begun)
            begun = time.perf_counter()
            self.assertEqual(program("replay", CAPTURE, "--calibration", CALIBRATION).returncode, 0)
            programs.append(time.perf_counter() - begun)
        print(f"replay: Python {min(ours):.3f} s, program {min(programs):.3f} s, {min(programs) / min(ours):.2f} times as fast")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

from drive import CAPTURE

EXAMPLE = Path(__file__).resolve().parents[3] / "tools/examples/labels_in_numpy.py"


class Example(unittest.TestCase):
    def test_says_what_every_frame_holds_and_labels_its_points_as_a_cloud(self):
        done = subprocess.run([sys.executable, EXAMPLE, CAPTURE], capture_output=True, text=True, env=os.environ, timeout=250)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^frame 3: \d+ returns, \d+\.\d% obstacle, nearest ahead \d+\.\d m$")
        self.assertRegex(done.stdout, r"(?m)^\d+ frames, p99 of all work \d")
        same = float(re.search(r"as a cloud: ([\d.]+)%", done.stdout)[1])
        self.assertGreater(same, 95)


if __name__ == "__main__":
    unittest.main()

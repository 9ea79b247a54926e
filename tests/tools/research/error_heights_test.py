# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/error_heights says of a frame made up here: a plane with a hedge's foot and a car."""
import importlib.util
import subprocess
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: this Python has no numpy (./tools/setup installs it for the distribution's)")
    sys.exit()

PATH = Path(__file__).resolve().parents[3] / "tools/error_heights"
loader = SourceFileLoader("error_heights", str(PATH))
tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("error_heights", loader))
loader.exec_module(tool)

TERRAIN, VEGETATION, CAR, UNLABELLED = 72, 70, 10, 0
GROUND, OBSTACLE = 40, 99


def plane():
    """Ground that rises by 0.1 in x, a return every 0.2 m over 10 m by 10 m, 1.73 m below the sensor."""
    x, y = np.meshgrid(np.arange(0, 10, 0.2), np.arange(0, 10, 0.2))
    return np.column_stack([x.ravel(), y.ravel(), 0.1 * x.ravel() - 1.73, 0 * x.ravel()])


def above_ground(x, y, height_m):
    return np.array([[x, y, 0.1 * x - 1.73 + height_m, 0]])


class TrueGround(unittest.TestCase):
    def test_it_is_the_ground_of_the_square_of_half_a_metre(self):
        points = np.vstack([plane(), above_ground(5.25, 5.25, 1.0)])
        below_m = tool.true_ground_m(points, np.arange(len(points)) < len(points) - 1)
        self.assertAlmostEqual(points[-1, 2] - below_m[-1], 1.0, delta=0.03)

    def test_it_is_that_around_where_a_square_has_none_and_unknown_farther_away(self):
        points = np.vstack([plane(), above_ground(11.2, 5.25, 1.0), above_ground(15, 5.25, 1.0)])
        below_m = tool.true_ground_m(points, np.arange(len(points)) < len(points) - 2)
        self.assertAlmostEqual(points[-2, 2] - below_m[-2], 1.0, delta=0.2)
        self.assertTrue(np.isnan(below_m[-1]))


class Errors(unittest.TestCase):
    def setUp(self):
        ground = plane()
        others = [above_ground(5.1, 5.1, 0.10), above_ground(5.1, 5.1, 0.60), above_ground(7.1, 7.1, 0.02),
                  above_ground(7.1, 7.1, 0.03)]  # fmt: skip
        self.points = np.vstack([ground, *others])
        self.truth = np.array([TERRAIN] * len(ground) + [VEGETATION, VEGETATION, CAR, UNLABELLED])
        self.predicted = np.array([GROUND] * len(ground) + [GROUND, OBSTACLE, GROUND, GROUND])
        self.predicted[:25] = OBSTACLE  # of 2500
        self.errors = tool.Errors()
        self.errors.add("00", self.points, self.truth, self.predicted)

    def test_wrong_labels_are_counted_by_class_and_height(self):
        below_5_cm, to_15_cm = 0, 1
        self.assertEqual(self.errors.wrong["terrain"], {below_5_cm: 25})
        self.assertEqual(self.errors.wrong["vegetation"], {to_15_cm: 1})
        self.assertEqual(self.errors.wrong["key obstacle"], {below_5_cm: 1})
        self.assertEqual(len(self.errors.wrong), 3, "unlabelled returns count nowhere")

    def test_labels_are_judged_as_eval_does(self):
        labels = self.errors.judged["these labels"]["00"]
        self.assertAlmostEqual(labels.iou_g(), 2475 / (2500 + 2))
        self.assertEqual(labels.recall_o(), 0)

    def test_the_oracle_calls_ground_what_is_low_enough(self):
        def iou_g(limit):
            return self.errors.judged[f"below {limit} m"]["00"].iou_g()

        self.assertAlmostEqual(iou_g("0.08"), 2500 / (2500 + 1))  # the car's lowest return
        self.assertAlmostEqual(iou_g("0.15"), 2500 / (2500 + 2))  # and the hedge's


class Program(unittest.TestCase):
    def test_labels_without_a_scan_are_named_and_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "sequences/00/predictions/000000.label"
            file.parent.mkdir(parents=True)
            file.write_bytes(b"\0\0\0\0")
            run = subprocess.run([sys.executable, str(PATH), folder, folder], capture_output=True, text=True)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("sequence 00, frame 000000: no scan and labels in", run.stderr)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
import tempfile
import threading
import unittest
from pathlib import Path

from drive import CAPTURE, labels_of_files, program

import numpy as np
import terracut

MOUNT_HEIGHT = 1.73


class Clouds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        frame = next(terracut.replay(CAPTURE, mount_height=MOUNT_HEIGHT, mount_roll=0, mount_pitch=0))
        cls.ring = frame.ring.copy()
        cls.points = np.zeros((len(frame), 4), np.float32)
        cls.points[:, :3] = frame.points
        cls.points[:, 2] -= MOUNT_HEIGHT
        cls.labels = terracut.Segmenter()(cls.points, cls.ring)
        cls.of_frame = frame.labels.copy()

    def test_labels_are_those_of_segment(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "scans").mkdir()
            self.points.tofile(Path(folder) / "scans" / "000000.bin")
            outcome = program(
                "segment", Path(folder) / "scans", "--labels", Path(folder) / "labels",
                "--mount-height", MOUNT_HEIGHT, "--mount-roll", 0, "--mount-pitch", 0,
            )  # fmt: skip
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            (wanted,) = labels_of_files(Path(folder) / "labels")
        np.testing.assert_array_equal(terracut.Segmenter()(self.points), wanted)

    def test_a_labelled_cloud_is_much_as_its_packets_are(self):
        self.assertEqual(set(np.unique(self.labels)), {terracut.GROUND, terracut.OBSTACLE})
        self.assertGreater(np.mean(self.labels == self.of_frame), 0.97)

    def test_every_layout_of_the_same_points_gives_the_same_labels(self):
        wide = np.zeros((len(self.points), 7), np.float64)
        wide[:, :4] = self.points
        twice = np.repeat(self.points, 2, axis=0)
        layouts = {
            "(N, 3)": self.points[:, :3],
            "float64": wide,
            "columns first": np.asfortranarray(self.points),
            "every other row": twice[::2],
            "backwards": self.points[::-1].copy()[::-1],
            "turned over": self.points.T.copy().T,
            "read only": np.frombuffer(self.points.tobytes(), np.float32).reshape(-1, 4),
        }
        for name, layout in layouts.items():
            np.testing.assert_array_equal(terracut.Segmenter()(layout, self.ring), self.labels, name)

    def test_every_point_has_a_height_above_the_ground_where_heights_are_asked_for(self):
        segmenter = terracut.Segmenter(heights=True)
        points = self.points.copy()
        points[5, :3] = 0  # no return
        labels = segmenter(points, self.ring)
        heights = segmenter.height_above_ground_m
        self.assertEqual((heights.shape, heights.dtype), (labels.shape, np.float32))
        np.testing.assert_array_equal(np.isnan(heights), labels == terracut.NONE)
        self.assertLess(np.median(np.abs(heights[labels == terracut.GROUND])), 0.03)
        self.assertGreater(np.median(heights[labels == terracut.OBSTACLE]), 0.3)
        segmenter(points[:, :3], self.ring)
        self.assertIsNot(segmenter.height_above_ground_m, heights)
        without = terracut.Segmenter()
        np.testing.assert_array_equal(without(points, self.ring), labels)
        self.assertIsNone(without.height_above_ground_m)

    def test_records_with_a_ring_say_it_themselves(self):
        types = [("intensity", "u1"), ("ring", "<u2"), ("x", "<f8"), ("z", "<f4"), ("y", "<f4"), ("name", "S3")]
        records = np.zeros(len(self.points), types)
        for column, name in enumerate("xyz"):
            records[name] = self.points[:, column]
        records["ring"] = self.ring
        np.testing.assert_array_equal(terracut.Segmenter()(records), self.labels)
        with self.assertRaisesRegex(ValueError, "ring"):
            terracut.Segmenter()(records, self.ring)
        with self.assertRaisesRegex(terracut.Error, "no field x, y or z"):
            terracut.Segmenter()(records[["x", "y"]])

    def test_an_organised_cloud_has_labels_of_its_shape(self):
        columns = 1800
        cloud = np.full((64, columns, 3), np.nan, np.float32)
        angles = np.arctan2(self.points[:, 1], self.points[:, 0])
        at = ((np.pi - angles) / (2 * np.pi) * columns).astype(int) % columns
        cloud[63 - self.ring, at] = self.points[:, :3]
        labels = terracut.Segmenter()(cloud)
        self.assertEqual(labels.shape, (64, columns))
        np.testing.assert_array_equal(labels == terracut.NONE, np.isnan(cloud[:, :, 0]))
        segmenter = terracut.Segmenter(heights=True)
        np.testing.assert_array_equal(segmenter(cloud), labels)
        self.assertEqual(segmenter.height_above_ground_m.shape, (64, columns))

    def test_clouds_have_objects_where_these_are_asked_for(self):
        segmenter = terracut.Segmenter(objects=True)
        labels = segmenter(self.points, self.ring)
        np.testing.assert_array_equal(labels, self.labels)
        numbers, objects = segmenter.object_numbers, segmenter.objects
        self.assertGreater(len(objects), 10)
        self.assertEqual(numbers.shape, labels.shape)
        self.assertEqual(numbers.max(), len(objects))
        np.testing.assert_array_equal(np.bincount(numbers)[1:], objects["returns"])
        self.assertTrue((labels[numbers > 0] == terracut.OBSTACLE).all())
        self.assertIsNone(terracut.Segmenter().objects)

    def test_clouds_have_their_free_way_where_it_is_asked_for(self):
        segmenter = terracut.Segmenter(free_way=True)
        np.testing.assert_array_equal(segmenter(self.points, self.ring), self.labels)
        way = segmenter.free_way
        self.assertGreater(len(way), 300)
        self.assertGreater(np.median(way["seen_m"]), 4)
        self.assertTrue(np.isfinite(way["obstacle_m"]).any())
        self.assertIsNone(terracut.Segmenter().free_way)

    def test_points_that_are_no_return_get_none(self):
        points = self.points.copy()
        points[10] = np.nan
        points[20, 1] = np.inf
        points[30] = 0
        labels = terracut.Segmenter()(points, self.ring)
        np.testing.assert_array_equal(np.flatnonzero(labels == terracut.NONE), [10, 20, 30])
        with self.assertRaises(terracut.Error):
            terracut.Segmenter()(np.full((1000, 3), np.nan, np.float32))

    def test_no_points_give_no_labels(self):
        segmenter = terracut.Segmenter()
        self.assertEqual(segmenter(np.zeros((0, 3), np.float32)).shape, (0,))
        self.assertEqual(segmenter(np.zeros((0, 64, 4), np.float32)).shape, (0, 64))
        np.testing.assert_array_equal(segmenter(self.points, self.ring), self.labels)

    def test_one_segmenter_serves_several_threads(self):
        segmenter, same = terracut.Segmenter(), []

        def label():
            for _ in range(4):
                same.append(np.array_equal(segmenter(self.points, self.ring), self.labels))

        threads = [threading.Thread(target=label) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(same, [True] * 12)

    def test_parameters_and_profile_change_the_method(self):
        paper = terracut.Segmenter(profile="paper")(self.points, self.ring)
        self.assertFalse(np.array_equal(paper, self.labels))
        lower = terracut.Segmenter(parameters={"elevation_map.obstacle_height_m": 1.5})(self.points, self.ring)
        self.assertLess(np.sum(lower == terracut.OBSTACLE), np.sum(self.labels == terracut.OBSTACLE))

    def test_the_mount_is_found_where_that_is_asked_for(self):
        self.assertIsNone(terracut.Segmenter().found_mount)
        segmenter = terracut.Segmenter(find_mount=True)
        self.assertIsNone(segmenter.found_mount)
        segmenter(self.points, self.ring)
        found = segmenter.found_mount
        self.assertAlmostEqual(found["height_m"], MOUNT_HEIGHT, delta=0.05)
        self.assertEqual(set(found), {"height_m", "roll_deg", "pitch_deg", "uncertainty", "found_in_frames"})
        self.assertLess(found["uncertainty"]["roll_deg"], 2)
        self.assertEqual(found["found_in_frames"], 1)

    def test_the_module_shows_what_it_is_for_and_nothing_else(self):
        self.assertEqual(sorted(dir(terracut)), sorted(terracut.__all__))


class Refusals(unittest.TestCase):
    def check(self, exception, words, points, laser=None):
        with self.assertRaises(exception) as raised:
            terracut.Segmenter()(points, laser)
        self.assertIn(words, str(raised.exception))

    def test_wrong_types_say_what_was_expected(self):
        self.check(TypeError, "expected float32 or float64, found int64", np.zeros((9, 3), np.int64))
        self.check(TypeError, "expected float32 or float64, found >f4", np.zeros((9, 3), ">f4"))
        self.check(TypeError, "expected float32 or float64, found object", [[1, 2, None]])
        self.check(TypeError, "expected float32 or float64, found <U3", "abc")
        self.check(TypeError, "expected float32 or float64, found complex", np.zeros((9, 3), np.complex64))
        self.check(TypeError, "laser: expected integers", np.ones((9, 3)), np.ones(9))

    def test_records_of_no_bytes_are_refused(self):
        for shape in (5, (2, 3)):
            self.check(ValueError, "records of no bytes", np.zeros(shape, [("x", "V0"), ("y", "V0"), ("z", "V0")]))
        self.check(ValueError, "records of no bytes", np.zeros(5, []))

    def test_wrong_shapes_say_what_was_expected(self):
        for shape in ((9,), (9, 2), (), (2, 2, 2, 3), (3, 9, 2)):
            self.check(ValueError, "expected (N, 3) or more columns", np.zeros(shape, np.float32))
        self.check(ValueError, "one number a point, 9", np.ones((9, 3)), np.ones(8, int))
        self.check(ValueError, "expected 0 to 255, found 256", np.ones((9, 3)), np.full(9, 256))
        self.check(ValueError, "expected 0 to 255, found -1", np.ones((9, 3)), np.full(9, -1))

    def test_clouds_that_show_no_lasers_are_refused_in_the_librarys_words(self):
        with self.assertRaises(terracut.Error) as raised:
            terracut.Segmenter()(np.random.default_rng(1).normal(size=(500, 3)))
        self.assertIn(raised.exception.code, ("unsupported", "malformed"))

    def test_wrong_settings(self):
        with self.assertRaisesRegex(terracut.InvalidArgument, "unknown|no parameter|nonsense"):
            terracut.Segmenter(parameters={"nonsense": 1})
        with self.assertRaisesRegex(terracut.InvalidArgument, "pfaff.cell_m"):
            terracut.Segmenter(parameters={"pfaff.cell_m": 0.5})
        with self.assertRaisesRegex(ValueError, "'terracut' or 'paper'"):
            terracut.Segmenter(profile="best")
        with self.assertRaises(terracut.InvalidArgument):
            terracut.Segmenter(mount_height=-3)


if __name__ == "__main__":
    unittest.main()

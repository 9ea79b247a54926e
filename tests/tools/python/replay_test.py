# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
import gc
import json
import pickle
import sys
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path

from drive import CALIBRATION, CAPTURE, error_of, labels_of_files, program

import numpy as np
import terracut

sys.path.append(str(Path(__file__).parents[1] / "cli" / "bag"))
import bag_files  # noqa: E402


class Replay(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_labels_equal_the_programs_on_every_frame(self):
        report = self.folder / "report.json"
        outcome = program("replay", CAPTURE, "--labels", self.folder / "labels", "--json", report)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        wanted = labels_of_files(self.folder / "labels")
        replay = terracut.replay(CAPTURE)
        frames = list(replay)
        self.assertGreater(len(wanted), 10)
        self.assertEqual(len(frames), len(wanted))
        for frame, labels in zip(frames, wanted):
            np.testing.assert_array_equal(frame.labels, labels)

        said, ours = json.loads(report.read_text()), replay.report()
        for key in ("calibration", "sensor", "profile", "stages"):
            self.assertEqual(ours[key], said[key])
        for key in ("frames", "complete_frames", "returns_in", "returns_labelled", "losses", "mount"):
            self.assertEqual(ours["summary"][key], said["summary"][key])
        self.assertEqual(frames[3].report["returns_in"], said["frames"][3]["returns_in"])
        self.assertIn("min_cut", frames[3].report["ms"])

    def test_settings_are_the_programs(self):
        given = ["--profile", "paper", "--set", "surface.interpolate_sectors=8", "--mount-pitch", "-0.5", "--duration", "0.4"]
        outcome = program("replay", CAPTURE, "--calibration", CALIBRATION, *given, "--labels", self.folder / "labels")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        frames = terracut.replay(
            CAPTURE,
            CALIBRATION,
            profile="paper",
            parameters={"surface.interpolate_sectors": 8},
            mount_pitch=-0.5,
            duration=0.4,
        )
        wanted = labels_of_files(self.folder / "labels")
        for frame, labels in zip(frames, wanted, strict=True):
            np.testing.assert_array_equal(frame.labels, labels)

    def test_returns_have_heights_above_the_ground_where_these_are_asked_for(self):
        without, frames = terracut.replay(CAPTURE), terracut.replay(CAPTURE, heights=True)
        for frame, plain in zip(frames, without, strict=True):
            heights = frame.height_above_ground_m
            self.assertEqual((heights.shape, heights.dtype), ((len(frame),), np.float32))
            self.assertTrue(np.isfinite(heights).all())
            self.assertIsNone(plain.height_above_ground_m)
            np.testing.assert_array_equal(frame.labels, plain.labels)
            np.testing.assert_array_equal(frame.data, plain.data)
        ground = np.abs(heights[frame.labels == terracut.GROUND])
        self.assertLess(np.percentile(ground, 90), 0.08)
        self.assertGreater(np.median(heights[frame.labels == terracut.OBSTACLE]), 0.3)
        del frame, plain
        self.assertGreater(heights.max(), 1)  # the array keeps its memory

    def test_frames_have_objects_where_these_are_asked_for(self):
        outcome = program("replay", CAPTURE, "--objects", "--duration", "0.3", "--labels", self.folder / "labels")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        files = sorted((self.folder / "labels").glob("*.label"))
        frames = list(terracut.replay(CAPTURE, objects=True, duration=0.3))
        self.assertEqual(len(frames), len(files))
        for frame, file in zip(frames, files):
            np.testing.assert_array_equal(frame.object_numbers, np.fromfile(file, np.uint32) >> 16)
            objects, numbers = frame.objects, frame.object_numbers
            self.assertGreater(len(objects), 10)
            self.assertEqual(numbers.max(), len(objects))
            np.testing.assert_array_equal(np.bincount(numbers)[1:], objects["returns"])
            self.assertTrue((frame.labels[numbers > 0] == terracut.OBSTACLE).all())
            nearest = frame.points[objects["first_return"]][:, :2] - np.stack([objects["x_m"], objects["y_m"]], 1)
            reach = np.hypot(objects["length_m"], objects["width_m"]) / 2
            self.assertTrue((np.linalg.norm(nearest, axis=1) <= reach + 1).all())
            self.assertLessEqual(objects["corner_count"].max(), 16)
        self.assertIsNone(next(terracut.replay(CAPTURE)).objects)
        del frame
        gc.collect()
        self.assertGreater(objects["top_m"].max(), 1)  # the array keeps its memory

    def test_frames_have_their_free_way_where_it_is_asked_for(self):
        frame = next(terracut.replay(CAPTURE, free_way=True))
        way = frame.free_way
        self.assertIsNone(frame.objects)
        self.assertEqual(frame.height_above_ground_m.shape, frame.labels.shape)
        self.assertEqual(way.shape, (720,))
        self.assertTrue((np.abs(way["azimuth_rad"]) <= np.pi).all())
        self.assertTrue((np.diff(np.unwrap(way["azimuth_rad"])) < 0).all())  # clockwise
        self.assertAlmostEqual(way["azimuth_rad"][0], 0, delta=0.01)
        ends = np.bincount(way["seen_end"], minlength=len(terracut.SEEN_ENDS))
        self.assertEqual(len(ends), len(terracut.SEEN_ENDS))
        self.assertGreater(np.median(way["seen_m"]), 4)
        # The nearest obstacle of each sector is a return of an obstacle there.
        stands = frame.points[frame.labels == terracut.OBSTACLE]
        away, azimuth = np.hypot(stands[:, 0], stands[:, 1]), np.arctan2(stands[:, 1], stands[:, 0])
        for sector in way[np.isfinite(way["obstacle_m"])][::20]:
            aside = np.abs(np.angle(np.exp(1j * (azimuth - sector["azimuth_rad"]))))
            self.assertLess(np.abs(away[aside < 0.02] - sector["obstacle_m"]).min(), 0.01)
        self.assertIsNone(next(terracut.replay(CAPTURE)).free_way)
        del frame
        gc.collect()
        self.assertGreater(way["seen_m"].max(), 1)  # the array keeps its memory

    def test_arrays_are_views_of_one_memory_that_they_keep(self):
        replay = terracut.replay(CAPTURE)
        frame = next(replay)
        columns = {"points": 3, "intensity": 1, "labels": 1, "ring": 1, "time": 1}
        for name in columns:
            array = getattr(frame, name)
            self.assertFalse(array.flags.owndata, name)
            self.assertTrue(np.shares_memory(array, frame.data), name)
            self.assertEqual(len(array), len(frame))
        np.testing.assert_array_equal(frame.points[:, 2], frame.data["z"])
        np.testing.assert_array_equal(frame.ring, frame.data["ring"])
        self.assertLess(frame.ring.max(), 64)
        whole = next(replay)
        self.assertLess(whole.time.max(), (whole.last_packet_ns - whole.first_packet_ns) / 1e9 + 0.01)
        # Of one laser the returns come one after the other.
        self.assertTrue(np.all(np.diff(whole.time[whole.ring == 20]) >= 0))
        self.assertGreater(whole.time.max(), 0.08)

        labels, before = frame.labels, frame.labels.copy()
        del frame
        gc.collect()
        for _ in replay:
            pass
        np.testing.assert_array_equal(labels, before)

    def test_memory_of_a_frame_that_was_dropped_is_used_again(self):
        seen = {frame.data.ctypes.data for frame in terracut.replay(CAPTURE)}
        self.assertLessEqual(len(seen), 4)

    def test_other_threads_run_while_it_works(self):
        turns, is_over = [], threading.Event()

        def count():
            while not is_over.is_set():
                turns.append(None)
                time.sleep(0.0002)

        replay = terracut.replay(CAPTURE)
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # from here on a thread runs only where another one lets it
        counter = threading.Thread(target=count)
        try:
            counter.start()
            turns_during = 0
            while True:
                before = len(turns)
                frame = next(replay, None)
                turns_during += len(turns) - before
                if frame is None:
                    break
        finally:
            is_over.set()
            sys.setswitchinterval(interval)
            counter.join()
        self.assertGreater(turns_during, 0)

    def test_threads_may_share_a_replay(self):
        replay, numbers = terracut.replay(CAPTURE), []
        threads = [threading.Thread(target=lambda: numbers.extend(f.number for f in replay)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(numbers), list(range(len(numbers))))
        self.assertGreater(len(numbers), 10)

    def test_a_capture_that_breaks_off_warns_and_gives_what_there_is(self):
        cut = self.folder / "cut.pcap"
        whole = CAPTURE.read_bytes()
        cut.write_bytes(whole[: len(whole) * 2 // 3])
        replay = terracut.replay(cut, CALIBRATION)
        with self.assertWarnsRegex(terracut.TerracutWarning, "cut.pcap"):
            frames = list(replay)
        self.assertGreater(len(frames), 5)
        self.assertIn("cut.pcap", replay.report()["input_warning"])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(terracut.TerracutWarning):
                list(terracut.replay(cut, CALIBRATION))


class Bags(unittest.TestCase):
    def test_packets_of_a_bag_are_labelled_as_the_captures(self):
        packets = bag_files.packets_of(CAPTURE)
        scans = [packets[i : i + 348] for i in range(0, len(packets), 348)]
        messages = [(0, scan[0][0], bag_files.velodyne_scan(scan)) for scan in scans]
        topics = [("/packets", "velodyne_msgs/msg/VelodyneScan"), ("/others", "velodyne_msgs/msg/VelodyneScan")]
        with tempfile.TemporaryDirectory() as folder:
            bag = Path(folder) / "drive.mcap"
            bag_files.write_mcap(bag, topics, messages)
            with self.assertRaisesRegex(terracut.InvalidArgument, "choose one by --topic: /packets"):
                terracut.replay(bag, CALIBRATION)
            for frame, same in zip(terracut.replay(bag, CALIBRATION, topic="/packets"), terracut.replay(CAPTURE), strict=True):
                np.testing.assert_array_equal(frame.labels, same.labels)


class Refusals(unittest.TestCase):
    def check_words(self, exception, code, call, *arguments):
        """`call` raises what the program says when it is given `arguments`."""
        with self.assertRaises(exception) as raised:
            call()
        self.assertEqual(str(raised.exception), error_of(*arguments))
        self.assertEqual(raised.exception.code, code)
        self.assertIsInstance(raised.exception, terracut.Error)
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual((type(again), str(again), again.code), (exception, str(raised.exception), code))

    def test_no_such_file(self):
        self.check_words(
            terracut.NotFound, "not_found", lambda: terracut.replay("nothere.pcap"), "replay", "nothere.pcap"
        )
        self.assertTrue(issubclass(terracut.NotFound, FileNotFoundError))

    def test_a_number_out_of_its_range(self):
        self.check_words(
            terracut.InvalidArgument,
            "invalid_argument",
            lambda: terracut.replay(CAPTURE, mount_height=99),
            "replay", CAPTURE, "--mount-height", "99",
        )  # fmt: skip
        self.assertTrue(issubclass(terracut.InvalidArgument, ValueError))

    def test_a_parameter_that_there_is_not(self):
        self.check_words(
            terracut.InvalidArgument,
            "invalid_argument",
            lambda: terracut.replay(CAPTURE, parameters={"surface.nonsense": 1}),
            "replay", CAPTURE, "--set", "surface.nonsense=1",
        )  # fmt: skip

    def test_what_is_no_capture(self):
        self.check_words(
            terracut.Error, "malformed", lambda: terracut.replay(CALIBRATION), "replay", CALIBRATION
        )

    def test_a_setting_that_there_is_not(self):
        with self.assertRaisesRegex(TypeError, "mount_heigth"):
            terracut.replay(CAPTURE, mount_heigth=2)


class Parameters(unittest.TestCase):
    def test_are_those_the_program_prints(self):
        printed = program("parameters").stdout
        listed = terracut.parameters()
        self.assertGreater(len(listed), 20)
        for parameter in listed:
            self.assertIn(f"`{parameter['key']}`", printed)
            self.assertTrue(("range" in parameter) != ("choices" in parameter))


if __name__ == "__main__":
    unittest.main()

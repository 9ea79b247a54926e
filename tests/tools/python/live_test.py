# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
import os
import signal
import socket
import subprocess
import threading
import unittest

from drive import CALIBRATION, CAPTURE, PROGRAM, error_of

import numpy as np
import terracut


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Live(unittest.TestCase):
    def setUp(self):
        self.address = f"127.0.0.1:{free_port()}"

    def be_the_sensor(self):
        environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        sensor = subprocess.Popen(
            [PROGRAM, "send", CAPTURE, "--to", self.address, "--loop"],
            env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self.addCleanup(sensor.wait)
        self.addCleanup(sensor.kill)

    def test_frames_come_labelled_until_the_block_ends(self):
        self.be_the_sensor()
        with terracut.live(self.address, CALIBRATION, deadline=1000, lock_memory=False) as frames:
            taken = [frame for frame, _ in zip(frames, range(5))]
        numbers = [frame.number for frame in taken]
        self.assertEqual(len(numbers), 5)
        self.assertEqual(numbers, sorted(set(numbers)))
        # A busy machine loses packets: no frame need be whole.
        self.assertGreater(sum(len(frame) for frame in taken), 10_000)
        for frame in taken:
            self.assertLessEqual(set(np.unique(frame.labels)), {terracut.GROUND, terracut.OBSTACLE})
            self.assertGreater(frame.last_packet_ns, frame.first_packet_ns)
        figures = frames.figures()
        self.assertGreaterEqual(figures["frames"], 5)
        self.assertGreater(figures["decoded"], 1000)

    def test_a_loop_that_is_too_slow_misses_the_oldest_frames_which_are_counted(self):
        self.be_the_sensor()
        with terracut.live(self.address, CALIBRATION, deadline=1000, lock_memory=False) as frames:
            first = next(frames)
            while frames.figures()["frames_left_out"] == 0:
                threading.Event().wait(0.01)
        waiting = list(frames)
        self.assertGreater(waiting[0].number, first.number + 1)
        self.assertLessEqual(len(waiting), 4)

    def test_sectors_come_one_after_the_other_and_make_up_their_frames(self):
        self.be_the_sensor()
        with terracut.live(self.address, CALIBRATION, deadline=1000, lock_memory=False, sectors=True, heights=True) as sectors:
            taken = [sector for sector, _ in zip(sectors, range(300))]
        places = [(sector.number, sector.first_return) for sector in taken]
        self.assertEqual(places, sorted(set(places)))
        self.assertGreater(len({number for number, _ in places}), 1)
        follow = sum(
            before.number == after.number and before.first_return + len(before) == after.first_return
            for before, after in zip(taken, taken[1:])
        )
        self.assertGreater(follow, 100)
        self.assertLessEqual({*np.unique(taken[0].labels)}, {terracut.GROUND, terracut.OBSTACLE})
        for sector in taken:
            self.assertEqual(sector.height_above_ground_m.shape, sector.labels.shape)
            self.assertTrue(np.isfinite(sector.height_above_ground_m).all())
        self.assertGreaterEqual(sectors.figures()["sectors"], 300)

    def test_sectors_have_the_objects_that_are_complete(self):
        self.be_the_sensor()
        with terracut.live(self.address, CALIBRATION, deadline=1000, lock_memory=False, sectors=True, objects=True) as sectors:
            taken = [sector for sector, _ in zip(sectors, range(400))]
        found = [(found["frame"], found["last_return"]) for sector in taken for found in sector.objects]
        self.assertGreater(len(found), 30)
        self.assertEqual(len(found), len(set(found)))
        for sector in taken:
            self.assertIsNone(sector.object_numbers)
            self.assertLessEqual({*sector.objects["frame"]}, {sector.number - 1, sector.number})
            # The last firings of a turn and the first of the next come at the same time.
            waits_ns = sector.last_packet_ns - sector.objects["last_packet_ns"]
            self.assertTrue((abs(waits_ns) < 100_000_000).all())

    def test_frames_have_objects_where_these_are_asked_for(self):
        self.be_the_sensor()
        with terracut.live(self.address, CALIBRATION, deadline=1000, lock_memory=False, objects=True) as frames:
            taken = [frame for frame, _ in zip(frames, range(3))]
        for frame in taken[1:]:
            self.assertGreater(len(frame.objects), 10)
            self.assertEqual(frame.object_numbers.max(), len(frame.objects))
            self.assertEqual(frame.object_numbers.shape, frame.labels.shape)
            self.assertTrue((frame.labels[frame.object_numbers > 0] == terracut.OBSTACLE).all())

    def test_frames_have_their_free_way_where_it_is_asked_for(self):
        self.be_the_sensor()
        with terracut.live(self.address, CALIBRATION, deadline=1000, lock_memory=False, free_way=True) as frames:
            taken = [frame for frame, _ in zip(frames, range(3))]
        for frame in taken[1:]:
            self.assertIsNone(frame.objects)
            self.assertEqual(len(frame.free_way), 720)
            self.assertGreater(np.median(frame.free_way["seen_m"]), 4)

    def test_a_run_ends_by_itself_after_its_duration(self):
        self.be_the_sensor()
        frames = list(terracut.live(self.address, CALIBRATION, duration=0.5, deadline=1000, lock_memory=False))
        self.assertGreater(len(frames), 0)

    def test_nobody_sends(self):
        with self.assertRaises(terracut.Error):
            terracut.live(self.address, patience=0.2, lock_memory=False)

    def test_ctrl_c_ends_the_wait_for_a_sensor(self):
        threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
        with self.assertRaises(KeyboardInterrupt):
            terracut.live(self.address, lock_memory=False)

    def test_wrong_settings_are_refused_in_the_programs_words(self):
        with self.assertRaises(terracut.InvalidArgument) as raised:
            terracut.live(self.address, deadline=0)
        self.assertEqual(str(raised.exception), error_of("live", "--listen", self.address, "--deadline", "0"))


if __name__ == "__main__":
    unittest.main()

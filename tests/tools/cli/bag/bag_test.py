# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Bags are read as the same captures and clouds: by `replay`, `segment`, `calibrate`, `info` and `relabel`.

usage: bag_test.py PROGRAM DRIVE.pcap WORK
"""

import json
import shutil
import struct
import subprocess
import sys
import unittest
from pathlib import Path

import bag_files

PROGRAM, DRIVE, WORK = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
SCAN, CLOUD, TF = "velodyne_msgs/msg/VelodyneScan", "sensor_msgs/msg/PointCloud2", "tf2_msgs/msg/TFMessage"
PACKETS = [("/velodyne_packets", SCAN)]
CLOUDS = [("/points", CLOUD)]
PER_SCAN = 348
MOUNT = ["--mount-height", "1.8", "--mount-roll", "0", "--mount-pitch", "0"]


def run(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=300)


def labels_in(folder):
    return {path.name: path.read_bytes() for path in sorted(Path(folder).glob("*.label"))}


class Bags(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.packets = bag_files.packets_of(DRIVE)
        cls.messages = [(0, scan[-1][0], bag_files.velodyne_scan(scan)) for scan in (
            cls.packets[i:i + PER_SCAN] for i in range(0, len(cls.packets), PER_SCAN))]
        cls.expected = cls.labels("replay", DRIVE)
        cls.clouds = cls.clouds_of_drive()

    @classmethod
    def labels(cls, command, source, *words):
        folder = WORK / "labels"
        shutil.rmtree(folder, ignore_errors=True)
        done = run(command, source, *MOUNT, "--labels", folder, *words)
        assert done.returncode == 0, done.stderr
        found = labels_in(folder)
        assert found, done.stderr
        return found

    @classmethod
    def clouds_of_drive(cls):
        """Writes clouds in the sensor's frame as nuScenes does, which state rings; returns them."""
        done = run("replay", DRIVE, *MOUNT, "--pcd", WORK / "pcd")
        assert done.returncode == 0, done.stderr
        clouds = []
        (WORK / "clouds").mkdir()
        for i, path in enumerate(sorted((WORK / "pcd").glob("*.pcd"))[:6]):
            points = cls.points_of(path)
            clouds.append(points)
            (WORK / "clouds" / f"{i:06}.pcd.bin").write_bytes(
                b"".join(struct.pack("<5f", -y, x, z, v, ring) for x, y, z, v, ring in points))
        return clouds

    @staticmethod
    def points_of(path):
        head, data = path.read_bytes().split(b"DATA binary\n", 1)
        lines = dict(line.split(" ", 1) for line in head.decode().splitlines() if " " in line and line[0] != "#")
        form = "<" + "".join({"F4": "f", "F8": "d", "U1": "B", "U2": "H", "U4": "I", "I4": "i"}[kind + size]
                             for kind, size in zip(lines["TYPE"].split(), lines["SIZE"].split()))
        names = lines["FIELDS"].split()
        rows = [dict(zip(names, row)) for row in struct.iter_unpack(form, data[:int(lines["POINTS"]) * struct.calcsize(form)])]
        return [(row["x"], row["y"], row["z"] - 1.8, row["intensity"], row["ring"]) for row in rows]

    def test_packets_in_an_sqlite_bag_are_labelled_as_the_capture(self):
        bag_files.write_sqlite_bag(WORK / "one", PACKETS, self.messages, 1)
        self.assertEqual(self.labels("replay", WORK / "one"), self.expected)
        self.assertEqual(self.labels("replay", WORK / "one" / "one_0.db3"), self.expected)

    def test_a_split_bag_is_one_recording(self):
        bag_files.write_sqlite_bag(WORK / "split", PACKETS, self.messages, 3)
        self.assertEqual(self.labels("replay", WORK / "split"), self.expected)

    def test_packets_in_mcap_are_labelled_as_the_capture(self):
        bag_files.write_mcap(WORK / "drive.mcap", PACKETS, self.messages)
        self.assertEqual(self.labels("replay", WORK / "drive.mcap"), self.expected)
        info = run("info", WORK / "drive.mcap")
        self.assertIn("VelodyneScan in /velodyne_packets", info.stdout)
        self.assertIn("HDL-64E", info.stdout)

    def test_other_packet_messages_hold_the_same_packets(self):
        for name, kind, make in (("nebula", "nebula_msgs/msg/NebulaPackets", bag_files.nebula_packets),
                                 ("pandar", "pandar_msgs/msg/PandarScan", bag_files.pandar_scan)):
            messages = [(0, stamp_ns, make(self.packets[i * PER_SCAN:(i + 1) * PER_SCAN]))
                        for i, (_, stamp_ns, _) in enumerate(self.messages)]
            bag_files.write_mcap(WORK / f"{name}.mcap", [("/packets", kind)], messages)
            self.assertEqual(self.labels("replay", WORK / f"{name}.mcap"), self.expected, name)
        for name, kind, begin in (("ouster", "ouster_sensor_msgs/msg/PacketMsg", None),
                                  ("rslidar", "rslidar_msg/msg/RslidarPacket", (0, 1))):
            messages = []
            for stamp_ns, payload in self.packets:
                cdr = bag_files.Cdr()
                if begin:
                    cdr.header(stamp_ns, "rslidar").number("B", begin[0]).number("B", begin[1])
                messages.append((0, stamp_ns, cdr.sequence(payload).message))
            bag_files.write_sqlite(WORK / f"{name}.db3", [("/packets", kind)], messages)
            self.assertEqual(self.labels("replay", WORK / f"{name}.db3"), self.expected, name)

    def test_a_truncated_bag_gives_what_came_before_the_break(self):
        whole = WORK / "whole.mcap"
        bag_files.write_mcap(whole, PACKETS, self.messages)
        data = whole.read_bytes()
        (WORK / "cut.mcap").write_bytes(data[:len(data) * 97 // 100])
        found = self.labels("replay", WORK / "cut.mcap")
        self.assertGreater(len(found), 10)
        self.assertLess(sum(map(len, found.values())), sum(map(len, self.expected.values())))
        for name in list(found)[:-2]:
            self.assertEqual(found[name], self.expected[name])
        done = run("replay", WORK / "cut.mcap", *MOUNT)
        self.assertEqual(done.returncode, 0)
        self.assertIn("cut.mcap: breaks off at byte", done.stderr)

    def test_clouds_in_bags_are_labelled_as_their_files(self):
        expected = self.labels("segment", WORK / "clouds")
        messages = [(0, 10**18 + i * 10**8, bag_files.point_cloud(10**18 + i * 10**8, "lidar", points))
                    for i, points in enumerate(self.clouds)]
        bag_files.write_sqlite_bag(WORK / "clouds_bag", CLOUDS, messages, 2)
        bag_files.write_mcap(WORK / "clouds.mcap", CLOUDS, messages, with_summary=False)
        self.assertEqual(self.labels("segment", WORK / "clouds_bag"), expected)
        self.assertEqual(self.labels("segment", WORK / "clouds.mcap"), expected)
        done = run("calibrate", WORK / "clouds.mcap", "--keep-mount", *MOUNT, "-o", WORK / "setup.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_mount_is_taken_from_tf_static(self):
        messages = [(1, 10**18, bag_files.static_transform("base_link", "lidar", (1.2, 0, 1.8), (0, 0, 0, 1)))]
        messages += [(0, 10**18 + i * 10**8, bag_files.point_cloud(10**18 + i * 10**8, "lidar", points))
                     for i, points in enumerate(self.clouds)]
        bag_files.write_mcap(WORK / "tf.mcap", CLOUDS + [("/tf_static", TF)], messages)
        folder = WORK / "tf_labels"
        done = run("segment", WORK / "tf.mcap", "--labels", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("lidar stands 1.800 m above base_link", done.stderr)
        self.assertEqual(labels_in(folder), self.labels("segment", WORK / "clouds"))

    def test_a_bag_of_our_own_is_labelled_again(self):
        own = WORK / "own.mcap"
        done = run("replay", DRIVE, *MOUNT, "--mcap", own)
        self.assertEqual(done.returncode, 0, done.stderr)
        folder = WORK / "own_labels"
        done = run("segment", own, "--labels", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("terracut_lidar stands 1.800 m above terracut_ground", done.stderr)
        ours = labels_in(folder)
        self.assertEqual(len(ours), len(self.expected))
        same = total = 0
        for name, again in zip(self.expected, ours.values()):
            for first, second in zip(struct.iter_unpack("<I", self.expected[name]), struct.iter_unpack("<I", again)):
                total += 1
                same += first == second
        self.assertGreater(same / total, 0.99)

    def test_relabel_takes_bags_as_drives(self):
        bag_files.write_sqlite_bag(WORK / "fleet" / "packets", PACKETS, self.messages, 2)
        bag_files.write_mcap(WORK / "fleet" / "clouds.mcap", CLOUDS, [
            (0, i, bag_files.point_cloud(i, "lidar", points)) for i, points in enumerate(self.clouds)])
        bag_files.write_mcap(WORK / "fleet" / "both.mcap", PACKETS + CLOUDS, self.messages[:1])
        done = run("manifest", WORK / "fleet", "-o", WORK / "fleet.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        manifest = json.loads((WORK / "fleet.json").read_text())
        self.assertEqual([(drive.get("capture"), drive.get("scans")) for drive in manifest["drives"]],
                         [(None, "clouds.mcap"), ("packets", None)])
        self.assertIn("choose one by --topic", manifest["left_out"][0]["why"])
        done = run("relabel", WORK / "fleet.json", "-o", WORK / "labelled", *MOUNT)
        self.assertEqual(done.returncode, 0, done.stderr)
        (folder,) = (WORK / "labelled").glob("packets-*")
        self.assertEqual(labels_in(folder), self.expected)

    def test_several_topics_are_named_and_one_is_chosen(self):
        topics = [("/front/points", CLOUD), ("/rear/points", CLOUD), ("/velodyne_packets", SCAN)]
        messages = [(0, 10**18, bag_files.point_cloud(10**18, "lidar", self.clouds[0])),
                    (1, 10**18, bag_files.point_cloud(10**18, "lidar", self.clouds[1])),
                    (2, 10**18, self.messages[0][2])]
        bag_files.write_sqlite(WORK / "topics.db3", topics, messages)
        done = run("segment", WORK / "topics.db3", *MOUNT)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("choose one by --topic: /front/points (sensor_msgs/msg/PointCloud2), /rear/points", done.stderr)
        self.assertEqual(run("segment", WORK / "topics.db3", *MOUNT, "--topic", "/rear/points").returncode, 0)
        self.assertIn("--topic /none: expected one of its topics with clouds",
                      run("segment", WORK / "topics.db3", *MOUNT, "--topic", "/none").stderr)
        bag_files.write_sqlite(WORK / "only_clouds.db3", CLOUDS, messages[:1])
        self.assertIn("none of its 1 topics holds packets; there are /points (sensor_msgs/msg/PointCloud2); `terracut "
                      "segment` labels clouds", run("replay", WORK / "only_clouds.db3").stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

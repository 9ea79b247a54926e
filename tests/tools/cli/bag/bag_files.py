# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Writes bags as rosbag2 does, and the messages in them, knowing nothing of terracut."""

import json
import sqlite3
import struct
from pathlib import Path


class Cdr:
    """A message in CDR, little-endian."""

    def __init__(self):
        self.body = b""

    def number(self, form, value):
        size = struct.calcsize(form)
        self.body += b"\0" * (-len(self.body) % size) + struct.pack("<" + form, value)
        return self

    def text(self, value):
        self.number("I", len(value) + 1)
        self.body += value.encode() + b"\0"
        return self

    def array(self, data):
        self.body += data
        return self

    def sequence(self, data):
        return self.number("I", len(data)).array(data)

    def time(self, stamp_ns):
        return self.number("i", stamp_ns // 10**9).number("I", stamp_ns % 10**9)

    def header(self, stamp_ns, frame):
        return self.time(stamp_ns).text(frame)

    @property
    def message(self):
        return b"\0\1\0\0" + self.body


def velodyne_scan(packets):
    """`packets` are (stamp_ns, 1206 bytes)."""
    cdr = Cdr().header(packets[0][0], "velodyne").number("I", len(packets))
    for stamp_ns, payload in packets:
        cdr.time(stamp_ns).array(payload)
    return cdr.message


def nebula_packets(packets):
    cdr = Cdr().header(packets[0][0], "velodyne").number("I", len(packets))
    for stamp_ns, payload in packets:
        cdr.time(stamp_ns).sequence(payload)
    return cdr.message


def pandar_scan(packets):
    cdr = Cdr().header(packets[0][0], "velodyne").number("I", len(packets))
    for stamp_ns, payload in packets:
        cdr.time(stamp_ns).array(payload.ljust(1500, b"\0")).number("I", len(payload))
    return cdr.message


def point_cloud(stamp_ns, frame, points):
    """`points` are (x, y, z, intensity, ring)."""
    cdr = Cdr().header(stamp_ns, frame).number("I", 1).number("I", len(points))
    fields = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("intensity", 12, 7), ("ring", 16, 4)]
    cdr.number("I", len(fields))
    for name, offset, kind in fields:
        cdr.text(name).number("I", offset).number("B", kind).number("I", 1)
    step = 18
    cdr.number("B", 0).number("I", step).number("I", step * len(points))
    cdr.sequence(b"".join(struct.pack("<4fH", *point) for point in points))
    return cdr.number("B", 1).message


def static_transform(parent, child, translation, rotation_xyzw):
    cdr = Cdr().number("I", 1).header(0, parent).text(child)
    for value in (*translation, *rotation_xyzw):
        cdr.number("d", value)
    return cdr.message


def write_sqlite(path, topics, messages):
    """`topics` are (name, type), `messages` (index of the topic, stamp_ns, message). By rosbag2's schema."""
    with sqlite3.connect(path) as database:
        database.executescript("""
            CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
            CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
            CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
            CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                data BLOB NOT NULL);
            CREATE INDEX timestamp_idx ON messages (timestamp ASC);
        """)
        database.executemany("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')",
                             [(i + 1, *topic) for i, topic in enumerate(topics)])
        database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                             [(topic + 1, stamp_ns, data) for topic, stamp_ns, data in messages])
    database.close()


def write_sqlite_bag(folder, topics, messages, files):
    """Splits the messages over this many files of a folder, with the metadata.yaml of `ros2 bag record`."""
    folder.mkdir(parents=True)
    names = [f"{folder.name}_{i}.db3" for i in range(files)]
    each = -(-len(messages) // files)
    for i, name in enumerate(names):
        write_sqlite(folder / name, topics, messages[i * each:(i + 1) * each])
    counts = [sum(1 for message in messages if message[0] == i) for i in range(len(topics))]
    begin, end = messages[0][1], messages[-1][1]
    (folder / "metadata.yaml").write_text(json.dumps({"rosbag2_bagfile_information": {
        "version": 5, "storage_identifier": "sqlite3", "duration": {"nanoseconds": end - begin},
        "starting_time": {"nanoseconds_since_epoch": begin}, "message_count": len(messages),
        "topics_with_message_count": [{
            "topic_metadata": {"name": name, "type": kind, "serialization_format": "cdr", "offered_qos_profiles": ""},
            "message_count": count} for (name, kind), count in zip(topics, counts)],
        "compression_format": "", "compression_mode": "", "relative_file_paths": names}}))


def write_mcap(path, topics, messages, with_summary=True):
    """Without compression, a chunk a message."""
    def record(opcode, content):
        return struct.pack("<BQ", opcode, len(content)) + content

    def text(value):
        return struct.pack("<I", len(value)) + value.encode()

    schemas = b"".join(record(3, struct.pack("<H", i + 1) + text(kind) + text("ros2msg") + text(""))
                       for i, (_, kind) in enumerate(topics))
    channels = b"".join(record(4, struct.pack("<HH", i, i + 1) + text(name) + text("cdr") + text(""))
                        for i, (name, _) in enumerate(topics))
    data = b"\x89MCAP0\r\n" + record(1, text("ros2") + text("test"))
    for i, (topic, stamp_ns, message) in enumerate(messages):
        inside = schemas + channels if i == 0 else b""
        inside += record(5, struct.pack("<HIQQ", topic, i, stamp_ns, stamp_ns) + message)
        data += record(6, struct.pack("<QQQI", stamp_ns, stamp_ns, len(inside), 0) + text("") +
                       struct.pack("<Q", len(inside)) + inside)
    data += record(15, struct.pack("<I", 0))
    summary = len(data) if with_summary else 0
    if with_summary:
        data += schemas + channels
    Path(path).write_bytes(data + record(2, struct.pack("<QQI", summary, 0, 0)) + b"\x89MCAP0\r\n")


def packets_of(capture):
    """Returns (stamp_ns, payload) of a capture that terracut wrote: Ethernet, IPv4 and UDP, nanoseconds."""
    data = Path(capture).read_bytes()
    packets, at = [], 24
    while at + 16 <= len(data):
        seconds, nanoseconds, length, _ = struct.unpack_from("<4I", data, at)
        packets.append((seconds * 10**9 + nanoseconds, data[at + 16 + 42:at + 16 + length]))
        at += 16 + length
    return packets

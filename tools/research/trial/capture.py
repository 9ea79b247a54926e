# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Simulated drives to send, and the few readers of captures and label files that a trial needs."""

from __future__ import annotations

import hashlib
import shutil
import struct
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

FILE_HEADER_BYTES = 24
RECORD_HEADER = struct.Struct("<IIII")
MICROSECOND_MAGIC = 0xA1B2C3D4
# Offset of the UDP destination port in a record that terracut writes: after the record's header,
# Ethernet, IPv4 without options and the source port.
PORT_AT = RECORD_HEADER.size + 14 + 20 + 2
PAYLOAD_AT = RECORD_HEADER.size + 14 + 20 + 8


@dataclass(frozen=True)
class Drive:
    """The files of `terracut simulate -o PCAP`."""

    pcap: Path
    calibration: Path | None  # none where the sensor's table is built in
    truth: Path

    @property
    def table_options(self) -> list[object]:
        return ["--calibration", self.calibration] if self.calibration else []


def records(pcap: Path):
    """Yields (stamp in nanoseconds, bytes of header and packet) for every record of a classic pcap file."""
    with pcap.open("rb") as file:
        magic = struct.unpack("<I", file.read(FILE_HEADER_BYTES)[:4])[0]
        unit_ns = 1000 if magic == MICROSECOND_MAGIC else 1
        while header := file.read(RECORD_HEADER.size):
            seconds, fraction, captured, _ = RECORD_HEADER.unpack(header)
            yield seconds * 10**9 + fraction * unit_ns, header + file.read(captured)


def packet_count(pcap: Path) -> int:
    return sum(1 for _ in records(pcap))


def cut_beginning(pcap: Path, packets: int, into: Path) -> int:
    """Writes the first packets of a capture to a file; returns the nanoseconds they span."""
    with pcap.open("rb") as file:
        content = file.read(FILE_HEADER_BYTES)
    stamps_ns = []
    for _, (stamp_ns, record) in zip(range(packets), records(pcap)):
        content += record
        stamps_ns.append(stamp_ns)
    into.write_bytes(content)
    return stamps_ns[-1] - stamps_ns[0]


def payloads(pcap: Path, for_s: float) -> list[bytes]:
    """Returns the data packets of the first seconds: those to the port with most packets."""
    found: list[tuple[int, bytes]] = []
    for number, (stamp_ns, record) in enumerate(records(pcap)):
        begin_ns = stamp_ns if number == 0 else begin_ns
        if stamp_ns - begin_ns > for_s * 1e9:
            break
        port = int.from_bytes(record[PORT_AT : PORT_AT + 2], "big")
        found.append((port, record[PAYLOAD_AT:]))
    data_port, _ = Counter(port for port, _ in found).most_common(1)[0]
    return [payload for port, payload in found if port == data_port]


def labels_of(folder: Path) -> dict[int, str]:
    """Returns a digest of every frame's label file, by frame number."""
    return {int(path.stem): hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.glob("*.label"))}


def fresh_folder(folder: Path) -> Path:
    """Makes the folder or empties it, and returns it."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Sends datagrams at a given rate, like an attacker or a second sensor. Runs as a separate process,
so that it shares only the machine with the trial: `python3 flood.py TO RATE SECONDS PAYLOADS
FROM...`."""

from __future__ import annotations

import json
import pickle
import random
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

TICK_S = 0.001
PRIORITY = ["chrt", "-f", "60"]  # as the sensor's, which this must not delay

# --- The datagrams ---


def garbage(packets: list[bytes], count: int = 2000) -> list[bytes]:
    """Returns meaningless packets: of any length, of the sensor's length, with only the bytes common to all its
    packets, and its packets with a quarter of the other bytes destroyed. The same every time."""
    dice = random.Random(20240229)
    sample = [packet for packet in packets[:500] if len(packet) == len(packets[0])]
    differing = [at for at, values in enumerate(zip(*sample)) if len(set(values)) > 1]
    made = []
    for _ in range(count):
        packet = bytearray(dice.choice(sample))
        kind = dice.randrange(4)
        if kind == 0:
            packet = bytearray(dice.randbytes(dice.randrange(0, 1400)))
        elif kind == 1:
            packet = bytearray(dice.randbytes(len(packet)))
        else:
            begin, length = (0, len(differing)) if kind == 2 else (dice.randrange(len(differing)), len(differing) // 4)
            for at in differing[begin : begin + length]:
                packet[at] = dice.randrange(256)
        made.append(bytes(packet))
    return made


# --- Sending ---


def send(to: tuple[str, int], rate: float, seconds: float, payloads: list[bytes], addresses: list[str]) -> dict:
    """Sends at that rate per millisecond, and catches up after delays on a busy machine. With 0 s
    it runs until SIGINT."""
    sockets = []
    for address in addresses:
        sockets.append(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        sockets[-1].bind((address, 0))
    over: list[int] = []
    signal.signal(signal.SIGINT, lambda number, _: over.append(number))
    sent = failed = 0
    begun = now = time.monotonic()
    while not over and (seconds == 0 or now - begun < seconds):
        due = int((now - begun) * rate)
        while sent + failed < due:
            number = sent + failed
            try:
                sockets[number % len(sockets)].sendto(payloads[number % len(payloads)], to)
                sent += 1
            except OSError:
                failed += 1
        time.sleep(TICK_S)
        now = time.monotonic()
    return {"sent": sent, "failed": failed, "per_second": sent / max(time.monotonic() - begun, TICK_S)}


class Flood:
    """Runs flood.py; stop() returns what it sent."""

    def __init__(self, to: str, rate: float, payloads: list[bytes], addresses: list[str], realtime: bool, scratch: Path):
        file = scratch / "flood.pickle"
        file.write_bytes(pickle.dumps(payloads))
        command = [*(PRIORITY if realtime else []), sys.executable, __file__, to, str(rate), "0", str(file), *addresses]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.told: dict = {}  # set once it has ended

    def stop(self) -> dict:
        if not self.told:
            self.process.send_signal(signal.SIGINT)
            output, _ = self.process.communicate()
            self.told = json.loads(output)
        return self.told


if __name__ == "__main__":
    host, port = sys.argv[1].rsplit(":", 1)
    told = send((host, int(port)), float(sys.argv[2]), float(sys.argv[3]), pickle.loads(Path(sys.argv[4]).read_bytes()), sys.argv[5:])
    print(json.dumps(told))

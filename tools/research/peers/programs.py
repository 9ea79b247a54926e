# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The measured programs: terracut, and those made with peer_program.hpp."""

import json
import os
import subprocess
import sys
from pathlib import Path

from .drives import MOUNT

PASSES = 2
# Names of terracut's own times.
SEGMENTING = "terracut, without decoding"
AFTER_FRAME = "terracut, after the frame's last packet"
FROM_PACKETS = "terracut, from packets"


def run(command, core=None):
    pin = (lambda: os.sched_setaffinity(0, {core})) if core is not None else None
    command = [str(part) for part in command]
    try:
        ran = subprocess.run(command, capture_output=True, text=True, preexec_fn=pin, errors="replace")
    except OSError as error:
        sys.exit(f"{command[0]}: {error.strerror}")
    if ran.returncode != 0:
        sys.exit(f"{' '.join(command)}\nexit code {ran.returncode}\n{ran.stderr}")
    return ran.stdout


class Terracut:
    names = (SEGMENTING, AFTER_FRAME, FROM_PACKETS)

    def __init__(self, core):
        checkout = Path(__file__).resolve().parents[3]
        self.program = os.environ.get("TERRACUT", str(checkout / "build/release/terracut"))
        self.core = core

    def run(self, *arguments):
        return run([self.program, *arguments])

    def times(self, drive):
        """Returns {name: [ms] of every frame of all passes}."""
        report = drive.folder / "bench.json"
        self.run("bench", drive.capture, "--calibration", drive.calibration, "--repeat", PASSES, "--core", self.core,
                 "--json", report, *MOUNT)  # fmt: skip
        frames = json.loads(report.read_text(encoding="utf-8"))["frames_ms"]
        report.unlink()
        return {
            SEGMENTING: [frame["segment"] for frame in frames],
            AFTER_FRAME: [frame["after_frame"] for frame in frames],
            FROM_PACKETS: [frame["segment"] + frame["decode"] for frame in frames],
        }

    def label(self, drive, folder):
        self.run("replay", drive.capture, "--calibration", drive.calibration, "--labels", folder, *MOUNT)


class Peer:
    def __init__(self, name, program, core):
        self.name, self.program, self.core = name, str(Path(program).resolve()), core
        self.names = (name,)

    def times(self, drive):
        lines = run([self.program, PASSES, "-", *drive.scans], self.core).split()
        if len(lines) != PASSES * len(drive.scans) or not all(line.isdigit() for line in lines):
            sys.exit(f"{self.program}: expected {PASSES * len(drive.scans)} numbers of nanoseconds, a line each, "
                     f"found {len(lines)}: {' '.join(lines[:3])}")  # fmt: skip
        return {self.name: [int(line) / 1e6 for line in lines]}

    def label(self, drive, folder):
        folder.mkdir(parents=True)
        run([self.program, 1, folder, *drive.scans], self.core)

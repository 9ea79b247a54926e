# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs `terracut`: makes drives, sends them, replays them. For the live process see live.py."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

from .capture import Drive


# The mount of all drives. It is stated, because a live run would estimate it from other frames than
# the replay with which it is compared.
MOUNT = ["--mount-height", "1.73", "--mount-roll", "0", "--mount-pitch", "0"]


class TrialError(Exception):
    """Raised if the trial could not be run; the message gives the reason."""


class Program:
    """`scratch` is a folder for results and for drives, which later trials reuse. `simulator` makes the drives, if it is not the
    program itself."""

    def __init__(self, path: Path, scratch: Path, simulator: Path | None = None):
        self.path = path
        self.simulator = simulator or path
        self.scratch = scratch
        (scratch / "drives").mkdir(parents=True, exist_ok=True)

    def run(self, *arguments: object, limit_s: float = 1800, by: Path | None = None) -> subprocess.CompletedProcess:
        command = [str(by or self.path), *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=limit_s, check=False)

    def must(self, *arguments: object, by: Path | None = None) -> str:
        done = self.run(*arguments, by=by)
        if done.returncode != 0:
            raise TrialError(f"terracut {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")
        return done.stdout

    def drive(self, sensor: str, returns: str, scene: str, seconds: float) -> Drive:
        """Returns a drive, which is simulated once and then kept: after a change of the simulator,
        delete the folder."""
        pcap = self.scratch / "drives" / f"{sensor}-{returns}-{scene}-{seconds:g}s.pcap"
        ending = {"hdl64e": "xml", "ruby128": "csv"}.get(sensor)  # the others' tables are built in
        table = ending and pcap.with_suffix(f".calibration.{ending}")
        drive = Drive(pcap, table, pcap.with_suffix(".truth"))
        if not (pcap.exists() and (table is None or table.exists())):
            print(f"Simulating {seconds:g} s of '{scene}' with the {sensor}, {returns} return", flush=True)
            self.must("simulate", "--sensor", sensor, "--returns", returns, "--scene", scene, "--seed", 1,
                      "--duration", seconds, "-o", pcap, by=self.simulator)  # fmt: skip
        return drive

    def replay(self, pcap: Path, calibration: Path | None, labels: Path | None = None, *options: object) -> dict:
        """Returns the report of `terracut replay`."""
        report = self.scratch / "replay.json"
        arguments = ["replay", pcap, "--json", report, *MOUNT, *options]
        if calibration is not None:
            arguments += ["--calibration", calibration]
        if labels is not None:
            arguments += ["--labels", labels]
        self.must(*arguments)
        return json.loads(report.read_text())

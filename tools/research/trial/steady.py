# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs an hour at 10 Hz: after the first minute memory and open files must not change, and nothing is lost."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path

from .accounting import judge_accounting
from .capture import packet_count
from .live import Live, losses, misses
from .loopback import DEADLINE_MS, DRIVE_S, SENSORS, FRAMES_A_SECOND
from .program import Program
from .report import Report

LOOK_EVERY_S = 10
START_S = 60  # growth within the first minute is allowed
ROWS = 12


@dataclass(frozen=True)
class Sample:
    """The kernel's figures about a process, some seconds after the first packet."""

    at_s: float
    resident_kib: int
    anonymous_kib: int
    open_files: int
    threads: int
    frames: int

    @staticmethod
    def of(live: Live, at_s: float) -> "Sample":
        process = Path(f"/proc/{live.pid()}")
        status = dict(line.split(":", 1) for line in (process / "status").read_text().splitlines() if ":" in line)
        figures = live.figures()
        return Sample(at_s, int(status["VmRSS"].split()[0]), int(status["RssAnon"].split()[0]),
                      len(os.listdir(process / "fd")), int(status["Threads"]),
                      figures["frames"]["count"] if figures else 0)  # fmt: skip


def hold(program: Program, report: Report, minutes: float, sensors: list[str]) -> None:
    for name in sensors:
        hold_one(program, report, minutes, name)


def hold_one(program: Program, report: Report, minutes: float, name: str) -> None:
    of, sensor = f"{name}: ", SENSORS[name]
    drive = program.drive(name, sensor.returns, "street", DRIVE_S)
    seconds = minutes * 60
    samples = []
    with Live(program, drive, "--metrics", "127.0.0.1:0", deadline_ms=DEADLINE_MS, limit_s=seconds + 300) as live:
        sending = live.send("--loop", limit_s=seconds + 300)
        begun = time.monotonic()
        while (at_s := time.monotonic() - begun) < seconds:
            samples.append(Sample.of(live, at_s))
            time.sleep(min(LOOK_EVERY_S, max(0.0, seconds - at_s)))
        sent = sending.stop()
        live.settled()
        samples.append(Sample.of(live, time.monotonic() - begun))
        summary = live.stop()

    judge_accounting(report, of, summary, sent["sent"])
    others = {cause: count for cause, count in losses(summary).items() if cause != "clock_jumps"}
    report.equal(of + "losses by cause, but for the clock of a drive that is repeated", others, {})
    revolutions = sent["sent"] / packet_count(drive.pcap) * DRIVE_S * FRAMES_A_SECOND
    report.check(of + f"frames of {revolutions:.1f} revolutions sent", summary["frames"]["count"] >= revolutions - 3,
                 summary["frames"]["count"])  # fmt: skip
    report.equal(of + "frames skipped", summary["frames"]["levels"]["skipped"], 0)
    report.equal(of + "misses of its own making", summary["misses"]["causes"]["own_work"], 0)
    judge_samples(report, of, [sample for sample in samples if sample.at_s >= START_S], minutes)
    report.table(f"{name}, {sensor.returns} return: {minutes:g} minutes at 10 Hz; misses: {misses(summary)}",
                 ["minute", "resident, KiB", "of it anonymous, KiB", "open files", "threads", "frames"],
                 [[f"{sample.at_s / 60:.1f}", sample.resident_kib, sample.anonymous_kib, sample.open_files,
                   sample.threads, sample.frames] for sample in spread(samples)])  # fmt: skip


def judge_samples(report: Report, of: str, steady: list[Sample], minutes: float) -> None:
    if len(steady) < 2:
        report.skip(of + "memory and open files after the first minute", f"only {minutes:g} minutes were held")
        return
    for what in ("resident_kib", "anonymous_kib", "open_files", "threads"):
        values = {getattr(sample, what) for sample in steady}
        report.check(of + f"{what} after the first minute, {len(steady)} looks", len(values) == 1,
                     " to ".join(str(value) for value in sorted({min(values), max(values)})))  # fmt: skip


def spread(samples: list[Sample]) -> list[Sample]:
    """Returns the first and the last sample, and some at equal distances between them."""
    step = max(1, len(samples) // ROWS)
    chosen = samples[::step]
    return chosen if chosen[-1] is samples[-1] else [*chosen, samples[-1]]

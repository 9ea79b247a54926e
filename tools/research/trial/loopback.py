# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs minutes at 10 Hz through a socket of this machine: an HDL-64E, then an RS-Ruby128 in dual return, or a VLP-16."""

from __future__ import annotations

import time
from dataclasses import dataclass

from . import machine
from .accounting import judge_accounting
from .beside import CyclicTest
from .capture import packet_count
from .live import Live, faults, losses, misses, times
from .program import Program
from .report import Report

DEADLINE_MS = 50
DRIVE_S = 30
FRAMES_A_SECOND = 10
SECTORS_A_TURN = 36  # of ten degrees each


@dataclass(frozen=True)
class Sensor:
    name: str
    returns: str
    cpu_bar_ms: float | None = None  # limit for the 99.9th percentile of a frame's processor time


SENSORS = {"hdl64e": Sensor("hdl64e", "single", 15), "ruby128": Sensor("ruby128", "dual", 25), "vlp16": Sensor("vlp16", "single")}
BY_DEFAULT = ("hdl64e", "ruby128")  # of all trials: one after the other


def hold(program: Program, report: Report, minutes: float, sensors: list[str]) -> None:
    rows = []
    for name in sensors:
        rows.append(hold_one(program, report, minutes, SENSORS[name]))
    report.table(
        f"{minutes:g} minutes a sensor at 10 Hz, milliseconds p50 / p99 / p99.9 / max",
        ["sensor", "frames", "packets", "processor time, the thread with a deadline", "of it decoding",
         "all threads, a frame in the mean", "wake-ups a frame", "firing to label, mean", "the longest in ten degrees",
         "of it after the closing packet", "sectors late", "misses of 50 ms",
         "cyclictest beside", "load average"],
        rows,
    )  # fmt: skip
    report.skip(
        "0 allocations on the real-time threads",
        "not measured here: the tests of decoder and segmenter count them; memory is locked, so a heap that grew would "
        "show as page faults",
    )


def hold_one(program: Program, report: Report, minutes: float, sensor: Sensor) -> list:
    drive = program.drive(sensor.name, sensor.returns, "street", DRIVE_S)
    loops = max(1, round(minutes * 60 / DRIVE_S))
    seconds = loops * DRIVE_S
    print(f"\n{sensor.name}, {sensor.returns} return, {seconds} s; load average {machine.load()}", flush=True)
    with Live(program, drive, deadline_ms=DEADLINE_MS, limit_s=seconds + 120) as live:
        test = CyclicTest(seconds)
        spent_before_s, wake_ups_before = live.used()
        sending = live.send("--loop", loops)
        time.sleep(seconds * 0.9)
        load = machine.load()
        sent = sending.wait()
        spent_s, wake_ups = live.used()
        summary = live.stop()
        cyclic = test.result()
    judge(report, sensor, summary, sent, loops, packet_count(drive.pcap))
    frames = summary["frames"]["count"]
    return [f"{sensor.name}, {sensor.returns} return", frames, summary["link"]["packets"],
            times(summary, "cpu_total"), times(summary, "cpu_decode"), f"{1000 * (spent_s - spent_before_s) / frames:.1f}",
            f"{(wake_ups - wake_ups_before) / frames:.1f}", f"{summary['firing_to_label']['mean_ms']:.1f}",
            times(summary, "firing_to_label"), times(summary, "wall"), summary["firing_to_label"]["late_sectors"],
            misses(summary),
            cyclic, load]  # fmt: skip


def judge(report: Report, sensor: Sensor, summary: dict, sent: dict, loops: int, packets: int) -> None:
    frames, of = summary["frames"], f"{sensor.name}: "
    revolutions = loops * DRIVE_S * FRAMES_A_SECOND
    report.equal(of + "datagrams sent", (sent["sent"], sent["failed"]), (loops * packets, 0))
    judge_accounting(report, of, summary, sent["sent"])
    report.equal(of + "packets taken in", summary["link"]["packets"], sent["sent"])
    # With every pass the drive's clock starts again while the head rotates on: one clock jump per
    # pass.
    expected = {"clock_jumps": loops - 1} if loops > 1 else {}
    report.equal(of + "losses by cause, but for the clock of a drive that is repeated", losses(summary), expected)
    # The end of the last revolution is unknown, because no packet follows it.
    report.check(of + f"frames of {revolutions} revolutions sent", revolutions - 2 <= frames["count"] <= revolutions, frames["count"])
    report.equal(of + "frames skipped", frames["levels"]["skipped"], 0)
    report.equal(of + "page faults of the real-time thread", faults(summary), 0)
    cpu_ms = summary["ms"]["cpu_total"]["p99.9"]
    if sensor.cpu_bar_ms is None:
        report.skip(of + "processor time end to end, p99.9", f"{cpu_ms:.2f} ms; no limit is set for this sensor")
    else:
        report.check(of + f"processor time end to end, p99.9 <= {sensor.cpu_bar_ms:g} ms", cpu_ms <= sensor.cpu_bar_ms,
                     f"{cpu_ms:.2f} ms")  # fmt: skip
    # A pass's first turn follows no other one; it is labelled when it is whole.
    late = max(0, summary["firing_to_label"]["late_sectors"] - loops * SECTORS_A_TURN)
    report.equal(of + f"sectors later than {DEADLINE_MS} ms, but for first turns", late, 0)
    report.check(of + f"no miss of {DEADLINE_MS} ms of its own making", summary["misses"]["causes"]["own_work"] == 0,
                 misses(summary))  # fmt: skip

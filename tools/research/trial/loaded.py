# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs minutes at 10 Hz while other programs use every core and the disk, at normal priority."""

from __future__ import annotations

import time
from collections.abc import Callable

from . import machine
from .accounting import judge_accounting
from .beside import CyclicTest, Stress
from .capture import Drive, packet_count
from .live import Live, faults, misses, times
from .loopback import DEADLINE_MS, DRIVE_S, SENSORS, FRAMES_A_SECOND
from .program import Program
from .report import Report
from .stalled import DeafReaders, FrozenDisk, judge_frames

SHARED = ["--priority", "0"]
CALM_S = 10  # time to recover after the load
MOST_MINUTES_WITHOUT_RIGHTS = 3  # enough to show the cost


def hold(program: Program, report: Report, minutes: float, sensors: list[str]) -> None:
    reason = machine.lacks("stress-ng")
    if reason:
        report.skip("every core loaded", reason)
        return
    rows = []
    for name in sensors:
        if machine.has_realtime_rights():
            rows.append(with_rights(program, report, minutes, name))
        else:
            report.skip(f"{name}: loaded, with real-time rights", "no right to SCHED_FIFO")
        rows.append(without_rights(program, report, min(minutes, MOST_MINUTES_WITHOUT_RIGHTS), name))
    report.table(
        f"{minutes:g} minutes under load ({MOST_MINUTES_WITHOUT_RIGHTS} at most without rights; stress-ng on every core, "
        "memory and the disk), milliseconds p50 / p99 / p99.9 / max",
        ["run", "frames", "processor time", "latency (wall)", "full / cut stopped / coarse / skipped",
         "misses of 50 ms", "cyclictest beside"],
        rows,
    )  # fmt: skip


def row(run: str, summary: dict, cyclic: str) -> list:
    levels = " / ".join(str(count) for count in summary["frames"]["levels"].values())
    return [run, summary["frames"]["count"], times(summary, "cpu_total"), times(summary, "latency"), levels,
            misses(summary), cyclic]  # fmt: skip


def with_rights(program: Program, report: Report, minutes: float, name: str) -> list:
    """Runs with rights, also stalling disk and readers if this machine permits."""
    of, sensor = f"{name}, loaded, with real-time rights: ", SENSORS[name]
    drive = program.drive(name, sensor.returns, "street", DRIVE_S)
    seconds = minutes * 60
    impossible = FrozenDisk.impossible()
    if impossible:
        report.skip(of + "labels to a disk that stands still", impossible)
        return loaded_run(program, report, of, drive, seconds, [], lambda: None, lambda: None)
    with FrozenDisk(program.scratch) as disk:
        folder = disk.folder / "labels"
        folder.mkdir()
        return loaded_run(program, report, of, drive, seconds, ["--labels", folder], disk.freeze, disk.thaw)


def loaded_run(program: Program, report: Report, of: str, drive: Drive, seconds: float, options: list,
               freeze: Callable[[], None], thaw: Callable[[], None]) -> list:  # fmt: skip
    options = [*options, "--metrics", "127.0.0.1:0"]
    with Live(program, drive, *options, deadline_ms=DEADLINE_MS, limit_s=seconds + 180) as live:
        freeze()
        readers = DeafReaders(live, live.port_after("figures at "))
        stress = Stress(program.scratch, seconds)
        test = CyclicTest(seconds)
        sending = live.send("--loop")
        time.sleep(seconds)
        sent = sending.stop()
        stress.stop()
        thaw()
        readers.leave()
        summary = live.stop()
    judge_frames(report, of, summary, sent, {"unwritten_label_frames"})
    report.equal(of + "page faults of both real-time threads", faults(summary), 0)
    report.equal(of + "frames skipped by its own making", own_skips(summary), 0)
    report.check(of + "every frame judged", judged_all(summary, sent, drive), summary["frames"]["count"])
    return row(of.rstrip(": "), summary, test.result())


def without_rights(program: Program, report: Report, minutes: float, name: str) -> list:
    of, sensor = f"{name}, loaded, without rights: ", SENSORS[name]
    drive = program.drive(name, sensor.returns, "street", DRIVE_S)
    seconds = minutes * 60
    with Live(program, drive, *SHARED, deadline_ms=DEADLINE_MS, limit_s=seconds + 180) as live:
        stress = Stress(program.scratch, seconds)
        test = CyclicTest(seconds)
        sending = live.send("--loop")
        time.sleep(seconds)
        stress.stop()
        time.sleep(CALM_S)
        calm = live.figures()
        sent = sending.stop()
        summary = live.stop()
    judge_accounting(report, of, summary, sent["sent"])
    levels = summary["frames"]["levels"]
    report.equal(of + "frames on all levels together", sum(levels.values()), summary["frames"]["count"])
    report.equal(of + "misses by all causes together", sum(summary["misses"]["causes"].values()),
                 summary["misses"]["total"])  # fmt: skip
    report.check(of + "no skipped frame that is not a miss", summary["misses"]["total"] >= levels["skipped"],
                 f"{levels['skipped']} skipped, {summary['misses']['total']} missed")  # fmt: skip
    missed_late = summary["ms"]["latency"]["max"] > DEADLINE_MS or levels["skipped"] > 0
    report.equal(of + "misses told when there were some", summary["misses"]["total"] > 0, missed_late)
    report.equal(of + "exit code (6: deadlines were missed)", live.exit_code,
                 6 if summary["misses"]["total"] else 0)  # fmt: skip
    report.check(of + f"recovered {CALM_S} s after the load", calm is not None and
                 calm["misses"]["consecutive"] == 0 and calm["frames"]["per_second"] > FRAMES_A_SECOND * 0.95,
                 f"{calm['frames']['per_second']:.1f} frames a second, {calm['misses']['consecutive']} missed in a row"
                 if calm else "no status page")  # fmt: skip
    return row(of.rstrip(": "), summary, test.result())


def own_skips(summary: dict) -> int:
    """Returns the number of skipped frames that no miss of another cause explains."""
    causes = summary["misses"]["causes"]
    others = sum(count for cause, count in causes.items() if cause != "own_work")
    return max(0, summary["frames"]["levels"]["skipped"] - others)


def judged_all(summary: dict, sent: dict, drive: Drive) -> bool:
    """True if all sent frames were counted, except those at the end."""
    revolutions = sent["sent"] / packet_count(drive.pcap) * DRIVE_S * FRAMES_A_SECOND
    return revolutions - 3 <= summary["frames"]["count"] <= revolutions + 1

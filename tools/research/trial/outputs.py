# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Measures the cost of each output of a live run, and checks that stalled readers delay nothing."""

from __future__ import annotations

import os
import shutil
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from . import machine, readers
from .live import Live, losses, misses
from .loopback import DEADLINE_MS, DRIVE_S, FRAMES_A_SECOND
from .program import Program
from .report import Report

STALL_S = 10
MEBI = 1 << 20


@dataclass(frozen=True)
class Output:
    name: str
    options: list[object]
    reader: Callable[[Live], object] | None  # None: it writes files
    left_out: tuple[str, ...]  # causes under which frames dropped for this output are counted


def outputs(program: Program, folder: Path) -> list[Output]:
    known = [
        Output("--labels", ["--labels", folder / "labels"], None, ("unwritten_label_frames",)),
        Output("--stream", ["--stream", "127.0.0.1:0"], readers.read_stream, ("unpublished_frames", "stream_")),
        Output("--view", ["--view", "127.0.0.1:0"], readers.read_page, ("view_",)),
        Output("--foxglove", ["--foxglove", "127.0.0.1:0"], readers.read_foxglove, ("foxglove_",)),
        Output("--mcap", ["--mcap", folder / "bag.mcap"], None, ("mcap_",)),
    ]
    if "built without DDS" not in program.run("node", "--duration", 0.1, "--dds-domain", readers.DDS_DOMAIN).stderr:
        known.append(Output("--dds", ["--dds", "--dds-domain", readers.DDS_DOMAIN, "--dds-interface", "lo"],
                            readers.NodeReader, ("dds_",)))  # fmt: skip
    return known


@dataclass
class Run:
    summary: dict
    cpu_ms: float  # of the whole process, per frame
    resident_mib: float  # the maximum
    bytes_read: list[int]  # by each output's reader, in all
    clouds_read: int  # by the node
    frames: int


def cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(") ", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_mib(pid: int) -> float:
    (line,) = [line for line in Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith("VmHWM")]
    return int(line.split()[1]) / 1024


def run(program: Program, chosen: list[Output], seconds: float, stalls: bool = False) -> Run:
    drive = program.drive("hdl64e", "single", "street", DRIVE_S)
    options = [option for output in chosen for option in output.options]
    with Live(program, drive, *options, deadline_ms=DEADLINE_MS, limit_s=seconds + 120) as live:
        reading = [output.reader(live) if output.reader else None for output in chosen]
        begun_s, begun = cpu_s(live.pid()), live.figures()["frames"]["count"]
        sending = live.send("--loop")
        time.sleep(seconds / 4)
        if stalls:
            for reader in filter(None, reading):
                reader.stall()
            time.sleep(STALL_S)
            for reader in filter(None, reading):
                reader.go_on()
        time.sleep(3 * seconds / 4)
        sending.stop()
        figures = live.settled()
        used_s, most_mib = cpu_s(live.pid()) - begun_s, resident_mib(live.pid())
        for reader in filter(None, reading):
            reader.leave()
        summary = live.stop()
    frames = figures["frames"]["count"] - begun
    clouds = sum(reader.clouds for reader in reading if isinstance(reader, readers.NodeReader))
    return Run(summary, 1000 * used_s / frames, most_mib, [reader.bytes if reader else 0 for reader in reading], clouds, frames)


def written_bytes(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def hold(program: Program, report: Report, seconds: float, rounds: int) -> None:
    folder = program.scratch / "outputs"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    known = outputs(program, folder)
    if known[-1].name != "--dds":
        report.skip("--dds", "this program was built without DDS")
    each(program, report, folder, known, seconds)
    stalled(program, report, known, seconds, rounds)
    shutil.rmtree(folder)


def each(program: Program, report: Report, folder: Path, known: list[Output], seconds: float) -> None:
    alone = run(program, [], seconds)
    rows = [["none", f"{alone.cpu_ms:.1f}", "", f"{alone.resident_mib:.0f}", alone.summary["ms"]["latency"]["p99"]]]
    for output in known:
        found = run(program, [output], seconds)
        taken = found.bytes_read[0] or written_bytes(folder)
        shutil.rmtree(folder)
        folder.mkdir()
        size = f"{taken / found.frames / 1e6:.2f}" if taken else f"{found.clouds_read} of {found.frames} clouds"
        rows.append([output.name, f"{found.cpu_ms:.1f} (+{found.cpu_ms - alone.cpu_ms:.1f})", size,
                     f"{found.resident_mib:.0f} (+{found.resident_mib - alone.resident_mib:.0f})",
                     found.summary["ms"]["latency"]["p99"]])  # fmt: skip
        report.check(f"{output.name}: no miss of {DEADLINE_MS} ms of its own making",
                     found.summary["misses"]["causes"]["own_work"] == 0, misses(found.summary))  # fmt: skip
    report.table(f"Each output with one reader, HDL-64E at {FRAMES_A_SECOND} Hz, {seconds:g} s: of the whole process",
                 ["output", "processor time a frame, ms", "taken, MB a frame", "resident, MiB", "latency p99, ms"], rows)  # fmt: skip


def stalled(program: Program, report: Report, known: list[Output], seconds: float, rounds: int) -> None:
    none, every = [], []
    for _ in range(rounds):
        none.append(run(program, [], seconds + STALL_S))
        every.append(run(program, known, seconds, stalls=True))

    def row(name: str, runs: list[Run]) -> list:
        latency = [[of.summary["ms"]["latency"][key] for of in runs] for key in ("p50", "p99", "max")]
        return [name, *(f"{statistics.median(values):.2f} ({min(values):.2f} to {max(values):.2f})" for values in latency)]

    report.table(f"All at once, every reader standing still for {STALL_S} s: latency in ms, median (range) of {rounds} runs in turn, "
                 f"load average {machine.load()}", ["outputs", "p50", "p99", "max"],
                 [row("none", none), row("all, their readers stalled", every)])  # fmt: skip
    for found in every:
        causes = found.summary["misses"]["causes"]
        report.check(f"all outputs: no miss of {DEADLINE_MS} ms of its own making", causes["own_work"] == 0, misses(found.summary))
        lost = losses(found.summary)
        named = {name: count for name, count in lost.items() if any(name.startswith(cause) for of in known for cause in of.left_out)}
        report.check("all outputs: what readers missed is counted", bool(named), named)
        report.equal("all outputs: losses by other causes", {name: lost[name] for name in lost.keys() - named - {"clock_jumps"}}, {})

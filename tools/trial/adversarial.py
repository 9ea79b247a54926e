# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A min-cut that is too large for the deadline: the ladder must stop it, say so, and lose nothing by it.

Rough ground in a rural scene, and seeds so strict that nearly every cell is unknown and all of them go
into the cut. The drive is sent once and labelled live under a short deadline; its truth judges both that
and the coarse stages alone.
"""

from __future__ import annotations

from array import array
from collections import Counter
from pathlib import Path

from .live import Live, losses, times
from .program import Program
from .report import Report

HARD = {"seeds.ground_share": 1, "seeds.max_ground_height_m": 0, "min_cut.max_unknown": 262144}
SETTINGS = [f"--set={key}={value}" for key, value in HARD.items()]
SEVERAL_TIMES = 3  # what the hard cut takes at least of the usual one
LABELLED_GROUND = 40
GROUND = {40, 44, 48, 49, 60, 72}
IGNORED = {0, 1}


def hold(program: Program, report: Report, seconds: float, deadline_ms: float) -> None:
    drive = program.drive("hdl64e", "single", "rural", seconds)
    usual = program.replay(drive.pcap, drive.calibration)
    hard = program.replay(drive.pcap, drive.calibration, None, *SETTINGS)
    cut_ms, usual_ms = (r["summary"]["ms"]["min_cut"]["p50"] for r in (hard, usual))
    unknown = max(frame["min_cut"]["unknown"] for frame in hard["frames"])
    report.check(f"the whole cut takes at least {SEVERAL_TIMES} times the usual", cut_ms >= SEVERAL_TIMES * usual_ms,
                 f"{cut_ms:.1f} ms of {unknown} cells, usually {usual_ms:.1f} ms")  # fmt: skip

    folder = fresh_folder(program.scratch / "labels_live")
    with Live(program, drive, *SETTINGS, "--labels", folder, deadline_ms=deadline_ms, limit_s=seconds + 120) as live:
        sent = live.send().wait()
        summary = live.stop()
    coarse = fresh_folder(program.scratch / "labels_coarse")
    program.replay(drive.pcap, drive.calibration, coarse, *SETTINGS, "--stages", "adjacent")
    full = fresh_folder(program.scratch / "labels_full")
    program.replay(drive.pcap, drive.calibration, full, *SETTINGS)

    rungs, frames = summary["frames"]["rungs"], summary["frames"]["count"]
    report.equal("packets taken in", summary["link"]["packets"], sent["sent"])
    report.equal("losses but for skipped frames", {k: v for k, v in losses(summary).items() if k != "skipped_frames"}, {})
    report.check("frames are marked as of a lower rung", rungs["cut_stopped"] + rungs["coarse"] > frames / 2, rungs)
    segment_ms = summary["ms"]["cpu_segment"]["p99.9"]
    report.check(f"processor time of segmenting, p99.9 within the deadline of {deadline_ms:g} ms",
                 segment_ms <= deadline_ms, f"{segment_ms:.2f} ms")  # fmt: skip
    report.equal("misses of its own making", summary["misses"]["causes"]["own_work"], 0)

    common = sorted({path.name for path in folder.glob("*.label")} & {path.name for path in drive.truth.glob("*.label")})
    report.check("frames labelled live that have a truth", len(common) >= 0.8 * frames, f"{len(common)} of {frames}")
    iou = {way: 100 * iou_ground([(labels / name, drive.truth / name) for name in common])
           for way, labels in (("live", folder), ("coarse", coarse), ("full", full))}  # fmt: skip
    report.check("labels at least as good as of the coarse stages alone (IoU_g)", iou["live"] >= iou["coarse"],
                 f"{iou['live']:.2f} % and {iou['coarse']:.2f} %")  # fmt: skip
    report.table(
        f"A cut of {unknown} unknown cells under a deadline of {deadline_ms:g} ms; p50 / p99 / p99.9 / max",
        ["frames", "full / cut stopped / coarse / skipped", "the whole cut, ms", "segmenting live, ms of processor time",
         "latency (wall)", "IoU_g live", "coarse + adjacent", "the whole cut"],
        [[frames, " / ".join(map(str, rungs.values())), f"{cut_ms:.1f}", times(summary, "cpu_segment"),
          times(summary, "latency"), f"{iou['live']:.2f} %", f"{iou['coarse']:.2f} %", f"{iou['full']:.2f} %"]],
    )  # fmt: skip


def fresh_folder(folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    for path in folder.iterdir():
        path.unlink()
    return folder


def ids(path: Path) -> array:
    values = array("I")
    values.frombytes(path.read_bytes())
    return values


def iou_ground(pairs: list[tuple[Path, Path]]) -> float:
    """IoU_g of label files against truth files, as pipeline/quality.cpp defines it."""
    counts: Counter = Counter()
    for labels, truth in pairs:
        counts.update(zip(ids(labels), ids(truth)))
    hit = missed = false = 0
    for (label, truth), count in counts.items():
        if truth & 0xFFFF in IGNORED:
            continue
        is_ground, as_ground = truth & 0xFFFF in GROUND, label == LABELLED_GROUND
        hit += count * (is_ground and as_ground)
        missed += count * (is_ground and not as_ground)
        false += count * (as_ground and not is_ground)
    return hit / (hit + missed + false)

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A min-cut that is too large for the deadline: degradation must stop it, report it, and lose nothing, from the first
frame on.

In a rural scene seeds are so strict that nearly every cell is unknown and goes into the cut. The drive is labelled live
under two deadlines: one that leaves time for most of the cut, and one too short even for its weights. These labels and
those of the coarse stages alone are scored against the truth; and every frame must have the labels of one level, bit
for bit.
"""

from __future__ import annotations

from array import array
from collections import Counter
from pathlib import Path

from .accounting import judge_accounting
from .capture import Drive, fresh_folder
from .live import Live, losses, misses, times
from .program import Program
from .report import Report

HARD = {"seeds.ground_share": 1, "min_cut.max_unknown": 262144}
SETTINGS = [f"--set={key}={value}" for key, value in HARD.items()]
SEVERAL_TIMES = 3  # how many times longer than the usual cut the hard one must take
WAKING_UP_MS = 1.5  # from the last packet to the segmenter
SHARES_OF_CUT = [0.8, 0.25]  # the shares of the cut's time that the deadline leaves
LOOPS = 2
LABELLED_GROUND = 40
GROUND = {40, 44, 48, 49, 60, 72}
IGNORED = {0, 1}


def hold(program: Program, report: Report, seconds: float) -> None:
    drive = program.drive("hdl64e", "single", "rural", seconds)
    usual = program.replay(drive.pcap, drive.calibration)
    coarse, full = (fresh_folder(program.scratch / f"labels_{name}") for name in ("coarse", "full"))
    program.replay(drive.pcap, drive.calibration, coarse, *SETTINGS, "--stages", "adjacent")
    hard = program.replay(drive.pcap, drive.calibration, full, *SETTINGS)
    ms = {stage: times["p50"] for stage, times in hard["summary"]["ms"].items()}
    usual_ms = usual["summary"]["ms"]["min_cut"]["p50"]
    unknown = max(frame["min_cut"]["unknown"] for frame in hard["frames"])
    report.check(f"the whole cut takes at least {SEVERAL_TIMES} times the usual",
                 ms["min_cut"] >= SEVERAL_TIMES * usual_ms,
                 f"{ms['min_cut']:.1f} ms of {unknown} cells, usually {usual_ms:.1f} ms")  # fmt: skip

    before_ms = ms["elevation_map"] + ms["adjacent_points"] + ms["seeds"] + ms["labels"] + WAKING_UP_MS
    rows = []
    for share in SHARES_OF_CUT:
        deadline_ms = round(before_ms + share * ms["min_cut"], 1)
        rows.append(live_run(program, report, drive, deadline_ms, coarse, full))
    report.table(
        f"A cut of {unknown} unknown cells that takes {ms['min_cut']:.1f} ms, under two deadlines; p50 / p99 / p99.9 / max",
        ["deadline, ms", "frames", "full / cut stopped / coarse / skipped", "segmenting, ms of processor time",
         "latency (wall)", "misses", "IoU_g live", "coarse + adjacent", "the whole cut"],
        rows,
    )  # fmt: skip


def live_run(program: Program, report: Report, drive: Drive, deadline_ms: float, coarse: Path,
             full: Path) -> list:  # fmt: skip
    of, folder = f"{deadline_ms:g} ms: ", fresh_folder(program.scratch / "labels_live")
    with Live(program, drive, *SETTINGS, "--labels", folder, deadline_ms=deadline_ms, limit_s=300) as live:
        sent = live.send("--loop", LOOPS).wait()
        summary = live.stop()
    levels, frames = summary["frames"]["levels"], summary["frames"]["count"]
    judge_accounting(report, of, summary, sent["sent"])
    report.equal(of + "packets taken in", summary["link"]["packets"], sent["sent"])
    others = {cause: count for cause, count in losses(summary).items() if cause not in ("skipped_frames", "clock_jumps")}
    report.equal(of + "losses but for skipped frames", others, {})
    lower = levels["cut_stopped"] + levels["coarse"]
    report.check(of + "most frames are marked as of a lower level", lower > frames / 2, levels)
    own = summary["misses"]["causes"]["own_work"]
    report.equal(of + "misses of its own making, the first frames included", own, 0)

    names = {path.name for path in folder.glob("*.label")} & {path.name for path in full.glob("*.label")}
    names = sorted(name for name in names if ids_count(folder / name) == ids_count(drive.truth / name))
    report.check(of + "frames that have a truth", len(names) >= 0.9 * frames / LOOPS, f"{len(names)} of {frames}")
    iou = [100 * iou_ground([(labels / name, drive.truth / name) for name in names]) for labels in (folder, coarse, full)]
    report.check(of + "IoU_g at least that of the coarse stages alone", iou[0] >= iou[1],
                 f"{iou[0]:.2f} % and {iou[1]:.2f} %")  # fmt: skip
    between = [name for name in names
               if (folder / name).read_bytes() not in ((coarse / name).read_bytes(), (full / name).read_bytes())]  # fmt: skip
    report.check(of + "no more labels than cuts were stopped are neither the coarse stages' nor the whole cut's",
                 len(between) <= levels["cut_stopped"], f"{len(between)}, {levels['cut_stopped']} stopped")  # fmt: skip
    return [f"{deadline_ms:g}", frames, " / ".join(map(str, levels.values())), times(summary, "cpu_segment"),
            times(summary, "latency"), misses(summary), *(f"{value:.2f} %" for value in iou)]  # fmt: skip


def ids_count(path: Path) -> int:
    return path.stat().st_size if path.exists() else -1


def ids(path: Path) -> array:
    values = array("I")
    values.frombytes(path.read_bytes())
    return values


def iou_ground(pairs: list[tuple[Path, Path]]) -> float:
    """Returns the IoU_g of label files against truth files, as defined in tools/lab/quality/quality.cpp."""
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

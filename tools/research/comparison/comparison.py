# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Compares the measures of two evaluations, frame by frame."""

from collections import defaultdict
from dataclasses import asdict, dataclass
from typing import Optional

import numpy

from comparison.paired_tests import PairedTest, sign_flip_test, signed_rank_test

MEASURES = {"iou_g": True, "recall_o": True, "iou_road": True, "ms": False}  # true if more is better


class Refused(Exception):
    """Raised with a message for people."""


@dataclass(frozen=True)
class Compared:
    """One side of a comparison."""

    report: dict  # of `terracut eval --json`
    name: str  # name of its file, for messages
    method: str


@dataclass(frozen=True)
class Change:
    """The change of one measure; means over the frames of both reports."""

    before: float
    after: float
    frames: PairedTest  # signed-rank test over frames, after - before
    # Sign-flip test over the means of sequences. Successive frames look alike, so the test over
    # frames finds differences too easily. None if there are fewer than two sequences.
    sequences: Optional[PairedTest]
    # The values that eval prints: means over sequences, computed from all points of a sequence
    # together. None for times, or if the two reports are not of the same frames.
    eval_before: Optional[float]
    eval_after: Optional[float]


def no_report(side, lacks):
    return Refused(f"{side.name}: expected a report of `terracut eval --json`, but {lacks}")


def method_of(side):
    methods = side.report.get("methods") if isinstance(side.report, dict) else None
    if not isinstance(methods, dict):
        raise no_report(side, "it has no 'methods'")
    if side.method not in methods:
        raise Refused(f"{side.name}: there is no method '{side.method}' in the report, only {', '.join(methods)}")
    return methods[side.method]


def frames_of(side):
    """Returns {(sequence, frame): {measure: number or None}}."""
    listed = method_of(side).get("frames")
    if not isinstance(listed, list):
        raise no_report(side, f"its method '{side.method}' has no 'frames'")
    frames = {}
    for frame in listed:
        for key in ("sequence", "frame"):
            if not isinstance(frame.get(key), str):
                raise no_report(side, f"one of its frames has no '{key}'")
        for measure in MEASURES:
            if measure not in frame or not isinstance(frame[measure], (int, float, type(None))):
                raise no_report(side, f"one of its frames has no '{measure}'")
        frames[frame["sequence"], frame["frame"]] = frame
    return frames


def mean_of_eval(side, measure):
    scope, name = ("road", "iou_g") if measure == "iou_road" else ("all", measure)
    return method_of(side).get("mean_over_sequences", {}).get(scope, {}).get(name)


def change_of(measure, before, after, pairs):
    """pairs: [(sequence, frame before, frame after)]; before, after: eval's overall values."""
    measured = [(sequence, was[measure], now[measure]) for sequence, was, now in pairs if None not in (was[measure], now[measure])]
    by_sequence = defaultdict(list)
    for sequence, was, now in measured:
        by_sequence[sequence].append(now - was)
    means = [numpy.mean(differences) for differences in by_sequence.values()]
    return Change(
        before=float(numpy.mean([was for _, was, _ in measured])) if measured else 0.0,
        after=float(numpy.mean([now for _, _, now in measured])) if measured else 0.0,
        frames=signed_rank_test([now - was for _, was, now in measured]),
        sequences=sign_flip_test(means) if len(means) > 1 else None,
        eval_before=before,
        eval_after=after,
    )


@dataclass(frozen=True)
class Comparison:
    before: str  # names, such as "paper of A.json"
    after: str
    frames: int  # number in both
    only_before: int
    only_after: int
    measures: dict  # {measure: Change}

    def worse(self, significance):
        """Returns the measures that got significantly worse by the test over frames. Times are left
        out: on a shared machine they differ between any two runs."""
        return [
            measure
            for measure, change in self.measures.items()
            if measure != "ms" and change.after < change.before and change.frames.p < significance
        ]

    def as_dict(self):
        return asdict(self)


def compare(before, after):
    """Compares two methods over the frames of both reports; each is a Compared."""
    was, now = frames_of(before), frames_of(after)
    both = sorted(was.keys() & now.keys())
    if not both:
        raise Refused("the two reports have no frame in common")
    pairs = [(key[0], was[key], now[key]) for key in both]
    same = len(both) == len(was) == len(now)
    measures = {}
    for measure in MEASURES:
        of_eval = [mean_of_eval(side, measure) if same else None for side in (before, after)]
        measures[measure] = change_of(measure, *of_eval, pairs)
    sides = [f"{side.method} of {side.name}" for side in (before, after)]
    return Comparison(*sides, len(both), len(was) - len(both), len(now) - len(both), measures)


def text(comparison, significance):
    """Returns text for people: one line per measure, and the significantly worse ones."""

    def line(measure, before, after):
        unit = 1 if measure == "ms" else 100  # shares as percent
        return f"{measure:<18}{unit * before:>9.3f}{unit * after:>9.3f}{unit * (after - before):>+9.3f}"

    one_sided = comparison.only_before + comparison.only_after
    beside = f", {comparison.only_before} only before, {comparison.only_after} only after" if one_sided else ""
    lines = [
        f"before    {comparison.before}",
        f"after     {comparison.after}",
        f"frames    {comparison.frames} in both{beside}",
        "",
        f"{'mean of frames':<18}{'before':>9}{'after':>9}{'change':>9}{'frames+':>8}{'frames-':>8}{'p (frames)':>12}{'p (sequences)':>15}",
    ]
    for measure, change in comparison.measures.items():
        p = f"{change.sequences.p:.2g}" if change.sequences else "-"
        lines.append(
            line(measure, change.before, change.after)
            + f"{change.frames.greater:>8}{change.frames.less:>8}{change.frames.p:>12.2g}{p:>15}"
        )
    if not one_sided:
        lines.append("as eval prints them, means over sequences of all their points together")
    for measure, change in comparison.measures.items():
        if None not in (change.eval_before, change.eval_after):
            lines.append(line(measure, change.eval_before, change.eval_after))
    worse = ", ".join(comparison.worse(significance)) or "nothing"
    lines.append(f"worse     {worse} (by p (frames) below {significance:g}; ms is not judged)")
    return "\n".join(lines)

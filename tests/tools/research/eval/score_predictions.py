#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Scores the .label files of `terracut eval --predictions` without any code of terracut, and compares
every measure with its report, to the last digit.

    score_predictions.py DATASET_ROOT PREDICTIONS REPORT.json
"""
import json
import math
import sys
from array import array
from collections import Counter, defaultdict
from pathlib import Path

KEY = {10, 11, 13, 15, 16, 18, 20, 30, 31, 32} | set(range(252, 260))
ALL_GROUND = {40, 44, 48, 49, 60, 72}
VEGETATION = 70
KNOWN = KEY | ALL_GROUND | {0, 1, 50, 51, 52, VEGETATION, 71, 80, 81, 99}
ROAD, OTHER_GROUND, OBSTACLE = 40, 49, 99
GROUND_LABELS = {ROAD, OTHER_GROUND}
SCOPES = {
    "all": (ALL_GROUND, {0, 1}, GROUND_LABELS),
    "road": ({40}, set(), {ROAD}),
    "all_vegetation_ignored": (ALL_GROUND, {0, 1, VEGETATION}, GROUND_LABELS),
}  # true ground, ignored, and what labels count as having called it ground
BANDS = ("<20m", "20-40m", ">40m")


def records(path, code):
    values = array(code)
    values.frombytes(path.read_bytes())
    return values


def count_frame(points, truth, predicted):
    """Counter of (class, band, label) over the points that have a label."""
    counts = Counter()
    for i, label in enumerate(predicted):
        if label == 0:
            continue
        distance = math.hypot(points[4 * i], points[4 * i + 1])
        band = 0 if distance < 20 else 1 if distance < 40 else 2
        counts[truth[i] & 0xFFFF, band, label] += 1
    return counts


def measures(counts, ground, ignored, predicted_ground, only_band=None):
    tp = fp = fn = key_found = key_missed = 0
    for (class_id, band, label), n in counts.items():
        if class_id not in KNOWN or class_id in ignored or (only_band is not None and band != only_band):
            continue
        called_ground = label in predicted_ground
        if class_id in ground:
            tp, fn = (tp + n, fn) if called_ground else (tp, fn + n)
            continue
        if called_ground:
            fp += n
        if class_id in KEY:
            key_missed, key_found = (key_missed + n, key_found) if called_ground else (key_missed, key_found + n)
    share = lambda part, whole: part / whole if whole else None
    precision, recall = share(tp, tp + fp), share(tp, tp + fn)
    # Where one of the two has nothing to share out, it counts as 1.
    p, r = (1.0 if precision is None else precision), (1.0 if recall is None else recall)
    return {
        "iou_g": share(tp, tp + fp + fn),
        "recall_o": share(key_found, key_found + key_missed),
        "precision": precision,
        "recall": recall,
        "f1": None if tp + fp + fn == 0 else 2 * p * r / (p + r) if p + r else 0.0,
    }


def mean(values):
    values = [value for value in values if value is not None]
    total = 0.0
    for value in values:
        total += value
    return total / len(values) if values else None


def spread(values):
    values = [value for value in values if value is not None]
    return {"min": min(values, default=None), "mean": mean(values), "max": max(values, default=None)}


def judged_by(oracle, counts):
    """What the oracle would have called the same points."""
    judged = Counter()
    for (class_id, band, _), n in counts.items():
        # What no physical ground is known of is its obstacle.
        judged[class_id, band, ROAD if oracle == "everything_ground" or class_id in ALL_GROUND else OBSTACLE] += n
    return judged


def main():
    root, predictions, report_path = map(Path, sys.argv[1:4])
    report = json.loads(report_path.read_text())
    differences, compared = [], 0

    def compare(where, ours, theirs):
        nonlocal compared
        compared += 1
        if ours != theirs:
            differences.append(f"{where}: {ours!r} here, {theirs!r} in the report")

    for method, reported in report["methods"].items():
        by_sequence = defaultdict(Counter)
        of_frames = defaultdict(lambda: defaultdict(list))
        frames = 0
        for path in sorted((predictions / method / "sequences").glob("*/predictions/*.label")):
            name = path.parts[-3]
            sequence = root / "sequences" / name
            predicted = records(path, "I")
            truth = records(sequence / "labels" / path.name, "I")
            points = records(sequence / "velodyne" / f"{path.stem}.bin", "f")
            assert len(predicted) == len(truth) == len(points) // 4, path
            counts = count_frame(points, truth, predicted)
            of_frame = measures(counts, *SCOPES["all"])
            theirs = reported["frames"][frames]
            compare(f"{method} {name}/{path.stem} frame", [name, path.stem], [theirs["sequence"], theirs["frame"]])
            compare(f"{method} {name}/{path.stem} iou_g", of_frame["iou_g"], theirs["iou_g"])
            compare(f"{method} {name}/{path.stem} recall_o", of_frame["recall_o"], theirs["recall_o"])
            road = measures(counts, *SCOPES["road"])["iou_g"]
            compare(f"{method} {name}/{path.stem} iou_road", road, theirs["iou_road"])
            for key, value in (("iou_g", of_frame["iou_g"]), ("recall_o", of_frame["recall_o"]), ("iou_road", road)):
                of_frames[name]["frame_" + key].append(value)
            by_sequence[name].update(counts)
            frames += 1
        compare(f"{method} frames", frames, len(reported["frames"]))

        for name, spreads in of_frames.items():
            for key, values in spreads.items():
                compare(f"{method} {name} {key}", spread(values), reported["sequences"][name][key])

        pooled = sum(by_sequence.values(), Counter())
        for scope, definition in SCOPES.items():
            of_sequences = {name: measures(counts, *definition) for name, counts in by_sequence.items()}
            for name, of_sequence in of_sequences.items():
                compare(f"{method} {name} {scope}", of_sequence, reported["sequences"][name][scope])
            means = {key: mean([each[key] for each in of_sequences.values()])
                     for key in ("iou_g", "recall_o", "precision", "recall", "f1")}
            compare(f"{method} mean {scope}", means, reported["mean_over_sequences"][scope])
            compare(f"{method} pooled {scope}", measures(pooled, *definition), reported["pooled"][scope])
        for band, name in enumerate(BANDS):
            for scope, place in (("all", "by_range"), ("road", "by_range_road")):
                compare(f"{method} {name} {scope}", measures(pooled, *SCOPES[scope], only_band=band), reported[place][name])
        by_class = defaultdict(lambda: [0, 0, 0])
        for (class_id, _, label), n in pooled.items():
            by_class[class_id][0] += n
            by_class[class_id][1] += n if label in GROUND_LABELS else 0
            by_class[class_id][2] += n if label == OTHER_GROUND else 0
        compare(f"{method} by class", [(each, *by_class[each], by_class[each][1] / by_class[each][0]) for each in sorted(by_class)],
                [(each["id"], each["points"], each["as_ground"], each["as_other_ground"], each["share_as_ground"])
                 for each in reported["by_class"]])
        for oracle, scores in report["oracles"].items():
            for scope, definition in SCOPES.items():
                of_sequences = {name: measures(judged_by(oracle, counts), *definition) for name, counts in by_sequence.items()}
                for name, of_sequence in of_sequences.items():
                    compare(f"{oracle} {name} {scope}", of_sequence, scores["sequences"][name][scope])
                means = {key: mean([each[key] for each in of_sequences.values()])
                         for key in ("iou_g", "recall_o", "precision", "recall", "f1")}
                compare(f"{oracle} mean {scope}", means, scores[scope])

    print(*differences, sep="\n", end="\n" if differences else "")
    print(f"{compared} compared, {len(differences)} different")
    return 1 if differences or compared == 0 else 0


sys.exit(main())

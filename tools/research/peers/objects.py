# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Objects found by every program among the same obstacles, and how well they come apart.

Counts panoptic quality anew, as tools/research/object_measures/instances.hpp describes it; that of terracut must be the one
which `terracut eval objects` counts."""

import json
import statistics
import sys
from array import array
from collections import Counter, defaultdict

from .drives import MOUNT
from .programs import run

TUNED_ON = ("00", "01", "06")  # tools/research/object_measures/object_trials.hpp
SPLITS = ("tuned", "unseen")
REPEAT = 3
FEWEST_OF_AN_INSTANCE = 10
NO_OBJECT = (0, 40, 44, 48, 49, 60, 72)  # tools/research/object_measures/true_objects.cpp
KINDS = {"cars": (10, 252), "persons": (30, 254), "two-wheelers": (11, 15, 31, 32, 253, 255)}
KIND_OF = {number: kind for kind, numbers in KINDS.items() for number in numbers}


def labels_in(path):
    return array("I", path.read_bytes())


class MarkedScans:
    """The labelled scans of SemanticKITTI roots in a scratch folder, with terracut's labels beside them."""

    def __init__(self, terracut, roots, scratch):
        self.scans, self.truth, self.split, self.ours = [], [], [], []
        for folder in sorted(folder for root in roots for folder in (root / "sequences").iterdir()):
            found = scratch / "terracut" / str(len(self.scans))
            terracut.run("segment", folder, "--labels", found, "--objects", *MOUNT)
            for scan in sorted((folder / "velodyne").glob("*.bin")):
                truth = folder / "labels" / f"{scan.stem}.label"
                if not truth.is_file():
                    continue
                marked = scratch / f"{len(self.scans):06}.bin"
                marked.symlink_to(scan.resolve())
                ours = found / truth.name
                marked.with_suffix(".label").write_bytes(array("I", [label & 0xFFFF for label in labels_in(ours)]).tobytes())
                self.scans.append(marked)
                self.truth.append(truth)
                self.split.append(SPLITS[folder.name not in TUNED_ON])
                self.ours.append(ours)
        if not self.scans:
            sys.exit("expected ROOT/sequences/NN with velodyne/ and labels/, found no such folder")


class Instances:
    """How many instances of a kind were found, as in the panoptic quality."""

    def __init__(self):
        self.found, self.missed, self.false, self.iou_sum = 0, 0, 0, 0.0

    @property
    def quality(self):
        weight = self.found + (self.missed + self.false) / 2
        return self.iou_sum / weight if weight else None

    @property
    def recall(self):
        return self.found / (self.found + self.missed) if self.found + self.missed else None


def has_instances(of_class):
    return 10 <= of_class <= 32 or of_class >= 252


def kind_of(true):
    return KIND_OF.get(true & 0xFFFF, "others")


def count_instances(pairs, by_kind):
    """Adds the instances of a scan to {kind: Instances}. `pairs`: {(entry of the truth, found object or 0): points}."""
    sizes, objects = Counter(), Counter()
    for (true, _), points in pairs.items():
        sizes[true] += points
    instances = {true for true, points in sizes.items()
                 if has_instances(true & 0xFFFF) and true >> 16 and points >= FEWEST_OF_AN_INSTANCE}  # fmt: skip
    known = {true for true in sizes if true in instances or (true & 0xFFFF) > 1 and not has_instances(true & 0xFFFF)}
    on_instances = defaultdict(Counter)
    for (true, found_object), points in pairs.items():
        if found_object and true in known:
            objects[found_object] += points
            if true in instances:
                on_instances[found_object][true] = points
    matched = {}
    for found_object, parts in on_instances.items():
        true, shared = max(parts.items(), key=lambda part: (part[1], -part[0]))
        iou = shared / (sizes[true] + objects[found_object] - shared)
        if iou > 0.5:
            matched[true] = iou
        elif 2 * parts.total() > objects[found_object]:
            by_kind[kind_of(true)].false += 1
    for true in instances:
        kind = by_kind[kind_of(true)]
        kind.found += true in matched
        kind.missed += true not in matched
        kind.iou_sum += matched.get(true, 0)


class Judged:
    """What is made of a program's objects, by split."""

    def __init__(self, name):
        self.name = name
        self.entropies = {split: [] for split in SPLITS}  # of each frame: over-, under-segmentation
        self.instances = {split: defaultdict(Instances) for split in SPLITS}
        self.returns = {split: Counter() for split in SPLITS}  # of what can be an object, by being in a found one
        self.ms = {split: [] for split in SPLITS}  # of each frame: processor time, the shortest of REPEAT

    def add(self, split, entropies, truth, found):
        """Counts a scan. `truth` and `found`: label files' entries by point."""
        pairs = Counter(zip(truth, (label >> 16 for label in found)))
        self.entropies[split].append(entropies)
        count_instances(pairs, self.instances[split])
        for (true, found_object), points in pairs.items():
            if (true & 0xFFFF) not in NO_OBJECT:
                self.returns[split][found_object != 0] += points

    def spread(self, split, which):
        """Returns (mean, deviation) over frames of OSE (0) or USE (1)."""
        values = [entropies[which] for entropies in self.entropies[split]]
        return (statistics.fmean(values), statistics.pstdev(values)) if values else None


def judge(judges, marked, judged, founds):
    """Fills `judged` by the label files `founds`, a list a program. Returns the largest difference between the judges, each a
    program as object_peers/object_entropies.cpp; the last of them is believed."""
    difference = 0.0
    for number, (scan, truth, split) in enumerate(zip(marked.scans, marked.truth, marked.split)):
        of_scan = [found[number] for found in founds]
        said = []
        for program in judges:
            lines = run([program, scan, truth, *of_scan]).splitlines()
            said.append([tuple(float(value) for value in line.split()) for line in lines])
            if len(said[-1]) != len(of_scan) or not all(len(line) == 2 for line in said[-1]):
                sys.exit(f"{program}: expected {len(of_scan)} lines of OSE and USE, found {len(lines)}")
        pairs = [values for of_program in zip(*said) for values in zip(*of_program)]
        difference = max([difference, *(max(values) - min(values) for values in pairs)])
        true_labels = labels_in(truth)
        for program, path, entropies in zip(judged, of_scan, said[-1]):
            program.add(split, entropies, true_labels, labels_in(path))
    return difference


def differences_to_eval(ours, report):
    """Yields what `terracut eval objects` counts otherwise; takes terracut's times from it."""
    (of_method,) = json.loads(report.read_text(encoding="utf-8"))["methods"].values()
    for split in SPLITS:
        counted = of_method["objects"][split]
        if counted["frames"] != len(ours.entropies[split]):
            yield f"{split}: {counted['frames']} frames, not {len(ours.entropies[split])}"
            continue
        if not counted["frames"]:
            continue
        ours.ms[split] = [counted["milliseconds"]]
        for which, name in enumerate(("ose", "use")):
            for value, at in zip(ours.spread(split, which), ("mean", "deviation")):
                if abs(value - counted[name][at]) > 0.001:
                    yield f"{split}: {at} of {name.upper()} {counted[name][at]:.3f}, not {value:.3f}"
        for entry in counted["instances"]:
            if entry["kind"] in KINDS:
                mine = ours.instances[split][entry["kind"]]
                told = (entry["found"], entry["instances"] - entry["found"], entry["false_objects"])
                if told != (mine.found, mine.missed, mine.false) or abs((entry["pq"] or 0) - (mine.quality or 0)) > 1e-6:
                    yield f"{split}: {entry['kind']} {told}, not {(mine.found, mine.missed, mine.false)}"


def time_and_label(peer, marked, judged, scratch):
    """Returns the label files a peer wrote, and takes its times."""
    scratch.mkdir(parents=True)
    lines = run([peer.program, REPEAT, scratch, *marked.scans], peer.core).split()
    if len(lines) != REPEAT * len(marked.scans) or not all(line.isdigit() for line in lines):
        sys.exit(f"{peer.program}: expected {REPEAT * len(marked.scans)} numbers of nanoseconds, a line each")
    for number, split in enumerate(marked.split):
        judged.ms[split].append(min(int(line) for line in lines[number :: len(marked.scans)]) / 1e6)
    found = [scratch / f"{number:06}.label" for number in range(len(marked.scans))]
    for path, scan in zip(found, marked.scans):
        if not path.is_file() or path.stat().st_size != scan.stat().st_size // 4:
            sys.exit(f"{peer.program}: expected a label for every point of {scan.resolve()}")
    return found


def cell(values):
    """Returns "tuned / unseen", "-" where there is nothing."""
    return " / ".join("-" if value is None else value for value in values)


def rows(judged):
    """Yields (program, cells) of the columns NAMES."""
    own = statistics.fmean([ms for split in SPLITS for ms in judged[0].ms[split]])

    def spread(program, which):
        found = (program.spread(split, which) for split in SPLITS)
        return cell(values and f"{values[0]:.1f} ({values[1]:.1f})" for values in found)

    def share(program):
        counts = (program.returns[split] for split in SPLITS)
        return cell(f"{100 * of[True] / of.total():.0f}" if of else None for of in counts)

    def quality(program, kind):
        counts = (program.instances[split][kind] for split in SPLITS)
        return cell(None if of.recall is None else f"{100 * of.quality:.1f}, {100 * of.recall:.1f}" for of in counts)

    for program in judged:
        ms = statistics.fmean([ms for split in SPLITS for ms in program.ms[split]])
        yield program.name, [spread(program, 0), spread(program, 1), share(program),
                             *(quality(program, kind) for kind in KINDS), f"{ms:.1f} (x {ms / own:.1f})"]  # fmt: skip


NAMES = ("OSE", "USE", "in objects, %", *(f"{kind}: PQ, recall" for kind in KINDS), "ms a frame")


def beside(terracut, peers, judges, roots, scratch):
    """Returns ([Judged] of terracut and its peers, how far the judges differ)."""
    marked = MarkedScans(terracut, roots, scratch)
    judged = [Judged("terracut"), *(Judged(peer.name) for peer in peers)]
    founds = [marked.ours]
    for number, peer in enumerate(peers, 1):
        founds.append(time_and_label(peer, marked, judged[number], scratch / f"labels_{number}"))
    difference = judge(judges, marked, judged, founds)
    report = scratch / "objects.json"
    terracut.run("eval", "objects", *roots, "--jobs", 1, "--json", report, *MOUNT)
    differing = list(differences_to_eval(judged[0], report))
    if differing:
        sys.exit("`terracut eval objects` counts otherwise:\n" + "\n".join(differing))
    return judged, difference

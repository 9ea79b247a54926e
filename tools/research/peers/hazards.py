# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Every program on the same hazards: scans that `terracut eval hazards --write` has written."""

import json
import shutil
from array import array
from collections import Counter, defaultdict

from .drives import MOUNT, score_of

SHOWS_HAZARD = 1  # the instance of returns that show a hazard (tools/research/hazards/scan_writer.hpp)


class Scans:
    """The scans of a folder, in the form of a drive for Peer."""

    def __init__(self, folder):
        self.folder = folder
        self.shown = json.loads((folder / "hazards.json").read_text(encoding="utf-8"))["scans"]
        self.scans = [self._file(scan, "velodyne", "bin") for scan in self.shown]
        self.truth = [self._file(scan, "labels", "label") for scan in self.shown]

    def _file(self, scan, kind, ending):
        return self.folder / "sequences" / scan["sequence"] / kind / f"{scan['scan']}.{ending}"


def written(program, root, kinds, trials, seed, scratch):
    """Yields the scans of a SemanticKITTI root, frame after frame; the files of a frame are removed
    when the next one is asked for."""
    folder = scratch / "hazards"
    for sequence in sorted((root / "sequences").glob("*")):
        for number in range(len(list((sequence / "labels").glob("*.label")))):
            program.run("eval", "hazards", root, "--sequences", sequence.name, "--frames", number, "--trials", trials,
                        "--seed", seed, "--jobs", 1, "--write", folder, *(["--kinds", kinds] if kinds else []), *MOUNT)  # fmt: skip
            yield Scans(folder)
            shutil.rmtree(folder)


class Found:
    """Counts what a program finds of hazards, as `terracut eval hazards` counts it."""

    def __init__(self):
        self.trials = defaultdict(Counter)  # by (what, ground, from_m, to_m)
        self.elsewhere = defaultdict(lambda: defaultdict(Counter))  # by disturbance or "" and sequence

    def add(self, scan, truth, labels, role_of):
        pairs = Counter(zip(truth, labels))
        if "ground" not in scan:
            counts = self.elsewhere[scan["what"]][scan["sequence"]]
            for (true, label), number in pairs.items():
                counts[true & 0xFFFF, label & 0xFFFF] += number
            return
        shown = {label: number for (true, label), number in pairs.items() if true >> 16 == SHOWS_HAZARD}
        of_label = Counter()
        for label, number in shown.items():
            of_label[role_of.get(label & 0xFFFF) == "ground"] += number
        returns, as_obstacle = of_label.total(), of_label[False]
        self.trials[scan["what"], scan["ground"], scan["from_m"], scan["to_m"]] += Counter(
            trials=1, found=int(as_obstacle >= 2 and 10 * as_obstacle >= 3 * returns), unseen=int(as_obstacle == 0)
        )

    def label(self, program, scans, labels, role_of):
        program.label(scans, labels)
        for number, (scan, truth) in enumerate(zip(scans.shown, scans.truth)):
            found = array("I", (labels / f"{number:06}.label").read_bytes())
            self.add(scan, array("I", truth.read_bytes()), found, role_of)
        shutil.rmtree(labels)


def trials_of(founds):
    """Yields (what, ground, from_m, to_m) of the trials, in order."""
    yield from sorted({key for found in founds for key in found.trials})


def counted(names, founds):
    """Returns the trials and what each program found in them, for a file."""
    return [dict(zip(("what", "ground", "from_m", "to_m"), key)) | {"of": {name: found.trials[key] for name, found in zip(names, founds)}}
            for key in trials_of(founds)]  # fmt: skip


def hazard_rows(founds):
    """Returns a row for each program, "found / no return called obstacle" in percent; the title has
    the number of trials."""
    for key in trials_of(founds):
        what, ground, from_m, to_m = key
        counts = [found.trials[key] for found in founds]
        title = f"{what}, {ground}, {from_m:.0f} to {to_m:.0f} m ({counts[0]['trials']})"
        yield title, [
            f"{100 * count['found'] / count['trials']:.0f} / {100 * count['unseen'] / count['trials']:.0f}" for count in counts
        ]


def disturbance_rows(founds, role_of, cell):
    """Returns cell(IoU_g, Recall_o) of the returns that did not move: means over sequences."""
    for what in sorted({what for found in founds for what in found.elsewhere}):
        scores = [[score_of(counts, role_of) for counts in found.elsewhere[what].values()] for found in founds]
        yield what or "nothing", [cell(of_sequences) for of_sequences in scores]

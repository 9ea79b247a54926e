# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs `terracut eval` and gathers what comes of it."""

import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from scan_folders import gather, link
from tables import mean

from .columns import CLOUDS, HAZARD_SEED, ROWS_LEFT, SEEDS, cells_of, layout, runs_of
from .rows import METHOD, STAGES, parameters_of
from .thinned_scans import thin_folder

RECORDED = ("semantickitti", "semantickitti_more")


class Refused(Exception):
    """What a program was asked for and said."""


def said(command):
    ran = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if ran.returncode != 0:
        raise Refused(f"{' '.join(map(str, command))}\n{ran.stderr}")
    return ran.stdout


def version_of(program, label_hash):
    """What figures belong to: the fingerprint of labels, every parameter that is measured, and the seeds."""
    parameters = parameters_of(said([program, "parameters"]))
    return {"labels": said([label_hash]).strip(), "seeds": [*SEEDS], "hazard_seed": HAZARD_SEED,
            "parameters": {known.key: known.value for known in parameters}}  # fmt: skip


def places_of(data, scratch):
    """Lays out the data for runs_of()."""
    places = {"scans": gather([data / name for name in RECORDED], scratch / "scans")}
    layouts = {name: {"rings": 64 // one_in} for name, one_in in ROWS_LEFT.items()}
    for name, one_in in ROWS_LEFT.items():
        places[name] = thin_folder(places["scans"], one_in, scratch / name)
    for name, (folder, keys) in CLOUDS.items():
        if not (data / folder).is_dir():
            sys.exit(f"expected {data / folder} with velodyne/ and labels/, found no such folder")
        places[name] = scratch / name
        places[name].mkdir()
        link(data / folder, places[name] / name)
        layouts[name] = keys
    for name, keys in layouts.items():
        places[f"{name}.yaml"] = scratch / f"{name}.yaml"
        places[f"{name}.yaml"].write_text(layout(keys), encoding="utf-8")
    return places


def evaluated(program, run, rows):
    """{row: its method in the report} of one run."""
    names = {row.name: row.name if row.name in (METHOD, *STAGES) else f"row_{number}" for number, row in enumerate(rows)}
    methods = [row.name for row in rows if names[row.name] == row.name]
    variants = [f"--variant={names[row.name]}={METHOD},{row.name}" for row in rows if row.name not in methods]
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        said([program, "eval", *run.arguments, "--json", report, "--method", ",".join(methods), *variants])
        told = json.loads(report.read_text(encoding="utf-8"))
    if told["faults"] or not told["complete"]:
        raise Refused(f"eval {' '.join(run.arguments)}: {told['faults'] or 'not complete'}")
    return {row: told["methods"][name] for row, name in names.items()}


class Measured:
    """Figures as they come in, run by run in any order."""

    def __init__(self):
        self.cells = {}  # {(row, column): {cell: [measures]}}
        self.hazards, self.disturbances = [], []

    def add(self, run, methods):
        if run.whole:
            counts = ("hazard", "ground", "from_m", "to_m", "trials", "found", "unseen")
            self.hazards = [{key: told[key] for key in counts} for told in methods[METHOD]["hazards"]]
            self.disturbances = methods[METHOD]["disturbances"]
            return
        for row, method in methods.items():
            for column in run.columns:
                cells = self.cells.setdefault((row, column), {})
                for cell, measures in cells_of(run, column, method).items():
                    cells.setdefault(cell, []).append(measures)

    def results(self):
        """As in docs/reference/measures.json: percent; of the method the cells of simulated drives, of each seed, too."""
        results = {"rows": {}, "cells": {}, "hazards": self.hazards, "disturbances": self.disturbances}
        for (row, column), cells in sorted(self.cells.items()):
            cells = {cell: sorted(of_seeds, key=str) for cell, of_seeds in sorted(cells.items())}
            results["rows"].setdefault(row, {})[column] = rounded(means_of([means_of(of) for of in cells.values()]))
            if row == METHOD and any(len(of_seeds) > 1 for of_seeds in cells.values()):
                results["cells"][column] = {cell: [rounded(of) for of in of_seeds] for cell, of_seeds in cells.items()}
        return results


def means_of(measures):
    return [mean(of) for of in zip(*measures)]


def rounded(measures):
    """Four digits: tables show two."""
    return [None if value is None else round(value, 4) for value in measures]


def measure(program, data, rows, columns, processes, say):
    """The results of these rows and columns, without columns of all and of every hazard; `say(done, of)` after each run.
    Raises Refused."""
    with tempfile.TemporaryDirectory() as folder:
        runs = [run for run in runs_of(places_of(data, Path(folder)))
                if columns is None or set(run.columns) & set(columns)]  # fmt: skip
        measured = Measured()
        with ThreadPoolExecutor(processes) as pool:
            asked = {pool.submit(evaluated, program, run, rows[:1] if run.whole else rows): run for run in runs}
            try:
                for done, future in enumerate(as_completed(asked), 1):
                    measured.add(asked[future], future.result())
                    say(done, len(runs))
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        return measured.results()

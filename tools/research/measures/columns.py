# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What it is measured on. A column's value is the mean over its cells: sequences, or scenes of simulated drives."""

from dataclasses import dataclass
from pathlib import Path

CLASSES = Path(__file__).resolve().parents[1] / "datasets/semantickitti_classes.yaml"
# Tuning saw none of these. Drives of one seed differ from those of another by ten points and more.
SEEDS = (31, 32, 33, 34, 35)
HAZARD_SEED = 77
SCENES = ("street", "highway", "rural", "hill")
DURATION_S = "0.1"

SENSORS = {"vlp16": "VLP-16", "hdl32e": "HDL-32E", "vlp32c": "VLP-32C", "hdl64e": "HDL-64E", "ruby128": "RS-Ruby128",
           "vls128": "VLS-128"}  # fmt: skip
MOUNTED = ("hdl64e", "ruby128")
MOUNTS = {  # beside the nominal one, 1.73 m and level
    "0.8 m": ("--mount-height", "0.8"),
    "3.0 m": ("--mount-height", "3.0"),
    "1.73 m, pitched 5°": ("--mount-height", "1.73", "--mount-pitch", "5"),
    "1.73 m, rolled 5°": ("--mount-height", "1.73", "--mount-roll", "5"),
    "3.0 m, pitched and rolled 5°": ("--mount-height", "3.0", "--mount-pitch", "5", "--mount-roll", "5"),
}
# The folder in the data, and what `eval own` has to know of it beside its classes, which are SemanticKITTI's numbers.
CLOUDS = {
    "nuscenes": ("nuscenes", {"rings": 32, "columns": 1084}),
    "av2_up": ("av2/up", {"rings": 32, "columns": 1800}),
    "av2_both": ("av2/both", {"rings": 64, "columns": 1800}),
    "av2_down": ("av2/down", {"rings": 32, "columns": 1800}),
    "ika": ("ika", {"rings": 32, "columns": 1800}),
}
ROWS_LEFT = {"second_row": 2, "fourth_row": 4}  # one in so many


@dataclass(frozen=True)
class Column:
    """`measures`: of "IoU_g", "Recall_o" and others, percent; of "none" (no return seen) less is better."""

    name: str
    title: str
    tuned: bool
    measures: tuple = ("IoU_g", "Recall_o")


SHARES = ("found", "none")
COLUMNS = (
    Column("scans", "36 scans", True, ("IoU_g", "Recall_o", "F1", "no vegetation")),
    Column("sequence_10", "36 scans, sequence 10", True),
    Column("second_row", "every second row left out", True),
    Column("fourth_row", "one row in four left", True),
    Column("nuscenes", "nuScenes, HDL-32E", True),
    Column("av2_up", "Argoverse 2, upper VLP-32C", True),
    Column("av2_both", "Argoverse 2, both", True),
    Column("av2_down", "Argoverse 2, lower", True),
    Column("ika", "32 rows, front sector of 45°", True),
    *(Column(sensor, title, False) for sensor, title in SENSORS.items()),
    Column("dual", "HDL-64E, dual return", False),
    *(Column(f"mounts_{sensor}", f"{SENSORS[sensor]}, mounts", False) for sensor in MOUNTED),
    Column("person_road", "lying person, road, 20 to 40 m", False, SHARES),
    Column("person_grass", "lying person, grass, 20 to 40 m", False, SHARES),
    Column("box", "box of 0.20 m, road, 5 to 20 m", False, SHARES),
    Column("tail_lift", "tail lift", False, ("returns",)),
    Column("ghosts_1", "1 % ghosts", False),
    Column("ghosts_5", "5 % ghosts", False),
    Column("puddle", "puddle", False),
)
COLUMN_OF = {column.name: column for column in COLUMNS}
LESS_IS_BETTER = ("none",)

# Column: hazard, grounds, from and up to how many metres.
HAZARDS = {
    "person_road": ("lying_person", ("road",), 20, 40),
    "person_grass": ("lying_person", ("grass",), 20, 40),
    "box": ("box_20cm", ("road",), 5, 20),
    "tail_lift": ("tail_lift", ("road",), 0, 60),
}
DISTURBANCES = ("ghosts_1", "ghosts_5", "puddle")


@dataclass(frozen=True)
class Run:
    """One `terracut eval`. `mount`: of its column's cells; `whole`: for the tables of hazards, the method alone."""

    columns: tuple
    arguments: tuple
    mount: str = ""
    whole: bool = False


def layout(keys):
    """A class table of clouds: folders in the root, and SemanticKITTI's numbers."""
    lines = ['sequences: "*"', 'points: "velodyne/*.pcd"', "point_format: pcd", 'labels: "labels/*.label"',
             "label_format: uint32", *(f"{key}: {value}" for key, value in keys.items()), "rings_from: field"]  # fmt: skip
    text = CLASSES.read_text(encoding="utf-8")
    return "layout:\n" + "".join(f"  {line}\n" for line in lines) + text[text.index("\nclasses:\n") + 1 :]


def runs_of(places):
    """All runs, the longest first. `places`: {name: folder} of "scans", ROWS_LEFT and CLOUDS, {name.yaml: its layout}."""
    scans, jobs = str(places["scans"]), ("--jobs", "1")
    hazards = ("hazards", "semantickitti", scans, "--seed", str(HAZARD_SEED), *jobs)
    runs = []
    for kind in dict.fromkeys(of[0] for of in HAZARDS.values()):
        columns = tuple(name for name, of in HAZARDS.items() if of[0] == kind)
        runs.append(Run(columns, (*hazards, "--kinds", kind)))
    runs.append(Run(DISTURBANCES, (*hazards, "--kinds", ",".join(DISTURBANCES))))
    runs.append(Run((), hazards, whole=True))
    runs.append(Run(("scans", "sequence_10"), ("semantickitti", scans, *jobs)))
    for name in (*ROWS_LEFT, *CLOUDS):
        find = ("--find-mount",) if name in CLOUDS else ()
        runs.append(Run((name,), ("own", str(places[name]), "--classes", str(places[f"{name}.yaml"]), *find, *jobs)))
    for seed in map(str, SEEDS):
        drives = ("simulated", ",".join(SCENES), "--duration", DURATION_S, "--seed", seed)
        for sensor in SENSORS:
            runs.append(Run((sensor,), (*drives, "--sensor", sensor)))
        runs.append(Run(("dual",), (*drives, "--sensor", "hdl64e", "--returns", "dual")))
        for sensor in MOUNTED:
            for mount, stated in MOUNTS.items():
                runs.append(Run((f"mounts_{sensor}",), (*drives, "--sensor", sensor, *stated), mount))
    return runs


def hazard_shares(trials):
    """(found, not one return), percent, of the method's trials."""
    count = sum(trial["trials"] for trial in trials)
    return [100 * sum(trial[what] for trial in trials) / count if count else None for what in ("found", "unseen")]


def returns_share(trials):
    count = sum(trial["returns"] for trial in trials)
    return [100 * sum(trial["returns_as_obstacle"] for trial in trials) / count if count else None]


def of_hazard(column, method):
    """The column's measures, of one method of a report of hazards."""
    if column in DISTURBANCES:
        elsewhere = next(told["elsewhere"] for told in method["disturbances"] if told["disturbance"] == column)
        return [100 * elsewhere[figure]["after"] for figure in ("iou_g", "recall_o")]
    kind, grounds, from_m, to_m = HAZARDS[column]
    trials = [told for told in method["hazards"]
              if told["hazard"] == kind and told["ground"] in grounds and from_m <= told["from_m"] < to_m]  # fmt: skip
    return returns_share(trials) if column == "tail_lift" else hazard_shares(trials)


def percent(share):
    return None if share is None else 100 * share


def of_sequence(sequence):
    """IoU_g, Recall_o, F1, and IoU_g with vegetation ignored."""
    everything = sequence["all"]
    return [percent(share) for share in (everything["iou_g"], everything["recall_o"], everything["f1"],
                                         sequence["all_vegetation_ignored"]["iou_g"])]  # fmt: skip


def cells_of(run, column, method):
    """{cell: measures} of one method of the run's report."""
    if column in HAZARDS or column in DISTURBANCES:
        return {"": of_hazard(column, method)}
    measures = COLUMN_OF[column].measures
    sequences = {"10": method["sequences"]["10"]} if column == "sequence_10" else method["sequences"]
    return {" ".join(filter(None, (run.mount, name))): of_sequence(sequence)[: len(measures)]
            for name, sequence in sequences.items()}  # fmt: skip

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The tables of docs/reference, as they stand between `<!-- measures: NAME -->` and `<!-- end of NAME -->`."""

from tables import mean, table

from .columns import CLOUDS, COLUMN_OF, MOUNTED, MOUNTS, ROWS_LEFT, SCENES, SENSORS
from .rows import METHOD, STAGES
from .worth import summary, worth_table

DOCUMENTS = ("docs/reference/method.md", "docs/reference/worth.md")
RESULTS = "docs/reference/measures.json"
LEAST_TRIALS = 10
RANGES_M = ((5, 10), (10, 20), (20, 40), (40, 60))
ON_GRASS = ("lying_person", "animal", "box_20cm")  # what it does to others is much the same
DISTURBED = {"ghosts_0.1": "ghosts, 0.1 % of low returns", "ghosts_1": "... 1 %", "ghosts_5": "... 5 %",
             "puddle": "puddle, half mirrored", "spray": "spray", "snow_1": "snow, 1 %", "snow_10": "... 10 %",
             "dirt": "dirt on a sector"}  # fmt: skip


def figure(value):
    return "" if value is None else f"{value:.2f}"


def stages_table(results):
    kinds = ("IoU_g", "F1", "Recall_o", "IoU_g, vegetation ignored")
    names = {"terracut_ring_map": "elevation map", "terracut_ring_map_adjacent": "+ adjacent points", METHOD: "**+ MRF**",
             "paper": STAGES["paper"]}  # fmt: skip
    rows = []
    for row, name in names.items():
        iou, recall, f1, no_vegetation = results["rows"][row]["scans"]
        rows.append((name, map(figure, (iou, f1, recall, no_vegetation))))
    ours = results["rows"][METHOD]
    for column in (*ROWS_LEFT, "sequence_10"):
        iou, recall = ours[column]
        rows.append((COLUMN_OF[column].title, (figure(iou), "", figure(recall), "")))
    return table("", kinds, rows)


def clouds_table(results):
    return table("", ("IoU_g", "Recall_o"), [(COLUMN_OF[column].title, map(figure, results["rows"][METHOD][column]))
                                             for column in CLOUDS])  # fmt: skip


def of_seeds(measures):
    """The means over the seeds, and the least of each."""
    each = [[value for value in values if value is not None] for values in zip(*measures)]
    means, least = ([f"{of(values):.1f}" for values in each] for of in (mean, min))
    return f"{' / '.join(means)} ({' / '.join(least)})"


def scenes_table(results, rows):
    return table("", SCENES, [(title, [of_seeds(results["cells"][column][f"{mount} {scene}".strip()]) for scene in SCENES])
                              for title, column, mount in rows])  # fmt: skip


def simulated_table(results):
    return scenes_table(results, [*((title, sensor, "") for sensor, title in SENSORS.items()),
                                  (COLUMN_OF["dual"].title, "dual", "")])  # fmt: skip


def mounts_table(results):
    return scenes_table(results, [(f"{SENSORS[sensor]}, {mount}", f"mounts_{sensor}", mount)
                                  for sensor in MOUNTED for mount in MOUNTS])  # fmt: skip


def hazards_table(results):
    rows = {}
    for told in results["hazards"]:
        if told["ground"] == "road" or (told["ground"] == "grass" and told["hazard"] in ON_GRASS):
            of = rows.setdefault(f"{told['hazard'].replace('_', ' ')}, {told['ground']}", {})
            if told["trials"] >= LEAST_TRIALS:
                shares = (100 * told[what] / told["trials"] for what in ("found", "unseen"))
                of[told["from_m"], told["to_m"]] = " / ".join(f"{share:.0f}" for share in shares)
    return table("found / not one return, %", [f"{near} to {far} m" for near, far in RANGES_M],
                 [(title, [of.get(reach, "") for reach in RANGES_M]) for title, of in rows.items()])  # fmt: skip


def disturbances_table(results):
    rows = []
    for told in results["disturbances"]:
        cells = []
        for of in (told["elsewhere"]["iou_g"], told["elsewhere"]["recall_o"]):
            cells += [figure(100 * of["after"]), f"{100 * (of['after'] - of['before']):+.2f}"]
        rows.append((DISTURBED[told["disturbance"]], cells))
    return table("what did not move, percent", ("IoU_g", "change", "Recall_o", "change"), rows)


def blocks(results, rows):
    """{name: lines} of all that the documents show."""
    version = results["version"]
    return {
        "stages": stages_table(results),
        "clouds": clouds_table(results),
        "simulated": simulated_table(results),
        "mounts": mounts_table(results),
        "hazards": hazards_table(results),
        "disturbances": disturbances_table(results),
        "version": [f"Measured on the version whose label hash is {version['labels'].partition(':')[0]}. Seeds of simulated "
                    f"drives: {', '.join(map(str, version['seeds']))}; of hazards: {version['hazard_seed']}."],
        "unseen": worth_table(results, rows, False),
        "tuned": worth_table(results, rows, True),
        "least": summary(results, rows),
    }  # fmt: skip

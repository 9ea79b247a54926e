# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""An evaluation as `terracut eval --report` writes it, with numbers made up here."""

import base64

# One grey pixel.
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="
)
SCOPES = ("all", "road", "all_vegetation_ignored")
BANDS = ("<20m", "20-40m", ">40m")


def measures(value):
    return {name: value - 0.01 * place for place, name in enumerate(("iou_g", "recall_o", "precision", "recall", "f1"))}


def scopes(value):
    return {scope: measures(value - 0.1 * place) for place, scope in enumerate(SCOPES)}


def times(value):
    return {"mean": value, "p50": value + 0.01, "p99": value + 0.5, "max": value + 1}


def spread(value):
    return {"min": value - 0.1, "mean": value, "max": value + 0.01}


def of_class(class_id, name, points, as_ground, as_other_ground=0):
    return {"id": class_id, "name": name, "points": points, "as_ground": as_ground, "as_other_ground": as_other_ground,
            "share_as_ground": as_ground / points, "share_as_other_ground": as_other_ground / points}  # fmt: skip


def method(about, value, sequences, frames, tells_road=False):
    return {
        "about": about,
        "parameters": {"grid.min_band_m": "0.4"},
        "mean_over_sequences": scopes(value),
        "pooled": scopes(value),
        "by_range": {band: measures(value) for band in BANDS},
        "by_range_road": {band: measures(value / 2) for band in BANDS},
        "by_class": [of_class(40, "road", 1000, 990, 10 if tells_road else 0), of_class(10, "car", 100, 3)],
        "ms": {"segment": times(4 * value), "elevation_map": times(2 * value)},
        "lost": {"points_without_ring": 1, "points_not_placed": 2, "points_not_finite": 3, "frames_realigned": 4},
        "sequences": {
            name: {"frames": frames, "points": 1100, **scopes(value), "frame_iou_g": spread(value),
                   "frame_recall_o": spread(value), "frame_iou_road": spread(value), "ms": times(4 * value)}
            for name in sequences
        },
        "frames": [
            {"sequence": name, "frame": f"{place:06}", "points": 1100, "iou_g": value, "recall_o": value, "iou_road": value / 2,
             "ms": 4 * value + 0.1 * place}
            for name in sequences for place in range(frames)
        ],
    }  # fmt: skip


def evaluation(dataset="semantickitti", sequences=("00", "03"), frames=3):
    return {
        "terracut": "0.0.0",
        "dataset": dataset,
        "root": "/data/made <up>",
        "through_packets": False,
        "complete": True,
        "interrupted": False,
        "classes": [{"id": 40, "name": "road", "all": "ground", "road": "ground", "vegetation": False},
                    {"id": 10, "name": "car", "all": "key", "road": "key", "vegetation": False}],
        "methods": {"pfaff": method("A grid", 0.8, sequences, frames),
                    "terracut_road": method("Ours & the road", 0.9, sequences, frames, tells_road=True)},
        "oracles": {name: {**scopes(0.5), "sequences": {sequence: scopes(0.5) for sequence in sequences}}
                    for name in ("everything_ground", "perfect_ground")},
        "faults": [],
        "warnings": [],
    }  # fmt: skip


def with_frames(made_up, folder):
    """The same with pictures, whose files are written to that folder."""
    (folder / "pictures").mkdir(parents=True)
    (folder / "pictures/a.png").write_bytes(PNG)
    frame = {"sequence": "00", "frame": "000001", "why": "lowest Recall_o", "side_m": 60, "truth": "pictures/a.png"}
    return {
        **made_up,
        "side_by_side": [{**frame, "methods": {name: "pictures/a.png" for name in made_up["methods"]}}],
        "worst_of": "terracut_road",
        "worst": [{**frame, "result": "pictures/a.png", "panorama": "pictures/a.png"}],
        "colours": {"truth": dict.fromkeys(["road", "ground", "ordinary", "key", "ignored"], "#112233"),
                    "verdict": dict.fromkeys(["ground", "other_ground", "obstacle", "missed_key", "missed_ordinary",
                                              "false_obstacle"], "#445566")},
    }  # fmt: skip

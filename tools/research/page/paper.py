# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The figures of the paper's Tables I to IX, by our names for its methods."""

import json
from pathlib import Path

TABLES = json.loads(Path(__file__).with_name("paper_tables.json").read_text())


def columns(evaluation):
    """Returns [(title, evaluated sequence or None, place in the paper's tables or None)] for the tables by sequence:
    the paper's sequences, then the other evaluated ones. The paper's ForestMap is in a folder KoblenzForestMap."""
    evaluated = list(next(iter(evaluation["methods"].values()))["sequences"])
    printed = TABLES["datasets"].get(evaluation["dataset"], {}).get("sequences", [])
    listed = []
    for place, title in enumerate(printed):
        listed.append((title, next((name for name in evaluated if name in (title, f"Koblenz{title}")), None), place))
    named = [name for _, name, _ in listed]
    return listed + [(name, name, None) for name in evaluated if name not in named]

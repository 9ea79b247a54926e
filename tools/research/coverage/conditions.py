# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Conditions of decisions, and whether tests showed that each decides: modified condition / decision coverage (MC/DC)."""

from collections import defaultdict
from dataclasses import dataclass


@dataclass(frozen=True, order=True)
class Condition:
    file: str
    line: int
    column: int
    is_covered: bool


def conditions_of(export):
    """The conditions of the sources in what `llvm-cov export` prints, in order. A condition that stands alone in its decision is
    covered if it was both true and false; one of several if it decided by itself what came out. What a template makes of a place
    counts as one."""
    found = []
    for file in export["data"][0]["files"]:
        decisions, outcomes = defaultdict(lambda: []), defaultdict(lambda: [0, 0])
        for line, column, end_line, end_column, _, _, covered in file["mcdc_records"]:
            decisions[(line, column, end_line, end_column)].append(covered)
        for line, column, _, _, times_true, times_false, *_ in file["branches"]:
            outcome = outcomes[(line, column)]
            outcome[0] += times_true
            outcome[1] += times_false
        inside = set()
        # A decision within another, in a call, begins later: it takes its conditions first.
        for (line, column, end_line, end_column), records in sorted(decisions.items(), reverse=True):
            places = sorted(place for place in outcomes if (line, column) <= place < (end_line, end_column) and place not in inside)
            covered = [any(each) for each in zip(*records)]
            found += [Condition(file["filename"], *place, is_covered) for place, is_covered in zip(places, covered)]
            inside.update(places)
        found += [Condition(file["filename"], *place, all(seen)) for place, seen in outcomes.items() if place not in inside]
    return sorted(found)


def counts_by(conditions, group_of):
    """{group: (covered, all)}"""
    counts = defaultdict(lambda: (0, 0))
    for condition in conditions:
        covered, total = counts[group_of(condition)]
        counts[group_of(condition)] = (covered + condition.is_covered, total + 1)
    return dict(counts)

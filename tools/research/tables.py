# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Figures in Markdown tables."""

import statistics


def mean(values):
    """Returns the mean of those that are not None, or None."""
    values = [value for value in values if value is not None]
    return statistics.fmean(values) if values else None


def row(cells):
    return "| " + " | ".join(cells) + " |"


def table(title, names, rows):
    yield row([title, *names])
    yield "|" + "---|" * (1 + len(names))
    for title_of_row, cells in rows:
        yield row([title_of_row, *cells])

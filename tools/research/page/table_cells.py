# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Makes table cells of numbers. The attribute `data-path` of a cell states, as a JSON pointer,
where its number is in the evaluation, so that anybody can check the page against the JSON. A
missing number is a dash."""

from markupsafe import Markup

EMPTY = Markup("<td>–</td>")


def number_at(evaluation, path):
    """Returns the number under those keys or list indices; None if there is none."""
    value = evaluation
    for key in path:
        try:
            value = value[key]
        except (KeyError, IndexError, TypeError):
            return None
    return value if isinstance(value, (int, float)) else None


class TableCells:
    def __init__(self, evaluation):
        self.evaluation = evaluation

    def cell(self, path, form, scale=1):
        number = number_at(self.evaluation, path)
        if number is None:
            return EMPTY
        pointer = "".join("/" + str(key).replace("~", "~0").replace("/", "~1") for key in path)
        return Markup('<td data-path="{}">{}</td>').format(pointer, format(scale * number, form))

    def percent(self, *path):
        return self.cell(path, ".2f", 100)

    def ms(self, *path):
        return self.cell(path, ".2f")

    def count(self, *path):
        return self.cell(path, ".0f")


def printed(value):
    """Returns the cell of a number from the paper."""
    return EMPTY if value is None else Markup('<td class="paper">{:.2f}</td>').format(value)

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Table cells of numbers. One that comes from the evaluation says in its attribute `data-path` where it lies there,
as a JSON pointer, so that anybody can check the page against the JSON. A number that is not there is a dash."""

from markupsafe import Markup

EMPTY = Markup("<td>–</td>")


def number_at(evaluation, path):
    """The number under those keys, or places of lists; None where there is none."""
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
    """A number of the paper."""
    return EMPTY if value is None else Markup('<td class="paper">{:.2f}</td>').format(value)

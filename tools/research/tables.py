# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Figures in Markdown tables, and these in documents."""

import re
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


def filled(text, command, blocks):
    """The document with every block of a command, `<!-- COMMAND: NAME -->` to `<!-- end of NAME -->`, as it should be; one that
    begins and ends within a line stays there. `blocks`: {name: lines}."""

    def block(found):
        name, newline = found[1], found[2]
        return f"<!-- {command}: {name} -->{newline}" + "\n".join(blocks[name]) + f"{newline}<!-- end of {name} -->"

    return re.sub(rf"<!-- {command}: (\w+) -->(\n?).*?<!-- end of \1 -->", block, text, flags=re.DOTALL)

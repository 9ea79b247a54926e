# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What is lost, and where, with something taken back."""

from tables import table

from .columns import COLUMNS, LESS_IS_BETTER
from .rows import METHOD, STAGES

LEAST_LOSS = 0.1  # less is chance
SMALL_LOSS = 0.5


def change(value, whole):
    """Of one figure against the method's: nothing where it rounds to nothing."""
    if value is None or whole is None or abs(value - whole) < LEAST_LOSS / 2:
        return ""
    return f"{value - whole:+.1f}"


def changes(values, whole):
    shown = [change(*both) for both in zip(values, whole)]
    return " / ".join(text or "0" for text in shown) if any(shown) else ""


def losses(results, row, tuned):
    """[(points lost, measure, column's title)] of a row, most first."""
    lost = []
    for column in COLUMNS:
        if column.tuned == tuned and column.name in results["rows"][row]:
            both = zip(column.measures, results["rows"][row][column.name], results["rows"][METHOD][column.name])
            for measure, value, whole in both:
                if value is not None and whole is not None:
                    points = value - whole if measure in LESS_IS_BETTER else whole - value
                    lost.append((points, measure, column.title))
    return sorted((of for of in lost if of[0] >= LEAST_LOSS), key=lambda of: -of[0])


def head(column):
    measures = column.measures[:2]
    return column.title + ("" if measures == ("IoU_g", "Recall_o") else f": {' / '.join(measures)}")


def worth_table(results, rows, tuned):
    """The method's figures; of every other row what it changes, and where it loses most."""
    whole = results["rows"][METHOD]
    columns = [column for column in COLUMNS if column.tuned == tuned and column.name in whole]
    lines = [(rows[0].what, [" / ".join("" if value is None else f"{value:.1f}" for value in whole[column.name][:2])
                             for column in columns] + [""])]  # fmt: skip
    for row in rows[1:]:
        of = results["rows"][row.name]
        setting = "" if row.name in STAGES else f"`{row.name.replace(',', ' ')}` "
        cells = [changes(of[column.name][:2], whole[column.name][:2]) for column in columns]
        most = losses(results, row.name, tuned)[:1]
        cells.append(f"{most[0][0]:.1f} {most[0][1]}, {most[0][2]}" if most else "**nothing**")
        lines.append((f"{setting}{row.what}".strip(), cells))
    return table("taken back", [*map(head, columns), "loses most"], lines)


def most_lost(results, rows, tuned=False):
    """{parameter: (points, measure, column's title)} of the most that one of its rows loses on such data, least first;
    (0, "", "") where none loses anything."""
    most = {}
    for row in rows:
        of_row = (losses(results, row.name, tuned) or [(0, "", "")])[0]
        if len(row.keys) == 1:
            key = row.keys[0]
            most[key] = max(most.get(key, of_row), of_row, key=lambda of: of[0])
    return dict(sorted(most.items(), key=lambda of: of[1][0]))


def summary(results, rows):
    most = most_lost(results, rows)
    if not most:
        return
    nothing = [f"`{key}`" for key, of in most.items() if of[0] == 0]
    little = [f"`{key}` ({points:.1f} {measure}, {title})" for key, (points, measure, title) in most.items()
              if 0 < points < SMALL_LOSS]  # fmt: skip
    yield f"Of {len(most)} parameters these lose less than {LEAST_LOSS} points on each unseen column: {', '.join(nothing) or 'none'}."
    yield f"These lose less than {SMALL_LOSS}: {', '.join(little) or 'none'}."

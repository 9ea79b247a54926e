# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Measures the method on all data at hand, and what it loses with each parameter taken back.

    ./tools/measures ../shared/data     # everything, into docs/reference/
    ./tools/measures ../shared/data --row surface.far_slope --row adjacent.column_reach=2 --columns scans,vlp16,ghosts_5
    ./tools/measures                    # the documents anew, from what was measured

A row is the method, one of its stages, the paper's profile, or the method with one parameter at the value that switches its
rule off, at the paper's or at its half and its double; rows follow from `terracut parameters`. A column is a set of data:
recorded scans, which all are tuned on, whole and with rows left out; clouds of other sensors; and what tuning did not see,
drives simulated with other seeds and hazards at other places. DATA has the folders that columns.py names.

Without --row and --columns the results go whole into docs/reference/measures.json, the tables of it into method.md and
worth.md; Documents.MeasuresAreOfThisVersion fails when the method is another one since. With either, tables are printed and
no document changes. The program is build/release/terracut or $TERRACUT; beside it stands tests/portability/label_hash.
"""

import argparse
import json
import os
import sys
from pathlib import Path

from tables import filled
from whole_file import write_whole_file

from .columns import COLUMNS
from .documents import DOCUMENTS, RESULTS, blocks
from .measurement import Refused, measure, said, version_of
from .rows import chosen, parameters_of, rows_of
from .worth import summary, worth_table

REPOSITORY = Path(__file__).resolve().parents[3]


def arguments(given):
    parser = argparse.ArgumentParser(prog="measures", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("data", type=Path, nargs="?", metavar="DATA")
    parser.add_argument("--row", action="append", metavar="NAME", help="a parameter, a method, or settings KEY=VALUE,...; "
                        "repeatable; the method itself always is one")  # fmt: skip
    parser.add_argument("--columns", type=columns, metavar="NAME,...",
                        help="of " + ", ".join(column.name for column in COLUMNS))  # fmt: skip
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="processes (default: one a core)")
    parser.add_argument("--json", type=Path, help="file for the results, beside those in the documents")
    return parser.parse_args(given)


def columns(text):
    names = text.split(",")
    unknown = set(names) - {column.name for column in COLUMNS}
    if unknown:
        raise argparse.ArgumentTypeError(f"there is no column {sorted(unknown)[0]}")
    return names


def printed(results, rows):
    measured = [column for column in COLUMNS if column.name in results["rows"][rows[0].name]]
    if any(not column.tuned for column in measured):
        yield from ("Not tuned on:", "", *worth_table(results, rows, False), "", *summary(results, rows), "")
    if any(column.tuned for column in measured):
        yield from ("Tuned on:", "", *worth_table(results, rows, True))


def main(given):
    options = arguments(given)
    program = Path(os.environ.get("TERRACUT", REPOSITORY / "build/release/terracut")).resolve()
    part = options.row is not None or options.columns is not None

    def say(done, of):
        print(f"\r{done}/{of}", end="\n" if done == of else "", file=sys.stderr, flush=True)

    try:
        rows = rows_of(parameters_of(said([program, "parameters"])))
        if options.data is None:
            show(json.loads((REPOSITORY / RESULTS).read_text(encoding="utf-8")), rows)
            return 0
        if options.row is not None:
            rows = chosen(rows, options.row)
        wanted = options.columns or ([column.name for column in COLUMNS] if part else None)
        # Before the work: what is missing shall be said at once.
        version = {} if part else version_of(program, program.parent / "tests/portability/label_hash")
        results = {"version": version} | measure(program, options.data, rows, wanted, options.jobs, say)
    except (Refused, ValueError, OSError) as error:
        sys.exit(f"error: {error}")
    except KeyError as missing:
        sys.exit(f"error: {RESULTS} has no {missing}: measure anew")
    if options.json:
        write_whole_file(options.json, written(results))
    if part:
        print("\n".join(printed(results, rows)))
        return 0
    write_whole_file(REPOSITORY / RESULTS, written(results))
    show(results, rows)
    return 0


def show(results, rows):
    for document in (REPOSITORY / name for name in DOCUMENTS):
        write_whole_file(document, filled(document.read_text(encoding="utf-8"), "measures", blocks(results, rows)))


def written(results):
    """JSON with a line for every row, column or trial."""

    def text(value):
        return json.dumps(value, ensure_ascii=False)

    parts = []
    for name, of in results.items():
        lines = [f"{text(key)}: {text(value)}" for key, value in of.items()] if isinstance(of, dict) else map(text, of)
        begin, end = "{}" if isinstance(of, dict) else "[]"
        parts.append(f"{text(name)}: {begin}\n" + ",\n".join(lines) + f"\n{end}")
    return "{\n" + ",\n".join(parts) + "\n}\n"

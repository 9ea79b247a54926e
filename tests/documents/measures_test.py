#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The measures in the documents are of this version of the method, whole, and printed as they were measured.

measures_test.py REPOSITORY TERRACUT LABEL_HASH
"""

import json
import sys
from collections import defaultdict
from pathlib import Path

REPOSITORY, TERRACUT, LABEL_HASH = map(Path, sys.argv[1:4])
sys.path.insert(0, str(REPOSITORY / "tools/research"))

from measures.columns import COLUMNS, runs_of  # noqa: E402
from measures.documents import DOCUMENTS, RESULTS, blocks  # noqa: E402
from measures.measurement import Measured, evaluated, said, version_of  # noqa: E402
from measures.rows import METHOD, OFF, TOGETHER, Row, parameters_of, rows_of  # noqa: E402
from tables import filled  # noqa: E402

SEEN_AGAIN = "vlp16"  # sees what the label hash's 64 rows do not: rows that are far apart
LEAST_DIFFERENCE = 0.02  # the simulator's sines differ in their last bit between machines


def of_another_version(results):
    version = version_of(TERRACUT, LABEL_HASH)
    was = results["version"]
    for what in ("labels", "seeds", "hazard_seed"):
        if was[what] != version[what]:
            yield f"measured with {what} {was[what]}; this version's: {version[what]}"
    for key in sorted(was["parameters"].keys() | version["parameters"].keys()):
        then, now = was["parameters"].get(key, "not there"), version["parameters"].get(key, "not there")
        if then != now:
            yield f"measured with {key} {then}; it is {now}"


def incomplete(results, rows):
    keys = {key for row in rows for key in row.keys}
    for key in {*OFF, *Row(",".join(TOGETHER), "").keys} - keys:
        yield f"rows.py takes {key} back, which is no parameter"
    for name in sorted({row.name for row in rows} ^ results["rows"].keys()):
        yield f"row {name} is " + ("of nothing in this version" if name in results["rows"] else "not measured")
    for name, columns in results["rows"].items():
        if columns.keys() != {column.name for column in COLUMNS}:
            yield f"row {name} has other columns than are measured"


def printed_otherwise(results, rows):
    for name in DOCUMENTS:
        text = (REPOSITORY / name).read_text(encoding="utf-8")
        if filled(text, "measures", blocks(results, rows)) != text:
            yield f"{name} shows other figures than {RESULTS} has"


def measured_otherwise(results, rows):
    run = next(run for run in runs_of(defaultdict(str)) if run.columns == (SEEN_AGAIN,))
    measured = Measured()
    measured.add(run, evaluated(TERRACUT, run, rows[:1]))
    for (_, column), cells in measured.cells.items():
        for cell, (found,) in cells.items():
            if not any(max(abs(a - b) for a, b in zip(found, known)) < LEAST_DIFFERENCE
                       for known in results["cells"][column][cell]):  # fmt: skip
                yield f"{column}, {cell}, measures {found} now"


def main():
    results = json.loads((REPOSITORY / RESULTS).read_text(encoding="utf-8"))
    rows = rows_of(parameters_of(said([TERRACUT, "parameters"])))
    faults = [*of_another_version(results), *incomplete(results, rows)]
    if not faults:
        faults = [*printed_otherwise(results, rows), *measured_otherwise(results, rows)]
    if faults:
        faults.append("measure anew: ./tools/measures ../shared/data")
    print("\n".join(faults) or f"the measures are of this version: {results['rows'][METHOD]['scans']}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

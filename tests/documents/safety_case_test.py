#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The safety case holds together: its ids, the tests that it names, and every counter of losses.

safety_case_test.py REPOSITORY
"""

import re
import sys
from pathlib import Path

PAGE = "docs/guide/safety_case.md"
ID = re.compile(r"\b([AHRF]\d+)\b")
CASE = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),\s*(\w+)", re.MULTILINE)
ADDED = re.compile(r"add_test\(NAME ([\w.${}]+)")


def tests_there_are(repository: Path) -> tuple[set[str], list[re.Pattern]]:
    """Suites and cases by name, and patterns of names that CMake puts together."""
    names, patterns = set(), []
    for file in (repository / "tests").rglob("*.cpp"):
        for suite, case in CASE.findall(file.read_text()):
            names |= {suite, f"{suite}.{case}"}
    for file in [*(repository / "tests").rglob("CMakeLists.txt"), *(repository / "tools/build/cmake").glob("*.cmake")]:
        for name in filter(re.compile(r"\w\.").search, ADDED.findall(file.read_text())):
            patterns.append(re.compile(re.sub(r"\\\$\\\{\w+\\\}", r"\\w+", re.escape(name)) + "$"))
    return names, patterns


def counters_there_are(repository: Path) -> set[str]:
    """As /metrics and reports call what is lost between the sensor and a label."""
    causes = (repository / "pipeline/status/loss_causes.cpp").read_text().split("outcomes_of(")[0]
    causes += (repository / "tools/cli/live/live_watch.cpp").read_text()
    causes += "".join((repository / f"pipeline/publish/{name}.cpp").read_text() for name in ("publisher", "retried_sink"))
    reasons = (repository / "firmware_io/frame/loss_counters.cpp").read_text()
    plain = set(re.findall(r'\{"(\w+)", ', causes))
    of_outputs = {f"NAME{ending}" for ending in re.findall(r'"\{\}(_\w+_(?:left_out|while_closed))"', causes)}
    rejected = {f"rejected_{name}" for name in re.findall(r'return "(\w+)";', reasons) if name != "unknown"}
    return plain | of_outputs | rejected


def rows_of(text: str) -> list[list[str]]:
    return [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in text.splitlines() if line.startswith("| ")]


def faults_of_ids(text: str, rows: list[list[str]]):
    ids = [row[0] for row in rows if ID.fullmatch(row[0])]
    for letter in "AHRF":
        numbers = [int(name[1:]) for name in ids if name[0] == letter]
        if numbers != list(range(1, len(numbers) + 1)):
            yield f"{letter} is not numbered from 1 in order: {numbers}"
    for name in sorted(set(ID.findall(text)) - set(ids)):
        yield f"{name} is named, and no row is called that"


def faults_of_hazards(rows: list[list[str]]):
    """Both tables must say the same of what is against what."""
    prevented = {(row[0], name) for row in rows if re.fullmatch(r"H\d+", row[0]) for name in ID.findall(row[3])}
    against = {(name, row[0]) for row in rows if re.fullmatch(r"R\d+", row[0]) for name in ID.findall(row[2])}
    for hazard, requirement in sorted(prevented ^ against):
        yield f"{requirement} is against {hazard} in one table and not in the other"


def faults_of_tests(repository: Path, text: str, rows: list[list[str]]):
    names, patterns = tests_there_are(repository)
    counters = rows_of(text.split("### Counters")[1].split("\n## ")[0])[1:]
    for row in [row for row in rows if re.fullmatch(r"R\d+", row[0])] + counters:
        shown_by = re.findall(r"`([\w.]+)`", row[-1])
        if not shown_by and "](#counters)" not in row[-1]:
            yield f"{row[0]} is shown by no test"
        for name in shown_by:
            if name not in names and not any(pattern.match(name) for pattern in patterns):
                yield f"{row[0]} is shown by {name}, and no test is called that"
    named = {name for row in counters for name in re.findall(r"`(\w+)`", row[0])}
    known = counters_there_are(repository)
    yield from (f"{name} is counted, and the page has no test of it" for name in sorted(known - named))
    yield from (f"{name} is no counter" for name in sorted(named - known))


def main() -> int:
    repository = Path(sys.argv[1])
    text = (repository / PAGE).read_text()
    rows = rows_of(text)
    faults = [*faults_of_ids(text, rows), *faults_of_hazards(rows), *faults_of_tests(repository, text, rows)]
    for fault in faults:
        print(f"{PAGE}: {fault}")
    print(f"{len(rows)} rows, {len(counters_there_are(repository))} counters")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

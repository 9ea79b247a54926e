# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The findings of a trial: checks that passed or failed, and tables of figures, as text, JSON and Markdown."""

from __future__ import annotations

import json
import time
from pathlib import Path

from . import machine


class Report:
    """Collects one trial's findings. `command` is the command line that repeats it."""

    def __init__(self, trial: str, command: str):
        self.trial = trial
        self.command = command
        self.started = time.strftime("%Y-%m-%d %H:%M", time.gmtime())
        self.points: list[dict] = []
        self.tables: list[dict] = []

    # --- Findings ---

    def check(self, point: str, passed: bool, found: object) -> None:
        self._add("PASS" if passed else "FAIL", point, found)

    def equal(self, point: str, found: object, expected: object) -> None:
        self.check(point, found == expected, found if found == expected else f"{found}, expected {expected}")

    def skip(self, point: str, reason: str) -> None:
        self._add("SKIP", point, reason)

    def table(self, title: str, header: list[str], rows: list[list]) -> None:
        self.tables.append({"title": title, "header": header, "rows": rows})

    def _add(self, verdict: str, point: str, found: object) -> None:
        self.points.append({"verdict": verdict, "point": point, "found": str(found)})
        print(f"  {verdict}  {point}: {found}", flush=True)

    # --- Output ---

    @property
    def failed(self) -> bool:
        return any(point["verdict"] == "FAIL" for point in self.points)

    def write(self, folder: Path) -> None:
        """Writes FOLDER/trial.json and FOLDER/trial.md; prints the tables too."""
        folder.mkdir(parents=True, exist_ok=True)
        for table in self.tables:
            print(f"\n{table['title']}\n")
            print(aligned([table["header"], *table["rows"]]))
        document = {
            "trial": self.trial,
            "command": self.command,
            "started": self.started,
            "machine": machine.line(),
            "points": self.points,
            "tables": self.tables,
        }
        (folder / f"{self.trial}.json").write_text(json.dumps(document, indent=1) + "\n")
        (folder / f"{self.trial}.md").write_text(self.markdown())
        counts = {verdict: sum(p["verdict"] == verdict for p in self.points) for verdict in ("PASS", "FAIL", "SKIP")}
        print(
            f"\n{self.trial}: {counts['PASS']} passed, {counts['FAIL']} failed, {counts['SKIP']} skipped; "
            f"{folder / self.trial}.json, .md"
        )

    def markdown(self) -> str:
        lines = [f"### {self.trial}", "", f"Machine: {machine.line()}; {self.started} UTC.", ""]
        lines += ["```", self.command, "```", ""]
        for table in self.tables:
            lines += [table["title"] + ":", ""]
            lines += [row_of(table["header"]), "|" + "---|" * len(table["header"])]
            lines += [row_of(row) for row in table["rows"]] + [""]
        lines += ["| | point | found |", "|---|---|---|"]
        lines += [row_of([p["verdict"], p["point"], p["found"]]) for p in self.points]
        return "\n".join(lines) + "\n"


def row_of(cells: list) -> str:
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def aligned(rows: list[list]) -> str:
    widths = [max(len(str(row[i])) for row in rows) for i in range(len(rows[0]))]
    return "\n".join("  ".join(str(cell).ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)

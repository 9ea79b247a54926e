#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Grafana's dashboard asks for metrics that there are, by labels that they have, in expressions that Prometheus reads.

dashboard_test.py REPOSITORY

The metrics are those of the table in docs/guide/monitoring.md, which MetricsText.IsWhatTheGuideSays compares with the
program's. Expressions are read by promtool, where it is installed.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BY_PROMETHEUS = {"instance", "le"}
ROW = re.compile(r"^\| `(terracut_\w+)` \|([^|]*)\|", re.MULTILINE)


def metrics_of(page: str) -> dict[str, set[str]]:
    """Each metric's labels."""
    return {name: set(re.findall(r"\w+", labels)) for name, labels in ROW.findall(page)}


def expressions_of(dashboard: dict):
    """(title of the panel, expression, labels that its legend shows)"""
    for panel in dashboard["panels"]:
        for target in panel["targets"]:
            yield panel["title"], target["expr"], set(re.findall(r"{{(\w+)}}", target["legendFormat"]))


def faults_of(expression: str, legend: set[str], metrics: dict[str, set[str]]):
    labels = set()
    for name in re.findall(r"\bterracut_\w+", expression):
        metric = name if name in metrics else re.sub(r"_(bucket|sum|count)$", "", name)
        if metric not in metrics:
            yield f"asks for {name}, which is not in the guide's table"
        labels |= metrics.get(metric, set())
    used = set(re.findall(r"(\w+)=~?\"|(\w+)!=\"", expression))
    named = {label for pair in used for label in pair if label} | legend
    for listed in re.findall(r"by \(([\w, ]+)\)", expression):
        named |= set(re.findall(r"\w+", listed))
    yield from (f"uses the label {label}, which its metrics do not have" for label in named - labels - BY_PROMETHEUS)


def promtool_faults(expressions: list[str]):
    if not shutil.which("promtool"):
        return
    filled = [re.sub(r"\$__\w+", "1m", expression) for expression in expressions]
    rules = [{"record": f"panel:{i}", "expr": expression} for i, expression in enumerate(filled)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "rules.yaml")  # JSON is YAML
        path.write_text(json.dumps({"groups": [{"name": "dashboard", "rules": rules}]}))
        checked = subprocess.run(["promtool", "check", "rules", path], capture_output=True, text=True, check=False)
    if checked.returncode != 0:
        yield f"promtool refuses an expression: {checked.stdout}{checked.stderr}"


def main() -> int:
    repository = Path(sys.argv[1])
    metrics = metrics_of((repository / "docs/guide/monitoring.md").read_text())
    dashboard = json.loads((repository / "tools/build/service/grafana.json").read_text())
    shown = list(expressions_of(dashboard))
    faults = [f"panel '{title}' {fault}" for title, expression, legend in shown
              for fault in faults_of(expression, legend, metrics)]
    if len(shown) < 20:
        faults.append(f"{len(shown)} expressions; expected are 20 at least")
    numbers = [panel["id"] for panel in dashboard["panels"]]
    if len(set(numbers)) != len(numbers):
        faults.append("two panels have one number")
    faults += promtool_faults([expression for _, expression, _ in shown])
    print("\n".join(faults) or f"{len(shown)} expressions ask for what there is")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The page: the template page.html, filled with an evaluation."""

import base64
from pathlib import Path

import jinja2
from markupsafe import Markup

from page import paper, plots
from page.table_cells import EMPTY, TableCells, printed

HERE = Path(__file__).parent


class Facts:
    """The functions of an evaluation that the template calls."""

    def __init__(self, evaluation):
        self.evaluation = evaluation
        self.methods = evaluation["methods"]
        self.columns = paper.columns(evaluation)

    def tells_road(self, method):
        """True if the method tells the road surface from other ground."""
        return any(entry["as_other_ground"] > 0 for entry in self.methods[method]["by_class"])

    def stages(self):
        """Returns decoding and all stages of the methods, in the order of the report."""
        return list(dict.fromkeys(stage for method in self.methods.values() for stage in method["ms"] if stage != "segment"))

    def role_of(self, class_id):
        """Returns the role of a class under both definitions, in words."""
        for entry in self.evaluation["classes"]:
            if entry["id"] == class_id:
                return entry["all"] if entry["all"] == entry["road"] else f"{entry['all']} (road: {entry['road']})"
        return "not in the class table"

    def place_of_class(self, method, class_id):
        """Returns the index in the method's list of the classes it met; None if it is not there."""
        ids = [entry["id"] for entry in self.methods[method]["by_class"]]
        return ids.index(class_id) if class_id in ids else None

    def frame_of(self, method, shown):
        same = (shown["sequence"], shown["frame"])
        return next((frame for frame in self.methods[method]["frames"] if (frame["sequence"], frame["frame"]) == same), None)

    def mean_of_measured(self, values):
        """Returns the mean of the paper's numbers for the evaluated sequences."""
        measured = [values[place] for _, name, place in self.columns if name is not None and place is not None]
        return sum(measured) / len(measured) if measured else None


def share(value):
    return "–" if value is None else f"{100 * value:.2f} %"


def render(evaluation, folder):
    """Returns the page as HTML in a single file, with the pictures of `folder`."""

    def png(name):
        return "data:image/png;base64," + base64.b64encode((folder / name).read_bytes()).decode()

    facts = Facts(evaluation)
    cells = TableCells(evaluation)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )
    return environment.get_template("page.html").render(
        any_tells_road=any(map(facts.tells_road, facts.methods)),
        averages=paper.TABLES["averages"],
        columns=facts.columns,
        count=cells.count,
        empty=EMPTY,
        evaluation=evaluation,
        frame_of=facts.frame_of,
        mean_of_measured=facts.mean_of_measured,
        ms=cells.ms,
        paper=paper.TABLES["datasets"].get(evaluation["dataset"]),
        percent=cells.percent,
        place_of_class=facts.place_of_class,
        plots=plots,
        png=png,
        printed=printed,
        role_of=facts.role_of,
        share=share,
        stages=facts.stages(),
        style=Markup((HERE / "style.css").read_text()),
        tells_road=facts.tells_road,
        worst_paper_frame_ms=paper.TABLES["worst_frame_ms"],
    )

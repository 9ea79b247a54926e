#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Checks a page of ./tools/report against the evaluation.json that it was drawn from.

usage: check_page.py PAGE JSON

Every element must be closed where it was opened, ids must be unique, links must lead somewhere in
the page, nothing may be loaded from anywhere else, and every table cell that says where its number
comes from (data-path) must show that number. Prints what is wrong; exit code 1 where anything is.
"""
import html.parser
import json
import sys

VOID = {"meta", "img", "br"}


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.faults = []
        self.open = []
        self.ids = []
        self.links = []
        self.cells = {}  # text by JSON pointer
        self.pictures = 0
        self.drawings = 0
        self.path = None
        self.text = ""

    def handle_starttag(self, tag, attributes):
        self.element(tag, dict(attributes))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.element(tag, dict(attributes))

    def element(self, tag, attributes):
        if "id" in attributes:
            self.ids.append(attributes["id"])
        for name in ("src", "href"):
            value = attributes.get(name)
            if value is None:
                continue
            if value.startswith("#"):
                self.links.append(value[1:])
            elif not value.startswith("data:image/png;base64,"):
                self.faults.append(f"<{tag}> loads {value[:60]!r}")
        if tag in ("script", "link", "iframe"):
            self.faults.append(f"there is a <{tag}>")
        self.pictures += tag == "img"
        self.drawings += tag == "svg"
        if tag == "td":
            self.path, self.text = attributes.get("data-path"), ""

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"line {self.getpos()[0]}: </{tag}> closes nothing")
        if tag == "td" and self.path is not None:
            self.cells.setdefault(self.path, []).append(self.text)
            self.path = None

    def handle_data(self, data):
        self.text += data


def number_at(evaluation, pointer):
    value = evaluation
    for key in pointer.split("/")[1:]:
        key = key.replace("~1", "/").replace("~0", "~")
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


def shown(pointer, value):
    keys = pointer.split("/")
    if keys[-1] in ("frames", "points"):
        return f"{value}"
    if "ms" in keys:
        return f"{value:.2f}"
    return f"{100 * value:.2f}"


def wanted(evaluation):
    """What a page may not leave out."""
    for method, results in evaluation["methods"].items():
        for scope in ("all", "road"):
            yield f"/methods/{method}/mean_over_sequences/{scope}/iou_g"
        yield f"/methods/{method}/mean_over_sequences/all/recall_o"
        for scope, measure in (("all", "precision"), ("road", "f1"), ("all_vegetation_ignored", "iou_g")):
            yield f"/methods/{method}/mean_over_sequences/{scope}/{measure}"
        for band in results["by_range"]:
            yield f"/methods/{method}/by_range_road/{band}/iou_g"
        tells_road = any(entry["as_other_ground"] > 0 for entry in results["by_class"])
        for place in range(len(results["by_class"])):
            yield f"/methods/{method}/by_class/{place}/share_as_ground"
            if tells_road:
                yield f"/methods/{method}/by_class/{place}/share_as_other_ground"
        for stage in results["ms"]:
            yield f"/methods/{method}/ms/{stage}/p50"
        yield f"/methods/{method}/ms/segment/max"
        for sequence in results["sequences"]:
            for which in ("min", "mean", "max"):
                yield f"/methods/{method}/sequences/{sequence}/frame_recall_o/{which}"
            for scope in ("all", "road"):
                yield f"/methods/{method}/sequences/{sequence}/{scope}/iou_g"
            yield f"/methods/{method}/sequences/{sequence}/all/recall_o"
            yield f"/methods/{method}/sequences/{sequence}/ms/mean"
    for oracle, results in evaluation["oracles"].items():
        for scope in ("all", "road"):
            yield f"/oracles/{oracle}/{scope}/iou_g"
            for sequence in results["sequences"]:
                yield f"/oracles/{oracle}/sequences/{sequence}/{scope}/iou_g"


def checked(html, evaluation):
    """The page as it was read, with all its faults."""
    page = Page()
    page.feed(html)
    page.close()
    faults = page.faults
    faults += [f"<{tag}> is never closed" for tag in page.open]
    faults += [f"the id {name!r} is there twice" for name in set(page.ids) if page.ids.count(name) > 1]
    faults += [f"a link leads to {name!r}, which is not there" for name in page.links if name not in page.ids]
    for pointer, texts in page.cells.items():
        expected = shown(pointer, number_at(evaluation, pointer))
        faults += [f"{pointer} is {expected}, the page says {text}" for text in texts if text != expected]
    for pointer in wanted(evaluation):
        if number_at(evaluation, pointer) is not None and pointer not in page.cells:
            faults.append(f"{pointer} is not on the page")
    return page


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as page_file, open(sys.argv[2], encoding="utf-8") as json_file:
        page = checked(page_file.read(), json.load(json_file))
    for fault in page.faults:
        print(fault)
    print(f"{len(page.cells)} numbers, {page.pictures} pictures, {page.drawings} drawings, {len(page.faults)} faults")
    return 1 if page.faults else 0


if __name__ == "__main__":
    sys.exit(main())

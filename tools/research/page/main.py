# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The command line of ./tools/report."""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

from jinja2 import UndefinedError

from page.page import render
from whole_file import write_whole_file

REPOSITORY = Path(__file__).resolve().parents[3]
# The program's codes (tools/cli/exit_codes.hpp).
DONE, INPUT_REFUSED, OUTPUT_FAILED = 0, 3, 4


class Refused(Exception):
    """An error with a message for people and an exit code."""


def read_evaluation(path):
    try:
        evaluation = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Refused(f"{path}: {error}", INPUT_REFUSED) from error
    methods = evaluation.get("methods") if isinstance(evaluation, dict) else None
    if not methods or not isinstance(methods, dict):
        raise Refused(f"{path}: expected a report of `terracut eval --report`, but it has no 'methods'", INPUT_REFUSED)
    for name, method in methods.items():
        if not method.get("frames"):
            raise Refused(f"{path}: there is no page without frames, and {name} has none", INPUT_REFUSED)
    return evaluation


def draw(folder):
    page, report = folder / "index.html", folder / "evaluation.json"
    evaluation = read_evaluation(report)
    try:
        html = render(evaluation, folder)
    except OSError as error:
        raise Refused(f"{error.filename}: {error.strerror}; {report} names this picture", INPUT_REFUSED) from error
    except (KeyError, UndefinedError) as error:
        raise Refused(f"{report}: it lacks {error}; did another version of terracut write it?", INPUT_REFUSED) from error
    try:
        write_whole_file(page, html)
    except OSError as error:
        raise Refused(f"{page}: {error.strerror}", OUTPUT_FAILED) from error
    print(f"page      {page}")


def age(path):
    return path.stat().st_mtime_ns if path.exists() else None


def evaluate(folder, arguments):
    """Runs `terracut eval` and prints its output, except for its hint to draw the page. Returns its
    exit code, and whether it wrote a report."""
    program = os.environ.get("TERRACUT", str(REPOSITORY / "build/release/terracut"))
    before = age(folder / "evaluation.json")
    try:
        ran = subprocess.run([program, "eval", *arguments, "--report", str(folder)], stdout=subprocess.PIPE, text=True)
    except OSError as error:
        raise Refused(f"{program}: {error.strerror}; `./tools/test` builds it, or set TERRACUT", INPUT_REFUSED) from error
    print("".join(line for line in ran.stdout.splitlines(keepends=True) if not line.startswith("report ")), end="")
    return ran.returncode, age(folder / "evaluation.json") != before


def main(arguments):
    parser = argparse.ArgumentParser(
        prog="./tools/report",
        description="Draws FOLDER/index.html: the paper's tables and figures beside what was measured, and where methods fail.",
        epilog="Without ARGUMENTS the page is drawn again of what FOLDER has. The program is build/release/terracut or $TERRACUT.",
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument(
        "arguments", nargs=argparse.REMAINDER, metavar="ARGUMENTS", help="of `terracut eval`: semantickitti ROOT --method terracut,paper"
    )
    options = parser.parse_args(arguments)
    try:
        exit_code, written = evaluate(options.folder, options.arguments) if options.arguments else (DONE, True)
        if written:
            draw(options.folder)
        return exit_code
    except Refused as refused:
        message, exit_code = refused.args
        print(f"error: {message}", file=sys.stderr)
        return exit_code

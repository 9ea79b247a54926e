# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The command line of ./tools/compare."""

import argparse
import json
import sys
from pathlib import Path

from comparison.comparison import Compared, Refused, compare, text
from whole_file import write_whole_file

# Exit codes, with the same meaning as the program's (tools/cli/exit_codes.hpp).
DONE, INPUT_REFUSED, OUTPUT_FAILED, GOT_WORSE = 0, 3, 4, 8


def probability(text):
    value = float(text)
    if not 0 < value <= 1:
        raise argparse.ArgumentTypeError(f"expected a number above 0 and up to 1, found {text}")
    return value


def read_report(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Refused(f"{path}: expected a report of `terracut eval --json`: {error}") from error


def main(arguments):
    parser = argparse.ArgumentParser(
        prog="./tools/compare",
        description="What a change did: two reports of `terracut eval`, frame by frame. Exit code 8: a measure got worse, and not by chance.",
    )
    parser.add_argument("before", type=Path, metavar="BEFORE", help="report of `terracut eval --json`")
    parser.add_argument("after", type=Path, metavar="AFTER", help="another one, of the same frames")
    parser.add_argument("--method", default="terracut", help="method to compare (default: %(default)s)")
    parser.add_argument("--method-after", help="method of AFTER (default: the same)")
    parser.add_argument(
        "--significance",
        type=probability,
        default=0.05,
        help="iou_g, recall_o or iou_road worse in the mean of frames, with a smaller p (frames) than this, leads to exit code 8; "
        "times are shown, not judged (default: %(default)s)",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="the same, for programs")
    options = parser.parse_args(arguments)
    if options.json and options.json.resolve() in (options.before.resolve(), options.after.resolve()):
        parser.error(f"--json {options.json} would be written over a report that is compared")
    try:
        sides = [(options.before, options.method), (options.after, options.method_after or options.method)]
        comparison = compare(*(Compared(read_report(path), str(path), method) for path, method in sides))
    except Refused as refused:
        print(f"error: {refused}", file=sys.stderr)
        return INPUT_REFUSED
    print(text(comparison, options.significance))
    if options.json:
        try:
            write_whole_file(options.json, json.dumps(comparison.as_dict(), indent=1) + "\n")
        except OSError as error:
            print(f"error: --json {options.json}: {error.strerror}", file=sys.stderr)
            return OUTPUT_FAILED
    return GOT_WORSE if comparison.worse(options.significance) else DONE

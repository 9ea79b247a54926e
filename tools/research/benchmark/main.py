# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Measures what terracut costs on this machine, part by part, and prints docs/reference/benchmark.md.

    ./tools/benchmark                   # all that is not measured yet of this program on this machine
    ./tools/benchmark --only sensors --beside ../old/build/release/terracut
    ./tools/benchmark --quick --results /tmp/tried
    ./tools/benchmark --only ''         # the documents anew, from what was measured

Parts: sensors (`terracut bench` and `plan`), models (a row for every sensor, in docs/reference/sensors.md), instructions (./tools/instructions), live and outputs (./tools/live_trial), peers
and hazards (./tools/beside_peer; README's plot, too). Every figure goes into RESULTS/PART.json as soon as it is measured, so that a run which breaks off goes on
where it was. Another program, machine, --beside or --quick begins a part anew, as does --anew. What there is no data, peer or
package for is left out, and the page says why. With --results the tables are printed and no document changes. The program is
build/release/terracut or $TERRACUT.
"""

import argparse
import hashlib
import os
import subprocess
import sys
from pathlib import Path

from chosen_names import names_of
from tables import filled
from trial import machine
from trial.program import TrialError
from whole_file import write_whole_file

from .page import DOCUMENTS, blocks
from .parts import PARTS, Failed, Setting, told
from .plot import FILE as PLOT
from .plot import plot
from .results import Results

REPOSITORY = Path(__file__).resolve().parents[3]
RESULTS = REPOSITORY / "docs/reference/benchmark"


def arguments(given):
    parser = argparse.ArgumentParser(prog="benchmark", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    names = [part.name for part in PARTS]
    parser.add_argument("--only", type=names_of("part", names), default=names, metavar="PART,...", help=f"of {','.join(names)}")
    parser.add_argument("--beside", type=Path, metavar="PROGRAM", help="another terracut, measured in turn (sensors)")
    parser.add_argument("--quick", action="store_true", help="few rounds, short runs: a try")
    parser.add_argument("--anew", action="store_true", help="what was measured before is dropped")
    parser.add_argument("--note", default="", metavar="TEXT", help="what else the page shall say of the machine")
    parser.add_argument("--data", type=Path, default=REPOSITORY / "../shared/data", help="default: ../shared/data")
    parser.add_argument("--peers", type=Path, default=REPOSITORY / "../peers", help="folder of ./tools/beside_peer (../peers)")
    parser.add_argument("--results", type=Path, default=RESULTS, help=f"default: {RESULTS.relative_to(REPOSITORY)}")
    return parser.parse_args(given)


def version_of(program):
    return told([program, "--version"]).split()[-1]


def commit_of(program):
    """The commit of the checkout that the program lies in, "no checkout" elsewhere."""
    asked = subprocess.run(["git", "-C", program.parent, "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True)
    return asked.stdout.strip() or "no checkout"


def measured_of(part, setting, note):
    """What a part's figures belong to."""
    of = {"version": version_of(setting.program), "commit": commit_of(setting.program),
          "program": hashlib.sha256(setting.program.read_bytes()).hexdigest()[:12], "machine": machine.line(),
          "way": part.way(setting.quick), "note": note}  # fmt: skip
    if setting.beside and part.name == "sensors":
        of["beside"] = f"{version_of(setting.beside)} ({commit_of(setting.beside)})"
    return of


def show(folder):
    results = {part.name: Results(folder / f"{part.name}.json") for part in PARTS}
    found = blocks(results)
    if folder.resolve() != RESULTS.resolve():
        print("\n\n".join(f"{name}:\n" + "\n".join(lines) for name, lines in found.items()))
        return
    for document in (REPOSITORY / name for name in DOCUMENTS):
        write_whole_file(document, filled(document.read_text(encoding="utf-8"), "benchmark", found))
    write_whole_file(REPOSITORY / PLOT, plot(results))


def main(given):
    options = arguments(given)
    program = Path(os.environ.get("TERRACUT", REPOSITORY / "build/release/terracut")).resolve()
    for needed in filter(None, (program, options.beside)):
        if not needed.is_file():
            sys.exit(f"error: there is no program {needed}")
    setting = Setting(program, options.beside and options.beside.resolve(), REPOSITORY / "build/benchmark", options.data.resolve(),
                      options.peers.resolve(), options.quick)  # fmt: skip
    setting.scratch.mkdir(parents=True, exist_ok=True)
    failed = []
    for part in PARTS:
        if part.name in options.only:
            file = options.results / f"{part.name}.json"
            if options.anew:
                file.unlink(missing_ok=True)
            try:
                part.measure(setting, Results(file, measured_of(part, setting, options.note)))
            except (Failed, TrialError) as why:
                failed.append(part.name)
                print(f"error: {part.name}: {why}", file=sys.stderr)
    show(options.results)
    if failed:
        print(f"not whole: {', '.join(failed)}; once more goes on from here", file=sys.stderr)
    return 1 if failed else 0

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs every fuzz target for a stated time on any number of cores.

    ./tools/fuzz --seconds 10               # each target, as ./tools/test --all does
    ./tools/fuzz --hours 4 --record         # of cores in all, shared evenly; adds to the table of docs/reference/fuzzing.md
    ./tools/fuzz --hours 2 sequence door    # targets whose names hold one of these words
    ./tools/fuzz --seconds 60 --keep        # and adds inputs that reach more to tests/fuzz/corpus, in its budget

Targets are built by clang 19 with AddressSanitizer and UndefinedBehaviorSanitizer, in build/asan-ubsan. Corpora grow in
build/asan-ubsan/fuzzing/corpus from run to run; each begins with what lies in tests/fuzz/corpus. Exit code 1 where an input was
found that breaks a target: its file is named, and build/release/tests/fuzz/TARGET FILE repeats it.
"""

import argparse
import hashlib
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from tables import filled, table
from whole_file import write_whole_file

from .target import Figures, Target, within_budget

REPOSITORY = Path(__file__).resolve().parents[3]
BUILD = REPOSITORY / "build/asan-ubsan"
FOLDER = BUILD / "fuzzing"
CORPUS = REPOSITORY / "tests/fuzz/corpus"
RECORD = REPOSITORY / "tests/fuzz/hours.json"
PAGE = REPOSITORY / "docs/reference/fuzzing.md"


def arguments(given):
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD", help="only targets whose names hold one of these (default: all)")
    time = parser.add_mutually_exclusive_group(required=True)
    time.add_argument("--seconds", type=int, help="for each target")
    time.add_argument("--hours", type=float, help="of cores, for all targets together")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="targets at once (default: one a core)")
    parser.add_argument("--keep", action="store_true", help="add inputs that reach more to the repository's corpus")
    parser.add_argument("--record", action="store_true", help="add hours and executions to the reference")
    return parser.parse_args(given)


def run(words, **more):
    return subprocess.run([str(word) for word in words], cwd=REPOSITORY, check=True, **more)


def build():
    run(["cmake", "--preset", "asan-ubsan", "-DCMAKE_CXX_COMPILER=clang++-19", "-DTERRACUT_LIBFUZZER=ON", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"],
        stdout=subprocess.DEVNULL)  # fmt: skip
    names = [Path(line).name for line in (BUILD / "fuzzers.txt").read_text().split()]
    run(["cmake", "--build", BUILD, "--parallel", os.cpu_count(), "--target", *names, "terracut_cli"], stdout=sys.stderr)


def drive():
    """A short simulated drive, to begin with."""
    capture = FOLDER / "drive.pcap"
    if not capture.exists():
        run([BUILD / "terracut", "simulate", "--scene", "street", "--seed", "3", "--duration", "0.5", "-o", capture], stdout=subprocess.DEVNULL)
    return capture


def seeds_of(name):
    """Whole inputs to start from, or parsers are only ever fuzzed at their door."""
    calibrations = REPOSITORY.parent / "shared/data/calib"
    yield from sorted((CORPUS / name).glob("*"))
    if name == "pcap_source_fuzz":
        head = FOLDER / "head_of_drive.pcap"
        head.write_bytes(drive().read_bytes()[:20000])
        yield head
    elif name == "hdl64e_xml_fuzz":
        yield drive().with_suffix(".calibration.xml")
        yield from calibrations.glob("*.xml")
    elif name == "hdl64e_yaml_fuzz":
        yield from calibrations.glob("*.y*ml")
    elif name == "dbc_fuzz":
        yield REPOSITORY / "pipeline/health/terracut_health.dbc"


def keep(target):
    there = sorted((CORPUS / target.name).glob("*"))
    chosen = within_budget(target.smallest_corpus(), there)
    for path in chosen:
        content = path.read_bytes()
        (CORPUS / target.name).mkdir(exist_ok=True)
        (CORPUS / target.name / hashlib.sha256(content).hexdigest()[:12]).write_bytes(content)
    return len(chosen)


def rows_of(record):
    total = sum((Figures(**figures) for figures in record.values()), Figures())

    def cells(figures, edges):
        return [f"{figures.seconds / 3600:.2f}", f"{figures.executions:,}", edges]

    for name, figures in sorted(record.items()):
        yield name, cells(Figures(**figures), f"{figures['edges']:,}")
    yield "**all**", cells(total, "")


def add_to_record(found):
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    for name, figures in found.items():
        total = Figures(**record.get(name, {})) + figures
        record[name] = {**asdict(total), "seconds": round(total.seconds, 1)}
    write_whole_file(RECORD, json.dumps(record, indent=1, sort_keys=True) + "\n")
    lines = list(table("target", ["hours of processor time", "executions", "edges reached"], rows_of(record)))
    write_whole_file(PAGE, filled(PAGE.read_text(), "fuzz", {"hours": lines}))


def main(given):
    given = arguments(given)
    build()
    FOLDER.mkdir(exist_ok=True)
    programs = [Path(line) for line in (BUILD / "fuzzers.txt").read_text().split()]
    chosen = [Target(path, FOLDER) for path in programs if not given.words or any(word in path.name for word in given.words)]
    if not chosen:
        print(f"error: no target's name holds {' or '.join(given.words)}; there are {', '.join(sorted(path.name for path in programs))}", file=sys.stderr)
        return 2
    seconds = given.seconds or max(1, round(given.hours * 3600 / len(chosen)))
    print(f"{len(chosen)} targets, {seconds} s each, {given.jobs} at a time", flush=True)
    seeds = {target.name: list(seeds_of(target.name)) for target in chosen}
    found = {}
    with ThreadPoolExecutor(given.jobs) as pool:
        for target, figures in zip(chosen, pool.map(lambda target: target.run(seconds, seeds[target.name]), chosen)):
            if figures is None:
                print("\n".join(target.log.read_text(errors="replace").splitlines()[-40:]))
                print(f"{target.name}: BROKEN by an input whose file is named above; build/release/tests/fuzz/{target.name} FILE repeats it", flush=True)
                continue
            found[target.name] = figures
            added = f", {keep(target)} inputs kept" if given.keep else ""
            print(f"{target.name}: {figures.executions:,} inputs, {figures.edges:,} edges, no failure{added}", flush=True)
    if given.record:
        add_to_record(found)
    return 0 if len(found) == len(chosen) else 1

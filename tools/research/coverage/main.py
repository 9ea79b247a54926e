# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Says which conditions in calib, firmware_io, pipeline and rt the tests decide (MC/DC), by room and folder.

    ./tools/coverage                            # builds, runs the suites of ./tools/test, prints the table
    ./tools/coverage --gaps firmware_io/decode  # ... and every condition below a place that no test decides
    ./tools/coverage --no-run --gaps rt         # of the last run

A condition that stands alone is covered if it was both true and false; one of several in a decision if there were two runs in which
it alone made the difference. Counted by clang 19 (-fcoverage-mcdc) in a build of its own, build/coverage. Sources are counted once,
whatever templates make of them; decisions of `if constexpr` and of macros of others are none.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

from tables import table

from .conditions import conditions_of, counts_by

REPOSITORY = Path(__file__).resolve().parents[3]
FOLDER = REPOSITORY / "build/coverage"
ROOMS = ("calib", "firmware_io", "pipeline", "rt")


def arguments(given):
    parser = argparse.ArgumentParser(prog="coverage", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gaps", nargs="*", metavar="PLACE", help="list what is not covered below these folders or files (default: all)")
    parser.add_argument("--no-run", action="store_true", help="neither build nor test: show the last run")
    parser.add_argument("--tests", metavar="REGEX", help="only suites whose name matches")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers and suites at once")
    return parser.parse_args(given)


def run(words, **more):
    return subprocess.run([str(word) for word in words], cwd=REPOSITORY, **more)


def build_and_test(given):
    run(["cmake", "--preset", "coverage", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"], check=True, stdout=subprocess.DEVNULL)
    run(["cmake", "--build", FOLDER, "--parallel", given.jobs], check=True)
    profiles = FOLDER / "profiles"
    for old in profiles.glob("*.profraw"):
        old.unlink()
    suites = ["--tests-regex", given.tests] if given.tests else ["--label-exclude", "slow|install|realtime|documents"]
    tested = run(["ctest", "--preset", "coverage", "--parallel", given.jobs, *suites],
                 env={**os.environ, "LLVM_PROFILE_FILE": str(profiles / "%p.profraw")})  # fmt: skip
    if tested.returncode != 0:
        print("warning: tests failed; what they would have covered is missing below", file=sys.stderr)


def programs():
    """Whatever was built and has counters."""
    for path in sorted(FOLDER.rglob("*")):
        if path.is_file() and os.access(path, os.X_OK) and path.suffix in ("", ".so") and "CMakeFiles" not in path.parts:
            with path.open("rb") as file:
                if file.read(4) == b"\x7fELF":
                    yield path


def measured():
    merged = FOLDER / "all.profdata"
    # A profile is broken if a test killed its process meanwhile: it is named, and left out. So each process has its own.
    run(["llvm-profdata-19", "merge", "-sparse", "-failure-mode=all", "-o", merged,
         *sorted((FOLDER / "profiles").glob("*.profraw"))], check=True)  # fmt: skip
    first, *others = programs()
    exported = run(["llvm-cov-19", "export", "-format=text", "-skip-functions", "-skip-expansions", f"-instr-profile={merged}",
                    f"-ignore-filename-regex=^(?!{REPOSITORY}/({'|'.join(ROOMS)})/)", first,
                    *(word for path in others for word in ("-object", path))], check=True, capture_output=True, text=True).stdout  # fmt: skip
    (FOLDER / "conditions.json").write_text(exported)


def place_of(condition):
    return str(Path(condition.file).relative_to(REPOSITORY))


def show(conditions):
    def row_of(name, covered, total):
        return name, [f"{covered:,} of {total:,}", f"{100 * covered / total:.1f}"]

    rows = []
    for room, count in sorted(counts_by(conditions, lambda condition: place_of(condition).split("/")[0]).items()):
        rows.append(row_of(f"**{room}**", *count))
        of_room = [condition for condition in conditions if place_of(condition).startswith(f"{room}/")]
        folders = counts_by(of_room, lambda condition: str(Path(place_of(condition)).parent))
        rows += [row_of(name, *count) for name, count in sorted(folders.items()) if name != room]
    print("\n".join(table("", ["conditions that tests decide", "%"], rows)))


def gaps(conditions, places):
    for condition in conditions:
        place = place_of(condition)
        if not condition.is_covered and (not places or any(place == name or place.startswith(name.rstrip("/") + "/") for name in places)):
            line = Path(condition.file).read_text().splitlines()[condition.line - 1].strip()
            print(f"{place}:{condition.line}:{condition.column}: {line}")


def main(given):
    given = arguments(given)
    if not given.no_run:
        build_and_test(given)
        measured()
    kept = FOLDER / "conditions.json"
    if not kept.exists():
        print(f"error: no {kept.relative_to(REPOSITORY)}; run without --no-run first", file=sys.stderr)
        return 2
    of_rooms = tuple(f"{REPOSITORY}/{room}/" for room in ROOMS)
    conditions = [each for each in conditions_of(json.loads(kept.read_text())) if each.file.startswith(of_rooms)]
    show(conditions)
    if given.gaps is not None:
        gaps(conditions, given.gaps)
    return 0

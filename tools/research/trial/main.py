# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The command line of ./tools/live_trial."""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
from pathlib import Path

from . import adversarial, breakage, doors, hostile, loaded, loopback, machine, outputs, scripted_faults, stalled, steady
from .program import Program, TrialError
from .report import Report

REPOSITORY = Path(__file__).resolve().parents[3]
ABOUT = """Puts `terracut live` to one of the trials below, and judges each point: PASS, FAIL, or SKIP
with its reason. Wall-clock times are shown and not judged: a machine may be shared. Exit code 1 when a point
failed, 2 when a trial could not be held. Results: DIR/results/TRIAL.json and .md."""


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./tools/live_trial", description=ABOUT)
    parser.add_argument("--program", type=Path, default=os.environ.get("TERRACUT", REPOSITORY / "build/release/terracut"),
                        help="the terracut to try ($TERRACUT; default build/release/terracut)")  # fmt: skip
    parser.add_argument("--simulator", type=Path, help="another terracut that simulates the drives: a sanitized one takes long")
    parser.add_argument("--dir", type=Path, default=REPOSITORY / "build/trial",
                        help="folder for drives, which are kept, and results (default build/trial)")  # fmt: skip
    trials = parser.add_subparsers(dest="trial", required=True)

    def add(name: str, about: str, minutes: float | None = None) -> argparse.ArgumentParser:
        sub = trials.add_parser(name, help=about, description=about)
        if minutes is not None:
            sub.add_argument("--minutes", type=float, default=minutes, help=f"a run (default {minutes:g})")
            sub.add_argument("--sensor", choices=[*loopback.SENSORS], help=f"only this one (default: {' and '.join(loopback.BY_DEFAULT)})")
        return sub

    add("loopback", "minutes at 10 Hz: losses, page faults, processor time, misses", 10)
    add("steady", "an hour at 10 Hz: memory and open files stay as they are", 60)
    add("loaded", "the same with every core loaded, with and without real-time rights", 3)
    sub = add("stalled", "a disk that hangs, readers that do not read")
    sub.add_argument("--seconds", type=float, default=30, help="a run (default 30)")
    sub = add("outputs", "what each output costs; all at once, with readers that stand still")
    sub.add_argument("--seconds", type=float, default=20, help="a run (default 20)")
    sub.add_argument("--rounds", type=int, default=3, help="with and without them, in turn (default 3)")
    sub = add("adversarial", "a min-cut too large for the deadline")
    sub.add_argument("--seconds", type=float, default=8, help="of the drive (default 8)")
    sub = add("faults", "every scripted fault of `terracut send`")
    sub.add_argument("--short", action="store_true", help="all faults in one run")
    sub = add("breakage", "killed readers, a lost interface, a full disk, a taken port, all doors at once")
    sub.add_argument("--short", action="store_true", help="seconds instead of a minute, and a deadline for busy machines")
    sub = add("doors", "the last of these alone: all that others can do from outside, at once")
    sub.add_argument("--short", action="store_true", help="as of breakage")
    sub = add("hostile", "floods, second sensors, stamps from the past, a sensor that reboots, clocks that step")
    sub.add_argument("--seconds", type=float, help="of each (default 10, with --short 3)")
    sub.add_argument("--sensor", choices=[*loopback.SENSORS], help=f"only this one (default: {' and '.join(loopback.BY_DEFAULT)})")
    sub.add_argument("--short", action="store_true", help="one sensor, and a deadline for busy machines")
    return parser.parse_args(arguments)


def hold(options: argparse.Namespace, program: Program, report: Report) -> None:
    if options.trial in ("loopback", "loaded", "steady"):
        sensors = [options.sensor] if options.sensor else loopback.BY_DEFAULT
        {"loopback": loopback, "loaded": loaded, "steady": steady}[options.trial].hold(
            program, report, options.minutes, sensors)  # fmt: skip
    elif options.trial == "stalled":
        stalled.hold(program, report, options.seconds)
    elif options.trial == "outputs":
        outputs.hold(program, report, options.seconds, options.rounds)
    elif options.trial == "adversarial":
        adversarial.hold(program, report, options.seconds)
    elif options.trial == "faults":
        scripted_faults.hold(program, report, options.short)
    elif options.trial == "hostile":
        sensors = [options.sensor] if options.sensor else loopback.BY_DEFAULT[: 1 if options.short else None]
        hostile.hold(program, report, options.seconds or (3 if options.short else 10), sensors, options.short)
    else:
        trial = {"breakage": breakage, "doors": doors}[options.trial]
        trial.hold(program, report, breakage.drive(program), 3 if options.short else 20, 2000 if options.short else loopback.DEADLINE_MS)


def main(arguments: list[str]) -> int:
    options = parse(arguments)
    if not options.program.is_file():
        print(f"error: no program at {options.program}; build it with ./tools/test, or name it with --program",
              file=sys.stderr)  # fmt: skip
        return 2
    report = Report(options.trial, "./tools/live_trial " + shlex.join(arguments))
    print(f"{options.trial}: {machine.line()}", flush=True)
    program = Program(options.program.resolve(), options.dir.resolve(), options.simulator and options.simulator.resolve())
    held = True
    try:
        hold(options, program, report)
    except (TrialError, OSError, subprocess.SubprocessError) as error:
        held = False
        report.check("held to its end", False, error)
    report.write(program.scratch / "results")
    if not held:
        return 2
    return 1 if report.failed else 0

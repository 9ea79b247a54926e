#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""README and the first steps work as printed: their commands are run in their order, in one folder, and each shows what it must.

readme_test.py REPOSITORY PROGRAM WORK_FOLDER

Commands are the lines of the pages' shell blocks, taken as they stand. EXPECTED has them in the same order with what each must
show: a command without an expectation fails, and so does an expectation without a command. Everything runs in a network of
its own, so that the pages' ports are free. About a minute and a half on two quiet cores.
"""

import dataclasses
import difflib
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

from blocks import blocks_of
from made_scans import write_sequence
from own_network import skip_without_own_network

PAGES = ("README.md", "docs/guide/first_steps.md")
PATIENCE_S = 300


class Failed(Exception):
    """What a page promises did not happen."""


@dataclasses.dataclass(frozen=True)
class NotRun:
    """A command that cannot be run here."""

    why: str


@dataclasses.dataclass(frozen=True)
class Shows:
    """A command that ends: with this exit code, after it has printed what these patterns find, and left these files."""

    patterns: tuple[str, ...]
    codes: tuple[int, ...] = (0,)
    files: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class GoesOn:
    """A command that runs until Ctrl-C: it is waited for until it has printed `ready`, whose groups are addresses of pages,
    and ended after the command that begins with `until` (empty: at once). By then it must have printed `patterns`."""

    ready: str
    until: str = ""
    patterns: tuple[str, ...] = ()
    codes: tuple[int, ...] = (0,)


BUILT = NotRun("installs packages and builds; `./tools/test --all` builds, installs and uses what was installed")
EXPECTED = [
    ("./tools/demo", BUILT),
    ("build/release/terracut view demo_output/drive.pcap", NotRun("needs what `./tools/demo` makes; `terracut view drive.pcap` is run below")),
    ("cmake -S . -B build/user -G Ninja -DCMAKE_UNITY_BUILD=ON -DTERRACUT_BUILD_TESTS=OFF", BUILT),
    ("cmake --build build/user", BUILT),
    ("cmake --install build/user --prefix ~/.local", BUILT),
    # A capture.
    ("terracut simulate --scene street --duration 3 -o drive.pcap",
     Shows((r"wrote +drive\.pcap", r"frames +30\b"), files=("drive.pcap", "drive.calibration.xml", "drive.truth/000029.label"))),
    ("terracut info drive.pcap", Shows((r"HDL-64E", r"600\.0 rpm", r"lost +0 packets", r"calibration +complete"))),
    ("terracut calibrate drive.pcap -o setup.yaml", Shows((r"mount +height 1\.7\d+ m", r"wrote +setup\.yaml"), files=("setup.yaml",))),
    ("terracut replay drive.pcap --setup setup.yaml --labels labels",
     Shows((r"frames +30 \(30 complete\)", r"losses +none"), files=("labels/000000.label", "labels/000029.label"))),
    ("terracut replay drive.pcap --truth drive.truth --png pictures",
     Shows((r"quality +IoU_g 9\d\.\d+ %, Recall_o 9\d\.\d+ %",), files=("pictures/000000.birdseye.png", "pictures/000029.mistakes.png"))),
    ("terracut view drive.pcap", GoesOn(r"in a browser: (http\S+)")),
    ("terracut bench drive.pcap", Shows((r"frames +300 \(10 passes\)", r"\ntotal( +\d+\.\d+){5}"))),
    # A sensor.
    ("terracut live --deadline 50 --stream 7447 --recorder-folder dumps",
     GoesOn(r"listening at", until="terracut doctor", codes=(0, 6),  # 6: deadlines were missed, on a busy machine
            patterns=(r"labelled points at 127\.0\.0\.1:7447", r"frames +[1-9]", r"network_gap_packets \d\d"))),
    ("terracut simulate --udp 127.0.0.1:2368", Shows((r"sending the first 1\.3 s", r"frames +30\b", r"sent +\d+ datagrams"))),
    ("terracut send drive.pcap --to 127.0.0.1:2368 --loop --faults loss@6s:20",
     GoesOn(r"", until="terracut dump", patterns=(r"fault +loss@6s:20packets: 20 packets",))),
    ("terracut top", GoesOn(r"frames +[1-9](?:.|\n)*losses .*network_gap_packets [2-9]\d", codes=(-signal.SIGINT,))),
    ("terracut dump", Shows((r"dumps/terracut-\d+-\S+-asked\.pcap\n", r"replay it: terracut replay "))),
    ("terracut doctor", Shows((r"\d+ problems, \d+ warnings of \d+ checks",), codes=(0, 7))),  # 7: no vehicle's computer
    # Labelled data.
    ("terracut eval simulated street --duration 0.5 --json before.json", Shows((r"terracut +9\d\.\d+",), files=("before.json",))),
    ("terracut eval simulated street --duration 0.5 --set elevation_map.obstacle_height_m=0.25 --json after.json",
     Shows((r"terracut +9\d\.\d+",), files=("after.json",))),
    ("./tools/compare before.json after.json", Shows((r"iou_g +\d+\.\d+ +\d+\.\d+ +\+0\.[1-9]", r"recall_o .* -0\.[01]"))),
    ("./tools/report page simulated flat --duration 0.5 --method terracut,paper", Shows((r"page +page/index\.html",), files=("page/index.html",))),
    ("terracut eval semantickitti ROOT --method terracut,paper,pfaff --json methods.json",
     Shows((r"terracut +9\d\.", r"paper +\d", r"pfaff +\d"), files=("methods.json",))),
    ("terracut segment sequences/00 --labels scan_labels", Shows((r"mount: height 1\.7", r"frames +10 \(10 complete\)"), files=("scan_labels/000009.label",))),
    ("terracut encode sequences/00 -o scans.pcap", Shows((r"wrote +scans\.pcap",), files=("scans.pcap",))),
]
# Scripts whose packages the test does without, where they are not installed.
NEEDED = {"./tools/compare": "scipy", "./tools/report": "jinja2, matplotlib, scipy"}


def commands_of(pages: list[Path]) -> list[str]:
    """Every line of the shell blocks, without its comment."""
    lines = "".join(text for page in pages for language, text in blocks_of(page) if language in ("", "sh")).splitlines()
    commands = [re.sub(r" +# .*$", "", line) for line in lines]
    return [command for command in commands if command]


def reject_differences(commands: list[str]):
    expected = [command for command, _ in EXPECTED]
    if commands != expected:
        difference = "\n".join(difflib.unified_diff(expected, commands, "EXPECTED", " and ".join(PAGES), lineterm="", n=0))
        raise Failed(f"commands without an expectation (+), expectations without a command (-):\n{difference}")


class Running:
    """A command that goes on, with all it has printed so far."""

    def __init__(self, command: str, expected: GoesOn, folder: Path, environment: dict[str, str]):
        self.command, self.expected = command, expected
        self.log = Path(tempfile.mkstemp(dir=folder.parent, suffix=".log")[1])
        with self.log.open("w") as output:
            self.process = subprocess.Popen(shlex.split(command), cwd=folder, env=environment, stdout=output, stderr=output)

    def printed(self) -> str:
        return self.log.read_text()

    def await_ready(self) -> re.Match:
        until = time.monotonic() + PATIENCE_S
        while not (found := re.search(self.expected.ready, self.printed())):
            if self.process.poll() is not None or time.monotonic() > until:
                raise Failed(f"{self.command}\ndid not print '{self.expected.ready}':\n{self.printed()}")
            time.sleep(0.05)
        return found

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(PATIENCE_S)
        check(self.command, code, self.printed(), self.expected.codes, self.expected.patterns)

    def kill(self):
        self.process.kill()
        self.process.wait()


def check(command: str, code: int, printed: str, codes: tuple[int, ...], patterns: tuple[str, ...]):
    if code not in codes:
        raise Failed(f"{command}\nended with exit code {code}:\n{printed}")
    for pattern in patterns:
        if not re.search(pattern, printed):
            raise Failed(f"{command}\ndid not print '{pattern}':\n{printed}")


class Reader:
    """Types the pages' commands, one after the other, in one folder."""

    def __init__(self, repository: Path, program: Path, folder: Path):
        self.folder = folder
        self.running: list[Running] = []
        folder.mkdir(parents=True)
        # As in a clone whose program is installed, beside data that the reader has.
        (folder / "tools").symlink_to(repository / "tools")
        write_sequence(folder / "ROOT/sequences/00")
        (folder / "sequences").symlink_to("ROOT/sequences")
        self.status = tempfile.mkdtemp(dir="/dev/shm")  # where no other live run is seen
        self.environment = os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}", "TERRACUT": str(program),
                                         "TERRACUT_STATUS_FOLDER": self.status}

    def type(self, command: str, expected: NotRun | Shows | GoesOn):
        if isinstance(expected, GoesOn):
            self.start(command, expected)
        else:
            done = subprocess.run(shlex.split(command), cwd=self.folder, env=self.environment, timeout=PATIENCE_S,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            check(command, done.returncode, done.stdout, expected.codes, expected.patterns)
            for name in expected.files:
                if not (self.folder / name).exists():
                    raise Failed(f"{command}\nleft no {name}:\n{done.stdout}")
        for running in [each for each in self.running if command.startswith(each.expected.until)]:
            self.running.remove(running)
            running.interrupt()

    def start(self, command: str, expected: GoesOn):
        running = Running(command, expected, self.folder, self.environment)
        self.running.append(running)
        for address in running.await_ready().groups():
            with urllib.request.urlopen(address, timeout=PATIENCE_S) as page:
                if b"<canvas" not in page.read():
                    raise Failed(f"{command}\nserves no page")

    def close(self):
        for running in self.running:
            running.kill()
        shutil.rmtree(self.status)


def missing_for(command: str) -> str:
    """Python packages of the distribution that it needs and that are not there."""
    packages = NEEDED.get(command.split()[0], "")
    there = not packages or subprocess.run(["/usr/bin/python3", "-c", f"import {packages}"], capture_output=True, check=False).returncode == 0
    return "" if there else packages


def main() -> int:
    repository, program, folder = (Path(argument).resolve() for argument in sys.argv[1:4])
    shutil.rmtree(folder, ignore_errors=True)
    reader = Reader(repository, program, folder / "one")
    try:
        reject_differences(commands_of([repository / page for page in PAGES]))
        for command, expected in EXPECTED:
            if isinstance(expected, NotRun):
                print(f"not run   {command}: {expected.why}")
            elif packages := missing_for(command):
                print(f"not run   {command}: needs {packages} (./tools/setup --report)")
            else:
                begun = time.monotonic()
                reader.type(command, expected)
                print(f"{time.monotonic() - begun:6.1f} s  {command}", flush=True)
    except (Failed, subprocess.TimeoutExpired) as failure:
        print(f"FAILED {failure}")
        return 1
    finally:
        reader.close()
    return 0


if __name__ == "__main__":
    skip_without_own_network()
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What the guide tells a reader to type works: every `terracut` command and every Python block is run.

guide_test.py REPOSITORY PROGRAM DRIVE WORK_FOLDER

DRIVE is a capture of an HDL-64E with its table and truth beside it. Everything runs in a network of its own (unshare), so
that ports are free and nothing leaves the machine; simulated drives are cut short. A command that cannot be run here is
passed over, and the reason is printed. Other scripts (./tools/...) and cmake are what CI and the test of the installation run.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

from blocks import blocks_of
from made_scans import write_sequence
from own_network import skip_without_own_network

DRIVE_S = "0.3"
SETUP = "front.setup.yaml"  # as a configuration of the guide names it
# Pattern of a command -> why it is not run.
NOT_HERE = {
    r"--can can\d": "needs a CAN interface",
    r"/etc/terracut/": "needs the installed package",
    r"\brear\b|\bfront$": "needs two sensors",
    r"\bCOMMAND\b|--config FILE": "is a pattern, not a command",
}
ELSEWHERE = ("first_steps.md",)  # readme_test.py runs it
PATIENCE_S = 120


class Failed(Exception):
    """What a document promises did not happen."""


def commands_of(text: str):
    """Every `terracut ...` of a block, without its comment, as a list of words."""
    for line in text.splitlines():
        if line.startswith("terracut "):
            yield shlex.split(line, comments=True)[1:]


class Sensor:
    """A drive sent to a live run over and over."""

    def __init__(self, program: Path, folder: Path, port: str):
        self.process = subprocess.Popen(
            [program, "send", "drive.pcap", "--to", f"127.0.0.1:{port}", "--loop"],
            cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def stop(self):
        self.process.terminate()
        self.process.wait(PATIENCE_S)


class Page:
    """One document, whose commands run one after another in a folder of its own."""

    def __init__(self, repository: Path, program: Path, folder: Path):
        self.repository, self.program, self.folder = repository, program, folder
        self.drive = self.live = self.sensor = None
        self.notebook = ""  # what the page's blocks for the module have done so far
        self.passed, self.left_out = 0, []
        self.environment = os.environ | {
            "PYTHONPATH": str(repository / "tools/examples"), "PYTHONUNBUFFERED": "1",
            "TERRACUT": str(program), "TERRACUT_STATUS_FOLDER": tempfile.mkdtemp(dir="/dev/shm")}  # where no other live run is seen

    def prepare(self, drive: Path):
        self.drive = drive
        self.take_drive()
        if not (self.folder.parent / SETUP).exists():
            self.check(["calibrate", "drive.pcap", "-o", f"../{SETUP}"])
        shutil.copy(self.folder.parent / SETUP, self.folder)
        (self.folder / "sequences").symlink_to("../ROOT/sequences")

    def take_drive(self):
        for path in self.drive.parent.glob(f"{self.drive.stem}.*"):
            place = self.folder / ("drive" + path.name.removeprefix(self.drive.stem))
            if path.is_dir():
                shutil.copytree(path, place, dirs_exist_ok=True)
            else:
                shutil.copy(path, place)

    def run(self, page: Path):
        try:
            for language, text in blocks_of(page):
                name = re.match(r"# (\S+\.yaml)\n", text)
                if name:
                    (self.folder / name[1]).write_text(text)
                elif language == "python":
                    self.run_python(text)
                else:
                    for words in commands_of(text):
                        self.run_command(words)
        finally:
            self.end_live()
            shutil.rmtree(self.environment["TERRACUT_STATUS_FOLDER"])

    def run_command(self, words: list[str]):
        said = shlex.join(words)
        for pattern, reason in NOT_HERE.items():
            if re.search(pattern, said):
                self.left_out.append(f"terracut {said}: {reason}")
                return
        if {"node", "--dds"} & set(words) and not self.has_dds():
            self.left_out.append(f"terracut {said}: needs a program that was built with DDS")
            return
        if words[0] == "live":
            self.begin_live(words)
        elif words[-1] == "live":  # by a file: of sensors whose addresses are not this machine's
            self.check([*words[:-1], "config"])
        elif words[0] == "view":
            self.look_at(words)
        elif words[0] == "top":
            self.check([*words, "--once"])
        elif words[0] == "node":
            self.check([*words, "--metrics", "off", "--duration", "0.3"])
        else:
            self.check(self.shortened(words))
            if words[0] == "simulate" and "drive.pcap" in words:
                self.take_drive()  # what was made is too short to hold the unit's table, which takes 1.2 s
        self.passed += 1

    def has_dds(self) -> bool:
        words = ["node", "--metrics", "off", "--duration", "0.01"]
        said = subprocess.run([self.program, *words], cwd=self.folder, env=self.environment, timeout=PATIENCE_S,
                              capture_output=True, text=True, check=False)
        return "built without DDS" not in said.stderr

    def shortened(self, words: list[str]) -> list[str]:
        if words[0] != "simulate":
            return words
        if "--duration" in words:
            at = words.index("--duration") + 1
            return [*words[:at], DRIVE_S, *words[at + 1:]]
        return [*words, "--duration", DRIVE_S]

    def check(self, words: list[str]):
        done = subprocess.run([self.program, *words], cwd=self.folder, env=self.environment, timeout=PATIENCE_S,
                              capture_output=True, text=True, check=False)
        # 7: this machine is not a vehicle's; 5: nobody publishes clouds here.
        ready = (0, 7) if words[-1] == "doctor" else (5,) if words[0] == "node" else (0,)
        if done.returncode not in ready:
            raise Failed(f"terracut {shlex.join(words)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")

    def look_at(self, words: list[str]):
        """A page that is served until somebody ends it."""
        with subprocess.Popen([self.program, *words], cwd=self.folder, env=self.environment, stderr=subprocess.PIPE,
                              text=True) as shown:
            said = []
            for line in shown.stderr:
                said.append(line)
                if found := re.search(r"in a browser: (\S+)", line):
                    with urllib.request.urlopen(found[1], timeout=PATIENCE_S) as page:
                        assert b"<canvas" in page.read()
                    break
            shown.terminate()
            if shown.wait(PATIENCE_S) != 0:
                raise Failed(f"terracut {shlex.join(words)}:\n{''.join(said)}{shown.stderr.read()}")

    def begin_live(self, words: list[str]):
        self.end_live()
        log = self.folder / "live.log"
        with log.open("w") as output:
            self.live = subprocess.Popen([self.program, *words], cwd=self.folder, env=self.environment,
                                         stdout=output, stderr=output)
        self.wait_for(log, "listening at")
        self.sensor = Sensor(self.program, self.folder, "2368")
        self.wait_for(log, "labelled points at" if "--stream" in words else "calibration:")

    def wait_for(self, log: Path, text: str):
        until = time.monotonic() + PATIENCE_S
        while text not in log.read_text():
            if self.live.poll() is not None or time.monotonic() > until:
                raise Failed(f"terracut live did not say '{text}':\n{log.read_text()}")
            time.sleep(0.05)

    def wait_for_a_frame(self):
        until = time.monotonic() + PATIENCE_S
        while self.live.poll() is None and time.monotonic() < until:
            shown = subprocess.run([self.program, "top", "--once"], env=self.environment, timeout=PATIENCE_S, capture_output=True,
                                   text=True, check=False)
            if re.search(r"frames +[1-9]", shown.stdout):
                return
            time.sleep(0.05)

    def end_live(self):
        if self.live is None:
            return
        self.wait_for_a_frame()
        self.sensor.stop()
        self.live.terminate()
        code = self.live.wait(PATIENCE_S)
        self.live = None
        if code not in (0, 6):  # 6: deadlines were missed, on a busy machine
            raise Failed(f"terracut live: exit code {code}\n{(self.folder / 'live.log').read_text()}")

    def run_notebook(self, text: str):
        """A block that has the module: each goes on from the ones before it."""
        self.notebook += text
        folder = self.program.parent / "tools/python"
        if not list(folder.glob("terracut/_terracut*.so")):
            self.left_out.append(f"{text.splitlines()[0]} ...: needs the Python module")
            return
        if "import pyarrow" in text and subprocess.run(["/usr/bin/python3", "-c", "import pyarrow"], stderr=subprocess.DEVNULL, check=False).returncode:
            self.left_out.append(f"{text.splitlines()[0]} ...: needs pyarrow")
            return
        sensor = Sensor(self.program, self.folder, "2368") if "terracut.live" in text else None
        try:
            done = subprocess.run(["/usr/bin/python3", "-c", self.notebook], cwd=self.folder, capture_output=True, text=True,
                                  env=self.environment | {"PYTHONPATH": str(folder)}, timeout=PATIENCE_S, check=False)
        finally:
            if sensor:
                sensor.stop()
        if done.returncode != 0 or not done.stdout:
            raise Failed(f"a block for the Python module said:\n{done.stdout}{done.stderr}")
        self.passed += 1

    def run_python(self, text: str):
        if self.notebook or "import terracut" in text:
            return self.run_notebook(text)
        process = subprocess.Popen([sys.executable, "-c", text], cwd=self.folder, env=self.environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        said = process.stdout.readline()
        process.terminate()  # one that reads a stream goes on for as long as that
        said += process.communicate(timeout=PATIENCE_S)[0]
        if not said or "Traceback" in said:
            raise Failed(f"a Python block said:\n{said}")
        self.passed += 1


def main() -> int:
    repository, program, drive, work = (Path(argument).resolve() for argument in sys.argv[1:5])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    failures = 0
    write_sequence(work / "ROOT/sequences/00")
    for document in sorted((repository / "docs/guide").glob("*.md")):
        if document.name in ELSEWHERE:
            continue
        page = Page(repository, program, work / document.stem)
        page.folder.mkdir()
        try:
            page.prepare(drive)
            page.run(document)
        except (Failed, subprocess.TimeoutExpired) as failure:
            failures += 1
            print(f"FAILED {document.name}: {failure}")
        print(f"{document.name}: {page.passed} ran")
        for line in page.left_out:
            print(f"  not run: {line}")
    return 1 if failures else 0


if __name__ == "__main__":
    skip_without_own_network()
    sys.exit(main())

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Breaks things around a live process: its watchers, its network interface, its disk, its port."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
import urllib.request

from . import doors, machine
from .accounting import judge_accounting
from .capture import Drive
from .live import Live, Send
from .program import Program
from .report import Report
from .stalled import judge_frames, line_with, returns_of, whole_labels
from .tiny_disk import TinyDisk

DRIVE_S = 2


def drive(program: Program) -> Drive:
    return program.drive("hdl64e", "single", "street", DRIVE_S)


def hold(program: Program, report: Report, drive: Drive, seconds: float, deadline_ms: float) -> None:
    killed_readers(program, report, drive, seconds, deadline_ms)
    second_process(program, report, drive, deadline_ms)
    full_disk(program, report, drive, deadline_ms)
    lost_interface(program, report, drive, deadline_ms)
    doors.hold(program, report, drive, seconds, deadline_ms)


# --- A watcher is killed ---


def killed_readers(program: Program, report: Report, drive: Drive, seconds: float, deadline_ms: float) -> None:
    of = "kill -9 of its readers: "
    options = ["--metrics", "127.0.0.1:0", "--stream", "127.0.0.1:0"]
    with Live(program, drive, *options, deadline_ms=deadline_ms, limit_s=seconds + 60) as live:
        metrics, stream = live.port_after("figures at "), live.port_after("labelled points at ")
        sending = live.send("--loop")
        kills, end = 0, time.monotonic() + seconds
        while time.monotonic() < end:
            for command in readers(program, live.name, metrics, stream):
                reader = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(0.2)
                reader.kill()
                reader.wait()
                kills += 1
        report.equal(of + "/metrics answers afterwards", answer_of(f"http://127.0.0.1:{metrics}/metrics"), 200)
        seen = live.figures()
        report.check(of + "the status page is there afterwards", seen is not None and seen["frames"]["count"] > 0,
                     f"{kills} readers were killed")  # fmt: skip
        sent = sending.stop()
        summary = live.stop()
    judge_frames(report, of, summary, sent, {name for name in summary["losses"] if "stream" in name})
    report.check(of + "exit code 0, or 6 if others took the time", live.exit_code in (0, 6), live.exit_code)


def answer_of(url: str) -> object:
    try:
        with urllib.request.urlopen(url, timeout=5) as answer:
            return answer.status
    except OSError as error:
        return error


def readers(program: Program, name: str, metrics: int, stream: int) -> list[list[str]]:
    commands = [[str(program.path), "top", name, "--interval", "0.1"]]
    if shutil.which("curl"):
        commands.append(["curl", "-s", "--limit-rate", "1k", f"http://127.0.0.1:{metrics}/metrics"])
        commands.append(["curl", "-s", f"telnet://127.0.0.1:{stream}"])
    return commands


# --- Another process wants the port ---


def second_process(program: Program, report: Report, drive: Drive, deadline_ms: float) -> None:
    of = "second process on the port: "
    with Live(program, drive, deadline_ms=deadline_ms, limit_s=60) as live:
        sending = live.send()
        live.until(lambda figures: figures["link"]["packets"] > 0, "receives")
        other = program.run("live", "--listen", f"127.0.0.1:{live.port}", "--metrics", "off", "--name", live.name + "-second",
                            "--calibration", drive.calibration, "--patience", 1, limit_s=30)  # fmt: skip
        sent = sending.wait()
        summary = live.stop()
    report.equal(of + "its exit code (3: input refused)", other.returncode, 3)
    named = str(live.port) in other.stderr and "error:" in other.stderr
    report.check(of + "its message names the port", named, other.stderr.strip().splitlines()[-1:])
    judge_frames(report, of, summary, sent, set())


# --- The disk is full ---


def full_disk(program: Program, report: Report, drive: Drive, deadline_ms: float) -> None:
    if not machine.is_root():
        report.skip("full disk", "needs root, to mount a small file system")
        return
    of = "full disk: "
    returns = returns_of(program.replay(drive.pcap, drive.calibration))
    with TinyDisk(program.scratch / "tiny", 1200) as disk:
        labels, dumps = disk / "labels", disk / "dumps"
        options = ["--labels", labels, "--recorder-folder", dumps, "--recorder-seconds", 2]
        with Live(program, drive, *options, deadline_ms=deadline_ms, limit_s=60) as live:
            sent = live.send().wait()
            asked = program.run("dump", live.name)
            summary = live.stop()
        report.check(of + "every frame was labelled all the same",
                     len(returns) - 2 <= summary["frames"]["count"] <= len(returns)
                     and summary["frames"]["levels"]["skipped"] == 0, summary["frames"]["count"])  # fmt: skip
        report.check(of + "told of labels", "no labels are written" in live.messages(),
                     line_with(live.messages(), "labels"))  # fmt: skip
        report.check(of + "told who asked for a dump", asked.returncode == 4 and "refused (disk_low)" in asked.stderr,
                     asked.stderr.strip())  # fmt: skip
        report.equal(of + "exit code (4: an output could not be written)", live.exit_code, 4)
        written = list(labels.glob("*.label"))
        report.check(of + "labels that found room", len(written) >= 1, len(written))
        report.equal(of + "label files that are not whole, and temporary ones", whole_labels(labels, returns), [])
        left = [path.name for path in dumps.iterdir()] if dumps.exists() else []
        report.equal(of + "files left by the dump", left, [])
    judge_frames(report, of, summary, sent, {"unwritten_label_frames"})


# --- The network interface is removed ---


class Link:
    """Two network name spaces joined by a virtual cable: the sensor's, and the computer's with the interface
    `lidar0`."""

    SENSOR, COMPUTER = "10.77.3.1", "10.77.3.2"

    def __init__(self):
        self.sensor, self.computer = (f"terracut-{end}-{os.getpid()}" for end in ("sensor", "computer"))

    def __enter__(self) -> "Link":
        for space in (self.sensor, self.computer):
            ip("netns", "add", space)
            ip("-n", space, "link", "set", "lo", "up")
        self.plug_in()
        return self

    def __exit__(self, *_: object) -> None:
        for space in (self.sensor, self.computer):
            subprocess.run(["ip", "netns", "del", space], check=False)

    def plug_in(self) -> None:
        ip("-n", self.computer, "link", "add", "lidar0", "type", "veth", "peer", "name", "cable0", "netns", self.sensor)
        ip("-n", self.computer, "addr", "add", self.COMPUTER + "/24", "dev", "lidar0")
        ip("-n", self.sensor, "addr", "add", self.SENSOR + "/24", "dev", "cable0")
        ip("-n", self.computer, "link", "set", "lidar0", "up")
        ip("-n", self.sensor, "link", "set", "cable0", "up")

    def pull_out(self) -> None:
        ip("-n", self.computer, "link", "del", "lidar0")

    @staticmethod
    def inside(space: str) -> list[str]:
        return ["ip", "netns", "exec", space]


def ip(*arguments: str) -> None:
    subprocess.run(["ip", *arguments], check=True, capture_output=True)


def lost_interface(program: Program, report: Report, drive: Drive, deadline_ms: float) -> None:
    of = "interface removed: "
    if not machine.is_root() or machine.lacks("ip"):
        report.skip(of + "all of it", "needs root and iproute2, for a network of its own")
        return
    with Link() as link:
        live = Live(program, drive, "--interface", "lidar0", deadline_ms=deadline_ms, limit_s=90, listen="0.0.0.0",
                    prefix=link.inside(link.computer), sender_prefix=link.inside(link.sensor))  # fmt: skip
        live.sends_to_address = link.COMPUTER
        with live:
            before = live.send().wait()
            first = live.settled()
            link.pull_out()
            live.until(lambda figures: figures["link"]["state"] == "interface_gone", "says that its interface is gone")
            link.plug_in()
            live.until(lambda figures: figures["link"]["state"] != "interface_gone", "has its interface again")
            after = Send(program, drive.pcap, live.sends_to, prefix=link.inside(link.sensor)).wait()
            summary = live.stop()
    report.equal(of + "packets before", first["link"]["packets"], before["sent"])
    judge_accounting(report, of, summary, before["sent"] + after["sent"])
    report.equal(of + "counted", summary["losses"]["link_losses"], 1)
    report.equal(of + "packets after it came back", summary["link"]["packets"] - before["sent"], after["sent"])
    revolutions = len(returns_of(program.replay(drive.pcap, drive.calibration)))
    report.check(of + "frames labelled before and after", summary["frames"]["count"] >= 2 * revolutions - 4,
                 f"{summary['frames']['count']} of {2 * revolutions}")  # fmt: skip
    report.equal(of + "misses of its own making", summary["misses"]["causes"]["own_work"], 0)

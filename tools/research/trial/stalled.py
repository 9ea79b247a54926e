# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Stalls the outputs: a disk whose writes block, and readers that do not read."""

from __future__ import annotations

import contextlib
import json
import signal
import socket
import subprocess
import time
from pathlib import Path

from . import machine
from .accounting import judge_accounting
from .live import Live, losses, misses
from .loopback import DEADLINE_MS, DRIVE_S
from .program import Program
from .report import Report

RETURN_BYTES = 4


class FrozenDisk:
    """A file system whose writes can be blocked, like that of a hanging disk."""

    def __init__(self, scratch: Path, megabytes: int = 512):
        self.image, self.folder = scratch / "disk.img", scratch / "disk"
        self.frozen = False
        with self.image.open("wb") as file:
            file.truncate(megabytes << 20)
        self.folder.mkdir(exist_ok=True)
        subprocess.run(["mkfs.ext4", "-q", "-F", str(self.image)], check=True, capture_output=True)
        subprocess.run(["mount", "-o", "loop", str(self.image), str(self.folder)], check=True, capture_output=True)

    @staticmethod
    def impossible() -> str:
        """Returns why this machine cannot have such a file system; empty if it can."""
        if not machine.is_root():
            return "needs root, to mount and freeze a file system"
        if not Path("/dev/loop-control").exists():
            return "needs loop devices"
        return machine.lacks("mkfs.ext4", "fsfreeze")

    def __enter__(self) -> "FrozenDisk":
        return self

    def __exit__(self, *_: object) -> None:
        self.thaw()
        for _ in range(50):
            if subprocess.run(["umount", str(self.folder)], capture_output=True, check=False).returncode == 0:
                break
            time.sleep(0.1)
        self.image.unlink()

    def freeze(self) -> None:
        subprocess.run(["fsfreeze", "-f", str(self.folder)], check=True)
        self.frozen = True

    def thaw(self) -> None:
        if self.frozen:
            subprocess.run(["fsfreeze", "-u", str(self.folder)], check=True)
            self.frozen = False


class DeafReaders:
    """Stalls all viewers of a live process: `terracut top` stopped while attached, and clients of /metrics (and of
    --stream, if there is one) that connect, request, and never read."""

    def __init__(self, live: Live, *ports: int):
        top = [str(live.program.path), "top", live.name, "--interval", "0.1"]
        self.top = subprocess.Popen(top, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.5)
        self.top.send_signal(signal.SIGSTOP)
        self.sockets = []
        for port in ports:
            client = socket.create_connection(("127.0.0.1", port), timeout=5)
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1)
            client.sendall(b"GET /metrics HTTP/1.1\r\nHost: here\r\n\r\n")
            self.sockets.append(client)

    def leave(self) -> None:
        self.top.kill()
        self.top.wait()
        for client in self.sockets:
            with contextlib.suppress(OSError):
                client.close()


def whole_labels(folder: Path, returns: dict[int, int]) -> list[str]:
    """Returns the names of label files whose number of labels is not the number of returns, and of
    all other files there."""
    wrong = []
    for path in sorted(folder.iterdir()):
        if path.name == ".label.terracut":  # the list of the run's own files
            continue
        number = int(path.stem) if path.suffix == ".label" and path.stem.isdigit() else -1
        if number not in returns or path.stat().st_size != RETURN_BYTES * returns[number]:
            wrong.append(path.name)
    return wrong


def line_with(text: str, words: str) -> str:
    return next((line for line in text.splitlines() if words in line), "no message")


def returns_of(report: dict) -> dict[int, int]:
    """Returns the number of returns of every frame of a replay."""
    return {frame["frame"]: frame["returns_labelled"] for frame in report["frames"]}


def hold(program: Program, report: Report, seconds: float) -> None:
    reason = FrozenDisk.impossible()
    if reason:
        report.skip("a disk whose writes block", reason)
    else:
        report.table("A disk that stands still, milliseconds p99.9 of processor time and of latency",
                     ["disk", "frames", "labels written", "frames unwritten", "processor time", "latency", "misses"],
                     [thawed(program, report, seconds), never_thawed(program, report, seconds)])  # fmt: skip
    deaf(program, report, seconds)


def judge_frames(report: Report, of: str, summary: dict, sent: dict, allowed: set[str]) -> None:
    judge_accounting(report, of, summary, sent["sent"])
    report.equal(of + "packets taken in", summary["link"]["packets"], sent["sent"])
    others = {name: count for name, count in losses(summary).items() if name not in allowed | {"clock_jumps"}}
    report.equal(of + "losses by other causes", others, {})
    report.equal(of + "misses of its own making", summary["misses"]["causes"]["own_work"], 0)


def row(state: str, summary: dict, files: int) -> list:
    return [state, summary["frames"]["count"], files, summary["losses"]["unwritten_label_frames"],
            summary["ms"]["cpu_total"]["p99.9"], summary["ms"]["latency"]["p99.9"], misses(summary)]  # fmt: skip


@contextlib.contextmanager
def writing_to_a_disk_that_hangs(program: Program, seconds: float):
    """Runs a live process for a third of its run and freezes its disk. Yields (disk, folder, live, sending)."""
    drive = program.drive("hdl64e", "single", "street", DRIVE_S)
    with FrozenDisk(program.scratch) as disk:
        folder = disk.folder / "labels"
        folder.mkdir()
        with Live(program, drive, "--labels", folder, deadline_ms=DEADLINE_MS, limit_s=seconds + 120) as live:
            sending = live.send("--loop")
            time.sleep(seconds / 3)
            disk.freeze()
            yield disk, folder, live, sending


def thawed(program: Program, report: Report, seconds: float) -> list:
    """Checks that the run survives a disk that hangs for its middle third."""
    of = "disk that hangs for a while: "
    with writing_to_a_disk_that_hangs(program, seconds) as (disk, folder, live, sending):
        time.sleep(seconds / 3)
        disk.thaw()
        time.sleep(seconds / 3)
        sent = sending.stop()
        summary = live.stop()
        judge_frames(report, of, summary, sent, {"unwritten_label_frames"})
        files = len(list(folder.glob("*.label")))
        unwritten, levels = summary["losses"]["unwritten_label_frames"], summary["frames"]["levels"]
        labelled = summary["frames"]["count"] - levels["skipped"]
        report.check(of + "frames went unwritten", unwritten > 0, unwritten)
        report.equal(of + "files and unwritten frames together", files + unwritten, labelled)
        once = returns_of(program.replay(live.drive.pcap, live.drive.calibration))
        period = len(once)
        expected = {number: once[number % period] for number in range(summary["frames"]["count"])}
        seam = {number for number in expected if number % period in (0, period - 1)}
        wrong = [name for name in whole_labels(folder, expected) if int(name.split(".")[0]) not in seam]
        report.equal(of + "files that are not whole", wrong, [])
        return row(f"hangs {seconds / 3:.0f} s of {seconds:.0f}", summary, files)


def never_thawed(program: Program, report: Report, seconds: float) -> list:
    """Checks that the process reports a disk that hangs for good, and ends all the same."""
    of = "disk that hangs for good: "
    with writing_to_a_disk_that_hangs(program, seconds) as (disk, folder, live, sending):
        time.sleep(2 * seconds / 3)
        sent = sending.stop()
        live.settled()
        live.interrupt()
        # The process has ended except for the thread that the kernel holds until the disk answers.
        end = time.monotonic() + 20
        while "disk does not answer" not in live.messages() and time.monotonic() < end:
            time.sleep(0.1)
        report.check(of + "says so at the end", "disk does not answer" in live.messages(),
                     line_with(live.messages(), "disk does not answer"))  # fmt: skip
        disk.thaw()
        live.process.wait(timeout=60)
        summary = json.loads(live.summary_file.read_text())
        judge_frames(report, of, summary, sent, {"unwritten_label_frames"})
        report.equal(of + "exit code (4: an output could not be written)", live.process.returncode, 4)
        left = [path.name for path in folder.iterdir() if path.suffix == ".label" and path.stat().st_size == 0]
        report.equal(of + "empty label files", left, [])
        return row(f"hangs after {seconds / 3:.0f} s of {seconds:.0f}", summary, len(list(folder.glob("*.label"))))


def deaf(program: Program, report: Report, seconds: float) -> None:
    of, drive = "readers that do not read: ", program.drive("hdl64e", "single", "street", DRIVE_S)
    options = ["--metrics", "127.0.0.1:0", "--stream", "127.0.0.1:0"]
    with Live(program, drive, *options, deadline_ms=DEADLINE_MS, limit_s=seconds + 120) as live:
        readers = DeafReaders(live, live.port_after("figures at "), live.port_after("labelled points at "))
        sending = live.send("--loop")
        time.sleep(seconds)
        sent = sending.stop()
        readers.leave()
        summary = live.stop()
    judge_frames(report, of, summary, sent, {name for name in summary["losses"] if "stream" in name})
    report.equal(of + "frames skipped", summary["frames"]["levels"]["skipped"], 0)

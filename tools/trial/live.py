# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A `terracut live` under trial, and the sensor that `terracut send` plays for it.

Every packet of a trial is accounted for: live is woken with the first packets of the drive, which it
only learns the sensor from, and the drive is sent once its threads wait for packets. So what it counts
must be what was sent, and its frame numbers are those of a replay.
"""

from __future__ import annotations

import json
import signal
import socket
import subprocess
import time
from pathlib import Path

from . import machine
from .capture import Drive, cut_beginning
from .program import Program, TrialError

WAKE_UP_PACKETS = 200
LONGEST_START_S = 60
# Below the live threads', so that it does not stand for their work; above everything that loads the
# machine, which a real sensor would not share.
SENDER_PRIORITY = 60


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Send:
    """`terracut send` of a drive; wait() gives its report."""

    def __init__(self, program: Program, pcap: Path, to: str, *options: object, prefix: list[str] | None = None,
                 limit_s: float = 3600):  # fmt: skip
        self.json = program.scratch / "send.json"
        self.json.unlink(missing_ok=True)
        command = [*(prefix or []), "timeout", "--foreground", "-k", "5", str(int(limit_s))]
        if machine.has_realtime_rights():
            command += ["chrt", "-f", str(SENDER_PRIORITY)]
        command += [str(program.path), "send", str(pcap), "--to", to, "--json", str(self.json), *map(str, options)]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def wait(self) -> dict:
        _, errors = self.process.communicate()
        if not self.json.exists():
            raise TrialError(f"terracut send: exit code {self.process.returncode}\n{errors}")
        return json.loads(self.json.read_text())

    def stop(self) -> dict:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.wait()


class Live:
    """A running `terracut live`; leave the `with` or call stop() to end it."""

    def __init__(self, program: Program, drive: Drive, *options: object, deadline_ms: float = 50,
                 limit_s: float = 3600, listen: str = "127.0.0.1", prefix: list[str] | None = None,
                 sender_prefix: list[str] | None = None):  # fmt: skip
        self.program = program
        self.drive = drive
        self.address = f"{listen}:{free_port()}"
        self.sends_to = self.address  # where its sensor sends to
        self.name = f"trial-{self.address.rsplit(':', 1)[1]}"
        self.summary_file = program.scratch / "live.json"
        self.summary_file.unlink(missing_ok=True)
        self.log = program.scratch / "live.log"
        self.prefix, self.sender_prefix = prefix or [], sender_prefix or []
        self.command = ["live", "--listen", self.address, "--calibration", str(drive.calibration), "--deadline-ms",
                        f"{deadline_ms:g}", "--name", self.name, "--json", str(self.summary_file)]  # fmt: skip
        self.command += [str(option) for option in options]
        if "--metrics" not in self.command:
            self.command += ["--metrics", "off"]
        self.limit_s = limit_s
        self.process: subprocess.Popen | None = None
        self.exit_code: int | None = None
        self.waiting: dict | None = None  # figures before the first packet

    def __enter__(self) -> "Live":
        guard = ["timeout", "--foreground", "-k", "5", str(int(self.limit_s))]  # of FIFO threads nobody must lose hold
        with self.log.open("w") as log:
            self.process = subprocess.Popen([*self.prefix, *guard, str(self.program.path), *self.command], stdout=log,
                                            stderr=log)  # fmt: skip
        try:
            self._await(lambda: "listening at" in self.messages(), "listens")
            self._wake()
            self._await(self._threads_wait, "has its threads waiting")
            early = self.waiting["link"]["packets"]
            if early:
                raise TrialError(f"terracut live counted {early} packets that were only to wake it; try again")
        except BaseException:
            self.kill()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.kill()

    # --- Start ---

    def _wake(self) -> None:
        first = self.program.scratch / "wake_up.pcap"
        cut_beginning(self.drive.pcap, WAKE_UP_PACKETS, first)
        # All at once, so that none comes after live has heard enough and begins to count.
        Send(self.program, first, self.sends_to, "--rate", 0, prefix=self.sender_prefix).wait()

    def _await(self, condition, what: str) -> None:
        end = time.monotonic() + LONGEST_START_S
        while not condition():
            if self.process.poll() is not None:
                raise TrialError(f"terracut live ended before it {what}:\n{self.messages()}")
            if time.monotonic() > end:
                raise TrialError(f"terracut live never {what}:\n{self.messages()}")
            time.sleep(0.1)

    def _threads_wait(self) -> bool:
        states = {}
        try:
            for task in Path(f"/proc/{self.pid()}/task").iterdir():
                name, rest = (task / "stat").read_text().split("(", 1)[1].rsplit(") ", 1)
                states[name] = rest[0]
        except OSError:
            return False
        if states.get("tc-receive") != "S" or states.get("tc-segment") != "S":
            return False
        time.sleep(0.3)  # twice the threads' longest wait: what the wake-up left is flushed
        self.waiting = self.figures()
        return self.waiting is not None

    # --- While it runs ---

    def pid(self) -> int:
        """Of terracut itself, not of what guards it."""
        pid = self.process.pid
        while children := Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
            pid = int(children[0])
        return pid

    def send(self, *options: object, pcap: Path | None = None) -> Send:
        return Send(self.program, pcap or self.drive.pcap, self.sends_to, *options, prefix=self.sender_prefix)

    def figures(self) -> dict | None:
        """What `terracut top` sees now."""
        seen = self.program.run("top", self.name, "--once", "--json")
        return json.loads(seen.stdout) if seen.returncode == 0 else None

    def messages(self) -> str:
        return self.log.read_text()

    def runs(self) -> bool:
        return self.process.poll() is None

    # --- End ---

    def interrupt(self) -> None:
        if self.runs():
            self.process.send_signal(signal.SIGINT)

    def stop(self) -> dict:
        """Its summary. Waits first, for what was sent last to be taken in."""
        time.sleep(0.5)
        self.interrupt()
        self.exit_code = self.process.wait(timeout=60)
        if not self.summary_file.exists():
            raise TrialError(f"terracut live: exit code {self.exit_code} and no summary\n{self.messages()}")
        return json.loads(self.summary_file.read_text())

    def kill(self) -> None:
        if self.process is not None and self.runs():
            self.process.terminate()
            try:
                self.process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                self.process.kill()


# --- Of a summary ---


def losses(summary: dict) -> dict[str, int]:
    """What is not zero."""
    return {name: count for name, count in summary["losses"].items() if count != 0}


def faults(summary: dict) -> int:
    return sum(thread["minor_faults"] + thread["major_faults"] for thread in summary["threads"])


def misses(summary: dict) -> str:
    named = [f"{cause} {count}" for cause, count in summary["misses"]["causes"].items() if count]
    return ", ".join(named) or "none"


def times(summary: dict, what: str) -> str:
    values = summary["ms"][what]
    return " / ".join(f"{values[key]:.1f}" for key in ("p50", "p99", "p99.9", "max"))

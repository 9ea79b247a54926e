# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Runs `terracut live` under trial, with `terracut send` as its sensor.

Every packet of a trial is accounted for: live gets the first packets of the drive to learn the sensor from, and the
drive is sent once its threads wait for packets. So it must count exactly the packets sent, and its frame numbers are
those of a replay.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

from . import machine
from .capture import Drive, cut_beginning
from .program import MOUNT, Program, TrialError

# Enough packets to recognise a sensor, and few enough for the smallest receive buffer.
WAKE_UP_PACKETS = 120
WAKE_UP_NS = 1_000_000_000  # their duration: live recognises a sensor after 0.3 s
LONGEST_WAIT_S = 200
# Lower than the priority of the live threads, so that the sender does not displace them. Higher
# than that of all programs that load the machine, because they would not delay a real sensor.
SENDER_PRIORITY = 60

Others = Callable[[str], contextlib.AbstractContextManager]


class Send:
    """Runs `terracut send` of a drive; wait() returns its report."""

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
        if not self.process.stderr.closed:
            _, self.errors = self.process.communicate()
        if not self.json.exists():
            raise TrialError(f"terracut send: exit code {self.process.returncode}\n{self.errors}")
        return json.loads(self.json.read_text())

    def stop(self) -> dict:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.wait()


class Live:
    """Runs `terracut live`; leave the `with` or call stop() to end it."""

    def __init__(self, program: Program, drive: Drive, *options: object, deadline_ms: float = 50,
                 limit_s: float = 3600, listen: str = "127.0.0.1", prefix: list[str] | None = None,
                 sender_prefix: list[str] | None = None, messages_to: object = None, others: Others | None = None):  # fmt: skip
        """`messages_to` receives its messages in place of a log. `others` sends to its address while it is woken."""
        self.program = program
        self.drive = drive
        self.port = 0  # these are set once it listens
        self.sends_to_address = "127.0.0.1"  # this computer's address for the sensor
        self.sends_to = ""
        self.name = f"trial-{os.getpid()}"
        self.summary_file = program.scratch / "live.json"
        self.summary_file.unlink(missing_ok=True)
        self.log = program.scratch / "live.log"
        self.prefix, self.sender_prefix = prefix or [], sender_prefix or []
        self.command = ["live", "--listen", f"{listen}:0", *map(str, drive.table_options), "--deadline",
                        f"{deadline_ms:g}", "--name", self.name, "--json", str(self.summary_file), *MOUNT]  # fmt: skip
        self.command += [str(option) for option in options]
        if "--metrics" not in self.command:
            self.command += ["--metrics", "off"]
        self.limit_s = limit_s
        self.messages_to, self.others = messages_to, others or (lambda to: contextlib.nullcontext())
        self.process: subprocess.Popen | None = None
        self.exit_code: int | None = None
        self.waiting: dict | None = None  # figures before the first packet

    def __enter__(self) -> "Live":
        guard = ["timeout", "--foreground", "-k", "5", str(int(self.limit_s))]  # FIFO threads must always be stoppable
        with self.log.open("w") as log:
            # Gives live a file of its own in which to remember its sensor, not shared with other
            # trials.
            environment = {**os.environ, "STATE_DIRECTORY": str(self.program.scratch)}
            to = log if self.messages_to is None else self.messages_to
            self.process = subprocess.Popen([*self.prefix, *guard, str(self.program.path), *self.command], stdout=to,
                                            stderr=to, env=environment)  # fmt: skip
        try:
            self.port = self.port_after("listening at ") if self.messages_to is None else self._port_of_page()
            self.sends_to = f"{self.sends_to_address}:{self.port}"
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

    def port_after(self, words: str) -> int:
        """Returns the port of the address that live prints after these words, as soon as it
        does."""
        line = re.compile(re.escape(words) + r"\S*:(\d+)\b.*\n")
        self._await(lambda: line.search(self.messages()), "said: " + words)
        return int(line.search(self.messages())[1])

    def _port_of_page(self) -> int:
        return int(self.until(lambda figures: ":" in figures["input"], "says where it listens")["input"].rsplit(":", 1)[1])

    def _wake(self) -> None:
        first = self.program.scratch / "wake_up.pcap"
        span_ns = cut_beginning(self.drive.pcap, WAKE_UP_PACKETS, first)
        # Stops live while packets are sent, so that all of them are there when it continues, and
        # none is counted later.
        os.kill(self.pid(), signal.SIGSTOP)
        try:
            with self.others(self.sends_to):
                Send(self.program, first, self.sends_to, "--rate", span_ns / WAKE_UP_NS, prefix=self.sender_prefix).wait()
        finally:
            os.kill(self.pid(), signal.SIGCONT)

    def _await(self, condition, what: str) -> None:
        end = time.monotonic() + LONGEST_WAIT_S
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
        if states.get("tc-label") != "S":
            return False
        time.sleep(0.3)  # the thread's longest wait and more: the wake-up's packets are flushed
        self.waiting = self.figures()
        return self.waiting is not None

    # --- While it runs ---

    def pid(self) -> int:
        """Returns the process id of terracut itself, not that of its guard."""
        pid = self.process.pid
        while children := Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
            pid = int(children[0])
        return pid

    def send(self, *options: object, limit_s: float = 3600) -> Send:
        return Send(self.program, self.drive.pcap, self.sends_to, *options, prefix=self.sender_prefix,
                    limit_s=limit_s)  # fmt: skip

    def figures(self) -> dict | None:
        """Returns the figures that `terracut top` shows now."""
        seen = self.program.run("top", self.name, "--once", "--print-json")
        return json.loads(seen.stdout) if seen.returncode == 0 else None

    def until(self, shows: Callable[[dict], bool], what: str) -> dict:
        """Waits for the first figures that satisfy `shows`."""
        seen: list[dict] = []

        def look() -> bool:
            seen[:] = [figures] if (figures := self.figures()) else []
            return bool(seen) and shows(seen[0])

        self._await(look, what)
        return seen[0]

    def settled(self) -> dict:
        """Returns the figures after all sent packets are processed: neither figures nor queues
        change any more."""

        def counts(figures: dict | None) -> object:
            return figures and (figures["link"]["packets"], figures["frames"]["count"], figures["losses"])

        before, now = None, self.figures()
        while not now or counts(now) != counts(before) or self.unread_bytes():
            if not self.runs():
                raise TrialError(f"terracut live has ended:\n{self.messages()}")
            time.sleep(0.3)
            before, now = now, self.figures()
        return now

    def used(self) -> tuple[float, int]:
        """Returns the processor seconds of all threads of live, and the number of their
        wake-ups."""
        seconds, wake_ups = 0.0, 0
        for task in Path(f"/proc/{self.pid()}/task").iterdir():
            seconds += int((task / "schedstat").read_text().split()[0]) / 1e9
            status = (task / "status").read_text()
            wake_ups += int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", status, re.MULTILINE)[1])
        return seconds, wake_ups

    def unread_bytes(self) -> int:
        """Returns the number of bytes waiting in the socket of live."""
        with (Path(f"/proc/{self.pid()}") / "net/udp").open() as table:
            rows = [line.split() for line in table][1:]
        return sum(int(row[4].split(":")[1], 16) for row in rows if int(row[1].split(":")[1], 16) == self.port)

    def messages(self) -> str:
        return self.log.read_text()

    def runs(self) -> bool:
        return self.process.poll() is None

    # --- End ---

    def interrupt(self) -> None:
        if self.runs():
            self.process.send_signal(signal.SIGINT)

    def stop(self) -> dict:
        """Returns the summary of live, after all sent packets are processed."""
        if self.runs():
            self.settled()
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


# --- The summary ---


def losses(summary: dict) -> dict[str, int]:
    """Returns the losses that are not zero."""
    return {name: count for name, count in summary["losses"].items() if count != 0}


def faults(summary: dict) -> int:
    return sum(thread["minor_faults"] + thread["major_faults"] for thread in summary["threads"])


def misses(summary: dict) -> str:
    named = [f"{cause} {count}" for cause, count in summary["misses"]["causes"].items() if count]
    return ", ".join(named) or "none"


def times(summary: dict, what: str) -> str:
    values = summary["ms"][what]
    return " / ".join(f"{values[key]:.1f}" for key in ("p50", "p99", "p99.9", "max"))

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Attacks a live process at once in all ways that are possible from outside: its messages, its
port, its disks, and each of its doors (the ports that it serves). The sensor's frames must still be
labelled, memory must not grow, and refusals must be counted."""

from __future__ import annotations

import contextlib
import os
import resource
import select
import socket
import subprocess
import threading
import time
import urllib.request
from pathlib import Path

from . import machine
from .accounting import judge_accounting
from .capture import Drive, fresh_folder, payloads
from .flood import Flood
from .live import WAKE_UP_NS, WAKE_UP_PACKETS, Live, losses, misses
from .loopback import FRAMES_A_SECOND
from .program import Program, TrialError
from .report import Report
from .tiny_disk import TinyDisk

MOST_GROWTH_MIB = 32
RECORDING_MIB = 56  # the recording's queue (pipeline/mcap/mcap_sink.hpp), which fills where the disk is too slow for it
IDLE_CONNECTIONS = 1000  # for each door
BABBLERS = [f"127.0.1.{number}" for number in range(1, 69)]
TWIN = "127.0.0.2"
IN_TIME = 0.95  # least share of frames that must be in time
DOORS_AGAIN_S = 30  # the longest time until all doors are served again; a door waits 10 s between two tries
ANSWERS_AGAIN_S = 30
CHUNK = 1 << 16
# Connections to a door at a time; more would overflow the host's own queue (netdev_max_backlog).
AT_ONCE, PAUSE_S = 20, 0.01


def hold(program: Program, report: Report, drive: Drive, seconds: float, deadline_ms: float) -> None:
    if not machine.is_root():
        report.skip("all doors at once", "needs root, to mount a small file system")
        return
    is_short = deadline_ms > 50
    learn_the_sensor(program, drive)
    rows = [all_at_once(program, report, drive, seconds, deadline_ms, is_short, messages) for messages in MESSAGES]
    report.table(f"Everything at once at the doors, {seconds:g} s: {len(BABBLERS)} senders of one byte and a second sensor before it "
                 f"starts, its ports taken, a recording in its place, label files and dumps to a full disk; then, its ports free, "
                 f"{IDLE_CONNECTIONS} idle connections a door, headers and bodies without end at three",
                 ["messages go to", "frames of revolutions, ports taken", "frames of revolutions, doors attacked", "misses",
                  "memory before, MiB", "grown by", "descriptors at most", "refused or lost, by cause"], rows)  # fmt: skip


def learn_the_sensor(program: Program, drive: Drive) -> None:
    """Makes an earlier run, so that the sensor's address is stored."""
    with Live(program, drive, limit_s=60) as live:
        live.interrupt()
        live.process.wait(timeout=60)


# --- The destination of messages ---


@contextlib.contextmanager
def full_device():
    with open("/dev/full", "wb") as device:
        yield device


@contextlib.contextmanager
def reader_that_ends():
    reader = subprocess.Popen(["head", "-n", "1"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL)
    with reader.stdin as pipe:
        yield pipe
    reader.wait()


@contextlib.contextmanager
def pipe_that_nobody_reads():
    reads, writes = os.pipe()
    os.set_blocking(writes, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(writes, b"." * 4096)
    os.set_blocking(writes, True)
    yield writes
    os.close(reads)
    os.close(writes)


MESSAGES = {
    "a full device": full_device,
    "a reader that has ended": reader_that_ends,
    "a full pipe that nobody reads": pipe_that_nobody_reads,
}


# --- Its ports ---


class Ports:
    """The addresses of the run's doors, reserved for this trial until they are given back."""

    NAMES = ("metrics", "view", "foxglove", "stream")
    HTTP = NAMES[:3]

    def __init__(self):
        self.held = {name: socket.create_server(("127.0.0.1", 0)) for name in self.NAMES}
        self.of = {name: held.getsockname()[1] for name, held in self.held.items()}

    def options(self) -> list[str]:
        return [word for name, port in self.of.items() for word in (f"--{name}", f"127.0.0.1:{port}")]

    def give_back(self) -> None:
        for held in self.held.values():
            held.close()

    def await_open(self) -> float:
        """Waits until all doors are served; returns the seconds that this took."""
        begun = time.monotonic()
        for name, port in self.of.items():
            while not is_open(port):
                if time.monotonic() - begun > DOORS_AGAIN_S:
                    raise TrialError(f"--{name}: not served {DOORS_AGAIN_S} s after its port was free")
                time.sleep(0.1)
        return time.monotonic() - begun


def is_open(port: int) -> bool:
    try:
        socket.create_connection(("127.0.0.1", port), timeout=1).close()
        return True
    except OSError:
        return False


# --- Senders to its port while it waits for its sensor ---


@contextlib.contextmanager
def babblers_and_twin(drive: Drive, to: str):
    """Sends one byte from each of many addresses, and the packets of a second sensor at the first
    one's rate."""
    host, port = to.rsplit(":", 1)
    for address in BABBLERS:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as babbler:
            babbler.bind((address, 0))
            babbler.sendto(b"x", (host, int(port)))
    packets = payloads(drive.pcap, for_s=1)[:WAKE_UP_PACKETS]

    def send() -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as twin:
            twin.bind((TWIN, 0))
            for packet in packets:
                twin.sendto(packet, (host, int(port)))
                time.sleep(WAKE_UP_NS / 1e9 / len(packets))

    sending = threading.Thread(target=send)
    sending.start()
    yield
    sending.join()


# --- Clients of its doors ---


def idle_connection(port: int) -> socket.socket:
    """Starts a connection without waiting until it is accepted."""
    connection = socket.socket()
    connection.setblocking(False)
    with contextlib.suppress(BlockingIOError):
        connection.connect(("127.0.0.1", port))
    return connection


class Crowd:
    """Holds idle connections to every door, and sends endless requests to those that take requests."""

    REQUESTS = {
        "headers": (b"GET /%b HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n", b"X-Header: " + b"y" * 1000 + b"\r\n"),
        "bodies": (b"POST /%b HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nTransfer-Encoding: chunked\r\n\r\n", b"%x\r\n" % CHUNK + b"z" * CHUNK + b"\r\n"),
    }  # fmt: skip
    PATHS = {"metrics": b"metrics", "view": b"control", "foxglove": b""}

    def __init__(self, ports: Ports):
        hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
        self.over = threading.Event()
        self.idle = []
        for number in range(min(IDLE_CONNECTIONS, hard // 5)):
            self.idle += [idle_connection(port) for port in ports.of.values()]
            if number % AT_ONCE == 0:
                time.sleep(PAUSE_S)
        self.threads = [threading.Thread(target=self._request, args=(ports.of[door], door, kind), daemon=True)
                        for door in ports.HTTP for kind in self.REQUESTS]  # fmt: skip
        self.sent_bytes = 0
        for thread in self.threads:
            thread.start()

    def _request(self, port: int, door: str, kind: str) -> None:
        begin, more = self.REQUESTS[kind]
        while not self.over.is_set():
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=2) as connection:
                connection.sendall(begin % (self.PATHS[door], port))
                while not self.over.is_set():
                    connection.sendall(more)
                    self.sent_bytes += len(more)
            time.sleep(0.01)

    def turned_away(self) -> int:
        """Returns how many idle connections the other side has closed or never accepted."""
        poll = select.poll()
        for connection in self.idle:
            poll.register(connection, select.POLLOUT | select.POLLRDHUP)
        taken = sum(not events & (select.POLLRDHUP | select.POLLHUP | select.POLLERR) for _, events in poll.poll(0))
        return len(self.idle) - taken

    def leave(self) -> None:
        self.over.set()
        for thread in self.threads:
            thread.join()
        for connection in self.idle:
            connection.close()


# --- Its cost ---


def memory_kib(pid: int, what: str) -> int:
    (line,) = [line for line in Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith(what)]
    return int(line.split()[1])


def forget_most_memory(pid: int) -> None:
    Path(f"/proc/{pid}/clear_refs").write_text("5")  # resets VmHWM (proc(5))


def descriptors(pid: int) -> int:
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def answers(port: int) -> bool:
    with contextlib.suppress(OSError), urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=2) as answer:
        return answer.status == 200
    return False


def frames_in(live: Live, seconds: float, at_each: object = lambda: None) -> tuple[int, float]:
    """Returns the number of frames labelled within that time, and of revolutions of the head."""
    begun, before = time.monotonic(), labelled(live.figures())
    while time.monotonic() - begun < seconds:
        at_each()
        time.sleep(0.2)
    return labelled(live.figures()) - before, (time.monotonic() - begun) * FRAMES_A_SECOND


def labelled(figures: dict) -> int:
    return figures["frames"]["count"] - figures["frames"]["levels"]["skipped"]


# --- The trial ---


def all_at_once(program: Program, report: Report, drive: Drive, seconds: float, deadline_ms: float, is_short: bool,
                messages: str) -> list:  # fmt: skip
    of = f"all doors at once, messages to {messages}: "
    bag = fresh_folder(program.scratch / "bag")
    (bag / "bag_0.mcap").write_text("of a run before")
    ports = Ports()
    with contextlib.ExitStack() as stack:
        disk = stack.enter_context(TinyDisk(program.scratch / "tiny", 1200))
        (disk / "of others").write_bytes(bytes(1150 << 10))
        messages_to = stack.enter_context(MESSAGES[messages]())
        live = stack.enter_context(
            Live(program, drive, *ports.options(), "--mcap", bag, "--labels", disk / "labels", "--recorder-folder", disk / "dumps", "--recorder-seconds", 2,
                 deadline_ms=deadline_ms, limit_s=4 * seconds + 120, messages_to=messages_to,
                 others=lambda to: babblers_and_twin(drive, to)))  # fmt: skip
        sending = live.send("--loop")
        packets = payloads(drive.pcap, for_s=1)
        twin = Flood(live.sends_to, len(packets), packets, [TWIN], machine.has_realtime_rights(), program.scratch)
        stack.callback(twin.stop)
        stack.callback(sending.stop)
        taken = frames_in(live, seconds / 2)
        closed = live.figures()["losses"]
        ports.give_back()
        waited_s = ports.await_open()
        forget_most_memory(live.pid())
        frames_in(live, 2)
        before_mib = memory_kib(live.pid(), "VmHWM") / 1024
        crowd, most_open = Crowd(ports), [0]
        stack.callback(crowd.leave)
        attacked = frames_in(live, seconds, lambda: most_open.append(descriptors(live.pid())))
        turned_away, sent_mb = crowd.turned_away(), crowd.sent_bytes / 1e6
        crowd.leave()
        grown_mib = memory_kib(live.pid(), "VmHWM") / 1024 - before_mib
        end = time.monotonic() + ANSWERS_AGAIN_S
        while not (served := answers(ports.of["metrics"])) and time.monotonic() < end:
            time.sleep(0.2)
        others = twin.stop()
        sent = sending.stop()
        summary = live.stop()
        exit_code = live.exit_code
    judge_accounting(report, of, summary, sent["sent"] + others["sent"])
    lost = losses(summary)
    for name in (f"{door}_frames_while_closed" for door in ("view", "foxglove", "stream")):
        report.check(of + f"{name} while its port was taken", closed[name] > 0, closed[name])
    report.check(of + "each port was served once it was free", True, f"within {waited_s:.0f} s")
    for door in ports.NAMES:
        refused = {name: count for name, count in lost.items() if name.startswith(door) and "refused" in name}
        report.check(of + f"{door}: what was refused is counted", bool(refused), refused)
    report.check(of + "idle connections turned away, of all; others wait", turned_away > 0,
                 f"{turned_away} of {len(crowd.idle)}; {sent_mb:.0f} MB were sent by others")  # fmt: skip
    most_mib = MOST_GROWTH_MIB + (RECORDING_MIB if lost.get("mcap_frames_left_out") else 0)
    report.check(of + f"memory grew by {most_mib} MiB at most", grown_mib <= most_mib, f"{grown_mib:.1f} MiB")
    report.check(of + "descriptors open at most", max(most_open) < 512, max(most_open))
    report.check(of + "/metrics answers afterwards", served, served)
    report.check(of + "label files without room are counted", lost.get("unwritten_label_frames", 0) > 0, lost.get("unwritten_label_frames"))
    report.equal(of + "the recording before is as it was", [path.read_text() for path in bag.iterdir()], ["of a run before"])
    recording = program.scratch / "bag_2"
    report.check(of + "the new one lies beside it, whole", (recording / "metadata.yaml").exists(), recording.name)
    fresh_folder(recording).rmdir()
    report.equal(of + "exit code (4: an output could not be written)", exit_code, 4)
    for state, (frames, revolutions) in (("its ports taken", taken), ("its doors attacked", attacked)):
        least = 1 if is_short else IN_TIME * revolutions - 2
        report.check(of + f"frames labelled, {state}", frames >= least, f"{frames} of {revolutions:.0f}")
    if not is_short:
        report.equal(of + "misses of its own making", summary["misses"]["causes"]["own_work"], 0)
    named = ", ".join(f"{cause} {count}" for cause, count in lost.items() if cause != "clock_jumps")
    return [messages, "{} of {:.0f}".format(*taken), "{} of {:.0f}".format(*attacked), misses(summary), f"{before_mib:.0f}",
            f"{grown_mib:.1f} MiB", max(most_open), named]  # fmt: skip

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A network with other senders, and a faulty sensor: the run must stay up, account for every datagram, and label the
sensor's frames in time, or give the cause for each missed one.

Only the sensor's clock steps. The computer's clock is not set, because that would affect all its programs; the sequence
fuzzers of tests/fuzz step it for the processing chain of live."""

from __future__ import annotations

import itertools
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from . import machine
from .accounting import judge_accounting
from .capture import Drive, fresh_folder, labels_of, payloads
from .flood import Flood, garbage
from .live import Live, losses, misses
from .loopback import DEADLINE_MS, SENSORS, FRAMES_A_SECOND
from .program import Program, TrialError
from .report import Report
from .scripted_faults import UndisturbedFrames, unmatched

FLOOD_A_SECOND = 20_000
REACHED_A_SECOND = 18_000  # a slower flood does not count
SENSOR = "127.0.0.1"
STRANGERS = [f"127.0.0.{number}" for number in range(2, 10)]
CALM_S = 1.5  # how long the drive goes on after the disturbance
SHORT_DEADLINE_MS = 2000
LEAST_S = 3
IN_TIME = 0.95  # share of the frames, if no other sender has the sensor's address


@dataclass(frozen=True)
class Attack:
    """A disturbance. `sends` makes the datagrams of another sender from the sensor's packets, `rate` their number per
    second from the sensor's. `faults` makes the sensor's script from its duration in seconds."""

    name: str
    addresses: list[str] | None = None
    sends: Callable[[list[bytes]], list[bytes]] = lambda packets: packets
    rate: Callable[[float], float] = lambda sensor_a_second: FLOOD_A_SECOND
    faults: Callable[[float], str] = lambda seconds: ""

    @property
    def is_flood(self) -> bool:
        return self.addresses is not None and self.rate(0) == FLOOD_A_SECOND

    @property
    def has_sensors_address(self) -> bool:
        return self.addresses is None or SENSOR in self.addresses


def reboots(seconds: float) -> str:
    """Returns faults: every two seconds the sensor is silent for 0.3 s, and its clock starts
    again."""
    times = itertools.takewhile(lambda at: at + 0.3 < seconds, itertools.count(2, 2))
    return " ".join(f"pause@{at}s:0.3s clock@{at + 0.3:.1f}s:-2s" for at in times)


def clock_steps(seconds: float) -> str:
    """Returns faults: twice a second the clock steps, a little or much, forward and back."""
    steps = itertools.cycle(["+0.05s", "-0.05s", "+2s", "-2s", "+1800s", "-1800s"])
    times = itertools.takewhile(lambda at: at < seconds, itertools.count(0.75, 0.5))
    return " ".join(f"clock@{at:.2f}s:{step}" for at, step in zip(times, steps))


ATTACKS = [
    Attack("a flood of garbage from the sensor's address", [SENSOR], garbage),
    Attack("a flood from other addresses", STRANGERS),
    Attack("a flood of well-formed packets from the sensor's address", [SENSOR]),
    Attack("a second sensor at another address", STRANGERS[:1], rate=lambda sensor_a_second: sensor_a_second),
    Attack("a second sensor at the sensor's address", [SENSOR], rate=lambda sensor_a_second: sensor_a_second),
    Attack("packets with stamps from the past", [SENSOR], lambda packets: packets[: len(packets) // 4],
           rate=lambda sensor_a_second: sensor_a_second / 10),
    Attack("a sensor that reboots every two seconds", faults=reboots),
    Attack("a sensor whose clock steps", faults=clock_steps),
]  # fmt: skip


def hold(program: Program, report: Report, seconds: float, sensors: list[str], short: bool) -> None:
    """Runs all disturbances. `short` selects a deadline for busy machines; then neither the rate of
    other senders is judged, nor how dropped packets and skipped frames change labels."""
    if seconds < LEAST_S:
        raise TrialError(f"{seconds:g} s of each: a sensor that reboots every two seconds needs at least {LEAST_S}")
    deadline_ms = SHORT_DEADLINE_MS if short else DEADLINE_MS
    for sensor in sensors:
        drive = program.drive(sensor, SENSORS[sensor].returns, "street", seconds + CALM_S)
        undisturbed = UndisturbedFrames(program, drive)
        rows = [attacked(program, report, drive, undisturbed, seconds, sensor, attack, deadline_ms, short) for attack in ATTACKS]
        report.table(
            f"{sensor}: {seconds:g} s of each, then {CALM_S:g} s of calm; labels within {deadline_ms} ms",
            ["", "beside the sensor, a second", "revolutions", "frames", "in time", "frames with their own labels",
             "misses", "lost"],
            rows,
        )  # fmt: skip


def attacked(program: Program, report: Report, drive: Drive, undisturbed: UndisturbedFrames, seconds: float, sensor: str, attack: Attack,
             deadline_ms: float, short: bool) -> list:  # fmt: skip
    of = f"{sensor}, {attack.name}: "
    labels = fresh_folder(program.scratch / "labels_live")
    packets = payloads(drive.pcap, for_s=2)
    a_second = len(undisturbed.stamps_ns) / (seconds + CALM_S)
    faults = ["--faults", attack.faults(seconds)] if attack.faults(seconds) else []
    with Live(program, drive, "--labels", labels, deadline_ms=deadline_ms, limit_s=seconds + 120) as live:
        flood = None
        if attack.addresses:
            flood = Flood(live.sends_to, attack.rate(a_second), attack.sends(packets), attack.addresses,
                          machine.has_realtime_rights(), program.scratch)  # fmt: skip
        sending = live.send(*faults)
        time.sleep(seconds)
        others = flood.stop() if flood else {"sent": 0, "per_second": 0}
        sent = sending.wait()
        report.check(of + "stays up, and answers", live.runs(), live.settled()["link"]["state"])
        summary = live.stop()
    report.check(of + "exit code (0, or 6: deadlines were missed)", live.exit_code in (0, 6), live.exit_code)

    judge_accounting(report, of, summary, sent["sent"] + others["sent"])
    if attack.is_flood and not short:
        report.check(of + f"datagrams beside the sensor, at least {REACHED_A_SECOND} a second",
                     others["per_second"] >= REACHED_A_SECOND, f"{others['per_second']:.0f}")  # fmt: skip
    touched = set().union(*(touched_by(fault, undisturbed) for fault in sent["faults"]))
    expected = len(undisturbed.labels) - len(touched)
    lost = unmatched(undisturbed.labels, touched, labels_of(labels))
    frames, in_time = summary["frames"]["count"], summary["frames"]["count"] - summary["misses"]["total"]
    judge_causes(report, of, summary, len(lost))
    if not short:
        judge_frames(report, of, attack, undisturbed, expected, in_time, lost)
    return [attack.name, f"{others['per_second']:.0f}", expected, frames, in_time, expected - len(lost), misses(summary),
            ", ".join(f"{cause} {count}" for cause, count in losses(summary).items()) or "-"]  # fmt: skip


def judge_frames(report: Report, of: str, attack: Attack, undisturbed: UndisturbedFrames, expected: int, in_time: int,
                lost: list[int]) -> None:  # fmt: skip
    if not attack.has_sensors_address:
        report.equal(of + "frames that have not the labels of a drive that nobody disturbs", lost, [])
        report.check(of + f"frames labelled within {DEADLINE_MS} ms, of {expected}", in_time >= IN_TIME * expected, in_time)
    calm = int((CALM_S - 0.5) * FRAMES_A_SECOND)
    last = [frame for frame in lost if frame >= len(undisturbed.labels) - calm]
    report.equal(of + f"of the last {calm} frames, in the calm, those that have not their own labels", last, [])


def touched_by(fault: dict, undisturbed: UndisturbedFrames) -> set[int]:
    """Returns the frames that a fault of a script changes; for a clock step, the frame with the
    step."""
    is_step = fault["fault"].startswith("clock")
    return set().union(*(undisturbed.of(first, 1 if is_step else count) for first, count in fault["runs"]))


def judge_causes(report: Report, of: str, summary: dict, lost: int) -> None:
    """Checks that every miss has a cause, and that frames are lost or changed only where a loss was
    counted."""
    causes = Counter(summary["misses"]["causes"])
    report.equal(of + "misses by all causes together", causes.total(), summary["misses"]["total"])
    named = sum(losses(summary).values())
    report.check(of + "frames lost or with other labels, and what was lost by cause", lost == 0 or named > 0,
                 f"{lost}, {named}")  # fmt: skip

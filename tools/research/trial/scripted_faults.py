# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Plays every fault that `terracut send --faults` knows: the right counter must change by the right amount, and the
labels of untouched frames must equal those of an offline replay, bit for bit."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from .accounting import judge_accounting
from .capture import Drive, fresh_folder, labels_of, packet_count, records
from .live import Live, losses
from .program import Program, TrialError
from .report import Report

# Labels are compared, so the deadline must be so long that no frame is cut short.
DEADLINE_MS = 10_000
STRANGER = "127.0.0.2"
# The recorder has room for the densest sensor; an HDL-64E's packets fill it less than a third as fast.
RECORDER_S = 6
COLUMNS_A_PACKET = 6  # of an HDL-64E
# The drive's frames begin every 100 ms. The first fault is in the middle of a frame, and faults are
# two frames apart.
FIRST_S, APART_S = 0.54, 0.2


@dataclass(frozen=True)
class Fault:
    """A fault with its effects: `counters` are increments for each affected packet that `send`
    reports, `once` those for the whole fault."""

    name: str
    kind: str
    amount: str
    counters: dict[str, int] = field(default_factory=dict)
    once: dict[str, int] = field(default_factory=dict)
    touches: bool = False  # changes the labels of its frames
    arriving: int = 0  # how many more packets arrive for each affected one; negative for fewer
    foreign_from: str = ""


FAULTS = [
    Fault("loss", "loss", "20packets", {"network_gap_packets": 1, "azimuth_hole_columns": COLUMNS_A_PACKET},
          touches=True, arriving=-1),
    Fault("reorder", "reorder", "3", touches=True),
    Fault("duplicate", "duplicate", "7", {"rejected_repeated": 1}, arriving=1),
    Fault("burst", "burst", "50ms"),
    Fault("truncate", "truncate", "5", {"rejected_wrong_size": 1, "network_gap_packets": 1,
                                        "azimuth_hole_columns": COLUMNS_A_PACKET}, touches=True),
    Fault("foreign, from another address", "foreign", "50", {"foreign_datagrams": 1}, foreign_from=STRANGER),
    Fault("foreign, from the sensor's address", "foreign", "50", {"rejected_wrong_size": 1}, arriving=1),
    Fault("clock forward", "clock", "+2.0s", once={"clock_jumps": 1}),
    Fault("clock back", "clock", "-1.5s", once={"clock_jumps": 1}),
    Fault("pause", "pause", "0.4s", {"network_gap_packets": 1, "azimuth_hole_columns": COLUMNS_A_PACKET},
          touches=True, arriving=-1),
]  # fmt: skip


def hold(program: Program, report: Report, together: bool) -> None:
    """Makes one run per fault. With `together`, makes a single run, which is faster but does not
    tell which fault failed."""
    seconds = FIRST_S + APART_S * len(FAULTS) + 1
    drive = program.drive("hdl64e", "single", "street", round(seconds, 1))
    undisturbed = UndisturbedFrames(program, drive)
    runs = [[fault] for fault in FAULTS]
    if together:
        runs = [[fault for fault in FAULTS if fault.name != "foreign, from the sensor's address"]]
    rows = [run(program, report, drive, undisturbed, faults) for faults in runs]
    report.table("Faults of an HDL-64E's stream", ["fault", "packets it had", "counted", "frames touched",
                 "frames as in the replay of the capture", "frames as in the replay of what was received"], rows)  # fmt: skip


class UndisturbedFrames:
    """The undisturbed frames of the drive: when each begins, and its labels."""

    def __init__(self, program: Program, drive: Drive):
        folder = fresh_folder(program.scratch / "labels_replay")
        replay = program.replay(drive.pcap, drive.calibration, folder)
        labels = labels_of(folder)
        self.begin_ns = [frame["first_packet_ns"] for frame in replay["frames"]]
        self.stamps_ns = [stamp for stamp, _ in records(drive.pcap)]
        # Only a replay knows where the last two frames end, because it sees the end of the file.
        self.labels = [labels[number] for number in range(len(self.begin_ns) - 2)]
        if len(set(self.labels)) != len(self.labels):
            raise TrialError(f"{drive.pcap} has frames with the same labels, which cannot be told apart")

    def of(self, first_packet: int, count: int) -> set[int]:
        numbers = [bisect_right(self.begin_ns, self.stamps_ns[packet]) - 1
                   for packet in (first_packet, first_packet + count - 1)]  # fmt: skip
        return set(range(numbers[0], numbers[1] + 1))


def run(program: Program, report: Report, drive: Drive, undisturbed: UndisturbedFrames, faults: list[Fault]) -> list:
    of = (faults[0].name if len(faults) == 1 else "all at once") + ": "
    script = " ".join(f"{fault.kind}@{FIRST_S + i * APART_S:.2f}s:{fault.amount}" for i, fault in enumerate(faults))
    stranger = next((["--foreign-from", fault.foreign_from] for fault in faults if fault.foreign_from), [])
    labels, dumps = (fresh_folder(program.scratch / name) for name in ("labels_live", "dumps"))
    options = ["--labels", labels, "--recorder-folder", dumps, "--recorder-seconds", RECORDER_S]
    with Live(program, drive, *options, deadline_ms=DEADLINE_MS, limit_s=120) as live:
        sent = live.send("--faults", script, *stranger).wait()
        live.settled()  # packets may still be gathering
        program.must("dump", live.name)
        summary = live.stop()

    touched = set()
    for fault, done in zip(faults, sent["faults"]):
        if fault.touches:
            touched |= set().union(*(undisturbed.of(first, count) for first, count in done["runs"]))

    report.check(of + "the fault was done whole", all(done["complete"] for done in sent["faults"]), script)
    had = [done["packets"] for done in sent["faults"]]
    arrived = len(undisturbed.stamps_ns) + sum(fault.arriving * count for fault, count in zip(faults, had))
    judge_accounting(report, of, summary, sent["sent"])
    report.equal(of + "packets taken in", summary["link"]["packets"], arrived)
    expected = expected_losses(faults, had)
    found = losses(summary)
    if "azimuth_hole_columns" in expected:
        # A frame has a fractional number of columns, so one column may be counted for its
        # neighbour.
        holes, columns = found.pop("azimuth_hole_columns", 0), expected.pop("azimuth_hole_columns")
        report.check(of + "columns missing", abs(holes - columns) <= len(touched), f"{holes} of {columns}")
    report.equal(of + "losses by cause", found, expected)
    report.equal(of + "misses", summary["misses"]["total"], 0)

    mine = labels_of(labels)
    lost = unmatched(undisturbed.labels, touched, mine)
    untouched = len(undisturbed.labels) - len(touched)
    report.equal(of + "untouched frames not as in the replay of the capture, or not in order", lost, [])
    differing, compared = against_dump(program, report, of, drive, dumps, mine, summary)
    report.equal(of + "frames not as in the replay of what was received", differing, [])
    return [of.rstrip(": "), ", ".join(map(str, had)), ", ".join(f"{k} {v}" for k, v in losses(summary).items()) or "-",
            ", ".join(map(str, sorted(touched))) or "-", f"{untouched - len(lost)} of {untouched}",
            f"{compared - len(differing)} of {compared}"]  # fmt: skip


def expected_losses(faults: list[Fault], had: list[int]) -> dict[str, int]:
    expected: Counter = Counter()
    for fault, packets in zip(faults, had):
        expected.update({name: each * packets for name, each in fault.counters.items()})
        expected.update(fault.once)
    return dict(expected)


def unmatched(sent: list[str], touched: set[int], received: dict[int, str]) -> list[int]:
    """Returns those untouched frames whose labels are not among the received ones, in order of
    number."""
    number_of = {labels: number for number, labels in received.items()}
    missing, newest = [], -1
    for frame, labels in enumerate(sent):
        if frame in touched:
            continue
        number = number_of.get(labels, -1)
        if number <= newest:
            missing.append(frame)
        else:
            newest = number
    return missing


def against_dump(program: Program, report: Report, of: str, drive: Drive, dumps: Path, frames: dict[int, str],
                 summary: dict) -> tuple[list[int], int]:  # fmt: skip
    """Returns the frames that a replay of the flight recorder's capture labels differently, and the number compared."""
    captures = list(dumps.glob("*.pcap"))
    report.equal(of + "dumps written", len(captures), 1)
    if not captures:
        return sorted(frames), len(frames)
    report.equal(of + "packets in the dump", packet_count(captures[0]), summary["link"]["packets"])
    folder = fresh_folder(program.scratch / "labels_dump")
    program.replay(captures[0], drive.calibration, folder)
    replayed = labels_of(folder)
    return [number for number, labels in frames.items() if replayed.get(number) != labels], len(frames)

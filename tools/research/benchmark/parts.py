# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What is measured, part by part; each adds to its results what they do not have yet."""

import json
import os
import re
import statistics
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from measures.columns import HAZARD_SEED
from peers.main import SCENES, percentile
from tables import mean
from trial.program import MOUNT, Program

TOOLS = Path(__file__).resolve().parents[2]
STAGES = ("decode", "elevation_map", "adjacent_points", "seeds", "min_cut", "labels", "total", "after_frame")
LIVE_SENSORS = ("hdl64e", "ruby128", "vlp16")
RECORDED = ("semantickitti", "semantickitti_more")
# What is put before the peers: bodies, at places that nothing was chosen on.
HAZARDS = ("lying_person", "sitting_person", "child", "animal", "box_20cm", "box_30cm", "tyre", "bollard", "pallet", "branch",
           "tail_lift", "manhole", "kerb_stone")  # fmt: skip


@dataclass(frozen=True)
class Setting:
    program: Path
    beside: Path | None  # another version of it
    scratch: Path  # drives are kept there
    data: Path
    peers: Path
    quick: bool

    @property
    def rounds(self):
        return 1 if self.quick else 5


@dataclass(frozen=True)
class Case:
    """What `bench` reads: a drive of `simulate` (returns, scene), a folder for `encode`, or a capture."""

    sensor: str
    title: str
    drive: tuple = ()
    scans: str = ""
    capture: str = ""

    @property
    def name(self):
        return f"{self.sensor}, {self.title}"


CASES = (
    Case("hdl64e", "street", ("single", "street")),
    Case("hdl64e", "rural", ("single", "rural")),
    Case("hdl64e", "recorded", scans="semantickitti/sequences/00"),
    Case("ruby128", "street", ("single", "street")),
    Case("ruby128", "rural", ("single", "rural")),
    Case("ruby128", "street, dual return", ("dual", "street")),
    Case("vlp16", "street", ("single", "street")),
    Case("vlp16", "rural", ("single", "rural")),
    Case("vlp16", "capture", capture="pcap/sample_velodyne_vlp16_gps.pcap"),
    Case("vlp16", "capture, dual return", capture="pcap/vlp16_nebula.pcap"),
    Case("hdl32e", "capture", capture="pcap/sample_velodyne_hdl32.pcap"),
    Case("vlp32c", "capture", capture="pcap/vlp32_nebula.pcap"),
    Case("vls128", "capture", capture="pcap/vls128_nebula.pcap"),
)
DRIVE_S, COUNTED_S = 2, 0.3  # of a simulated drive; of one whose instructions are counted
# Every sensor that is decoded, by its word: how it is called, and what its packets are proved on beside made ones.
MODELS = {
    "hdl64e": ("HDL-64E", "S1: real; S2 and S3: made"),
    "ruby128": ("RS-Ruby128", "made"),
    "rs32": ("RS-LiDAR-32", "made"),
    "helios": ("RS-Helios", "made"),
    "vlp16": ("VLP-16", "two real, single and dual return"),
    "hdl32e": ("HDL-32E", "real"),
    "vlp32c": ("VLP-32C", "real, half its view"),
    "vls128": ("VLS-128", "real"),
    "pandar40p": ("Pandar40P", "real, dual return"),
    "pandar64": ("Pandar64", "real, dual return"),
    "pandarqt64": ("PandarQT64", "real, dual return"),
    "pandarqt128": ("PandarQT128", "real, dual return"),
    "pandarxt16": ("PandarXT-16", "made"),
    "pandarxt32": ("PandarXT-32", "real, dual return"),
    "pandarxt32m": ("PandarXT-32M", "made"),
    "ot128": ("OT128", "made"),
    "pandar128": ("Pandar128", "made"),
    "ouster32": ("Ouster, 32 rows", "made"),
    "ouster64": ("Ouster, 64 rows", "real, legacy profile"),
    "ouster128": ("Ouster, 128 rows", "four real, RNG19, RNG15 and FUSA dual profiles"),
}
MODEL_S = 1  # of a drive of each of them


class Failed(Exception):
    """What a program was asked for and said. It ends its part, whose figures up to then are kept."""


def told(command, **options):
    """What a command prints. Raises Failed."""
    ran = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, text=True, **options)
    if ran.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}\nexit code {ran.returncode}\n{ran.stderr or ''}")
    return ran.stdout


def quietly(command):
    return told(command, stderr=subprocess.PIPE)


def options_of(drive):
    return [drive.pcap, *drive.table_options, *MOUNT]


def input_of(case, setting):
    """The arguments that name the case's capture, made if need be. Raises FileNotFoundError."""
    program = Program(setting.program, setting.scratch)
    if case.drive:
        return options_of(program.drive(case.sensor, *case.drive, DRIVE_S))
    given = setting.data / (case.scans or case.capture)
    if not given.exists():
        raise FileNotFoundError(f"there is no {given}")
    if case.capture:
        return [given]
    capture = setting.scratch / "drives" / f"{case.scans.replace('/', '-')}.pcap"
    if not capture.is_file():
        quietly([setting.program, "encode", given, "-o", capture])
    return [capture, "--calibration", capture.with_suffix(".calibration.xml"), *MOUNT]


def bench(program, arguments, setting):
    report = setting.scratch / "bench.json"
    ran = subprocess.run([str(part) for part in (program, "bench", *arguments, "--repeat", 2 if setting.quick else 5,
                                                 "--json", report)], capture_output=True, text=True)  # fmt: skip
    if ran.returncode != 0:
        raise Failed(f"{program} bench {' '.join(map(str, arguments))}\n{ran.stderr}")
    return json.loads(report.read_text(encoding="utf-8"))


def benches(number, arguments, setting):
    """This version's report, and the other's or why it has none; None without another."""
    if setting.beside is None:
        return bench(setting.program, arguments, setting), None
    ours = bench(setting.program, arguments, setting) if number % 2 == 0 else None
    try:
        other = bench(setting.beside, arguments, setting)
    except Failed as refused:
        other = str(refused)
    return ours or bench(setting.program, arguments, setting), other


def ratios(frames, others):
    """[whole work, after the last packet] of two reports' frames, by their medians."""

    def median(of, *keys):
        return statistics.median(sum(frame[key] for key in keys) for frame in of)

    return [round(median(frames, *keys) / median(others, *keys), 3) for keys in (("decode", "segment"), ("after_frame",))]


def sensors(setting, results):
    """`terracut bench`, every case in each round; beside another version in turn, who is first changes by the round."""
    for number in range(setting.rounds):
        for case in CASES:
            if results.rounds(case.name) > number:
                continue
            try:
                arguments = input_of(case, setting)
            except FileNotFoundError as missing:
                results.leave_out(case.name, str(missing))
                continue
            report, other = benches(number, arguments, setting)
            figures = {"returns": report["returns_per_frame"]}
            figures |= {stage: [report["ms"][stage][of] for of in ("p50", "p99")] for stage in STAGES}
            if isinstance(other, str):
                results.leave_out(f"{case.name}, of the other version", other.strip().splitlines()[-1])
            elif other is not None:
                figures["beside"] = ratios(report["frames_ms"], other["frames_ms"])
            results.add(case.name, figures | {"planned_bytes": planned_bytes(case.sensor, setting)})
            print(f"round {number + 1}/{setting.rounds}: {case.name}", file=sys.stderr)


def planned_bytes(sensor, setting):
    plan = setting.scratch / "plan.json"
    quietly([setting.program, "plan", "--sensor", sensor, "--json", plan])
    return json.loads(plan.read_text(encoding="utf-8"))["total_bytes"]


def models(setting, results):
    """`terracut bench` of a drive of every sensor, all in each round, and how right the labels are by `replay --truth`."""
    row = re.search(r"^\| `sensor\.model` \|  \| auto, ([^|]*?) \|", quietly([setting.program, "config", "--print-table"]), re.MULTILINE)
    if row is None or row[1].split(", ") != list(MODELS):
        raise Failed(f"the program decodes {row and row[1]}, and the table is of {', '.join(MODELS)}")
    program = Program(setting.program, setting.scratch)
    for number in range(setting.rounds):
        for model in MODELS:
            if results.rounds(model) > number:
                continue
            drive = program.drive(model, "single", "street", MODEL_S)
            report = bench(setting.program, options_of(drive), setting)
            quality = program.replay(drive.pcap, drive.calibration, None, "--truth", drive.truth)["summary"]
            results.add(model, {"returns": report["returns_per_frame"], "planned_bytes": planned_bytes(model, setting),
                                "quality": [quality["iou_g"], quality["recall_o"]],
                                **{stage: [report["ms"][stage][of] for of in ("p50", "p99")] for stage in ("total", "after_frame")}})  # fmt: skip
            print(f"round {number + 1}/{setting.rounds}: {model}", file=sys.stderr)


def instructions(setting, results):
    """./tools/instructions."""
    for case in [case for case in CASES if case.drive and case.drive[0] == "single" and case.sensor != "vlp16"]:
        if results.rounds(case.name):
            continue
        drive = Program(setting.program, setting.scratch).drive(case.sensor, *case.drive, COUNTED_S)
        printed = quietly(["env", f"TERRACUT={setting.program}", TOOLS / "instructions", *options_of(drive)])
        rows = re.findall(r"^\| \**([^|*]+?)\** \| \**([\d.]+)\** \| (?:\d+%)? ?\|$", printed, re.MULTILINE)
        results.add(case.name, {stage: float(million) for stage, million in rows})
        print(f"instructions: {case.name}", file=sys.stderr)


def live_trial(setting, trial, *options):
    """The tables of a trial, each a list of {header: cell}, and how many of its points failed, of how many."""
    command = [TOOLS / "live_trial", "--program", setting.program, "--dir", setting.scratch, trial, *options]
    ran = subprocess.run([str(part) for part in command], stdout=sys.stderr)
    if ran.returncode not in (0, 1):
        raise Failed(f"{' '.join(map(str, command))}\nexit code {ran.returncode}")
    report = json.loads((setting.scratch / "results" / f"{trial}.json").read_text(encoding="utf-8"))
    verdicts = [point["verdict"] for point in report["points"]]
    tables = [[dict(zip(table["header"], row)) for row in table["rows"]] for table in report["tables"]]
    return tables, f"{verdicts.count('FAIL')} of {len(verdicts) - verdicts.count('SKIP')}"


def live(setting, results):
    """./tools/live_trial loopback."""
    for sensor in LIVE_SENSORS:
        if not results.rounds(sensor):
            tables, failed = live_trial(setting, "loopback", "--minutes", 0.5 if setting.quick else 3, "--sensor", sensor)
            results.add(sensor, tables[0][0] | {"points of the trial that failed": failed})


def outputs(setting, results):
    """./tools/live_trial outputs."""
    if not results.rounds("outputs"):
        quick = ("--seconds", 4, "--rounds", 1)
        tables, failed = live_trial(setting, "outputs", *(quick if setting.quick else ()))
        results.add("outputs", {"each": tables[0], "stalled": tables[1], "failed": failed})


def recorded_roots(setting, results):
    roots = [setting.data / name for name in RECORDED if (setting.data / name).is_dir()]
    if not roots:
        results.leave_out("recorded", f"there is no {setting.data / RECORDED[0]}")
    return roots


def beside_peer(setting, results, arguments):
    """The report of ./tools/beside_peer. Peers that it leaves out are told to the results."""
    report = setting.scratch / "peers.json"
    ran = subprocess.run([str(part) for part in (
        "env", f"TERRACUT={setting.program}", TOOLS / "beside_peer", *arguments, "--peers", setting.peers, "--json", report)],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)  # fmt: skip
    if ran.returncode != 0:
        raise Failed(f"beside_peer: exit code {ran.returncode}\n{ran.stderr}")
    for peer, reason in re.findall(r"^left out: (.*?): (.*)$", ran.stderr, re.MULTILINE):
        results.leave_out(peer, reason.split(": ")[0])
    return json.loads(report.read_text(encoding="utf-8"))


def peers(setting, results):
    """./tools/beside_peer, a run for all recorded scans and one for each scene."""
    roots = recorded_roots(setting, results)
    cases = {"recorded": [*roots, "--scenes", ""]} if roots else {}
    cases |= {scene: ["--scenes", scene, "--duration", 0.3 if setting.quick else 1] for scene in SCENES}
    for name, arguments in cases.items():
        if results.rounds(name):
            continue
        results.add(name, of_peers(beside_peer(setting, results, [*arguments, "--rounds", setting.rounds])))
        print(f"peers: {name}", file=sys.stderr)


def of_peers(report):
    """{program: {"ms": [p50, p99] over all frames, "quality": [IoU_g, Recall_o], the means over drives}}."""
    figures = {}
    for name in next(iter(report["ms"].values())):
        ms = [time for drive in report["ms"].values() for time in drive[name]]
        quality = [mean(drive[name][measure] for drive in report["quality"].values()) for measure in (0, 1)]
        figures[name] = {"ms": [round(statistics.median(ms), 3), round(percentile(ms, 99), 3)],
                         "quality": [None if share is None else round(share, 4) for share in quality]}  # fmt: skip
    return figures


def hazards(setting, results):
    """./tools/beside_peer --hazards, on all recorded scans."""
    roots = recorded_roots(setting, results)
    if roots and not results.rounds("road"):
        kinds = HAZARDS[:1] if setting.quick else HAZARDS
        results.add("road", on_road(beside_peer(setting, results, [*roots, "--hazards", ",".join(kinds), "--seed", HAZARD_SEED])))


def on_road(report):
    """{program: how many of the hazards on the road it found, of how many}."""
    trials = [trial["of"] for trial in report if trial["ground"] == "road"]
    return {name: {key: sum(of[name].get(key, 0) for of in trials) for key in ("found", "trials")} for name in (trials[0] if trials else ())}


@dataclass(frozen=True)
class Part:
    name: str
    measure: Callable
    way: Callable  # of quick: how it is measured, for its line in the page


PARTS = (
    Part("sensors", sensors, lambda quick: "1 round of 2 passes (--quick)" if quick else "5 rounds of 5 passes"),
    Part("models", models, lambda quick: "1 round of 2 passes (--quick)" if quick else "5 rounds of 5 passes"),
    Part("instructions", instructions, lambda quick: "3 frames"),
    Part("live", live, lambda quick: "half a minute a sensor (--quick)" if quick else "3 minutes a sensor"),
    Part("outputs", outputs, lambda quick: "4 s a run, 1 round (--quick)" if quick else "20 s a run, 3 rounds"),
    Part("peers", peers, lambda quick: "1 round, scenes of 0.3 s (--quick)" if quick else "5 rounds, scenes of 1 s"),
    Part("hazards", hazards, lambda quick: f"{HAZARDS[0]} alone (--quick)" if quick else "a trial of each kind for each ground, range and frame"),
)

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The tables of docs/reference and the figures in README.md, of what was measured."""

import statistics

from peers.programs import AFTER_FRAME, FROM_PACKETS, SEGMENTING
from tables import table

from .parts import CASES, MODELS

DOCUMENTS = ("README.md", *(f"docs/reference/{page}.md" for page in ("benchmark", "sensors")))
STAGE_ROWS = {
    "total": "**total**",
    "after_frame": "of it after the turn's last packet",
    "decode": "decoding",
    "elevation_map": "elevation map, and the points it is made of",
    "adjacent_points": "adjacent points",
    "seeds": "seeds and region term",
    "min_cut": "min-cut, weights included",
    "labels": "labels of all returns",
}
TABLES = (("hdl64e",), ("ruby128",), ("vlp16", "hdl32e", "vlp32c", "vls128"))  # the sensors of each
NAMES = {"hdl64e": "HDL-64E", "ruby128": "RS-Ruby128", "vlp16": "VLP-16", "hdl32e": "HDL-32E", "vlp32c": "VLP-32C",
         "vls128": "VLS-128"}  # fmt: skip
UNIT = "hdl64e, street"  # what the others are told in
# The drive that the live trial sends: the columns of the sensors' tables which its latencies belong to.
SENT = {"hdl64e": "hdl64e, street", "ruby128": "ruby128, street, dual return", "vlp16": "vlp16, street"}
FIRING_TO_LABEL, LONGEST = "firing to label, mean", "the longest in ten degrees"
ELSEWHERE = "models"  # the part that another page shows
STAMPED = ("at", "load")  # of every round, beside its figures
TIMED, TUNED = "street", "recorded"  # of the peers' drives: the one whose times README shows, the one that terracut is tuned on
MEBI = 1 << 20


def median(rounds, *keys):
    """Of the rounds' figures below these keys; None without any."""

    def below(figures):
        for key in keys:
            figures = figures.get(key) if isinstance(figures, dict) else figures[key]
            if figures is None:
                return None
        return figures

    known = [value for value in map(below, rounds) if value is not None]
    return statistics.median(known) if known else None


def spanned(ratios):
    """The median with its span, where there is more than one."""
    if not ratios:
        return ""
    span = f" ({min(ratios):.2f}-{max(ratios):.2f})" if len(ratios) > 1 else ""
    return f"{statistics.median(ratios):.2f}{span}"


def machines(results):
    """Where the parts were measured that benchmark.md shows, each once."""
    return list(dict.fromkeys(of.measured["machine"] for name, of in results.items() if of.cases and name not in (ELSEWHERE, "hazards")))


def stamp(results, known=""):
    """What the figures of a part are of, in a line; the machine that the page names once is left out."""
    of, rounds = results.measured, [figures for case in results.cases.values() for figures in case]
    if not rounds:
        return ["Not measured.", ""]
    loads = [figures["load"] for figures in rounds]
    beside = f", beside {of['beside']} in turn" if of.get("beside") else ""
    machine = "" if of["machine"] == known else f"{of['machine']}; "
    note = f"; {of['note']}" if of.get("note") else ""
    text = (f"terracut {of['version']} (program {of['program']}){beside}; {machine}"
            f"{min(figures['at'] for figures in rounds)} UTC; {of['way']}; load average {min(loads)} to {max(loads)}{note}.")  # fmt: skip
    left_out = {}
    for what, reason in results.left_out.items():
        left_out.setdefault(reason, []).append(what)
    reasons = [f"{', '.join(names)} ({reason})" for reason, names in left_out.items()]
    return [text, *([f"Left out: {'; '.join(reasons)}."] if reasons else []), ""]


def sensor_table(sensors, results):
    measured, live = results["sensors"].cases, results["live"].cases
    cases = [case for case in CASES if case.sensor in sensors and case.name in measured]
    rows = []

    def add(title, of):
        cells = [of(case.name) for case in cases]
        if any(cells):
            rows.append((title, cells))

    def by_unit(name):
        pairs = zip(measured[name], measured.get(UNIT, ()))
        return spanned([ours["total"][0] / unit["total"][0] for ours, unit in pairs])

    def by_version(which):
        return lambda name: spanned([figures["beside"][which] for figures in measured[name] if "beside" in figures])

    def both(stage):
        return lambda name: " / ".join(f"{median(measured[name], stage, of):.2f}" for of in (0, 1))

    def latency(name):
        sensor = next((sensor for sensor, sent in SENT.items() if sent == name and sensor in live), None)
        if sensor is None:
            return ""
        told = live[sensor][-1]
        return f"{told[FIRING_TO_LABEL]} / {told[LONGEST].split(' / ')[1]}"

    other = results["sensors"].measured.get("beside")
    if not cases:
        return []
    add("times an HDL-64E's street", by_unit)
    add(f"total, times that of {other}", by_version(0))
    add("after the turn's last packet, times", by_version(1))
    for stage, title in STAGE_ROWS.items():
        add(title, both(stage))
    add("a firing to its label in `live`: mean / p99 of ten degrees", latency)
    add("returns a turn", lambda name: f"{median(measured[name], 'returns'):,.0f}")
    add("memory planned, MiB", lambda name: f"{median(measured[name], 'planned_bytes') / MEBI:.1f}")
    titles = [case.title if len(sensors) == 1 else f"{NAMES[case.sensor]}, {case.title}" for case in cases]
    return [*table(f"{NAMES[sensors[0]] if len(sensors) == 1 else 'others'}; ms, p50 / p99", titles, rows), ""]


def models_table(results):
    measured = results["models"].cases
    unit = measured.get("hdl64e", ())
    rows = []
    for model, (name, proved) in MODELS.items():
        rounds = measured.get(model)
        if not rounds:
            continue
        times = spanned([ours["total"][0] / its["total"][0] for ours, its in zip(rounds, unit)])
        iou, recall = rounds[-1]["quality"]

        def both(stage):
            return " / ".join(f"{median(rounds, stage, of):.2f}" for of in (0, 1))

        rows.append((f"{name} (`{model}`)", [proved, times, both("total"), both("after_frame"), f"{median(rounds, 'planned_bytes') / MEBI:.1f}",
                                             f"{median(rounds, 'returns'):,.0f}", f"{100 * iou:.2f} / {100 * recall:.2f}"]))  # fmt: skip
    if not rows:
        return []
    return table("sensor (word)", ["packets proved on", "times an HDL-64E", "whole work, ms", "after the turn's last packet, ms",
                                   "memory, MiB", "returns a turn", "IoU_g / Recall_o, %"], rows)  # fmt: skip


def instructions_table(results):
    cases = results["instructions"].cases
    if not cases:
        return []
    stages = dict.fromkeys(stage for rounds in cases.values() for stage in rounds[-1] if stage not in STAMPED)
    names = {case.name: f"{NAMES[case.sensor]}, {case.title}" for case in CASES}
    return table("million instructions a turn", [names[case] for case in cases],
                 [(f"**{stage}**" if stage == "all" else stage, [f"{rounds[-1].get(stage, 0):.2f}" for rounds in cases.values()])
                  for stage in stages])  # fmt: skip


def live_table(results):
    cases = {sensor: rounds[-1] for sensor, rounds in results["live"].cases.items()}
    if not cases:
        return []
    titles = dict.fromkeys(title for told in cases.values() for title in told if title not in (*STAMPED, "sensor", "load average"))
    return table("ms, p50 / p99 / p99.9 / max", [told["sensor"].replace(sensor, NAMES[sensor]) for sensor, told in cases.items()],
                 [(title, [str(told.get(title, "")) for told in cases.values()]) for title in titles])  # fmt: skip


def outputs_table(which, results):
    rows = [rows for told in results["outputs"].cases.get("outputs", [])[-1:] for rows in told[which]]
    if not rows:
        return []
    title, *names = rows[0]
    return [*table(title, names, [(str(row[title]), [str(row[name]) for name in names]) for row in rows]), ""]


def peers_table(results):
    cases = {name: rounds[-1] for name, rounds in results["peers"].cases.items()}
    if not cases:
        return []
    names = dict.fromkeys(name for told in cases.values() for name in told if name not in STAMPED)

    def cell(told, name):
        if name not in told:
            return ""
        (p50, p99), unit = told[name]["ms"], told[FROM_PACKETS]["ms"][0]
        return f"x {p50 / unit:.2f}; {p50:.2f} / {p99:.2f} ms"

    return table("times terracut's whole work; p50 / p99", cases,
                 [(name, [cell(told, name) for told in cases.values()]) for name in names])  # fmt: skip


def segmenters(cases):
    """{name: its key in the figures} of every program that makes labels, terracut first."""
    keys = dict.fromkeys(key for told in cases.values() for key in told if key not in (*STAMPED, SEGMENTING, AFTER_FRAME))
    return {"terracut" if key == FROM_PACKETS else key: key for key in sorted(keys, key=lambda key: key != FROM_PACKETS)}


def hazards_found(results):
    """{name: share of the hazards on the road that it finds}; empty if that was not measured."""
    for told in results["hazards"].cases.get("road", [])[-1:]:
        return {name: of["found"] / of["trials"] for name, of in told.items() if name not in STAMPED}
    return {}


def qualities_table(results):
    """README's: how good each program is on each drive, and what a frame of the simulated street costs it."""
    cases = {name: rounds[-1] for name, rounds in results["peers"].cases.items()}
    if TIMED not in cases:
        return []
    # Drives that nothing was tuned on come first.
    titles = {name: f"{name}, tuned on" if name == TUNED else name for name in sorted(cases, key=lambda name: name == TUNED)}

    def quality(told):
        return " / ".join("-" if share is None else f"{100 * share:.1f}" for share in told["quality"]) if told else ""

    found = hazards_found(results)

    def rest(name, key):
        if found:
            yield f"{100 * found[name]:.0f}" if name in found else ""
        yield f"{cases[TIMED][key]['ms'][0]:.2f}" if key in cases[TIMED] else ""

    rows = [(name, [*(quality(cases[case].get(key)) for case in titles), *rest(name, key)]) for name, key in segmenters(cases).items()]
    missing = [] if found else ["What others find of hazards is not measured."]
    if left_out := ", ".join(results["peers"].left_out):
        missing.append(f"Not built for this measurement: {left_out}.")
    return [*table("IoU_g / Recall_o, %", [*titles.values(), *(["hazards on the road found, %"] if found else []), f"ms a frame, {TIMED}"], rows),
            *(["", " ".join(missing)] if missing else [])]  # fmt: skip


def frame_text(results):
    rounds = results["sensors"].cases.get(UNIT, ())
    return [f"{median(rounds, 'total', 0):.1f} ms" if rounds else ""]


def live_text(results):
    for told in results["live"].cases.get("hdl64e", [])[-1:]:
        p50, p99 = told[LONGEST].split(" / ")[:2]
        return [f"{told['all threads, a frame in the mean']} ms of processor time; a return's label {told[FIRING_TO_LABEL]} ms after "
                f"its packet, the last of ten degrees {p50}, p99 {p99}"]  # fmt: skip
    return [""]


def memory_text(results):
    cases = results["sensors"].cases
    hdl64e, ruby128 = (median(cases.get(f"{sensor}, street", ()), "planned_bytes") for sensor in ("hdl64e", "ruby128"))
    return [f"{hdl64e / MEBI:.0f} MiB, RS-Ruby128 {ruby128 / MEBI:.0f}" if hdl64e and ruby128 else ""]


def blocks(results):
    """{name: lines} of all that the documents show; `results`: {part: Results}."""
    tables = {
        "sensors": [line for sensors in TABLES for line in sensor_table(sensors, results)][:-1],
        "models": models_table(results),
        "instructions": instructions_table(results),
        "live": live_table(results),
        "outputs": (outputs_table("each", results) + outputs_table("stalled", results))[:-1],
        "peers": peers_table(results),
    }
    found = machines(results)
    known = found[0] if len(found) == 1 else ""
    bare = {"machine": [f"Machine: {machine}." for machine in found], "qualities": qualities_table(results), "frame_text": frame_text(results),
            "live_text": live_text(results), "memory_text": memory_text(results)}  # fmt: skip
    return {part: [*stamp(results[part], "" if part == ELSEWHERE else known), *lines] for part, lines in tables.items()} | bare

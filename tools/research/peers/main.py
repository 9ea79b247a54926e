# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Compares terracut with other ground segmenters: in turn, in the same minutes, on the same core, over the same points.

The peers (sources.py) are fetched from GitHub, each at one commit, and built in a folder outside of this repository with an
adapter of ours. A peer that cannot be fetched or built is left out, and the reason is printed. `--peer NAME=PROGRAM` adds
another program. It is called as `PROGRAM REPEAT LABELS SCAN.bin...` and reads all scans (float32 x y z remission). REPEAT
times over, it segments every scan and prints the nanoseconds of processor time that this took, one line a scan. Unless
LABELS is "-", it writes LABELS/NNNNNN.label for the n-th scan, one uint32 a point: 40, 44, 48, 49, 60 and 72 are ground.

Drives are recorded SemanticKITTI sequences, encoded as packets (`terracut encode`), and simulated drives. terracut labels
the packets. Three of its times are shown: with decoding, without it, and the time still needed when the frame's last packet
has come. A peer gets the points decoded from these packets in its own container, which is not timed. Every round runs each
program over every drive: one pass to warm up and two that count. p50 and p99 are over all frames of all rounds, "x" is the
ratio of medians. IoU_g and Recall_o count all ground; each is computed for a drive's points together. The last rows show
their means over recorded and over simulated drives. The program is build/release/terracut or $TERRACUT.

With `--hazards` no time is measured. `terracut eval hazards` puts hazards into the scans of the given roots, every program
labels the same clouds, and the tables show what each of them finds, counted as `eval hazards` counts. terracut is
build/release/tests/bench/cloud_peer then.

With `--objects` every program finds objects among the same obstacles, those of terracut, in the labelled scans of the given
roots. A peer (`--peer`; Euclidean clusters are at hand) is called as above; beside every SCAN.bin lies SCAN.label, where 99 is
an obstacle, and it writes the object of each point, or 0, into its labels' upper 16 bits. Shown are, of the sequences that
terracut's parameters were chosen on / of the others: over- and under-segmentation entropy, mean (deviation) over frames;
how many returns of what can be an object are in one (what is whole in none costs no entropy); panoptic quality and recall of
numbered instances, %; processor time for the objects alone, the shortest of three, its mean over frames and how many times
terracut's that is. `--judge PROGRAM SCAN.bin TRUE.label FOUND.label...` may count the entropies in
our place: it prints those of each FOUND, a line each.
"""

import argparse
import json
import math
import os
import statistics
import sys
import tempfile
from pathlib import Path

from chosen_names import names_of
from peers.drives import recorded, roles, simulated
from peers.hazards import Found, counted, disturbance_rows, hazard_rows, written
from peers.objects import NAMES, beside, rows
from peers.programs import FROM_PACKETS, Peer, Terracut
from peers.sources import JUDGE, OBJECT_PEERS, PEERS, Unavailable, build
from tables import mean, table
from whole_file import write_whole_file

SCENES = ("street", "highway", "rural", "hill")


def percentile(values, percent):
    """Returns the percentile by nearest rank."""
    return sorted(values)[max(1, math.ceil(percent / 100 * len(values))) - 1]


def percent(share):
    return "-" if share is None else f"{100 * share:.1f}"


def time_rows(groups, names, samples):
    """Returns p50 / p99 (x FROM_PACKETS) of every name, for each drive and each group of drives."""
    for group, drives in groups.items():
        rows = [(drive, [drive]) for drive in drives]
        if len(drives) > 1:
            rows.append((f"**{group}, all**", drives))
        for title, among in rows:
            of = {name: [ms for drive in among for ms in samples[drive][name]] for name in names}
            ours = statistics.median(of[FROM_PACKETS])
            yield title, [
                f"{statistics.median(ms):.2f} / {percentile(ms, 99):.2f} (x {statistics.median(ms) / ours:.2f})"
                for ms in of.values()
            ]


def quality_rows(groups, names, quality):
    for group, drives in groups.items():
        rows = [(drive, [drive]) for drive in drives]
        if len(drives) > 1:
            rows.append((f"**{group}, mean**", drives))
        for title, among in rows:
            yield title, [
                " / ".join(percent(mean(quality[drive][name][measure] for drive in among)) for measure in (0, 1))
                for name in names
            ]


def available_peers(options, sources=PEERS):
    peers = []
    for source in sources:
        if options.only is not None and source.name not in options.only:
            continue
        try:
            peers.append(Peer(source.name, build(source, options.peers.resolve()), options.core))
        except Unavailable as why:
            print(f"left out: {source.name}: {why}", file=sys.stderr)
    for text in options.peer:
        name, equals, program = text.partition("=")
        if not equals or not name or not program:
            sys.exit(f"--peer: expected NAME=PROGRAM, found '{text}'")
        peers.append(Peer(name, program, options.core))
    return peers


def arguments(given):
    parser = argparse.ArgumentParser(prog="beside_peer", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("roots", nargs="*", type=Path, metavar="DATASET_ROOT", help="of recorded sequences")
    parser.add_argument("--peers", type=Path, default=Path("../peers"), metavar="FOLDER",
                        help="where they are fetched to and built (default: ../peers)")  # fmt: skip
    parser.add_argument("--only", type=names_of("peer", [peer.name for peer in (*PEERS, *OBJECT_PEERS)]), metavar="NAME,...",
                        help="of " + ", ".join(peer.name for peer in (*PEERS, *OBJECT_PEERS)) + "; '' is none")  # fmt: skip
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=PROGRAM", help="one more")
    parser.add_argument("--scenes", type=lambda text: text.split(",") if text else [], default=SCENES, metavar="SCENE,...",
                        help="simulated drives (default: " + ",".join(SCENES) + ")")  # fmt: skip
    parser.add_argument("--duration", type=float, default=1.0, metavar="S", help="of a simulated drive (default: 1)")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    parser.add_argument("--json", type=Path, help="file for every single time, or for what was found of each hazard")
    parser.add_argument("--hazards", nargs="?", const="", metavar="KIND,...", help="what `terracut eval hazards` puts into "
                        "the scans of the roots (default: all kinds), found by each program")  # fmt: skip
    parser.add_argument("--objects", action="store_true", help="objects in the scans of the roots, found by each program")
    parser.add_argument("--judge", type=Path, metavar="PROGRAM", help="counts the entropies, beside our own count")
    parser.add_argument("--trials", type=int, default=1, help="of a kind for each ground, range and frame (default: 1)")
    parser.add_argument("--seed", type=int, default=1, help="of the hazards' places (default: 1)")
    return parser.parse_args(given)


def beside_on_hazards(options):
    ours = Path(__file__).resolve().parents[3] / "build/release/tests/bench/cloud_peer"
    programs = [Peer("terracut", ours, options.core), *available_peers(options)]
    names = [program.name for program in programs]
    founds, role_of = [Found() for _ in programs], roles()
    with tempfile.TemporaryDirectory() as folder:
        for root in options.roots:
            for scans in written(Terracut(options.core), root, options.hazards, options.trials, options.seed, Path(folder)):
                for program, found in zip(programs, founds):
                    found.label(program, scans, Path(folder) / "labels", role_of)

    if options.json:
        write_whole_file(options.json, json.dumps(counted(names, founds), indent=1) + "\n")

    def cell(scores):
        return " / ".join(percent(mean(measures)) for measures in zip(*scores))

    print("\n".join(table("found / not one return, % (trials)", names, hazard_rows(founds))))
    print()
    print("\n".join(table("IoU_g / Recall_o of what is not moved, %", names, disturbance_rows(founds, role_of, cell))))
    return 0


def beside_on_objects(options):
    peers = available_peers(options, OBJECT_PEERS)
    try:
        judges = [build(JUDGE, options.peers.resolve()), *([options.judge.resolve()] if options.judge else [])]
    except Unavailable as why:
        sys.exit(str(why))
    with tempfile.TemporaryDirectory() as folder:
        judged, difference = beside(Terracut(options.core), peers, judges, options.roots, Path(folder))
    print("\n".join(table("tuned / unseen", NAMES, rows(judged))))
    if options.judge:
        print(f"\nlargest difference between {options.judge.name}, shown here, and our own count of a frame: {difference:.2g}")
    return 0


def main(given):
    options = arguments(given)
    if options.objects:
        return beside_on_objects(options)
    if options.hazards is not None:
        return beside_on_hazards(options)
    terracut = Terracut(options.core)
    programs = [terracut, *available_peers(options)]
    names = [name for program in programs for name in program.names]
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        drives = [drive for root in options.roots for drive in recorded(terracut, root, scratch)]
        drives += [simulated(terracut, scene, options.duration, scratch) for scene in options.scenes]
        groups = {}
        for drive in drives:
            groups.setdefault(drive.group, []).append(drive.name)

        role_of = roles()
        quality = {drive.name: {} for drive in drives}
        for drive in drives:
            for number, program in enumerate(programs):
                labels = drive.folder / f"labels_{number}"
                program.label(drive, labels)
                score = drive.score(labels, role_of)
                quality[drive.name] |= {name: score for name in program.names}

        samples = {drive.name: {name: [] for name in names} for drive in drives}
        for number in range(options.rounds):
            for drive in drives:
                for program in programs:
                    for name, times in program.times(drive).items():
                        samples[drive.name][name] += times
            print(f"\r{number + 1}/{options.rounds}", end="", file=sys.stderr, flush=True)
        print(file=sys.stderr)

    if options.json:
        write_whole_file(options.json, json.dumps({"ms": samples, "quality": quality}, indent=1) + "\n")
    print("\n".join(table("ms a frame, p50 / p99", names, time_rows(groups, names, samples))))
    print()
    print("\n".join(table("IoU_g / Recall_o, %", names[2:], quality_rows(groups, names[2:], quality))))
    return 0

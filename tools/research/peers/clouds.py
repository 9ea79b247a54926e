# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Compares terracut's library with a peer on recorded scans of which all rows are kept, every second, or every fourth.

Both take clouds in memory and return labels; they run in turn on one core. One run labels all scans of a sequence. Times
are processor milliseconds a cloud: p50 / p99 over all clouds, and "x", the ratio of medians to the peer's. IoU_g / Recall_o
count all ground; each is computed for a sequence's points together and then averaged over sequences. Needs
build/release/tests/bench/cloud_peer and, unless --peer names another program, FugSeg (./tools/setup --peers).
"""

import argparse
import math
import os
import statistics
import struct
import sys
import tempfile
from array import array
from pathlib import Path

from .drives import roles, score_of
from .programs import Peer
from .sources import PEERS, build

ROWS = 64
# (n, k): keeps row k of every n rows, counted upwards from 0, the lowest one.
KEPT = ((1, 0), (2, 0), (2, 1), (4, 0), (4, 2))


def rings_of(points):
    """Returns the ring of each point from the top, by KITTI's order (firmware_io/scan/ring_recovery.hpp)."""
    jitter = math.pi / 18
    rings, ring, last = [], 0, 0.0
    for x, y, _, _ in points:
        azimuth = math.atan2(y, x) % (2 * math.pi)
        if azimuth - last < -math.pi:
            ring += 1
        elif rings and last < jitter and azimuth > 2 * math.pi - jitter and ring > 0:
            ring -= 1
        rings.append(ring)
        last = azimuth
    if 0 < rings.count(0) < 8:
        rings = [max(0, ring - 1) for ring in rings]
    return rings


class Sequence:
    """A sequence's scans reduced to some rows, as files."""

    def __init__(self, folder, scratch, every, first):
        self.scans, self.truth = [], []
        scratch.mkdir(parents=True)
        for scan in sorted((folder / "velodyne").glob("*.bin")):
            label_file = folder / "labels" / f"{scan.stem}.label"
            if not label_file.is_file():
                continue
            points = list(struct.iter_unpack("<4f", scan.read_bytes()))
            labels = array("I", label_file.read_bytes())
            rings = rings_of(points)
            if rings[-1] != ROWS - 1:
                sys.exit(f"{scan}: {rings[-1] + 1} rings, expected {ROWS}")
            kept = [i for i, ring in enumerate(rings) if (ROWS - 1 - ring) % every == first]
            path = scratch / scan.name
            path.write_bytes(b"".join(struct.pack("<4f", *points[i]) for i in kept))
            self.scans.append(path)
            self.truth.append([labels[i] & 0xFFFF for i in kept])

    def score(self, labels, role_of):
        counts = {}
        for number, truth in enumerate(self.truth):
            found = array("I", (labels / f"{number:06}.label").read_bytes())
            for pair in zip(truth, found):
                counts[pair] = counts.get(pair, 0) + 1
        return score_of(counts, role_of)


def arguments(given):
    parser = argparse.ArgumentParser(prog="beside_clouds", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("roots", nargs="+", type=Path, metavar="DATASET_ROOT")
    parser.add_argument("--peers", type=Path, default=Path("../peers"), metavar="FOLDER")
    parser.add_argument("--peer", metavar="NAME=PROGRAM", help="in place of FugSeg")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    return parser.parse_args(given)


def main(given):
    options = arguments(given)
    checkout = Path(__file__).resolve().parents[3]
    ours = Peer("terracut", checkout / "build/release/tests/bench/cloud_peer", options.core)
    if options.peer:
        peer = Peer(*options.peer.split("=", 1), options.core)
    else:
        source = next(source for source in PEERS if source.name == "FugSeg")
        peer = Peer(source.name, build(source, options.peers.resolve()), options.core)
    role_of = roles()
    folders = sorted(folder for root in options.roots for folder in (root / "sequences").iterdir())
    print(f"| rows kept | {ours.name}, ms | {peer.name}, ms | x | {ours.name}, IoU_g / Recall_o | {peer.name} |")
    print("|---|---|---|---|---|---|")
    for every, first in KEPT:
        with tempfile.TemporaryDirectory() as scratch:
            sequences = [Sequence(folder, Path(scratch) / str(i), every, first) for i, folder in enumerate(folders)]
            samples, quality = {ours.name: [], peer.name: []}, {ours.name: [], peer.name: []}
            for i, sequence in enumerate(sequences):
                for program in (ours, peer):
                    labels = Path(scratch) / f"{i}_{program.name}"
                    program.label(sequence, labels)
                    quality[program.name].append(sequence.score(labels, role_of))
            for _ in range(options.rounds):
                for sequence in sequences:
                    for program in (ours, peer):
                        samples[program.name] += program.times(sequence)[program.name]
        medians = {name: statistics.median(ms) for name, ms in samples.items()}
        times = [f"{medians[name]:.2f} / {sorted(ms)[math.ceil(0.99 * len(ms)) - 1]:.2f}" for name, ms in samples.items()]
        scores = [" / ".join(f"{100 * statistics.fmean(values):.1f}" for values in zip(*found)) for found in quality.values()]
        title = f"{ROWS // every}" + (f", from row {first} up" if every > 1 else "")
        print(f"| {title} | {' | '.join(times)} | {medians[ours.name] / medians[peer.name]:.2f} | {' | '.join(scores)} |", flush=True)
    return 0

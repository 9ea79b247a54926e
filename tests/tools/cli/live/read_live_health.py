#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Compares the health that a live run told on a CAN bus with the summary that it wrote.

usage: read_live_health.py FILE.dbc CONSOLE

CONSOLE is what live_can_in_vm.sh printed: candump's lines and, between two marks, the summary. Ends
with 0 when every report is there, in order, and as the summary says.
"""
import json
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../../firmware_io/can"))
import read_health  # noqa: E402


def expect(true, what):
    if not true:
        sys.exit(what)


def main():
    path, console = sys.argv[1], open(sys.argv[2]).read()
    reports, others = read_health.reports_on(console, path)
    summary = json.loads(re.search(r"^summary-begin\s*$(.*)^summary-end\s*$", console, re.M | re.S)[1])
    motion, health = summary["motion"], summary["health"]

    expect(health["sent"] == 2 * len(reports), "%d frames were sent, candump saw %d reports" % (
        health["sent"], len(reports)))
    alive = [int(report["Alive"]) for report in reports]
    expect(alive == [i % 256 for i in range(len(alive))], "Alive does not count up: %s" % alive)
    # A frame is known to be skipped while the one before it is still at work.
    skipped_level = 3
    numbers = [report["FrameNumber"] for report in reports if report["Level"] != skipped_level]
    expect(numbers == sorted(numbers) and numbers[-1] > 0, "labelled frames out of order: %s" % numbers)
    expect(reports[-1]["Misses"] == summary["misses"]["total"], "misses differ")
    expect(reports[-1]["Skipped"] == summary["frames"]["levels"]["skipped"], "skipped frames differ")
    for flag in 0, 1:
        expect(any(report["EgoMotion"] == flag for report in reports),
               "EgoMotion never was %d" % flag)

    expect(motion["deskewed_frames"] + motion["no_ego_motion_frames"] == summary["frames"]["count"],
           "frames are neither freed of the motion nor marked: %s" % motion)
    expect(motion["faults"]["link_losses"] >= 1 and motion["faults"]["interface_changes"] == 1,
           "comings and goings: %s" % motion["faults"])
    expect(motion["faults"]["bus_off"] == 1, "bus-off: %s" % motion["faults"])
    expect(motion["spare_samples"] > 0, "no flood: %s" % motion)
    after_frame_ms = motion["newest_sample_after_frame_ms"]
    expect(-1000 <= after_frame_ms["min"] <= after_frame_ms["mean"] <= after_frame_ms["max"],
           "samples against frames: %s" % after_frame_ms)
    print("%d reports read as the summary says, %d frames by canmatrix too; %d "
          "frames of %d deskewed" % (len(reports), others, motion["deskewed_frames"],
                            summary["frames"]["count"]))


main()

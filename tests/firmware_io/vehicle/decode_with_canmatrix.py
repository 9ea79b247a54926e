#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Decodes frames with canmatrix, a DBC reader that shares nothing with terracut's.

usage: decode_with_canmatrix.py FILE.dbc < frames

A line of `frames` is an id as a DBC file writes it (bit 31: 29-bit) and the data in hexadecimal.
Prints "MESSAGE SIGNAL value" for every signal of every frame.
"""
import logging
import sys

logging.disable(logging.CRITICAL)
import canmatrix.formats  # noqa: E402


def main():
    matrix = canmatrix.formats.loadp_flat(sys.argv[1])
    frames = {}
    for frame in matrix.frames:
        extended = 0x80000000 if frame.arbitration_id.extended else 0
        frames[frame.arbitration_id.id | extended] = frame
    for line in sys.stdin:
        number, data = line.split()
        frame = frames[int(number)]
        for name, signal in frame.decode(bytes.fromhex(data)).items():
            print(frame.name, name, repr(float(signal.phys_value)))


main()

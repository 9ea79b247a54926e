#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Reads terracut's health as another program on the bus would: candump lines and the DBC file.

usage: read_health.py FILE.dbc CONSOLE

CONSOLE holds lines "(stamp) vcan0 6D0#..." of candump and lines "health NAME=value ..." of what was
sent. Ends with 0 when every one of these was found on the bus. Decodes by the few lines below and,
where it is installed, by canmatrix too.
"""
import logging
import re
import sys

logging.disable(logging.CRITICAL)


def signals_of(dbc):
    """{id: [(name, start bit, bits, factor)]}; ours are all Intel and unsigned, without offset."""
    messages, current = {}, None
    for line in dbc.splitlines():
        if message := re.match(r"BO_ (\d+) ", line):
            current = messages.setdefault(int(message[1]), [])
        elif signal := re.match(r" SG_ (\w+) : (\d+)\|(\d+)@1\+ \(([\d.]+),0\)", line):
            current.append((signal[1], int(signal[2]), int(signal[3]), float(signal[4])))
    return messages


def decode(signals, data):
    number = int.from_bytes(data, "little")
    return {name: (number >> start & (1 << bits) - 1) * factor for name, start, bits, factor in signals}


def decode_with_canmatrix(path, number, data):
    try:
        import canmatrix.formats
    except ImportError:
        return None
    matrix = canmatrix.formats.loadp_flat(path)
    frame = next(frame for frame in matrix.frames if frame.arbitration_id.id == number)
    return {name: float(signal.phys_value) for name, signal in frame.decode(data).items()}


def reports_on(console, path):
    """([{name: value} of each report in order], how many frames canmatrix read the same)."""
    messages = signals_of(open(path).read())
    reports, others = [], 0
    for number, data in re.findall(r"^\(\d+\.\d+\) +vcan[01] +(6D[01])#([0-9A-F]{16})\s*$", console, re.M):
        data = bytes.fromhex(data)
        values = decode(messages[int(number, 16)], data)
        theirs = decode_with_canmatrix(path, int(number, 16), data)
        if theirs is not None:
            others += 1
            if any(abs(theirs[name] - value) > 1e-9 for name, value in values.items()):
                sys.exit(f"canmatrix reads {theirs}, this script {values}")
        if number == "6D0":
            reports.append(values)
        else:
            reports[-1].update(values)
    return reports, others


def main():
    path, console = sys.argv[1], open(sys.argv[2]).read()
    reports, others = reports_on(console, path)
    sent = [
        {name: float(value) for name, value in (part.split("=") for part in line.split())}
        for line in re.findall(r"^health (.*?)\s*$", console, re.M)
    ]
    if not sent:
        sys.exit("the trial has sent nothing")
    if len(reports) != len(sent):
        sys.exit(f"{len(sent)} reports were sent, candump saw {len(reports)}")
    for report, expected in zip(reports, sent):
        if set(report) != set(expected):
            sys.exit(f"sent {sorted(expected)}, but the DBC file has {sorted(report)}")
        for name, value in expected.items():
            if abs(report[name] - value) > 1e-6:
                sys.exit(f"{name}: sent {value}, read {report[name]}")
    print(f"{len(sent)} reports read as sent; {others} frames by canmatrix too")


if __name__ == "__main__":
    main()

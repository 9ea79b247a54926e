# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The figures of one part, in a file that is written anew after each of them: a run that breaks off goes on from there."""

import json
import os
import time

from whole_file import write_whole_file

TOLD = ("commit", "note")  # of other ones a run goes on all the same: documents are committed, too


class Results:
    """`cases`: {case: [rounds]}, each round a dictionary of figures with its minute and load average."""

    def __init__(self, file, measured=None):
        """`measured` says of what the figures are (program, machine, way); what the file has of anything else is left
        out. Without it the file is only read."""
        self.file = file
        known = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
        self.measured = measured or known.get("measured", {})
        same = measured is None or essence(known.get("measured", {})) == essence(measured)
        self.cases = known.get("cases", {}) if same else {}
        self.left_out = known.get("left_out", {}) if measured is None else {}  # who measures tells it again

    def add(self, case, figures):
        """Takes a round's figures into the file."""
        stamp = {"at": time.strftime("%Y-%m-%d %H:%M", time.gmtime()), "load": round(os.getloadavg()[0], 1)}
        self.cases.setdefault(case, []).append(stamp | figures)
        self.left_out.pop(case, None)
        self._write()

    def leave_out(self, what, reason):
        self.left_out[what] = reason
        self._write()

    def rounds(self, case):
        return len(self.cases.get(case, ()))

    def _write(self):
        def lines(of):
            return ",\n".join(f"{text(key)}: {text(value)}" for key, value in of.items())

        cases = ",\n".join(f"{text(case)}: [\n" + ",\n".join(map(text, rounds)) + "\n]" for case, rounds in self.cases.items())
        write_whole_file(self.file, f'{{\n"measured": {{\n{lines(self.measured)}\n}},\n"left_out": {{\n{lines(self.left_out)}\n}},\n'
                                    f'"cases": {{\n{cases}\n}}\n}}\n')  # fmt: skip


def text(value):
    return json.dumps(value, ensure_ascii=False)


def essence(measured):
    return {key: value for key, value in measured.items() if key not in TOLD}

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Fuzz targets are run, those that break are told, and corpora stay small."""

import stat
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/research"))

from fuzzing.main import rows_of  # noqa: E402
from fuzzing.target import MOST_BYTES, MOST_FILES, Figures, Target, within_budget  # noqa: E402

SOUND = """#!/bin/sh
for last; do true; done
echo "#2 INITED cov: 17 ft: 20"
echo "#9 NEW cov: 21 ft: 30"
ls "$last" | grep -q seed && echo "stat::number_of_executed_units: 1234"
"""
BROKEN = """#!/bin/sh
echo "==1==ERROR: AddressSanitizer: heap-buffer-overflow"
exit 77
"""


class Targets(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def target(self, text):
        program = self.folder / "made_fuzz"
        program.write_text(text)
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        return Target(program, self.folder)

    def made(self, name, size, fill=b"a"):
        path = self.folder / name
        path.write_bytes(fill * size)
        return path

    def test_a_run_begins_with_the_seeds_and_tells_its_figures(self):
        figures = self.target(SOUND).run(3, [self.made("seed", 5)])
        self.assertEqual((figures.executions, figures.edges), (1234, 21))
        self.assertLess(0, figures.seconds)

    def test_one_that_breaks_has_no_figures_and_its_log_says_why(self):
        target = self.target(BROKEN)
        self.assertIsNone(target.run(3, []))
        self.assertIn("heap-buffer-overflow", target.log.read_text())

    def test_runs_add_up(self):
        both = Figures(10, 200, 7) + Figures(20, 100, 5)
        self.assertEqual(both, Figures(30, 300, 7))
        self.assertEqual([row[1] for row in rows_of({"made_fuzz": vars(both)})], [["0.01", "300", "7"], ["0.01", "300", ""]])

    def test_the_smallest_inputs_are_kept_as_long_as_there_is_room(self):
        files = [self.made(f"{n}", n + 1, bytes([n])) for n in range(2 * MOST_FILES)]
        self.assertEqual(within_budget(files[::-1], []), files[:MOST_FILES])
        self.assertEqual(within_budget(files, files[:3]), files[3:MOST_FILES])
        large = self.made("large", MOST_BYTES - 1, b"b")
        self.assertEqual(within_budget([large, self.made("small", 3, b"c")], []), [self.folder / "small"])

    def test_what_is_kept_already_is_not_kept_again(self):
        there, again = self.made("there", 9), self.made("again", 9)
        self.assertEqual(within_budget([again], [there]), [])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Conditions that decide are told from those that were only met."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/research"))

from coverage.conditions import conditions_of, counts_by  # noqa: E402

SOURCE = """
bool one_in_call(bool value) { return value; }
template <int N>
bool is_any(bool a, bool b) {
  return a || b;
}
int alone(int a) {
  return a > 3 ? 1 : 2;
}
bool nested(bool a, bool b, bool c) {
  return a && one_in_call(
      b || c);
}
int main(int argc, char**) {
  const bool yes = argc > 0, no = !yes;
  return is_any<1>(yes, no) + is_any<2>(no, yes) + is_any<2>(no, no) + alone(argc) +
         nested(yes, no, no) + nested(yes, yes, no) + nested(no, no, no) == 77;
}
"""


class Conditions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        scratch = Path(folder.name)
        (scratch / "made.cpp").write_text(SOURCE)

        def run(*words):
            return subprocess.run(words, cwd=scratch, check=True, capture_output=True, text=True).stdout

        run("clang++-19", "-std=c++20", "-w", "-fprofile-instr-generate", "-fcoverage-mapping", "-fcoverage-mcdc", "made.cpp", "-o", "made")
        subprocess.run("./made", cwd=scratch, env={"LLVM_PROFILE_FILE": "made.profraw"})
        run("llvm-profdata-19", "merge", "made.profraw", "-o", "made.profdata")
        export = run("llvm-cov-19", "export", "-skip-functions", "-skip-expansions", "-instr-profile=made.profdata", "made")
        self.conditions = [each for each in conditions_of(json.loads(export)) if each.line < 14]

    def test_each_is_covered_where_it_was_seen_to_decide(self):
        self.assertEqual(
            [(each.line, each.column, each.is_covered) for each in self.conditions],
            [
                (5, 10, False),  # true and false, but nothing shows it beside `b` in one of the two functions of the template
                (5, 15, True),
                (8, 10, False),  # never true
                (11, 10, True),
                (11, 15, True),
                (12, 7, True),
                (12, 12, False),  # never true
            ],
        )

    def test_they_are_counted_by_group(self):
        self.assertEqual(counts_by(self.conditions, lambda each: each.line > 9), {False: (1, 3), True: (3, 4)})


if __name__ == "__main__":
    if not all(map(shutil.which, ("clang++-19", "llvm-cov-19", "llvm-profdata-19"))):
        print("skipped: needs clang 19 and llvm 19 (./tools/setup --all)")
        sys.exit(0)
    unittest.main()

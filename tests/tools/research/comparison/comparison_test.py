# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What ./tools/compare says of two reports, of figures made up here. Runs in the distribution's Python, as the script does."""

import copy
import json
import subprocess
import sys
import tempfile
import unittest
from itertools import product
from pathlib import Path
from random import Random

REPOSITORY = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(REPOSITORY / "tools/research"))
try:
    import scipy  # noqa: F401
except ModuleNotFoundError as missing:
    print(f"skipped: Python's {missing.name} is missing (tools/setup --report installs it)")
    sys.exit(0)

from comparison.comparison import Compared, Refused, compare, text  # noqa: E402
from comparison.paired_tests import sign_flip_test, signed_rank_test  # noqa: E402


def report(frames, gain, method="terracut"):
    """Of `frames` frames in two sequences whose measures are moved by `gain`."""
    return {"methods": {method: {"frames": [
        {"sequence": f"0{i % 2}", "frame": str(i), "iou_g": 0.9 + 0.001 * i + gain * (1 + 0.01 * i),
         "recall_o": 0.95 if i else None, "iou_road": 0.4 - gain * (1 + 0.02 * i), "ms": 4 + 0.01 * i}
        for i in range(frames)]}}}  # fmt: skip


def compare_reports(before, after, method_before="terracut", method_after="terracut"):
    return compare(Compared(before, "A.json", method_before), Compared(after, "B.json", method_after))


class Comparison(unittest.TestCase):
    def test_says_what_got_better_and_what_got_worse(self):
        comparison = compare_reports(report(30, 0), report(30, 0.01))
        better = comparison.measures["iou_g"]
        self.assertEqual((comparison.frames, better.frames.greater), (30, 30))
        self.assertLess(better.frames.p, 1e-5)
        self.assertEqual(better.sequences.p, 0.5)  # two sequences cannot say more
        self.assertEqual(comparison.worse(0.05), ["iou_road"])

    def test_of_a_report_with_itself_finds_nothing(self):
        comparison = compare_reports(report(30, 0), report(30, 0))
        for change in comparison.measures.values():
            self.assertEqual(change.frames.p, 1)
            self.assertEqual(change.before, change.after)
        self.assertEqual(comparison.worse(0.05), [])

    def test_is_over_the_frames_both_have(self):
        comparison = compare_reports(report(10, 0), report(7, 0.01, "paper"), "terracut", "paper")
        self.assertEqual((comparison.frames, comparison.only_before, comparison.only_after), (7, 3, 0))
        self.assertEqual(comparison.measures["iou_g"].frames.pairs, 7)
        self.assertEqual(comparison.measures["recall_o"].frames.pairs, 6)  # one frame has no obstacle
        self.assertIn("7 in both, 3 only before, 0 only after", text(comparison, 0.05))

    def test_has_no_test_over_a_single_sequence(self):
        self.assertIsNone(compare_reports(report(1, 0), report(1, 0)).measures["iou_g"].sequences)

    def test_refuses_what_cannot_be_compared(self):
        with self.assertRaisesRegex(Refused, "A.json: there is no method 'zhang' in the report, only terracut"):
            compare_reports(report(3, 0), report(3, 0), "zhang")
        with self.assertRaisesRegex(Refused, "no frame in common"):
            compare_reports(report(3, 0), report(0, 0))

    def test_names_the_file_that_is_no_report_and_what_it_lacks(self):
        good = report(3, 0)
        no_frames, no_time, no_number = (copy.deepcopy(good) for _ in range(3))
        del no_frames["methods"]["terracut"]["frames"]
        del no_time["methods"]["terracut"]["frames"][1]["ms"]
        no_number["methods"]["terracut"]["frames"][1]["iou_g"] = "much"
        for bad, lacks in (
            ([], "it has no 'methods'"),
            ({}, "it has no 'methods'"),
            ({"methods": 1}, "it has no 'methods'"),
            (no_frames, "its method 'terracut' has no 'frames'"),
            (no_time, "one of its frames has no 'ms'"),
            (no_number, "one of its frames has no 'iou_g'"),
        ):
            with self.assertRaisesRegex(Refused, f"B.json: expected a report .*{lacks}"):
                compare_reports(good, bad)

    def test_says_what_it_judges_by_and_judges_no_times(self):
        slower = report(30, 0)
        for frame in slower["methods"]["terracut"]["frames"]:
            frame["ms"] += 1
        comparison = compare_reports(report(30, 0), slower)
        self.assertLess(comparison.measures["ms"].frames.p, 0.001)
        self.assertEqual(comparison.worse(0.05), [])
        self.assertIn("worse     nothing (by p (frames) below 0.05; ms is not judged)", text(comparison, 0.05))

    def test_shows_the_means_that_eval_prints_of_the_same_frames(self):
        before, after = report(10, 0), report(10, 0.01)
        before["methods"]["terracut"]["mean_over_sequences"] = {"all": {"iou_g": 0.953}, "road": {"iou_g": 0.5}}
        after["methods"]["terracut"]["mean_over_sequences"] = {"all": {"iou_g": 0.954}}
        comparison = compare_reports(before, after)
        of_iou = comparison.measures["iou_g"]
        self.assertEqual((of_iou.eval_before, of_iou.eval_after), (0.953, 0.954))
        self.assertEqual(comparison.measures["iou_road"].eval_before, 0.5)
        self.assertIsNone(comparison.measures["ms"].eval_before)
        self.assertIn("95.300   95.400", text(comparison, 0.05))
        self.assertIsNone(compare_reports(before, report(9, 0)).measures["iou_g"].eval_before)  # not the same frames


def differences_of(pairs, rank_sum):
    """Differences 1 to `pairs` in size, of which those below 0 have this sum."""
    below = set()
    for rank in range(pairs, 0, -1):
        if rank <= rank_sum:
            below.add(rank)
            rank_sum -= rank
    return [-rank if rank in below else rank for rank in range(1, pairs + 1)]


class SignedRankTest(unittest.TestCase):
    def test_is_exact_for_few_pairs(self):
        # All of n differences positive: only one of 2^n ways on either side is as extreme.
        self.assertAlmostEqual(signed_rank_test([1, 2, 3, 4, 5]).p, 2 / 32)
        self.assertAlmostEqual(signed_rank_test([-1, 2, 3, 4, 5]).p, 4 / 32)
        self.assertAlmostEqual(signed_rank_test([-1, 2]).p, 1)

    def test_gives_the_value_of_a_textbook(self):
        # Hollander & Wolfe, Hamilton depression scale, table 3.1: T+ = 5 of 9 pairs, one-sided 0.0195.
        differences = [-0.952, 0.147, -1.022, -0.43, -0.62, -0.59, -0.49, 0.08, -0.01]
        self.assertAlmostEqual(signed_rank_test(differences).p, 2 * 0.01953125)

    def test_agrees_with_counting_all_ways_to_give_the_ranks_signs(self):
        random = Random(7)
        for pairs in range(1, 12):
            differences = [random.gauss(0.3, 1) for _ in range(pairs)]
            ranks = {difference: rank for rank, difference in enumerate(sorted(differences, key=abs), start=1)}

            def sum_above(signs):
                return sum(ranks[difference] for difference, sign in zip(differences, signs) if sign > 0)

            sums = [sum_above(signs) for signs in product((-1, 1), repeat=pairs)]
            found = sum_above(differences)
            smaller = min(found, pairs * (pairs + 1) // 2 - found)
            expected = min(1, 2 * sum(way <= smaller for way in sums) / len(sums))
            self.assertAlmostEqual(signed_rank_test(differences).p, expected)

    def test_has_the_critical_values_of_tables(self):
        # Two-sided 5 %: the largest T of n pairs, as tables print them.
        for pairs, largest in ((6, 0), (7, 2), (8, 3), (9, 5), (10, 8), (12, 13), (15, 25), (20, 52), (25, 89)):
            self.assertLessEqual(signed_rank_test(differences_of(pairs, largest)).p, 0.05)
            self.assertGreater(signed_rank_test(differences_of(pairs, largest + 1)).p, 0.05)

    def test_leaves_zeros_out_and_shares_ranks_among_ties(self):
        with_zeros = signed_rank_test([0, 1, 0, 2, 3])
        self.assertEqual(with_zeros.p, signed_rank_test([1, 2, 3]).p)
        self.assertEqual((with_zeros.pairs, with_zeros.greater, with_zeros.less), (5, 3, 0))
        # Ties by the normal approximation: n = 4, mean 5, variance 7.5 - 60/48, T = 0.
        self.assertAlmostEqual(signed_rank_test([1, 1, 1, 1]).p, 0.07186, places=5)

    def test_agrees_with_itself_where_the_approximation_takes_over(self):
        differences = [-i if i % 3 == 0 else i for i in range(1, 26)]
        exact = signed_rank_test(differences).p
        self.assertAlmostEqual(signed_rank_test([*differences, 1e-9]).p, exact, delta=0.02)

    def test_finds_nothing_in_nothing(self):
        self.assertEqual(signed_rank_test([]).p, 1)
        self.assertEqual(signed_rank_test([0, 0]).p, 1)


class SignFlipTest(unittest.TestCase):
    def test_agrees_with_counting_all_ways(self):
        random = Random(8)
        for count in range(2, 12):
            differences = [random.gauss(0.3, 1) for _ in range(count)]
            sums = [abs(sum(sign * d for sign, d in zip(signs, differences))) for signs in product((-1, 1), repeat=count)]
            expected = sum(way >= abs(sum(differences)) - 1e-12 for way in sums) / len(sums)
            self.assertAlmostEqual(sign_flip_test(differences).p, expected)

    def test_counts_the_ways_to_as_large_a_mean(self):
        self.assertAlmostEqual(sign_flip_test([1, 2, 3]).p, 2 / 8)
        self.assertAlmostEqual(sign_flip_test([-1, 2, 3]).p, 4 / 8)
        self.assertAlmostEqual(sign_flip_test([-1, 2, 3]).mean, 4 / 3)
        self.assertAlmostEqual(sign_flip_test([1, -1]).p, 1)

    def test_of_many_draws_ways_at_random_and_always_the_same(self):
        many = [(-1) ** (i % 3 == 0) * (1 + 0.1 * i) for i in range(22)]
        self.assertEqual(sign_flip_test(many), sign_flip_test(many))
        self.assertLess(sign_flip_test([1.0] * 22).p, 1e-4)


class Script(unittest.TestCase):
    """./tools/compare"""

    def run_script(self, *arguments, python=()):
        command = [*python, str(REPOSITORY / "tools/compare"), *arguments]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.folder)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name, gain in (("before.json", 0), ("after.json", 0.01)):
            (self.folder / name).write_text(json.dumps(report(30, gain)))

    def test_ends_with_8_where_a_measure_got_worse_and_not_by_chance(self):
        self.assertEqual(self.run_script("before.json", "before.json").returncode, 0)
        worse = self.run_script("before.json", "after.json", "--json", "said.json")
        self.assertEqual(worse.returncode, 8, worse.stderr)
        self.assertIn("worse     iou_road", worse.stdout)
        said = json.loads((self.folder / "said.json").read_text())
        self.assertEqual(said["measures"]["iou_g"]["frames"]["greater"], 30)
        self.assertEqual(self.run_script("before.json", "after.json", "--significance", "1e-9").returncode, 0)

    def test_refuses_what_it_cannot_do_and_says_what_is_expected(self):
        for arguments, exit_code, said in (
            (("before.json", "none.json"), 3, "none.json"),
            (("before.json", "after.json", "--method", "zhang"), 3, "no method 'zhang'"),
            (("before.json", "after.json", "--significance", "2"), 2, "up to 1"),
            (("before.json", "after.json", "--json", "./after.json"), 2, "written over"),
            (("before.json", "after.json", "--json", "before.json/said.json"), 4, "before.json/said.json"),
        ):
            ran = self.run_script(*arguments)
            self.assertEqual(ran.returncode, exit_code, ran.stderr)
            self.assertIn(said, ran.stderr)

    def test_names_the_packages_that_are_missing(self):
        ran = self.run_script("before.json", "after.json", python=("/usr/bin/python3", "-S"))
        self.assertNotEqual(ran.returncode, 0)
        self.assertIn("apt-get install python3-scipy", ran.stderr)


if __name__ == "__main__":
    unittest.main()

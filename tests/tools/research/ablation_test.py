# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/ablation makes of reports, of figures made up here."""
import importlib.util
import sys
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

PATH = Path(__file__).resolve().parents[3] / "tools/ablation"
loader = SourceFileLoader("ablation", str(PATH))
tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("ablation", loader))
sys.modules["ablation"] = tool
loader.exec_module(tool)


def figures(value, **others):
    return {title: others.get(title, value) for title in tool.MEASURES}


def report(**times):
    """Of two frames: name=(ms, ms)."""
    return {"methods": {name: {"frames": [{"sequence": "00", "frame": str(i), "ms": ms} for i, ms in enumerate(of)]}
                        for name, of in times.items()}}  # fmt: skip


A = tool.Departure("a", "A", ("a=1",), ("a=2",))
B = tool.Departure("b", "B", ("b=1",))


class Ablation(unittest.TestCase):
    def test_a_departure_buys_what_is_lost_without_it_and_won_with_it(self):
        measured = {"terracut": figures(95), "paper": figures(90), "no_a": figures(94), "paper_a": figures(92)}
        self.assertEqual(tool.gains(A, measured)["IoU_g"], (1, 2))

    def test_one_that_cannot_stand_alone_is_not_added_to_the_paper(self):
        measured = {"terracut": figures(95), "paper": figures(90), "no_b": figures(96)}
        self.assertEqual(tool.gains(B, measured)["IoU_g"], (-1, None))
        self.assertNotIn("paper_b", [name for name, _, _ in tool.variants([A, B])])

    def test_a_measure_that_a_dataset_does_not_have_is_no_gain(self):
        measured = {"terracut": figures(95, worst=None), "no_b": figures(94, worst=None), "paper": figures(90)}
        self.assertEqual(tool.gains(B, measured)["worst"], (None, None))

    def test_one_that_buys_something_in_one_measure_on_one_mount_is_kept(self):
        same = {"terracut": figures(95), "paper": figures(90), "no_b": figures(95)}
        worse = {"terracut": figures(95), "paper": figures(90), "no_b": figures(95.5)}
        helped = {"terracut": figures(95), "paper": figures(90), "no_b": figures(95, Recall_o=94.9)}
        self.assertTrue(tool.buys_nothing(B, same, [same, worse]))
        self.assertFalse(tool.buys_nothing(B, same, [worse, helped]))

    def test_times_are_the_median_over_frames_of_the_best_of_each(self):
        rounds = [report(a=(3, 9)), report(a=(4, 5))]
        self.assertEqual(tool.best_times(rounds, "a"), 4)

    def test_every_setting_is_named_once(self):
        names = [departure.name for departure in tool.DEPARTURES]
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    unittest.main()

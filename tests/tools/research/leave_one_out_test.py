# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/leave_one_out chooses, of figures made up here."""
import importlib.util
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

PATH = Path(__file__).resolve().parents[3] / "tools/leave_one_out"
loader = SourceFileLoader("leave_one_out", str(PATH))
tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("leave_one_out", loader))
loader.exec_module(tool)


def setting(**sequences):
    """Figures of one setting: sequence=(IoU_g, Recall_o)."""
    return {name: {"all": {"iou_g": iou, "recall_o": recall}} for name, (iou, recall) in sequences.items()}


class LeaveOneOut(unittest.TestCase):
    def test_a_sequence_has_no_say_in_its_own_setting(self):
        measured = [setting(a=(0.99, 0.99), b=(0.5, 0.99), c=(0.5, 0.99)),
                    setting(a=(0.1, 0.99), b=(0.6, 0.99), c=(0.6, 0.99))]  # fmt: skip
        self.assertEqual(tool.leave_one_out(measured, "all", 0.98), {"a": 1, "b": 0, "c": 0})

    def test_a_setting_that_misses_obstacles_is_not_chosen(self):
        measured = [setting(a=(0.99, 0.97), b=(0.99, 0.97)), setting(a=(0.9, 0.985), b=(0.9, 0.985))]
        self.assertEqual(tool.best_setting(measured, ["a", "b"], "all", 0.98), 1)

    def test_where_all_miss_some_the_one_that_misses_least_is(self):
        measured = [setting(a=(0.99, 0.90)), setting(a=(0.9, 0.95)), setting(a=(0.95, 0.91))]
        self.assertEqual(tool.best_setting(measured, ["a"], "all", 0.98), 1)

    def test_a_sequence_without_key_obstacles_does_not_count_for_recall(self):
        measured = [setting(a=(0.9, None), b=(0.9, 0.99)), setting(a=(0.8, None), b=(0.8, 0.99))]
        self.assertEqual(tool.best_setting(measured, ["a", "b"], "all", 0.98), 0)


if __name__ == "__main__":
    unittest.main()

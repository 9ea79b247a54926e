# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/leave_one_out chooses, of figures made up here."""
import importlib.util
import tempfile
import unittest
from collections import Counter
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

    def test_frames_of_a_sequence_in_several_roots_are_taken_together(self):
        with tempfile.TemporaryDirectory() as folder:
            roots = [Path(folder) / name for name in ("one", "more")]
            for root, frame in zip(roots, ("000000", "000003")):
                for kind, ending in (("velodyne", "bin"), ("labels", "label")):
                    file = root / "sequences/01" / kind / f"{frame}.{ending}"
                    file.parent.mkdir(parents=True)
                    file.write_bytes(frame.encode())
                (root / "sequences/01/poses.txt").write_text(root.name)
            merged = tool.gather(roots, Path(folder) / "merged") / "sequences/01"
            self.assertEqual(sorted(file.name for file in merged.glob("velodyne/*")), ["000000.bin", "000003.bin"])
            self.assertEqual((merged / "labels/000003.label").read_bytes(), b"000003")
            self.assertEqual((merged / "poses.txt").read_text(), "one")

    def test_every_sequence_is_shown_under_its_own_setting(self):
        def measure(variants):
            def sequence(recall):
                scope = {"iou_g": 0.9, "f1": 0.95, "recall_o": recall}
                return {"all": scope, "all_vegetation_ignored": scope, "road": scope, "frame_recall_o": {"min": 0.8},
                        "tall": {"share": 0.0}, "flips": {"share": None, "true_share": None}}  # fmt: skip

            return {name: {place: sequence(0.5 if "key=2" in settings else 0.7) for place in ("00", "01")}
                    for name, (_, settings) in variants.items()}  # fmt: skip

        rows, stages = tool.tables(measure, [("key=1",), ("key=2",)], {"00": 1, "01": 0})
        self.assertEqual((rows["00"]["Recall_o"], rows["01"]["Recall_o"]), (0.5, 0.7))
        self.assertEqual(stages["00"]["+ MRF, Rec"], 0.5)

    def test_the_last_row_has_means_and_the_worst_frame_of_all(self):
        rows = {"a": {"IoU_g": 0.9, "worst frame": 0.8, "flips": None}, "b": {"IoU_g": 0.8, "worst frame": 0.9, "flips": None}}
        row = tool.last_row(list(rows["a"]), rows)
        self.assertAlmostEqual(row["IoU_g"], 0.85)
        self.assertEqual((row["worst frame"], row["flips"]), (0.8, None))

    def test_a_peer_is_scored_by_the_same_measures(self):
        counts = Counter({("ground", True): 6, ("ground", False): 2, ("ordinary", True): 1, ("key", True): 1, ("key", False): 3,
                          ("ignored", True): 100})  # fmt: skip
        self.assertEqual(tool.scores(counts), {"IoU_g": 0.6, "F1": 0.75, "Recall_o": 0.75})


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What ./tools/measures takes back, reads out of reports and prints, of figures made up here."""
import sys
import tempfile
import unittest
from array import array
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/research"))

from measures.columns import COLUMNS, Run, cells_of, layout, runs_of  # noqa: E402
from measures.measurement import Measured  # noqa: E402
from measures.rows import METHOD, STAGES, Row, chosen, parameters_of, rows_of  # noqa: E402
from measures.thinned_scans import ring_starts, thin_folder, thinned  # noqa: E402
from measures.worth import changes, losses, most_lost, worth_table  # noqa: E402
from tables import filled  # noqa: E402

PARAMETERS = """| key | unit | range | terracut | paper | what it is |
|---|---|---|---|---|---|
| `grid.min_band_m` | m | 0 .. 10 | 0.4 | 0 | Bands |
| `grid.max_band_m` | m | 0.5 .. no limit | 2 | no limit | Bands |
| `surface.far_slope` | m/m | 0 .. 2 | 0.06 |  | off at 0 |
| `surface.max_slope` | m/m | 0 .. 0.9 | 0.5 |  | no value is off |
| `seeds.window_rows` | steps | 1 .. 8 | 3 | 3 | Window |
| `region.bins_per_metre` | 1/m | 0.1 .. 100 |  | 10 | the paper's alone |
| `road.track_m` | m | 1 .. 100 | 12 | 12 | off |
| `min_cut.max_unknown` | cells | 0 .. 9 | 3 | 3 | a bound |
| `zhang.sectors` |  | 3 .. 2000 | 180 | 180 | of a baseline |
"""


def names_of(key):
    return [row.name for row in rows_of(parameters_of(PARAMETERS)) if row.keys == [key]]


class Rows(unittest.TestCase):
    def test_a_parameter_goes_back_to_where_its_rule_is_off(self):
        self.assertEqual(names_of("surface.far_slope"), ["surface.far_slope=0"])

    def test_without_that_it_goes_back_to_the_papers_value(self):
        self.assertEqual(names_of("grid.min_band_m"), ["grid.min_band_m=0"])
        self.assertEqual(names_of("grid.max_band_m"), ["grid.max_band_m=1e9"])

    def test_without_either_it_is_halved_and_doubled_within_its_range(self):
        self.assertEqual(names_of("surface.max_slope"), ["surface.max_slope=0.25", "surface.max_slope=0.9"])
        self.assertEqual(names_of("seeds.window_rows"), ["seeds.window_rows=1", "seeds.window_rows=6"])

    def test_what_the_method_does_not_read_and_what_bounds_time_has_no_row(self):
        keys = {key for row in rows_of(parameters_of(PARAMETERS)) for key in row.keys}
        self.assertEqual(keys, {"grid.min_band_m", "grid.max_band_m", "surface.far_slope", "surface.max_slope",
                                "seeds.window_rows"})  # fmt: skip

    def test_parts_are_chosen_by_parameter_by_row_or_as_new_settings(self):
        rows = rows_of(parameters_of(PARAMETERS))
        asked = ["surface.max_slope", "seeds.window_rows=1", "seeds.window_rows=5", "paper"]
        self.assertEqual([row.name for row in chosen(rows, asked)], [METHOD, "surface.max_slope=0.25", "surface.max_slope=0.9", "seeds.window_rows=1",
                                 "seeds.window_rows=5", "paper"])  # fmt: skip
        self.assertRaises(ValueError, chosen, rows, ["surface.min_slope"])


def sequence(iou):
    return {"all": {"iou_g": iou, "recall_o": None, "f1": 0.5}, "all_vegetation_ignored": {"iou_g": 0.25}}


class Reports(unittest.TestCase):
    def test_a_column_is_the_mean_over_scenes_of_their_means_over_seeds(self):
        measured = Measured()
        for street, hill in ((0.5, 0.9), (0.7, 0.9)):
            report = {"sequences": {"street": sequence(street), "hill": sequence(hill)}}
            measured.add(Run(("vlp16",), ()), {METHOD: report})
        results = measured.results()
        self.assertEqual(results["rows"][METHOD]["vlp16"], [75, None])
        self.assertEqual(results["cells"]["vlp16"]["street"], [[50, None], [70, None]])

    def test_mounts_are_cells_of_one_column(self):
        run = Run(("mounts_hdl64e",), (), "0.8 m")
        self.assertEqual(cells_of(run, "mounts_hdl64e", {"sequences": {"hill": sequence(0.5)}}), {"0.8 m hill": [50, None]})

    def test_hazards_are_counted_over_the_distances_of_their_column(self):
        def told(ground, from_m, found, unseen):
            return {"hazard": "lying_person", "ground": ground, "from_m": from_m, "trials": 10, "found": found,
                    "unseen": unseen}  # fmt: skip

        method = {"hazards": [told("road", 10, 0, 9), told("road", 20, 9, 1), told("grass", 20, 0, 9)]}
        self.assertEqual(cells_of(Run((), ()), "person_road", method), {"": [90, 10]})

    def test_every_column_is_measured_by_some_run(self):
        runs = runs_of(defaultdict(str))
        self.assertEqual({column for run in runs for column in run.columns}, {column.name for column in COLUMNS})

    def test_clouds_of_other_sensors_have_the_recorded_scans_classes(self):
        text = layout({"rings": 32})
        self.assertTrue(text.startswith('layout:\n  sequences: "*"\n'))
        self.assertIn("\n  rings: 32\n  rings_from: field\nclasses:\n  - {id: 0, ", text)


def results(**rows):
    """name=([scans], [vlp16], [person_road])"""
    return {"rows": {name: dict(zip(("scans", "vlp16", "person_road"), of)) for name, of in rows.items()}}


class Worth(unittest.TestCase):
    def setUp(self):
        self.rows = [Row(METHOD, "method"), Row("a=1", "half"), Row("a=2", "double"), Row("b=0", "off")]
        self.results = results(terracut=([95, 98], [90, 97], [99, 1]))
        of = self.results["rows"]
        of["a=1"] = {"scans": [94, 98], "vlp16": [90.02, 97.2], "person_road": [99, 0]}
        of["a=2"] = {"scans": [95, 98], "vlp16": [90, 97], "person_road": [99, 3]}
        of["b=0"] = {"scans": [90, 98], "vlp16": [90.5, 97], "person_road": [99, 1]}

    def test_more_without_a_return_is_a_loss(self):
        self.assertEqual(losses(self.results, "a=2", False), [(2, "none", "lying person, road, 20 to 40 m")])
        self.assertEqual(losses(self.results, "a=1", False), [])

    def test_a_parameter_counts_if_one_of_its_rows_loses_on_unseen_data(self):
        self.assertEqual(most_lost(self.results, self.rows),
                         {"b": (0, "", ""), "a": (2, "none", "lying person, road, 20 to 40 m")})  # fmt: skip

    def test_the_table_shows_what_changes_and_where_most_is_lost(self):
        lines = list(worth_table(self.results, self.rows, False))
        self.assertEqual(lines[2], "| method | 90.0 / 97.0 | 99.0 / 1.0 |  |")
        self.assertEqual(lines[3], "| `a=1` half | 0 / +0.2 | 0 / -1.0 | **nothing** |")
        self.assertEqual(lines[4], "| `a=2` double |  | 0 / +2.0 | 2.0 none, lying person, road, 20 to 40 m |")

    def test_a_figure_that_is_not_there_changes_nothing(self):
        self.assertEqual(changes([None, 1], [2, 2]), "0 / -1.0")


class Documents(unittest.TestCase):
    def test_blocks_are_replaced_where_they_stand(self):
        text = "a\n<!-- measures: x -->\nold\nold\n<!-- end of x -->\n| <!-- measures: y --><!-- end of y --> |"
        new = "a\n<!-- measures: x -->\n1\n2\n<!-- end of x -->\n| <!-- measures: y -->3<!-- end of y --> |"
        blocks = {"x": ["1", "2"], "y": ["3"]}
        self.assertEqual(filled(text, "measures", blocks), new)
        self.assertEqual(filled(new, "measures", blocks), new)


class ThinnedScans(unittest.TestCase):
    def setUp(self):
        """64 rings of four returns each, counter-clockwise from straight ahead; the ring is in z, the label, too."""
        self.points, self.labels = array("f"), array("I")
        for ring in range(64):
            for x, y in ((5, 0.1), (0, 5), (-5, 0), (5, -0.1)):
                self.points.extend((x, y, ring, 0.5))
                self.labels.append(ring)

    def test_rings_begin_straight_ahead(self):
        self.assertEqual(ring_starts(self.points[0::4], self.points[1::4]), list(range(0, 256, 4)))

    def test_one_row_in_four_is_kept_with_its_labels_and_numbered_anew(self):
        cloud, labels = thinned(self.points.tobytes(), self.labels.tobytes(), 4)
        header, _, data = cloud.partition(b"DATA binary\n")
        fields = array("f", data)
        self.assertIn(b"\nPOINTS 64\n", header)
        self.assertEqual(list(fields[2:20:5]), [2] * 4)
        self.assertEqual(list(fields[4::5]), [ring for ring in range(16) for _ in range(4)])
        self.assertEqual(list(array("I", labels)), [ring for ring in range(2, 64, 4) for _ in range(4)])

    def test_a_cloud_of_other_rings_is_refused(self):
        self.assertRaises(ValueError, thinned, self.points.tobytes()[: 4 * 4 * 8], self.labels.tobytes()[: 4 * 8], 2)

    def test_folders_are_laid_out_as_the_layout_says(self):
        with tempfile.TemporaryDirectory() as folder:
            root, sequence = Path(folder), Path(folder) / "sequences/00"
            for kind, ending, content in (("velodyne", "bin", self.points), ("labels", "label", self.labels)):
                (sequence / kind).mkdir(parents=True)
                (sequence / kind / f"000003.{ending}").write_bytes(content.tobytes())
            made = thin_folder(root, 2, root / "thin")
            self.assertTrue((made / "00/velodyne/000003.pcd").is_file())
            self.assertEqual((made / "00/labels/000003.label").stat().st_size, 4 * 128)


class Names(unittest.TestCase):
    def test_a_row_that_is_a_method_has_no_settings(self):
        self.assertEqual([Row(name, "").keys for name in (METHOD, *STAGES)], [[]] * 4)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The page of an evaluation: its numbers are the evaluation's, it is well formed, a browser shows it, and what cannot be
drawn is refused. Runs in the distribution's Python, as ./tools/report does."""

import copy
import functools
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(REPOSITORY / "tools/research"))
try:
    import jinja2  # noqa: F401
    import matplotlib  # noqa: F401
except ModuleNotFoundError as missing:
    print(f"skipped: Python's {missing.name} is missing (tools/setup --report installs it)")
    sys.exit(0)

from check_page import checked  # noqa: E402
from made_up_evaluation import evaluation, with_frames  # noqa: E402
from page.page import render  # noqa: E402
from page.paper import TABLES  # noqa: E402
from page.plots import MOST_STROKES, times  # noqa: E402

SECTIONS = ("average", "sequences", "measures", "range", "classes", "recall", "time", "comparison", "worst", "settings")


@functools.cache
def untouched_page():
    """That of the evaluation as it was made up."""
    with tempfile.TemporaryDirectory() as folder:
        return render(with_frames(evaluation(), Path(folder)), Path(folder))


class PageTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.evaluation = with_frames(evaluation(), self.folder)

    def page(self):
        return render(self.evaluation, self.folder)


class Page(PageTest):
    def test_shows_the_numbers_of_the_evaluation_and_is_well_formed(self):
        page = checked(untouched_page(), self.evaluation)
        self.assertEqual(page.faults, [])
        self.assertGreater(len(page.cells), 100)
        self.assertEqual((page.pictures, page.drawings), (6, 3))

    def test_has_every_section(self):
        ids = checked(untouched_page(), self.evaluation).ids
        self.assertEqual([name for name in SECTIONS if name not in ids], [])

    def test_has_a_checker_that_notices_wrong_numbers_and_markup(self):
        good = untouched_page()
        cell = 'data-path="/methods/pfaff/sequences/03/road/iou_g">'
        for wrong, right, fault in (
            (cell, cell + "1", "the page says 1"),
            (cell, ">", "pfaff/sequences/03/road/iou_g is not on the page"),
            ("</section>", "", "closes nothing"),
            ("data:image/png;base64,", "http://example.org/", "loads"),
            ('href="#average"', 'href="#elsewhere"', "which is not there"),
        ):
            self.assertIn(wrong, good)
            faults = checked(good.replace(wrong, right, 1), self.evaluation).faults
            self.assertTrue(any(fault in found for found in faults), fault)

    def test_sets_the_papers_numbers_beside_them(self):
        page = untouched_page()
        for number in ("48.58", "47.10", "1477.63"):  # Table III; IV; VI, of a method not measured here
            self.assertIn(f'<td class="paper">{number}</td>', page)
        self.assertIn('<td class="paper">43.78</td>', page)  # the paper's mean of 00 and 03

    def test_knows_the_maps_of_koblenz_by_their_folders(self):
        self.evaluation = evaluation("koblenz", ("KoblenzForestMap", "KoblenzFarmMap"))
        page = self.page()
        self.assertIn("Table VII", page)
        self.assertIn('<td class="paper">44.20</td>', page)  # the mean of Forest and Farm
        self.assertEqual(checked(page, self.evaluation).faults, [])

    def test_says_where_the_paper_has_nothing_to_compare_with(self):
        self.evaluation["dataset"] = "simulated"
        page = self.page()
        self.assertIn("The paper does not measure on simulated", page)
        self.assertEqual(checked(page, self.evaluation).faults, [])

    def test_shows_sequences_the_paper_does_not_have_beside_its_own(self):
        self.evaluation = evaluation(sequences=("00", "103"))  # ends like one of the paper's, and is none
        page = self.page()
        self.assertIn("<th>10</th><th>103</th>", page)
        self.assertNotIn('<td class="paper">43.78</td>', page)
        self.assertEqual(checked(page, self.evaluation).faults, [])

    def test_says_so_where_frames_were_not_kept(self):
        self.evaluation = evaluation("simulated")
        page = self.page()
        self.assertIn("The frames were not kept", page)
        self.assertNotIn("<img", page)
        self.assertEqual(checked(page, self.evaluation).faults, [])

    def test_names_frames_that_cannot_be_shown(self):
        for key in ("side_by_side", "worst"):
            self.evaluation[key] = [{"sequence": "03", "frame": "000001", "why": "middle", "fault": f"{key}: torn"}]
        page = self.page()
        for sentence in ("Not shown: side_by_side: torn", "Not shown: worst: torn"):
            self.assertIn(sentence, page)
        self.assertEqual(checked(page, self.evaluation).faults, [])

    def test_names_what_could_not_be_evaluated(self):
        self.evaluation.update(complete=False, faults=[{"where": "03", "what": "000001.bin has no label file"}])
        page = self.page()
        self.assertIn("Not complete", page)
        self.assertIn("03: 000001.bin has no label file", page)

    def test_has_a_dash_where_there_is_no_number(self):
        results = self.evaluation["methods"]["pfaff"]
        results["mean_over_sequences"]["all"]["recall_o"] = None
        results["sequences"]["03"]["frame_recall_o"] = dict.fromkeys(("min", "mean", "max"))
        results["frames"][0]["recall_o"] = None
        page = checked(self.page(), self.evaluation)
        self.assertEqual(page.faults, [])
        self.assertNotIn("/methods/pfaff/mean_over_sequences/all/recall_o", page.cells)

    def test_takes_names_for_text_and_not_for_markup(self):
        page = untouched_page()
        self.assertIn("/data/made &lt;up&gt;", page)
        self.assertIn("Ours &amp; the road", page)

    def test_shows_other_ground_only_of_methods_that_tell_it(self):
        page = checked(untouched_page(), self.evaluation)
        self.assertIn("/methods/terracut_road/by_class/0/share_as_other_ground", page.cells)
        self.assertNotIn("/methods/pfaff/by_class/0/share_as_other_ground", page.cells)


class Plots(PageTest):
    def test_have_a_title_a_legend_and_units(self):
        drawings = [drawing.split("</svg>")[0] for drawing in untouched_page().split("<svg ")[1:]]
        self.assertEqual(len(drawings), 3)
        methods = list(self.evaluation["methods"])
        for drawing, texts in zip(drawings, (
            ["of the worst, the mean and the best frame", "of frames [%]", ">sequence<", *methods],
            ["pfaff: time of every frame", "pfaff: how the times are distributed", "time [ms]", ">frames<", "median", "99 %"],
            ["terracut_road: time of every frame", "time [ms]", "frame, sequence after sequence", ">00<", ">03<"],
        )):  # fmt: skip
            for text in texts:
                self.assertIn(text, drawing)

    def test_tell_the_numbers_where_the_pointer_rests(self):
        page = untouched_page()
        self.assertIn("<title>pfaff, 00: 70.00 / 80.00 / 81.00 %</title>", page)

    def test_show_the_extremes_of_many_frames_in_few_strokes(self):
        few = self.evaluation["methods"]["pfaff"]
        many = copy.deepcopy(few)
        many["frames"] = [{"sequence": "00", "frame": f"{i:06}", "ms": 3 + i % 2} for i in range(40 * MOST_STROKES)]
        self.assertLess(len(times("pfaff", many, 0)), 100_000 + len(times("pfaff", few, 0)))

    def test_are_the_same_twice(self):
        self.assertEqual(self.page(), untouched_page())


class PaperTables(unittest.TestCase):
    def test_rows_have_the_means_that_are_printed_with_them(self):
        # A slip of the pen would show: the paper's means are the means of what it prints, as far as it rounds them.
        for dataset in TABLES["datasets"].values():
            self.assertEqual(len(dataset["sequences"]), len(dataset["scans"]))
            for measure in ("iou_g", "recall_o", "ms"):
                self.assertEqual(list(dataset[measure]["rows"]), ["zhang", "bogoslavskyi", "paper"])
                for row in dataset[measure]["rows"].values():
                    self.assertEqual(len(row["values"]), len(dataset["sequences"]))
                    rounding = 0.5 if row["mean"] > 1000 else 0.06 if measure == "ms" and row["mean"] < 40 else 0.011
                    mean = sum(row["values"]) / len(row["values"])
                    self.assertAlmostEqual(mean, row["mean"], delta=rounding)


class Script(PageTest):
    """./tools/report"""

    def run_script(self, *arguments, python=()):
        command = [*python, str(REPOSITORY / "tools/report"), str(self.folder), *arguments]
        return subprocess.run(command, capture_output=True, text=True, env={"PATH": "/usr/bin:/bin", "TERRACUT": "/nowhere/terracut"})

    def write(self, content):
        (self.folder / "evaluation.json").write_text(json.dumps(content))

    def test_draws_the_page_of_what_the_folder_has(self):
        self.write(self.evaluation)
        ran = self.run_script()
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual((self.folder / "index.html").read_text(), untouched_page())

    def test_refuses_what_is_no_report_and_leaves_the_page_as_it_was(self):
        (self.folder / "index.html").write_text("the page before")
        no_frames = copy.deepcopy(self.evaluation)
        no_frames["methods"]["pfaff"]["frames"] = []
        for content, said in ((None, "evaluation.json"), ([], "no 'methods'"), ({"methods": 1}, "no 'methods'"), (no_frames, "pfaff has none")):
            if content is not None:
                self.write(content)
            ran = self.run_script()
            self.assertEqual(ran.returncode, 3, content)
            self.assertRegex(ran.stderr, f"^error: .*{said}")
            self.assertEqual((self.folder / "index.html").read_text(), "the page before")

    def test_names_the_picture_that_is_missing(self):
        self.write(self.evaluation)
        (self.folder / "pictures/a.png").unlink()
        ran = self.run_script()
        self.assertEqual(ran.returncode, 3)
        self.assertRegex(ran.stderr, "^error: .*pictures/a.png: No such file")

    def test_says_what_a_report_of_another_version_lacks(self):
        for path in (("root",), ("methods", "pfaff", "sequences", "00", "frame_recall_o")):
            older = copy.deepcopy(self.evaluation)
            parent = functools.reduce(dict.__getitem__, path[:-1], older)
            del parent[path[-1]]
            self.write(older)
            ran = self.run_script()
            self.assertEqual(ran.returncode, 3, ran.stderr)
            self.assertRegex(ran.stderr, f"^error: .*evaluation.json: it lacks .*{path[-1]}.*; did another version")

    def test_names_a_page_that_cannot_be_written(self):
        self.write(self.evaluation)
        (self.folder / "index.html").mkdir()
        ran = self.run_script()
        self.assertEqual(ran.returncode, 4)
        self.assertIn("index.html", ran.stderr)
        self.assertFalse((self.folder / "index.html.part").exists())

    def test_names_the_program_that_is_not_there(self):
        self.write(self.evaluation)
        ran = self.run_script("semantickitti", "root")
        self.assertEqual(ran.returncode, 3)
        self.assertIn("/nowhere/terracut", ran.stderr)

    def test_names_the_packages_that_are_missing_before_any_work(self):
        ran = self.run_script("semantickitti", "root", python=("/usr/bin/python3", "-S"))
        self.assertNotEqual(ran.returncode, 0)
        self.assertIn("apt-get install python3-matplotlib python3-jinja2", ran.stderr)
        self.assertNotIn("/nowhere/terracut", ran.stderr)


BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
INSPECTION = """<script>
for (const img of document.images) if (img.naturalWidth < 1) console.error('broken picture: ' + img.alt);
if (document.documentElement.scrollWidth > window.innerWidth) console.error('wider than the window');
for (const text of document.querySelectorAll('svg text')) {
  const inner = text.getBoundingClientRect(), outer = text.closest('svg').getBoundingClientRect();
  if (inner.left < outer.left - 1 || inner.right > outer.right + 1 || inner.top < outer.top - 1 || inner.bottom > outer.bottom + 1)
    console.error('cut off: ' + text.textContent);
}
</script></body>"""


@unittest.skipUnless(BROWSER, "no chromium here (tools/setup --all installs it)")
class InABrowser(PageTest):
    def console_of(self, html):
        """What a browser says of the page."""
        (self.folder / "page.html").write_text(html)
        command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--enable-logging=stderr",
                   "--window-size=1280,2400", f"--user-data-dir={self.folder / 'profile'}",
                   f"--screenshot={self.folder / 'page.png'}", f"file://{self.folder / 'page.html'}"]  # fmt: skip
        ran = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return [line for line in ran.stderr.splitlines() if "CONSOLE" in line]

    def test_is_shown_without_complaint(self):
        good = untouched_page()
        self.assertEqual(self.console_of(good), [])
        # The page has no script; the same one with a script tells what a person would see.
        may_run = good.replace("default-src 'none'", "default-src 'none'; script-src 'unsafe-inline'", 1)
        self.assertEqual(self.console_of(may_run.replace("</body>", INSPECTION)), [])
        # And a complaint would be heard: the page itself lets no script run.
        self.assertNotEqual(self.console_of(good.replace("</body>", "<script>1</script></body>")), [])


if __name__ == "__main__":
    unittest.main()

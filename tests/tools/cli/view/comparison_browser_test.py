#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What the page in a real browser draws of the truth and of two sets of parameters.

comparison_browser_test.py PROGRAM DRIVE [FOLDER FOR PICTURES]
"""

import tempfile
from pathlib import Path

from drawn_page import DRIVE, DrawnPage, main, picture

COLOURS = {"missed": [255, 30, 30], "false": [255, 221, 0], "other alone": [255, 86, 70], "own alone": [70, 205, 255]}


def count(name, pixels):
    return int((pixels == COLOURS[name]).all(axis=-1).sum())


class AComparison(DrawnPage):
    def compared(self):
        """A run that is compared with the truth and with another set of parameters, at a frame; what stands above each picture."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        other = Path(folder.name) / "other.yaml"
        other.write_text("method:\n  profile: paper\n")
        served = self.served("view", DRIVE, "--truth", DRIVE.with_suffix(".truth"), "--beside", other, "--at", "127.0.0.1:0")
        self.browser.open(served.url)
        served.stand_at(0.5)
        self.browser.wait_for("document.querySelectorAll('.pane em').length === 4 && document.body.dataset.playing === 'false'")
        return self.browser.evaluate("[...document.querySelectorAll('.pane')].map(pane => pane.innerText)")

    def boxes_of_panes(self):
        return self.browser.evaluate(
            "[...document.querySelectorAll('.pane')].map(p => p.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom].map(Math.round))"
        )

    def test_truth_and_two_sets_of_parameters_are_seen_side_by_side(self):
        captions = self.compared()
        for caption, name in zip(captions, ("terracut", "other.yaml")):
            self.assertRegex(caption, name + r"\s+IoU_g 9\d\.\d\d %, Recall_o 9\d\.\d\d %\s+[\d,]+ missed\s+[\d,]+ false")
        self.browser.press("d" if self.pixels()[0, 0].sum() > 400 else "")
        self.browser.press("5")
        (_, _, edge, _), (begin, *_) = self.boxes_of_panes()
        self.assertLessEqual(abs(edge - begin), 1)
        pixels = self.pixels()
        picture(self.browser, "mistakes_side_by_side")
        own, other = pixels[:, :edge], pixels[:, edge:]
        self.assertGreater(count("false", own), 100)
        self.assertGreater(count("missed", other), 3 * count("missed", own))
        # Without ground and obstacles mistakes are left.
        for key in ("g", "o"):
            self.browser.press(key)
        self.assertEqual([count("missed", self.pixels()) > 100, int(self.shows(self.pixels(), "ground").sum())], [True, 0])
        for key in ("g", "o", "6"):
            self.browser.press(key)
        pixels = self.pixels()
        picture(self.browser, "differences")
        self.assertEqual(len(self.boxes_of_panes()), 1)
        for name in ("other alone", "own alone"):
            self.assertGreater(count(name, pixels), 100)
        self.browser.press("s")
        self.pixels()
        self.assertEqual(len(self.boxes_of_panes()), 2)
        self.browser.resize(390, 844, phone=True)
        self.pixels()
        picture(self.browser, "phone_side_by_side")
        (left, _, right, edge), (_, begin, *_) = self.boxes_of_panes()
        self.assertEqual([left, right], [0, 390])
        self.assertLessEqual(abs(edge - begin), 1)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The page in a real browser: what is drawn is what the truth says, how often, and that a browser which stops delays nothing.

browser_test.py PROGRAM DRIVE [FOLDER FOR PICTURES]
"""

import json
import re
import socket
import struct
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path

from drawn_page import DRIVE, PROGRAM, READ_PIXELS, TEXT_OF, DrawnPage, main, np, picture, pixels_of
from served import Served

HEADER_BYTES = 56
POINT = np and np.dtype([("xyz", "<f4", 3), ("intensity", "u1"), ("label", "u1"), ("row", "<u2"), ("time", "<f4"), ("above_ground", "<f4")])


def newest_frame(served):
    """(number, points) of the frame that stands."""
    with urllib.request.urlopen(served.url + "frames", timeout=20) as stream:
        number, count = struct.unpack_from("<II", header := stream.read(HEADER_BYTES), 8)
        assert struct.unpack_from("<H", header, 40)[0] == POINT.itemsize
        return number, np.frombuffer(stream.read(count * POINT.itemsize), POINT)


def two_digits(value):
    return f"{round(float(value), 2) + 0.0:.2f}"  # no -0.00


READ_RANGE_IMAGE = """(({width, height}, paint) => {
  return {width, height, pixels: TEXT_OF(paint.getImageData(0, 0, width, height).data)};
})(document.getElementById('range'), document.getElementById('range').getContext('2d'))""".replace("TEXT_OF", TEXT_OF)

# `asked` is what was found, as the page asked for it; their answers come once letGo() was called.
HELD_OBJECTS = """{
  window.asked = [];
  const isLetGo = new Promise(resolve => { window.letGo = resolve; });
  const fetchNow = window.fetch;
  window.fetch = (url, options) => {
    if (!String(url).startsWith('found/')) return fetchNow(url, options);
    asked.push(url);
    return isLetGo.then(() => fetchNow(url, options));
  };
}"""


class APage(DrawnPage):
    def places_on_screen(self, xy):
        """From above: where places on the ground are, by the distances that the page marks."""
        marks = self.browser.evaluate(
            "[...document.querySelectorAll('#distances span')].map(s => [s.textContent, s.style.transform])"
        )
        metres, screen = [], []
        for text, transform in marks:
            distance = float(text.split()[0])
            metres.append([distance * np.cos(0.6), -distance * np.sin(0.6)])
            left, top = (float(part) for part in re.findall(r"-?[\d.]+(?=px)", transform))
            screen.append([left - 4, top + 8])
        metres, screen = np.array(metres), np.array(screen)
        scale = (screen[-1, 0] - screen[0, 0]) / (metres[0, 1] - metres[-1, 1])
        x = screen[0, 0] - (xy[:, 1] - metres[0, 1]) * scale
        y = screen[0, 1] - (xy[:, 0] - metres[0, 0]) * scale
        return np.stack([x, y], axis=1), scale

    def test_pixels_have_the_colours_of_what_the_truth_says(self):
        served = self.served("view", DRIVE, "--at", "127.0.0.1:0")
        self.browser.open(served.url)
        served.stand_at(0.5)
        self.browser.wait_for("document.body.dataset.playing === 'false'")
        self.browser.press("t")
        number, points = newest_frame(served)
        self.browser.wait_for(f"document.getElementById('frame').dataset.number === '{number}'")
        picture(self.browser, "from_above")
        truths = [np.fromfile(file, np.uint32) & 0xFFFF for file in DRIVE.with_suffix(".truth").glob("*.label")]
        (truth,) = [labels for labels in truths if len(labels) == len(points)]
        is_ground = np.isin(truth, (40, 44, 48, 49, 60, 72))

        pixels = self.pixels()
        height, width, _ = pixels.shape
        places, scale = self.places_on_screen(points["xyz"][:, :2])
        self.assertGreater(scale, 2)
        at = np.floor(places).astype(int)
        inside = (at > 4).all(axis=1) & (at[:, 0] < width - 4) & (at[:, 1] < height - 4)
        counts = np.zeros((2, height, width), int)
        for kind in (0, 1):
            chosen = at[inside & (is_ground == bool(kind))]
            np.add.at(counts[kind], (chosen[:, 1], chosen[:, 0]), 1)
        near = np.zeros_like(counts)  # points may cover the pixels beside their own
        for dy in (-2, -1, 0, 1, 2):
            for dx in (-2, -1, 0, 1, 2):
                near += np.roll(counts, (dy, dx), (1, 2))
        for kind, name in ((1, "ground"), (0, "obstacle")):
            alone = (counts[kind] > 0) & (near[1 - kind] == 0)
            right = self.shows(pixels[alone], name)
            print(f"{name}: {right.mean():.1%} of {len(right)} pixels have the colour that the truth says")
            self.assertGreater(len(right), 500)
            self.assertGreater(right.mean(), 0.93)  # labels themselves are not all right

        alone = np.argwhere((counts.sum(axis=0) == 1) & (near.sum(axis=0) == 1))  # y, x
        self.values_of_a_click(number, points, at, [(x, y) for y, x in alone])
        self.address_that_leads_back(served, number)
        self.range_image(points)
        self.light_and_dark()
        self.picture_that_is_saved()

    def values(self):
        """What the page says of the return that was clicked, by name."""
        names_and_values = self.browser.evaluate("[...document.getElementById('values-rows').children].map(e => e.textContent.replaceAll('−', '-'))")
        return dict(zip(names_and_values[::2], names_and_values[1::2]))

    def values_of_a_click(self, number, points, at, places):
        """`at`: where each return is seen; `places`: where one is seen alone."""
        chosen = [np.flatnonzero((at == place).all(axis=1))[0] for place in (places[0], places[-1])]
        for press, index in zip((None, "m"), chosen):
            if press:
                self.browser.press(press)
            self.browser.click(*(at[index] + 0.5))
            self.assertEqual(self.browser.evaluate("document.getElementById('values-title').textContent"), f"return {index}, frame {number}")
            point, values = points[index], self.values()
            x, y, z = point["xyz"].astype(float)
            self.assertEqual(values["x, y, z"], ", ".join(map(two_digits, (x, y, z))) + " m")
            self.assertAlmostEqual(float(values["range"].split()[0]), np.hypot(np.hypot(x, y), z - 1.73), delta=0.02)
            self.assertEqual(values["above ground"], two_digits(point["above_ground"]) + " m")
            self.assertEqual([values["ring"], values["intensity"]], [str(point["row"]), str(point["intensity"])])
            self.assertEqual(values["label"], {40: "ground", 99: "obstacle"}[point["label"]])
        between = np.diff(points["xyz"][chosen].astype(float), axis=0)[0]
        self.assertEqual(values["distance"], two_digits(np.linalg.norm(between)) + " m")
        self.assertEqual(values["up"], two_digits(between[2]) + " m")
        picture(self.browser, "measured")
        self.browser.press("Escape")
        self.assertTrue(self.browser.evaluate("document.getElementById('values').hidden"))

    def address_that_leads_back(self, served, number):
        self.browser.press("+")
        self.browser.press("4")
        self.browser.wait_for(f"location.hash.startsWith('#frame={number}&view=top&camera=') && location.hash.endsWith('colour=ring')")
        scale = "document.getElementById('scale').firstElementChild.style.width"
        link, seen = self.browser.evaluate("[location.href, " + scale + "]")
        served.tell(playing=True, seek_s=0)
        self.browser.open("about:blank")
        self.browser.open(link)
        self.browser.wait_for(f"document.body.dataset.playing === 'false' && document.getElementById('frame').dataset.number === '{number}'")
        self.browser.wait_for(f"location.hash === '{link[link.index('#'):]}'")
        self.assertEqual(self.browser.evaluate(scale), seen)
        self.browser.press("1")

    def range_image(self, points):
        self.browser.press("i")
        self.browser.evaluate(READ_PIXELS)
        picture(self.browser, "range_image")
        image = pixels_of(self.browser.evaluate(READ_RANGE_IMAGE))
        rows, width, _ = image.shape
        self.assertEqual(rows, 64)
        x, y, _ = points["xyz"].T
        columns = np.minimum(((0.5 - np.arctan2(y, x) / (2 * np.pi)) * width).astype(int), width - 1)
        shown = image[63 - points["row"], columns]
        for label, kind in ((40, "ground"), (99, "obstacle")):
            self.assertGreater(self.shows(shown[points["label"] == label], kind).mean(), 0.9)
        self.browser.press("i")

    def light_and_dark(self):
        is_ground, paper = int(self.shows(self.pixels(), "ground").sum()), self.pixels()[0, 0]
        self.browser.press("d")
        other = self.pixels()
        self.assertGreater(abs(other[0, 0] - paper).sum(), 500)
        self.assertAlmostEqual(int(self.shows(other, "ground").sum()), is_ground, delta=0.1 * is_ground)

    def picture_that_is_saved(self):
        saved = self.browser.saved_by(lambda: self.browser.press("p"), "png")
        width, height = struct.unpack_from(">II", saved, 16)
        self.assertEqual([saved[:8], width, height], [b"\x89PNG\r\n\x1a\n", 1280, 720])

    def test_kinds_are_switched_off(self):
        served = self.served("view", DRIVE, "--at", "127.0.0.1:0")
        self.browser.open(served.url)
        served.stand_at(0.5)
        self.browser.wait_for("document.getElementById('frame').dataset.number")

        def count(stops):
            return int(self.shows(self.pixels(), stops).sum())

        ground, sand = count("ground"), self.stops_of("ground")
        self.assertGreater(ground, 3000)
        self.assertGreater(count("obstacle"), 1000)
        self.browser.evaluate("{ const size = document.getElementById('points-size'); size.value = 1; size.dispatchEvent(new Event('input')); }")
        self.assertGreater(count("ground"), 1.5 * ground)
        for _ in range(5):
            self.browser.press("[")
        self.assertAlmostEqual(count("ground"), ground, delta=0.2 * ground)
        self.browser.press("g")
        self.assertEqual(count("ground"), 0)
        self.assertGreater(count("obstacle"), 1000)
        self.browser.press("g")
        for key, name in (("2", "height"), ("3", "intensity"), ("4", "ring")):
            self.browser.press(key)
            self.assertLess(count(sand), 1000)
            picture(self.browser, f"by_{name}")

    def test_boxes_of_objects_are_drawn_where_there_are_any(self):
        served = self.served("view", DRIVE, "--objects", "--at", "127.0.0.1:0")
        self.browser.open(served.url)
        served.stand_at(0.5)
        self.browser.wait_for("!document.querySelector('[data-kind=box]').hidden")
        self.browser.wait_for("document.getElementById('frame').dataset.number")

        def drawn():
            return int(self.shows(self.pixels(), "box").sum())

        given_up = time.monotonic() + 60
        while drawn() < 500:
            self.assertLess(time.monotonic(), given_up)
        picture(self.browser, "boxes")
        self.object_of_a_click(served)
        self.browser.press("x")
        self.assertEqual(drawn(), 0)

    def object_of_a_click(self, served):
        """A return in the middle of the first object is of that object."""
        number, points = newest_frame(served)
        with urllib.request.urlopen(f"{served.url}found/{number}", timeout=20) as answer:
            boxes = json.load(answer)["boxes"]
        self.browser.press("t")
        self.browser.press("g")
        self.pixels()
        centres = np.array([np.mean(box["corners"], axis=0) for box in boxes])
        nearest = int(np.argmin(np.linalg.norm(centres, axis=1)))
        corners = np.array(boxes[nearest]["corners"])
        xyz = points["xyz"]
        (low_x, low_y), (high_x, high_y) = corners.min(axis=0), corners.max(axis=0)
        inside = (points["label"] == 99) & (xyz[:, 0] > low_x) & (xyz[:, 0] < high_x) & (xyz[:, 1] > low_y) & (xyz[:, 1] < high_y)
        places, _ = self.places_on_screen(xyz[inside][:, :2])
        self.browser.click(*np.median(places, axis=0))
        self.assertEqual(self.values()["object"], str(nearest + 1))
        self.browser.press("g")
        self.browser.press("b")

    def test_the_free_way_is_drawn_where_it_is_found(self):
        served = self.served("view", DRIVE, "--free-way", "--at", "127.0.0.1:0")
        self.browser.open(served.url)
        served.stand_at(0.5)
        self.browser.wait_for("!document.querySelector('[data-kind=way]').hidden")
        self.assertTrue(self.browser.evaluate("document.querySelector('[data-kind=box]').hidden"))
        self.browser.press("t")

        def drawn():
            return int(self.shows(self.pixels(), "way").sum())

        given_up = time.monotonic() + 60
        while drawn() < 200:
            self.assertLess(time.monotonic(), given_up)
        picture(self.browser, "free_way")
        self.browser.press("w")
        self.assertEqual(drawn(), 0)

    def test_boxes_follow_a_frame_that_came_while_others_were_awaited(self):
        served = self.served("view", DRIVE, "--objects", "--at", "127.0.0.1:0")
        served.stand_at(0.5)
        self.browser.call("Page.addScriptToEvaluateOnNewDocument", source=HELD_OBJECTS)
        self.browser.open(served.url)
        held = self.browser.wait_for("window.asked && asked.at(-1)")
        served.tell(step=True)
        shown = self.browser.wait_for(
            f"(number => 'found/' + number !== '{held}' && 'found/' + number)(document.getElementById('frame').dataset.number)"
        )
        self.browser.evaluate("void letGo()")
        self.browser.wait_for(f"asked.at(-1) === '{shown}'")

    def test_a_capture_is_played_stepped_and_sought(self):
        served = self.served("view", DRIVE, "--at", "127.0.0.1:0")
        self.browser.open(served.url)
        served.tell(playing=False, seek_s=0)
        at = "Number(document.getElementById('position').value)"
        self.browser.wait_for(f"document.body.dataset.playing === 'false' && {at} < 0.05")
        self.browser.press(" ")
        self.browser.wait_for(f"{at} > 0.05")
        served.stand_at(0.6)
        self.browser.wait_for(f"Math.abs({at} - 0.6) < 0.06")
        before = self.browser.evaluate(at)
        self.browser.press("ArrowRight")
        self.browser.wait_for(f"{at} > {before} + 0.05")
        ahead = self.browser.evaluate(at)
        self.assertAlmostEqual(ahead - before, 0.1, delta=0.03)
        self.browser.press("ArrowLeft")
        self.browser.wait_for(f"{at} < {ahead} - 0.05")
        self.assertAlmostEqual(self.browser.evaluate(at), before, delta=0.03)
        self.browser.press("Home")
        self.browser.wait_for(f"{at} < 0.05")
        for is_looped in (False, True):
            self.browser.press("l")
            self.browser.wait_for(f"document.getElementById('loop').ariaPressed === '{str(is_looped).lower()}'")
            self.assertEqual(served.figures()["capture"]["loop"], is_looped)
        self.assertAlmostEqual(served.figures()["capture"]["duration_s"], 1.3, delta=0.2)

    def test_it_fits_a_phone(self):
        served = self.served("view", DRIVE, "--at", "127.0.0.1:0")
        self.browser.resize(390, 844, phone=True)
        self.browser.open(served.url)
        self.browser.wait_for("document.getElementById('frame').dataset.number && document.getElementById('times-figures').textContent")
        served.stand_at(0.5)
        self.browser.wait_for("document.body.dataset.playing === 'false'")
        picture(self.browser, "phone")
        overlaps = self.browser.evaluate(
            """(() => {
              const boxes = [...document.querySelectorAll('.panel')].filter(p => !p.hidden).map(p => p.getBoundingClientRect());
              const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
              const out = boxes.filter(b => b.left < 0 || b.top < 0 || b.right > innerWidth || b.bottom > innerHeight).length;
              return out + boxes.flatMap((a, i) => boxes.slice(i + 1).filter(b => !apart(a, b))).length;
            })()"""
        )
        self.assertEqual(overlaps, 0)
        small = self.browser.evaluate(
            "[...document.querySelectorAll('.panel button')].filter(b => b.offsetParent && b.getBoundingClientRect().height < 28).length"
        )
        self.assertEqual(small, 0)
        height = "document.getElementById('scene').clientHeight"
        whole = self.browser.evaluate(height)
        self.browser.evaluate("document.getElementById('fold').click()")
        self.assertGreater(self.browser.evaluate(height), 1.5 * whole)
        self.assertTrue(self.browser.evaluate("getComputedStyle(document.getElementById('look')).display === 'none'"))
        picture(self.browser, "phone_folded")

    def be_the_sensor(self):
        """The address that it sends to."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            address = f"127.0.0.1:{probe.getsockname()[1]}"
        sensor = subprocess.Popen(
            [PROGRAM, "send", DRIVE, "--to", address, "--loop"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self.addCleanup(sensor.wait)
        self.addCleanup(sensor.kill)
        return address

    def live(self, address, *words):
        return Served(PROGRAM, "live", "--listen", address, "--calibration", DRIVE.with_suffix(".calibration.xml"), "--view", "127.0.0.1:0",
                      "--metrics", "off", "--no-lock-memory", *words)  # fmt: skip

    def coloured(self):
        """How many pixels show points, from above."""
        self.browser.press("t")
        pixels = self.pixels()
        return sum(int(self.shows(pixels, kind).sum()) for kind in ("ground", "obstacle"))

    def test_sectors_that_are_drawn_as_they_come_make_a_whole_turn(self):
        capture = self.served("view", DRIVE, "--at", "127.0.0.1:0")
        self.browser.open(capture.url)
        capture.stand_at(0.9)
        self.browser.wait_for("document.body.dataset.playing === 'false'")
        whole = self.coloured()
        served = self.live(self.be_the_sensor())
        try:
            self.browser.open(served.url)
            self.browser.wait_for("Number(document.getElementById('frame').dataset.number) > 25")
            # A busy machine's picture has gaps; one without says what is to be said. None has more than a turn.
            by_sectors, given_up = [0], time.monotonic() + 60
            while max(by_sectors) < 0.85 * whole and time.monotonic() < given_up:
                by_sectors.append(self.coloured())
            rate = self.browser.wait_for("document.getElementById('rate').textContent")
            picture(self.browser, "live_from_above")
        finally:
            self.assertIn(served.end(), (0, 6))
        print(f"live: {by_sectors[1:]} pixels show points, of a whole frame {whole}; {rate}")
        self.assertGreater(max(by_sectors), 0.85 * whole)
        self.assertLess(max(by_sectors), 1.15 * whole)

    def film_of_a_moment(self):
        self.browser.press("v")
        self.browser.wait_for("parseFloat(document.getElementById('film').textContent.split(',')[1]) >= 0.1")
        self.browser.press("v")

    def test_a_live_run_is_drawn_and_not_delayed_by_a_browser_that_stops(self):
        address = self.be_the_sensor()
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "live.json"
            served = self.live(address, "--json", report)
            try:
                self.browser.open(served.url)
                self.browser.wait_for("document.getElementById('frame').dataset.number")
                served.wait_until(lambda figures: figures["browsers"]["sent"] >= 60 * 87)  # sectors of 60 turns
                rate = self.browser.wait_for("document.getElementById('rate').textContent")
                returns = self.browser.evaluate("document.getElementById('frame').textContent")
                picture(self.browser, "live")
                film = self.browser.saved_by(self.film_of_a_moment, "webm")
                self.assertEqual(film[:4], b"\x1a\x45\xdf\xa3")  # EBML
                self.assertGreater(len(film), 10_000)
                drawn = served.figures()
                self.browser.stop()
                newest = drawn["frames"][-1]
                stopped = served.wait_until(lambda figures: newest not in figures["frames"][-40:])
                self.browser.go_on()
            finally:
                self.assertIn(served.end(), (0, 6))
            self.assertGreater(stopped["browsers"]["looking"], 0)
            summary = json.loads(report.read_text())
        print(f"live: {returns}, {rate} drawn in software")
        for name, figures in (("drawn", drawn), ("and stopped", stopped)):
            ms = sorted(ms for ms, _, _ in figures["frames"])
            print(f"  {name}: latency p50 {ms[len(ms) // 2]:.1f} ms, worst {ms[-1]:.1f} ms of {len(ms)} frames; {figures['browsers']}")
        self.assertTrue(rate)
        self.assertNotIn("view_frames_left_out", json.dumps(summary).replace('"view_frames_left_out": 0', ""))


if __name__ == "__main__":
    main()

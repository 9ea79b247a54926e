# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The page in a real browser, for tests of what it draws.

NAME_test.py PROGRAM DRIVE [FOLDER FOR PICTURES]
"""

import base64
import re
import sys
import unittest
from pathlib import Path

from browser import Browser, find_chromium
from served import Served

try:
    import numpy as np
except ImportError:
    np = None

PROGRAM, DRIVE = sys.argv[1], Path(sys.argv[2])
PICTURES = Path(sys.argv[3]) if len(sys.argv) > 3 else None


def picture(browser, name):
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
        browser.photograph(PICTURES / f"{name}.png")


TEXT_OF = """(pixels => {
  let text = '';
  for (let i = 0; i < pixels.length; i += 32768) text += String.fromCharCode(...pixels.subarray(i, i + 32768));
  return btoa(text);
})"""

# Read right after the page has drawn, in the same picture; the lowest line first.
READ_PIXELS = """new Promise(resolve => {
  dispatchEvent(new Event('resize'));
  requestAnimationFrame(() => {
    const gl = document.getElementById('scene').getContext('webgl2');
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    resolve({width, height, pixels: TEXT_OF(pixels)});
  });
})""".replace("TEXT_OF", TEXT_OF)


def pixels_of(read):
    flat = np.frombuffer(base64.b64decode(read["pixels"]), np.uint8)
    return flat.reshape(read["height"], read["width"], 4)[:, :, :3].astype(int)


class DrawnPage(unittest.TestCase):
    def setUp(self):
        self.browser = Browser()
        self.addCleanup(self.browser.close)

    def served(self, *words):
        served = Served(PROGRAM, *words)
        self.addCleanup(served.end)
        return served

    def pixels(self):
        return pixels_of(self.browser.evaluate(READ_PIXELS))[::-1]

    def stops_of(self, kind):
        """The colours that the legend shows, from one to the next."""
        text = self.browser.evaluate(f"getComputedStyle(document.querySelector('[data-kind={kind}] i')).backgroundImage")
        return np.array([[int(part) for part in found] for found in re.findall(r"rgb\((\d+), (\d+), (\d+)\)", text)], float)

    def shows(self, pixels, stops):
        """True where a pixel has one of these colours, or one between them; `stops`: or the kind that has them."""
        stops = self.stops_of(stops) if isinstance(stops, str) else stops
        found = np.zeros(pixels.shape[:-1], bool)
        for begin, way in zip(stops, np.diff(stops, axis=0)):
            along = np.clip((pixels - begin) @ way / max(way @ way, 1), 0, 1)
            found |= (np.abs(pixels - begin - along[..., None] * way) <= 2).all(axis=-1)
        return found


def main():
    if find_chromium() is None or np is None:
        print("skipped: needs chromium and numpy (./tools/setup --all)")
        sys.exit(0)
    unittest.main(argv=sys.argv[:1])

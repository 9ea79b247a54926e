# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""README's plot: every program on the drives that nothing was tuned on."""

import math
from html import escape

from .page import TIMED, TUNED, hazards_found, segmenters

FILE = "docs/images/peers.svg"
WIDTH, TOP, ROW, NAMES, GAP = 800, 64, 44, 124, 36  # pixels
STEPS = (1, 2, 5, 10, 20, 50, 100, 200, 500)
STYLE = """
  text { font: 12px system-ui, -apple-system, "Segoe UI", Helvetica, Arial, sans-serif; fill: #4b5563 }
  .paper { fill: #ffffff } .grid { stroke: #e5e7eb } .range { stroke: #9ca3af; stroke-width: 3 } .dot, .bar { fill: #6b7280 }
  .name, .title { fill: #111827 } .title { font-weight: 600 } .ours .range { stroke: #7dbdf0 }
  .ours .dot, .ours .bar { fill: #0b6fc2 } .ours .name { font-weight: 700 } .end { text-anchor: end } .middle { text-anchor: middle }
  @media (prefers-color-scheme: dark) {
    text { fill: #9aa4b2 } .paper { fill: #0d1117 } .grid { stroke: #272e38 } .range { stroke: #5b6675 } .dot, .bar { fill: #9aa4b2 }
    .name, .title { fill: #e6edf3 } .ours .range { stroke: #1f5f99 } .ours .dot, .ours .bar { fill: #58a6ff }
  }
"""  # fmt: skip


class Axis:
    """A panel's scale from `least` to `most`, or to the lines next to them."""

    def __init__(self, title, left, width, least, most):
        self.title, self.left, self.width = title, left, width
        self.step = next(step for step in STEPS if most - least <= 5 * step)
        self.most = self.step * math.ceil(most / self.step)
        self.least = min(self.step * math.floor(least / self.step), self.most - self.step)

    def x(self, value):
        return round(self.left + self.width * (value - self.least) / (self.most - self.least), 1)

    def drawn(self, bottom):
        yield f'<text class="title" x="{self.left}" y="20">{self.title}</text>'
        for value in range(self.least, self.most + 1, self.step):
            yield f'<path class="grid" d="M{self.x(value)} {TOP - 18}V{bottom}"/>'
            yield f'<text class="middle" x="{self.x(value)}" y="{TOP - 24}">{value}</text>'


def share(axis, of_drives, y):
    """A dot for each drive; the worst is named."""
    worst = min(of_drives, key=of_drives.get)
    yield f'<path class="range" d="M{axis.x(of_drives[worst])} {y}H{axis.x(max(of_drives.values()))}"/>'
    for drive, value in of_drives.items():
        yield f'<circle class="dot" cx="{axis.x(value)}" cy="{y}" r="4.5"><title>{drive}: {value:.1f}</title></circle>'
    yield f'<text class="middle" x="{axis.x(of_drives[worst])}" y="{y + 18}">{of_drives[worst]:.1f} {worst}</text>'


def bar(axis, value, y):
    end = axis.x(value)
    yield f'<rect class="bar" x="{axis.left}" y="{y - 6}" width="{end - axis.left:.1f}" height="12"/>'
    yield f'<text class="end" x="{end}" y="{y + 18}">{value:.1f}</text>'


def plot(results):
    """Returns the SVG, empty without measures: for every program IoU_g and Recall_o on each drive, the hazards that it finds, if
    that was measured, and the time of a frame."""
    cases = {name: rounds[-1] for name, rounds in results["peers"].cases.items() if name != TUNED}
    if TIMED not in cases:
        return ""
    programs = segmenters(cases)

    def of_drives(measure):
        return {program: {drive: 100 * told[key]["quality"][measure] for drive, told in cases.items()
                          if key in told and told[key]["quality"][measure] is not None}
                for program, key in programs.items()}  # fmt: skip

    found = {program: 100 * share for program, share in hazards_found(results).items()}
    times = {program: cases[TIMED][key]["ms"][0] for program, key in programs.items() if key in cases[TIMED]}
    panels = [("IoU_g, %", share, of_drives(0)), ("Recall_o, %", share, of_drives(1)),
              *([("hazards found, %", bar, found)] if found else []), (f"ms a frame, {TIMED}", bar, times)]  # fmt: skip
    bottom, width = TOP + ROW * len(programs), (WIDTH - NAMES - len(panels) * GAP) // len(panels)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {bottom + 28}" role="img">',
             "<!-- SPDX-License-Identifier: Apache-2.0; Copyright 2026 The terracut authors; by ./tools/benchmark -->",
             f"<style>{STYLE}</style>", '<rect class="paper" width="100%" height="100%"/>']  # fmt: skip
    axes = []
    for number, (title, drawn, of) in enumerate(panels):
        least = min(min(drives.values()) for drives in of.values() if drives) if drawn is share else 0
        most = max(of.values()) if of is times else 100
        axes.append(Axis(title, NAMES + number * (width + GAP), width, least, most))
        lines += axes[-1].drawn(bottom)
    for number, program in enumerate(programs):
        y = TOP + ROW * number + 10
        lines += [f'<g class="{"ours" if number == 0 else "theirs"}">', f'<text class="name" x="8" y="{y + 4}">{escape(program)}</text>']
        for axis, (_, drawn, of) in zip(axes, panels):
            lines += drawn(axis, of[program], y) if of.get(program) else []
        lines.append("</g>")
    lines += [f'<text x="8" y="{bottom + 14}">A dot is a simulated drive ({", ".join(cases)}) that nothing was tuned on; the worst is named.</text>',
              "</svg>", ""]  # fmt: skip
    return "\n".join(lines)

# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The plots of the page, as inline SVG elements."""

import io
import math
import re
from itertools import groupby

import numpy
from markupsafe import Markup, escape
from matplotlib import rc_context
from matplotlib.figure import Figure

# Colours that are distinguishable with red-green colour blindness (Okabe, Ito).
METHOD_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#444444", "#882255"]
STYLE = {
    "svg.fonttype": "none",  # text is kept as text
    "font.size": 9,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#6b7480",
    "axes.grid": True,
    "axes.grid.axis": "y",
    "axes.axisbelow": True,
    "grid.color": "#d9dee5",
    "legend.frameon": False,
}
WIDTH = 12.8  # inches: the width of the page
MOST_STROKES = 600
LEGEND_LETTERS = 160  # number of letters that fit side by side
RECALL = r"Recall$_\mathrm{o}$"


def colour_of_method(place):
    return METHOD_COLOURS[place % len(METHOD_COLOURS)]


class Plot:
    """A figure in the page's style. A browser shows an artist's tip when the pointer rests on the
    artist."""

    def __init__(self, name, height, alternative, below=0.45):
        """Heights are in inches; `below` is left free under the axes."""
        self.name = name
        self.alternative = alternative
        self.tips = {}
        self.figure = Figure(figsize=(WIDTH, height))
        # Fixed margins, so that the axes of stacked plots are aligned.
        self.figure.subplots_adjust(left=0.055, right=0.995, top=1 - 0.3 / height, bottom=below / height, wspace=0.12)

    def tip(self, artist, text):
        key = f"tip-{self.name}-{len(self.tips)}"
        artist.set_gid(key)
        self.tips[key] = text

    def svg(self):
        file = io.StringIO()
        no_metadata = dict.fromkeys(["Creator", "Date", "Format", "Type"])
        with rc_context({**STYLE, "svg.hashsalt": self.name}):
            self.figure.savefig(file, format="svg", metadata=no_metadata)
        text = file.getvalue()
        text = text[text.index("<svg") :]
        # Removes numbered ids, which would repeat in each plot; ids that are referenced are hashes
        # of this plot's name.
        text = re.sub(r' id="[\w.]+_\d+"', "", text)
        for key, tip in self.tips.items():
            text = text.replace(f'<g id="{key}">', f'<g id="{key}"><title>{escape(tip)}</title>')
        return Markup(text.replace("<svg ", f'<svg role="img" aria-label="{escape(self.alternative)}" ', 1))


def recalls(evaluation):
    """Plots the worst, the mean and the best frame of every sequence, by method."""
    methods = evaluation["methods"]
    sequences = list(next(iter(methods.values()))["sequences"])
    step = min(0.8 / len(methods), 0.12)
    columns = max(1, int(LEGEND_LETTERS / (6 + max(map(len, methods)))))
    below = 0.55 + 0.2 * math.ceil(len(methods) / columns)
    plot = Plot("recalls", 2.95 + below, "Recall_o of the worst, the mean and the best frame of every sequence", below)
    with rc_context(STYLE):
        axes = plot.figure.add_subplot()
        for place, (method, results) in enumerate(methods.items()):
            colour = colour_of_method(place)
            offset = (place - (len(methods) - 1) / 2) * step
            axes.plot([], [], "-o", color=colour, label=method)
            for x, sequence in enumerate(sequences):
                spread = results["sequences"][sequence]["frame_recall_o"]
                if spread["mean"] is None:
                    continue
                low, mean, high = (100 * spread[which] for which in ("min", "mean", "max"))
                axes.vlines(x + offset, low, high, color=colour, linewidth=2.5)
                (dot,) = axes.plot(x + offset, mean, "o", color=colour, markersize=6, clip_on=False)
                plot.tip(dot, f"{method}, {sequence}: {low:.2f} / {mean:.2f} / {high:.2f} %")
        axes.set_xticks(range(len(sequences)), sequences)
        axes.set_xlim(-0.5, len(sequences) - 0.5)
        axes.set_ylim(top=100)
        axes.set_xlabel("sequence")
        axes.set_ylabel(f"{RECALL} of frames [%]")
        axes.set_title(f"{RECALL} of the worst, the mean and the best frame of every sequence")
        axes.legend(loc="upper left", bbox_to_anchor=(0, -0.17), ncol=columns)
    return plot.svg()


def times(method, results, place):
    """Plots the time of every frame, and the distribution of the times."""
    frames = results["frames"]
    values = numpy.array([frame["ms"] for frame in frames])
    colour = colour_of_method(place)
    plot = Plot(f"times-{method}", 2.6, f"Time of every frame, and how the times are distributed: {method}")
    with rc_context(STYLE):
        series, histogram = plot.figure.subplots(1, 2, gridspec_kw={"width_ratios": [2, 1]})
        # If there is no room for every frame, neighbours share a stroke from their least to their
        # greatest time.
        strokes = numpy.array_split(numpy.arange(len(values)), min(MOST_STROKES, len(values)))
        middles = [stroke.mean() for stroke in strokes]
        lows, highs = ([pick(values[stroke]) for stroke in strokes] for pick in (numpy.min, numpy.max))
        few = len(values) < MOST_STROKES
        series.plot(middles, highs, "o" if few else "-", color=colour, markersize=3, linewidth=0.8, label="a frame" if few else "frames")
        if not few:
            series.fill_between(middles, lows, highs, color=colour, linewidth=0.8)
        summary = results["ms"]["segment"]
        series.axhline(summary["p50"], color="#1d2733", linewidth=1, label=f"median, {summary['p50']:.2f} ms")
        series.axhline(summary["p99"], color="#1d2733", linewidth=1, linestyle="--", label=f"99 %, {summary['p99']:.2f} ms")
        name_sequences(series, [frame["sequence"] for frame in frames])
        series.set_ylim(0, 1.25 * values.max() or 1)
        series.set_ylabel("time [ms]")
        series.set_title(f"{method}: time of every frame")
        series.legend(loc="upper right", ncol=3)
        histogram.hist(values, bins=40, range=(0, values.max() or 1), color=colour)
        histogram.set_xlabel("time [ms]")
        histogram.set_ylabel("frames")
        histogram.set_title(f"{method}: how the times are distributed")
        histogram.yaxis.get_major_locator().set_params(integer=True)
    return plot.svg()


def name_sequences(axes, sequences):
    """Marks the sequences of the frames along the x axis."""
    start, middles, names = 0, [], []
    for name, group in groupby(sequences):
        count = len(list(group))
        if start:
            axes.axvline(start - 0.5, color="#d9dee5", linewidth=1, zorder=0.5)  # behind what is plotted
        if count >= 0.03 * len(sequences):  # its name is drawn only if there is room
            middles.append(start + (count - 1) / 2)
            names.append(name)
        start += count
    axes.set_xticks(middles, names)
    axes.set_xlim(-0.5, len(sequences) - 0.5)
    axes.set_xlabel("frame, sequence after sequence")

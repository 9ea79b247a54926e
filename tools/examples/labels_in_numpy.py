#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Labels a capture with numpy in cells, as in a notebook (docs/guide/python.md).

labels_in_numpy.py CAPTURE [PICTURE.png]: the picture needs matplotlib.
"""

# %% Every frame of a capture, labelled. The arrays are views of the frame's memory; nothing is
# copied.
import sys
from pathlib import Path

import numpy as np
import terracut

capture = Path(sys.argv[1])
replay = terracut.replay(capture)
print(replay.sensor)
for frame in replay:
    obstacles = frame.labels == terracut.OBSTACLE
    distance_m = np.hypot(frame.points[:, 0], frame.points[:, 1])
    ahead = obstacles & (np.abs(frame.points[:, 1]) < 1.5) & (frame.points[:, 0] > 3)
    nearest_m = distance_m[ahead].min(initial=np.inf)
    print(f"frame {frame.number}: {len(frame)} returns, {obstacles.mean():.1%} obstacle, nearest ahead {nearest_m:.1f} m")

# %% The run's report, as of `terracut replay --json`.
summary = replay.report()["summary"]
print(f"{summary['frames']} frames, p99 of all work {summary['ms']['total']['p99']:.1f} ms, losses {summary['losses']}")

# %% The same points as a cloud from any source: with the laser of each point, in the sensor's
# frame.
height_m = summary["mount"]["height_m"]
cloud = frame.points - np.float32([0, 0, height_m])
segmenter = terracut.Segmenter(mount_height=height_m)
labels = segmenter(cloud, laser=frame.ring)
print(f"as a cloud: {np.mean(labels == frame.labels):.2%} of the labels are the same")

# %% The points seen from above.
if len(sys.argv) > 2:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    for label, name, colour in ((terracut.GROUND, "ground", "#b9b49a"), (terracut.OBSTACLE, "obstacle", "#d9772b")):
        x, y, _ = frame.points[frame.labels == label].T
        axes.scatter(x, y, s=0.3, c=colour, label=name, linewidths=0)
    axes.set(xlim=(-30, 60), ylim=(-25, 25), aspect="equal", xlabel="ahead, m", ylabel="left, m")
    axes.legend(markerscale=15, loc="upper right")
    axes.set_title(f"frame {frame.number} of {capture.name}")
    figure.savefig(sys.argv[2], dpi=110)

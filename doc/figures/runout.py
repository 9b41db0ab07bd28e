# SPDX-License-Identifier: LGPL-2.1-or-later
"""Front position and number of points over time, for one or more landslides.

    python3 runout.py PICTURE.png FOLDER[=LABEL] ...
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

COLORS = [SPLIT, UNSPLIT, "#3a8f5c", "#8a5aa8"]
DASHES = ["-", "-", "--", ":"]


def draw(figure_axes, folder, label, style):
    table = statistics(folder)
    time = table["time [s]"]
    front, speed, points = figure_axes
    front.plot(time, table["front x [m]"], label=label, **style)
    speed.plot(time, table["centre velocity x [m/s]"], **style)
    points.plot(time, table["points"] / 1000, **style)


name, cases = sys.argv[1], [a.partition("=") for a in sys.argv[2:]]
figure, axes = plt.subplots(1, 3, figsize=(7.8, 2.6), constrained_layout=True)
for (folder, _, label), color, dash in zip(cases, COLORS, DASHES):
    draw(axes, folder, label, {"color": color, "linestyle": dash})

titles = ["front: largest x of a point [m]", "velocity of the centre of mass "
          "[m/s]", "points [thousands]"]
for a, title in zip(axes, titles):
    a.set_title(title)
    a.set_xlabel("time [s]")
    a.set_xlim(left=0)
    a.grid(linewidth=0.3)
for a in axes[1:]:
    a.set_ylim(bottom=0)
if len(cases) > 1 or cases[0][2]:
    axes[0].legend(loc="lower right")
save(figure, name)

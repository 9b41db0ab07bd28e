# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of a slab failure: where the strength is lost, at several times, and
the length of the shear band.

    /usr/bin/python3 slab_failure.py PICTURE.png FOLDER

FOLDER holds the output of prm/slab-failure.prm.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

WIDTH, PANEL, STEP, GRAPH = 7.8, 0.72, 0.98, 1.5  # inches
LEFT, RIGHT, BOTTOM = 0.55, 0.95, 0.45
WINDOW = (-175, 275, 0, 12)
SHOWN = [8, 10, 14, 24, 40, 60]
ZONE, CRITICAL = 60., 47.9  # length of the zone, critical length, m


def place(figure, bottom, height):
    """Axes over the width of the picture, inches from its lower edge."""
    width, total = figure.get_size_inches()
    return figure.add_axes([LEFT / width, bottom / total,
                            (width - LEFT - RIGHT) / width, height / total])


def draw_bands(axes, folder):
    """Length of the yielded layer, the zone included, over time."""
    with open(os.path.join(folder, "bands.csv"), newline="") as stream:
        header, *rows = list(csv.reader(stream))
    table = dict(zip(header, numpy.array(rows, float).T))
    for kind, color in (("yielded", SPLIT), ("residual", UNSPLIT)):
        length = sum(table["%s length of %s [m]" % (kind, body)]
                     for body in ("up", "down"))
        axes.plot(table["time [s]"], ZONE + length, color=color,
                  label="%s, with the zone" % kind)
    axes.axhline(CRITICAL, color=EXACT, ls="--", label="critical length")
    axes.set_xlim(0, 20)
    axes.set_ylim(0, 340)
    axes.set_ylabel("band [m]")
    axes.set_xlabel("time [s]")
    axes.legend(loc="upper left", ncol=3)


name, folder = sys.argv[1:3]
reader, times = open_points(folder)
graph = BOTTOM + GRAPH + 0.62
figure = plt.figure(figsize=(WIDTH, graph + len(SHOWN) * STEP))
size = [int((WIDTH - LEFT - RIGHT) * 260), int(PANEL * 260)]
exaggeration = size[1] * (WINDOW[1] - WINDOW[0]) / size[0] / WINDOW[3]
for i, wanted in enumerate(SHOWN):
    time = nearest(times, wanted)
    axes = place(figure, graph + (len(SHOWN) - 1 - i) * STEP, PANEL)
    show(axes, render(reader, time, "softening", (0, 1), WINDOW, size), WINDOW)
    axes.set_title("t = %.0f s" % time, pad=2)
    axes.set_ylabel("y [m]")
    axes.set_yticks([0, 6, 12])
    axes.tick_params(labelbottom=i + 1 == len(SHOWN))
axes.set_xlabel("x along the slope [m]; heights are drawn %.1f times too large"
                % exaggeration)
scale = plt.cm.ScalarMappable(plt.Normalize(0, 1), "viridis")
height = figure.get_size_inches()[1]
figure.colorbar(
    scale, label="displacement over softening displacement",
    cax=figure.add_axes([1 - (RIGHT - 0.2) / WIDTH, graph / height, 0.1 / WIDTH,
                         ((len(SHOWN) - 1) * STEP + PANEL) / height]))
draw_bands(place(figure, BOTTOM, GRAPH), folder)
save(figure, name)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The points near the toe without and with splitting, over the background grid.

    /usr/bin/python3 toe.py PICTURE.png UNSPLIT SPLIT [TIME ...]
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

WIDTH, PANEL, STEP = 7.8, 0.8, 1.2  # inches
LEFT, RIGHT, BOTTOM = 0.55, 0.95, 0.5
LENGTH, HEIGHT = 46, 2.8  # m, of the window

name, folders = sys.argv[1], sys.argv[2:4]
labels = ["without splitting", "with splitting"]
tables = [statistics(folder) for folder in folders]
series = [open_points(folder) for folder in folders]
wanted = [float(t) for t in sys.argv[4:]] or [20, series[0][1][-1]]
cell = float(parameter(folders[0], "Cell size"))
speeds = (0, 6)

n_rows = 2 * len(wanted)
figure = plt.figure(figsize=(WIDTH, BOTTOM + (n_rows - 1) * STEP + PANEL + 0.25))
height = figure.get_size_inches()[1]
size = [int((WIDTH - LEFT - RIGHT) * 260), int(PANEL * 260)]
exaggeration = size[1] * LENGTH / size[0] / HEIGHT

row = 0
for wish in wanted:
    # Both in the same window, which ends ahead of the further front.
    front = max(t["front x [m]"][numpy.argmin(abs(t["time [s]"] - wish))]
                for t in tables)
    right = 2 * numpy.ceil((front + 1) / 2)
    window = (right - LENGTH, right, 0, HEIGHT)
    for label, table, (reader, times) in zip(labels, tables, series):
        time = nearest(times, wish)
        at = numpy.argmin(abs(table["time [s]"] - time))
        axes = figure.add_axes([LEFT / WIDTH,
                                (BOTTOM + (n_rows - 1 - row) * STEP) / height,
                                (WIDTH - LEFT - RIGHT) / WIDTH, PANEL / height])
        picture = render(reader, time, "speed [m/s]", speeds, window, size,
                         dots=4)
        show(axes, picture, window)
        for x in numpy.arange(window[0], window[1], cell):
            axes.axvline(x, color="0.85", linewidth=0.25)
        for y in numpy.arange(0, HEIGHT, cell):
            axes.axhline(y, color="0.85", linewidth=0.25)
        axes.set_title("t = %.0f s %s: %d points, %d empty interior cells, %d "
                       "empty columns, %d connected %s"
                       % (time, label, table["points"][at],
                          table["empty interior cells"][at],
                          table["empty columns"][at],
                          table["connected bodies"][at],
                          "body" if table["connected bodies"][at] == 1
                          else "bodies"), pad=2)
        axes.set_ylabel("y [m]")
        axes.set_yticks([0, 1, 2])
        row += 1
axes.set_xlabel("x along the slope [m]; heights are drawn %.1f times too large; "
                "grid: cells of %g m" % (exaggeration, cell))

place = [1 - (RIGHT - 0.25) / WIDTH, BOTTOM / height, 0.1 / WIDTH,
         ((n_rows - 1) * STEP + PANEL) / height]
figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(*speeds), "viridis"),
                cax=figure.add_axes(place), label="speed [m/s]")
save(figure, name)

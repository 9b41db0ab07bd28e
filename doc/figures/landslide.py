# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of one landslide: the soil at several times, coloured by speed, and
by plastic strain at the end.

    /usr/bin/python3 landslide.py FOLDER PICTURE.png

FOLDER holds the output of a run with Output/Boxes as cells = true.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

WIDTH, PANEL, STEP = 7.8, 0.66, 0.9  # inches
LEFT, RIGHT, BOTTOM = 0.55, 0.95, 0.5


def frame(figure, row, n_rows):
    """Axes of a row, counted from the top."""
    width, height = figure.get_size_inches()
    bottom = BOTTOM + (n_rows - 1 - row) * STEP
    return figure.add_axes([LEFT / width, bottom / height,
                            (width - LEFT - RIGHT) / width, PANEL / height])


def color_bar(figure, first, last, label, limits):
    """One bar to the right of the axes from `first` to `last`."""
    width = figure.get_size_inches()[0]
    bottom = last.get_position().y0
    place = [1 - (RIGHT - 0.2) / width, bottom, 0.1 / width,
             first.get_position().y1 - bottom]
    scale = plt.cm.ScalarMappable(plt.Normalize(*limits), "viridis")
    figure.colorbar(scale, cax=figure.add_axes(place), label=label)


folder, name = sys.argv[1:3]
reader, times = open_points(folder)
end = times[-1]
wanted = [0, 5, 10, 15, 20, end] if end > 24 else numpy.linspace(0, end, 6)
shown = sorted({nearest(times, t) for t in wanted})

table = statistics(folder)
window = (10 * numpy.floor(table["rear x [m]"].min() / 10),
          10 * numpy.ceil((table["front x [m]"].max() + 2) / 10), 0, 5.5)
speeds = (0, numpy.ceil(table["maximum speed of points [m/s]"].max()))
strains = (0, 3)

n_rows = len(shown) + 1
figure = plt.figure(figsize=(WIDTH, BOTTOM + (n_rows - 1) * STEP + PANEL + 0.22))
size = [int((WIDTH - LEFT - RIGHT) * 260), int(PANEL * 260)]
exaggeration = size[1] * (window[1] - window[0]) / size[0] / window[3]

rows = [frame(figure, i, n_rows) for i in range(n_rows)]
for axes, time in zip(rows, shown):
    n = table["points"][numpy.argmin(abs(table["time [s]"] - time))]
    show(axes, render(reader, time, "speed [m/s]", speeds, window, size), window)
    axes.set_title("t = %.0f s, %d points" % (time, n), pad=2)
show(rows[-1], render(reader, end, "plastic strain", strains, window, size),
     window)
rows[-1].set_title("t = %.0f s, plastic strain" % end, pad=2)
for axes in rows:
    axes.set_ylabel("y [m]")
    axes.set_yticks([0, 2.5, 5])
    axes.tick_params(labelbottom=axes is rows[-1])
rows[-1].set_xlabel("x along the slope [m]; heights are drawn %.1f times too "
                    "large" % exaggeration)
color_bar(figure, rows[0], rows[-2], "speed [m/s]", speeds)
color_bar(figure, rows[-1], rows[-1], "strain [-]", strains)
save(figure, name)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of a submerged slope of sand that pore pressure sets going.

    /usr/bin/python3 sand_slope.py PICTURE.png FOLDER

FOLDER holds the output of prm/sand-slope.prm.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

WINDOW = (-40, 70, 0, 17)
SHOWN = [8, 14, 20, 30]

name, folder = sys.argv[1:3]
reader, times = open_points(folder)
figure = plt.figure(figsize=(7.8, 7.6))
for i, wanted in enumerate(SHOWN):
    time = nearest(times, wanted)
    axes = figure.add_axes([0.07, 0.79 - 0.185 * i, 0.8, 0.15])
    corners, values = reader.read(time)
    pressure = values["excess pore pressure [Pa]"] / 1e3
    cells = PolyCollection(corners[:, :, :2], array=pressure, cmap="viridis",
                           edgecolors="face", linewidths=0.2)
    cells.set_clim(0, 130)
    axes.add_collection(cells)
    axes.plot([40, -20, -60], [0, 15, 15], color=EXACT, lw=0.8, ls="--")
    axes.set_xlim(*WINDOW[:2])
    axes.set_ylim(*WINDOW[2:])
    axes.set_title("t = %.0f s" % time, pad=2)
    axes.tick_params(labelbottom=wanted == SHOWN[-1])
    axes.set_ylabel("y [m]")
bar = figure.colorbar(cells, cax=figure.add_axes([0.895, 0.235, 0.015, 0.705]))
bar.set_label("excess pore pressure [kPa]")
axes.set_xlabel("x [m]")

table = statistics(folder)
axes = figure.add_axes([0.07, 0.06, 0.8, 0.1])
axes.plot(table["time [s]"], table["maximum speed [m/s]"], color=SPLIT)
# r_u = 1 - tan(14 degrees)/tan(33 degrees) of a ramp to 0.9 in 20 s
axes.axvline(20 / numpy.pi * numpy.arccos(1 - 2 * 0.615 / 0.9), color=EXACT,
             ls="--")
axes.set_xlim(0, 35)
axes.set_xlabel("time [s]")
axes.set_ylabel("speed [m/s]")
save(figure, name)

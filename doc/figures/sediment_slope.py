# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of a slope of young clay: strength at the start, and pore pressure.

    /usr/bin/python3 sediment_slope.py PICTURE.png FOLDER

FOLDER holds the output of prm/sediment-slope.prm.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

STRENGTH = ("undrained shear strength [Pa]", "undrained shear\nstrength [kPa]", 6)
PRESSURE = ("excess pore pressure [Pa]", "excess pore\npressure [kPa]", 40)
SHOWN = [(0, *STRENGTH), (0, *PRESSURE), (40, *PRESSURE), (1000, *PRESSURE)]

name, folder = sys.argv[1:3]
reader, times = open_points(folder)
figure, panels = plt.subplots(len(SHOWN), figsize=(7.8, 6.2), sharex=True,
                              layout="constrained")
for axes, (wanted, field, label, limit) in zip(panels, SHOWN):
    time = nearest(times, wanted)
    corners, values = reader.read(time)
    cells = PolyCollection(corners[:, :, :2], array=values[field] / 1e3, cmap="viridis",
                           edgecolors="face", linewidths=0.2)
    cells.set_clim(0, limit)
    axes.add_collection(cells)
    axes.plot([150, -21.5, -60], [0, 15, 15], color=EXACT, lw=0.8, ls="--")
    axes.set_xlim(-60, 200)
    axes.set_ylim(0, 17)
    axes.set_title("t = %.0f s" % time, pad=2)
    axes.set_ylabel("y [m]")
    figure.colorbar(cells, ax=axes, pad=0.01).set_label(label)
panels[-1].set_xlabel("x [m]")
save(figure, name)

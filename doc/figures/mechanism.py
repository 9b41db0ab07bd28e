# SPDX-License-Identifier: LGPL-2.1-or-later
"""How soil fails when its strength is reduced: mechanism.pvd of some runs.

    /usr/bin/python3 mechanism.py PICTURE.png FOLDER=TITLE ...

The runs must have written points as dots (Output/Boxes as cells = false).
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *


def mechanism(folder):
    """Places of the points and how they move, the largest component 1."""
    series, times = open_points(folder, "mechanism")
    corners, values = series.read(times[-1])
    return corners[:, 0], values["mechanism [-]"]


name, runs = sys.argv[1], [run.split("=", 1) for run in sys.argv[2:]]
figure, rows = plt.subplots(len(runs), 1, figsize=(7.8, 2.1 * len(runs)),
                            constrained_layout=True)
for axes, (folder, title) in zip(numpy.atleast_1d(rows), runs):
    x, motion = mechanism(folder)
    speed = numpy.linalg.norm(motion, axis=1)
    dots = axes.scatter(x[:, 0], x[:, 1], c=speed / speed.max(), s=7,
                        marker="s", linewidths=0, cmap="viridis", vmin=0,
                        vmax=1)
    # Arrows for some of those that move.
    moving = numpy.flatnonzero(speed > 0.15 * speed.max())
    shown = numpy.random.default_rng(1).choice(
        moving, min(60, len(moving)), replace=False)
    axes.quiver(x[shown, 0], x[shown, 1], motion[shown, 0], motion[shown, 1],
                color="black", scale=22, width=0.0018)
    axes.set_aspect("equal")
    axes.set_title(title)
    axes.set_ylabel("y [m]")
    figure.colorbar(dots, ax=axes, label="motion", shrink=0.9)
axes.set_xlabel("x [m]")
figure.savefig(name)

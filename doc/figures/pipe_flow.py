# SPDX-License-Identifier: LGPL-2.1-or-later
"""Speed of clay around a pipe that is dragged through it.

    /usr/bin/python3 pipe_flow.py PICTURE.png FOLDER=TITLE ...

FOLDER holds the output of prm/verification/pipe.prm.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

name, cases = sys.argv[1], [a.split("=", 1) for a in sys.argv[2:]]
radius, speed = 0.5, 0.173336  # of prm/verification/pipe.prm
size, reach = 560, 1.5  # pixels, m
figure, panels = plt.subplots(1, len(cases), figsize=(3.5 * len(cases), 3.5),
                              sharey=True, constrained_layout=True)
for axes, (folder, title) in zip(numpy.atleast_1d(panels), cases):
    reader, times = open_points(folder)
    with open(os.path.join(folder, "obstacles.csv"), newline="") as stream:
        last = list(csv.DictReader(stream))[-1]
    centre = float(last["pipe displacement x [m]"])
    window = (centre - reach, centre + reach, -reach, reach)
    axes.imshow(render(reader, times[-1], "speed [m/s]", (0, 1.5 * speed),
                       window, [size, size]), extent=window)
    angle = numpy.linspace(0, 2 * numpy.pi, 90)
    axes.fill(centre + radius * numpy.cos(angle), radius * numpy.sin(angle),
              color="0.2")
    axes.set_title(title)
    axes.set_xlabel("x [D]")
panels[0].set_ylabel("y [D]")
scale = plt.cm.ScalarMappable(plt.Normalize(0, 1.5), "viridis")
figure.colorbar(scale, ax=panels, label="speed over that of the pipe",
                shrink=0.8)
figure.savefig(name)

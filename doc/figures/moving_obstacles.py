# SPDX-License-Identifier: LGPL-2.1-or-later
"""A pipe on springs in a slide: pictures at some times, displacement, and forces.

    /usr/bin/python3 moving_obstacles.py PICTURE.png FOLDER

FOLDER holds the output of prm/pipe-on-springs.prm.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

WIDTH, HEIGHT = 7.8, 6.4  # inches


def table(folder, file):
    with open(os.path.join(folder, file), newline="") as stream:
        rows = list(csv.reader(stream))
    values = numpy.array([[float(x or "nan") for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


name, folder = sys.argv[1:3]
place = [float(v) for v in parameter(folder, "Obstacles/pipe/Centre").split(",")]
radius = 0.3  # of prm/pipe-on-springs.prm
body = table(folder, "obstacles.csv")
time = body["time [s]"]
x = body["pipe displacement x [m]"]
reader, times = open_points(folder)
hit = time[numpy.argmax(body["pipe contact area [m]"] > 0)]
wanted = [nearest(times, hit + dt) for dt in (0, 1, 2, 4)]

figure = plt.figure(figsize=(WIDTH, HEIGHT))
window = (place[0] - 4.5, place[0] + 11.2, 0, 5.1)
size = [1570, 510]
angle = numpy.linspace(0, 2 * numpy.pi, 60)
for i, now in enumerate(wanted):
    axes = figure.add_axes([0.07 + 0.46 * (i % 2), 0.80 - 0.205 * (i // 2),
                            0.40, 0.155])
    show(axes, render(reader, now, "speed [m/s]", (0, 6), window, size), window)
    moved = place[0] + numpy.interp(now, time, x)
    axes.plot(place[0] + radius * numpy.cos(angle),
              place[1] + radius * numpy.sin(angle), color="0.4", linewidth=0.6)
    axes.fill(moved + radius * numpy.cos(angle),
              place[1] + radius * numpy.sin(angle), color="0.2")
    axes.set_title("t = %.1f s" % now, pad=2)
    axes.set_ylabel("y [m]" if i % 2 == 0 else "")
    axes.set_xlabel("x [m]" if i // 2 else "")
    axes.tick_params(labelbottom=bool(i // 2))
scale = plt.cm.ScalarMappable(plt.Normalize(0, 6), "viridis")
figure.colorbar(scale, cax=figure.add_axes([0.945, 0.60, 0.012, 0.35]),
                label="speed [m/s]")

axes = figure.add_axes([0.09, 0.325, 0.84, 0.17])
axes.plot(time, x, color=SPLIT, label="displacement")
axes.plot(time, body["pipe spring slip x [m]"], color=UNSPLIT, linestyle="--",
          label="plastic elongation of the springs")
axes.set_ylabel("[m]")
axes.set_xlim(hit - 1, time[-1])
axes.tick_params(labelbottom=False)
axes.legend(loc="lower right")

axes = figure.add_axes([0.09, 0.075, 0.84, 0.21])
axes.plot(time, body["pipe force x [N]"] / 1e3, color=SPLIT,
          label="force of the soil on the pipe")
axes.plot(time, -body["pipe spring force x [N]"] / 1e3, color=UNSPLIT,
          label="force of the pipe on springs and dashpot")
axes.axhline(0, color="0.7", linewidth=0.5)
axes.set_xlim(hit - 1, time[-1])
axes.set_xlabel("time [s]")
axes.set_ylabel("force [kN/m]")
axes.legend(loc="lower right")
figure.savefig(name)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The slide around a pipe at some times, and the force on the pipe.

    /usr/bin/python3 pipeline.py PICTURE.png FOLDER [UNDISTURBED C_D N_P]

FOLDER holds the output of prm/pipeline.prm. UNDISTURBED is that of the same
slide without the pipe (without the section Obstacles): with
it, and the two coefficients, the force of the hybrid formula
(1/2 C_D rho u^2 + N_P s_u) D is drawn, u being the depth-mean velocity of the
undisturbed slide where the pipe is.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

WIDTH, HEIGHT = 7.8, 6.2  # inches
TIMES = 4


def table(folder, file):
    with open(os.path.join(folder, file), newline="") as stream:
        rows = list(csv.reader(stream))
    values = numpy.array([[float(x or "nan") for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def velocity_at(folder, x):
    """Times and depth-mean velocity of the column at x; 0 without soil."""
    profile = table(folder, "profile.csv")
    times = numpy.unique(profile["time [s]"])
    velocity = numpy.zeros(len(times))
    for i, time in enumerate(times):
        now = profile["time [s]"] == time
        places = profile["x [m]"][now]
        if len(places) and places.min() <= x <= places.max():
            velocity[i] = numpy.interp(
                x, places, profile["depth-mean velocity [m/s]"][now])
    return times, velocity


name, folder = sys.argv[1:3]
place = [float(v) for v in parameter(folder, "Obstacles/pipe/Centre").split(",")]
radius = 0.3  # of prm/pipeline.prm
forces = table(folder, "obstacles.csv")
reader, times = open_points(folder)
hit = forces["time [s]"][numpy.argmax(forces["pipe contact area [m]"] > 0)]
wanted = [nearest(times, hit + dt) for dt in (0.5, 1.5, 3, 6)]

figure = plt.figure(figsize=(WIDTH, HEIGHT))
# A metre is as long along both axes.
window = (place[0] - 4.5, place[0] + 6.2, 0, 4)
size = [1070, 400]
for i, time in enumerate(wanted):
    axes = figure.add_axes([0.07 + 0.46 * (i % 2), 0.77 - 0.235 * (i // 2),
                            0.40, 0.188])
    show(axes, render(reader, time, "speed [m/s]", (0, 6), window, size),
         window)
    # Places in the picture of the pipe, which is a circle in metres.
    angle = numpy.linspace(0, 2 * numpy.pi, 60)
    axes.fill(place[0] + radius * numpy.cos(angle),
              place[1] + radius * numpy.sin(angle), color="0.2")
    axes.set_title("t = %.1f s" % time, pad=2)
    axes.set_ylabel("y [m]" if i % 2 == 0 else "")
    axes.set_xlabel("x [m]" if i // 2 else "")
    axes.tick_params(labelbottom=bool(i // 2))
scale = plt.cm.ScalarMappable(plt.Normalize(0, 6), "viridis")
figure.colorbar(scale, cax=figure.add_axes([0.945, 0.535, 0.012, 0.423]),
                label="speed [m/s]")

axes = figure.add_axes([0.09, 0.075, 0.84, 0.33])
time = forces["time [s]"]
axes.plot(time, forces["pipe force x [N]"] / 1e3, color=SPLIT,
          label="along the seabed")
axes.fill_between(time, forces["pipe least force x [N]"] / 1e3,
                  forces["pipe largest force x [N]"] / 1e3,
                  color=SPLIT, alpha=0.2, linewidth=0)
axes.plot(time, forces["pipe force y [N]"] / 1e3, color=UNSPLIT,
          label="away from the seabed")
if len(sys.argv) > 3:
    drag, bearing = float(sys.argv[4]), float(sys.argv[5])
    at, u = velocity_at(sys.argv[3], place[0])
    density = float(parameter(folder, "Density"))
    strength = float(parameter(folder, "Undrained shear strength"))
    axes.plot(at, numpy.where(u > 0, (0.5 * drag * density * u**2 +
                                      bearing * strength) * 2 * radius, 0) / 1e3,
              color=EXACT, linestyle="--",
              label="hybrid formula, C_D = %g, N_p = %g" % (drag, bearing))
axes.axhline(0, color="0.7", linewidth=0.5)
axes.set_xlim(hit - 1, time[-1])
axes.set_xlabel("time [s]")
axes.set_ylabel("force on the pipe [kN/m]")
axes.set_title("means over 0.1 s; shaded: least and largest of a time step")
axes.legend(loc="upper right")
figure.savefig(name)

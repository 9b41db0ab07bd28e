# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bar of the paper: where it splits, and velocity and energy against the
closed form.

    /usr/bin/python3 bar.py PICTURE.png SPLIT UNSPLIT
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import *

name, split, unsplit = sys.argv[1:4]

# The case of prm/bar.prm; energies per metre width of a bar 0.5 m high.
E, density, length, height, v0 = 10e3, 1000., 25., 0.5, 0.1
b = numpy.pi / (2 * length)
w = b * numpy.sqrt(E / density)
period = 2 * numpy.pi / w
peak_velocity = 2 * v0 / numpy.pi
peak_energy = density * v0 ** 2 * length / 4 * height
threshold = float(parameter(split, "Threshold"))
# Where the largest stretch, 1 + (v0/c) cos(b x), is just the threshold.
reach = numpy.arccos((threshold - 1) * w / b / v0) / b


def draw_split_map(axes):
    """The boxes of the points over x and t, for half a period, over which the
    bar is in tension."""
    reader, times = open_points(split)
    times = times[times <= period / 2]
    for time, next_time in zip(times, numpy.append(times[1:], period / 2)):
        position, size, generation = extract(
            reader, time, ["position [m]", "box length [m]", "generation"])
        for is_split, color in [(False, "0.82"), (True, SPLIT)]:
            here = (generation > 0) == is_split
            axes.broken_barh(
                numpy.column_stack([position[here, 0] - size[here, 0] / 2,
                                    size[here, 0]]),
                (time, next_time - time), facecolor=color,
                edgecolor="white", linewidth=0.15)
    time = numpy.linspace(0, period / 2)
    axes.plot(reach + v0 / w * numpy.sin(w * time) * numpy.sin(b * reach), time,
              color="black", linestyle="--", linewidth=0.9)
    axes.set_title("(a) boxes of the points: grey as created, blue split once")
    axes.set_xlabel("x [m]; dashed: limit of the split by the closed form")
    axes.set_ylabel("time [s]")
    axes.set_xlim(0, length + 1.5)
    axes.set_ylim(0, period / 2)


figure = plt.figure(figsize=(7.8, 6.6), constrained_layout=True)
grid = figure.add_gridspec(3, 2)
draw_split_map(figure.add_subplot(grid[0, 0]))

tables = [statistics(split), statistics(unsplit)]
styles = [{"color": SPLIT, "label": "with splitting"},
          {"color": UNSPLIT, "label": "without splitting", "linestyle": "--"}]
fine = numpy.linspace(0, 10 * period, 4000)

axes = figure.add_subplot(grid[0, 1])
for table, style in zip(tables, styles):
    axes.plot(table["time [s]"], table["points"], **style)
axes.set_title("(b) number of points")
axes.set_xlabel("time [s]")
axes.set_xlim(0, period)
axes.set_ylim(0, 500)
axes.legend(loc="lower right")

axes = figure.add_subplot(grid[1, :])
axes.plot(fine / period, peak_velocity * numpy.cos(w * fine), color=EXACT,
          linewidth=2.5, alpha=0.45, label="closed form (linear elasticity)")
for table, style in zip(tables, styles):
    axes.plot(table["time [s]"] / period, table["centre velocity x [m/s]"],
              linewidth=0.9, **{k: v for k, v in style.items()})
axes.set_title("(c) velocity of the centre of mass [m/s]")
axes.set_xlabel("time [periods of %.2f s]" % period)
axes.set_xlim(0, 10)
axes.set_ylim(-0.075, 0.1)
axes.legend(loc="upper right", ncol=3)

axes = figure.add_subplot(grid[2, 0])
axes.plot(fine / period, peak_energy * numpy.cos(w * fine) ** 2, color=EXACT,
          linewidth=2.5, alpha=0.45)
axes.plot(fine / period, peak_energy * numpy.sin(w * fine) ** 2, color=EXACT,
          linewidth=2.5, alpha=0.45)
for table, style in zip(tables, styles):
    time = table["time [s]"] / period
    axes.plot(time, table["kinetic energy [J]"], color=style["color"],
              linestyle=style.get("linestyle", "-"))
    axes.plot(time, table["elastic energy [J]"], color=style["color"],
              linestyle=style.get("linestyle", "-"))
axes.text(0.04, peak_energy * 1.06, "kinetic")
axes.text(0.26, peak_energy * 1.06, "strain")
axes.set_title("(d) energy in the first period [J per m width]")
axes.set_xlabel("time [periods]")
axes.set_xlim(0, 1)
axes.set_ylim(0, peak_energy * 1.25)

axes = figure.add_subplot(grid[2, 1])
for table, style in zip(tables, styles):
    time = table["time [s]"]
    error = table["centre velocity x [m/s]"] - peak_velocity * numpy.cos(w * time)
    axes.plot(time / period, 100 * error / peak_velocity, color=style["color"],
              linestyle=style.get("linestyle", "-"))
axes.set_title("(e) velocity less closed form [% of its amplitude]")
axes.set_xlabel("time [periods]")
axes.set_xlim(0, 10)
axes.grid(linewidth=0.3)
save(figure, name)

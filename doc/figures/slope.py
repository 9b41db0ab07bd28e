# SPDX-License-Identifier: LGPL-2.1-or-later
"""A slide on a bathymetry: the map, the thalweg in time and a force.

    /usr/bin/python3 slope.py PICTURE.png SLOPE_3D SLOPE

SLOPE_3D holds the output of prm/slope-3d.prm, SLOPE that of prm/slope.prm.
"""

import csv
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                "../../share/talus"))
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import LightSource

from talus_tools.esri import read_grid

LINE = ((515000, 6740700), (515000, 6742200))  # the pipeline of slope-3d.prm


def table(folder, name):
    with open(os.path.join(folder, name), newline="") as stream:
        rows = list(csv.reader(stream))
    values = numpy.array([[float(x or "nan") for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def draw_map(axes, folder):
    grid = {name: read_grid(os.path.join(folder, "maps", name + ".asc"))
            for name in ("ground", "maximum-thickness")}
    ground = grid["ground"]
    west, south = ground.west, ground.south
    rows, columns = ground.values.shape
    extent = [west / 1e3, (west + columns * ground.dx) / 1e3,
              south / 1e3, (south + rows * ground.dy) / 1e3]
    relief = LightSource(315, 35).hillshade(
        ground.values, vert_exag=4, dx=ground.dx, dy=ground.dy)
    axes.imshow(relief, extent=extent, cmap="gray", vmin=-0.2, vmax=1.2)
    x = extent[0] + (numpy.arange(columns) + 0.5) * ground.dx / 1e3
    y = extent[3] - (numpy.arange(rows) + 0.5) * ground.dy / 1e3
    lines = axes.contour(x, y, ground.values, numpy.arange(-500, -200, 20),
                         colors="black", linewidths=0.3)
    axes.clabel(lines, lines.levels[::2], fontsize=5, fmt="%g m")
    thickness = grid["maximum-thickness"].values
    thickness = numpy.where(thickness > 0.2, thickness, numpy.nan)
    picture = axes.imshow(thickness, extent=extent, cmap="viridis", alpha=0.85)
    axes.plot(*(numpy.transpose(LINE) / 1e3), color="tab:red", lw=1)
    axes.text(LINE[1][0] / 1e3, LINE[1][1] / 1e3, " pipeline", color="tab:red",
              fontsize=7, va="top")
    axes.set(xlabel="easting [km]", ylabel="northing [km]")
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.set_aspect("equal")
    plt.colorbar(picture, ax=axes, label="maximum thickness [m]", shrink=0.8)


def draw_thalweg(axes, folder):
    """Thickness over x and time."""
    profile = table(folder, "profile.csv")
    times = numpy.unique(profile["time [s]"])
    places = numpy.unique(profile["x [m]"])
    field = numpy.full((len(times), len(places)), numpy.nan)
    field[numpy.searchsorted(times, profile["time [s]"]),
          numpy.searchsorted(places, profile["x [m]"])] = profile["thickness [m]"]
    picture = axes.pcolormesh(places, times, field, cmap="viridis",
                              shading="nearest")
    axes.axvline(3000, color="tab:red", lw=1)
    axes.set(xlabel="x along the section [m]", ylabel="time [s]")
    plt.colorbar(picture, ax=axes, label="thickness [m]")


def draw_force(axes, folder):
    forces = table(folder, "obstacles.csv")
    time = forces["time [s]"]
    axes.fill_between(time, forces["structure least force x [N]"] / 1e6,
                      forces["structure largest force x [N]"] / 1e6,
                      color="tab:blue", alpha=0.25, lw=0,
                      label="least and largest in a step")
    axes.plot(time, forces["structure force x [N]"] / 1e6, color="tab:blue",
              lw=1, label="mean over 1 s")
    axes.set(xlabel="time [s]", ylabel="force on the structure [MN/m]")
    axes.legend(frameon=False)


def main():
    picture, slope_3d, slope = sys.argv[1:4]
    plt.rcParams.update({"font.size": 7})
    figure = plt.figure(figsize=(7.8, 5.4), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=[1.35, 1])
    draw_map(upper.subplots(), slope_3d)
    left, right = lower.subplots(1, 2)
    draw_thalweg(left, slope)
    draw_force(right, slope)
    figure.savefig(picture, dpi=150)


main()

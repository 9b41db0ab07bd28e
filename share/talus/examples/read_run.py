#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How to read a run of talus in Python: tables, fields and maps.

    python3 read_run.py DIR

prints a few results of the run in DIR and draws them into read_run.png. Copy what is needed;
it needs Debian's packages python3-numpy and python3-matplotlib.
"""

import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

# The module is in the folder above this file's, unless it is installed for Python.
sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import talus

results = talus.read(sys.argv[1] if len(sys.argv) > 1 else ".")

# 1. Parameters, as the run understood them: a dictionary of texts.
parameters = results.parameters
print(f"title: {parameters.get('Title', '')}, cell size {parameters['Grid/Cell size']} m")

# 2. A table: columns by their names (doc/output.md explains each).
statistics = results.table("statistics")
axes = "xz" if parameters["Dimension"] == "3" else "x"
time = statistics["time"]
# In plan, whatever the direction of the slide.
speed = numpy.sqrt(sum(statistics[f"centre velocity {axis}"]**2 for axis in axes))
fastest = numpy.argmax(speed)
print(f"largest speed of the centre: {speed[fastest]:.4g} m/s at t = {time[fastest]:.4g} s")
figure, (above, below) = plt.subplots(2, 1, figsize=(8, 6), constrained_layout=True)
above.plot(time, speed)
above.set(xlabel="time [s]", ylabel="speed of the centre in plan [m/s]")

# 3. Fields: the material points at one time, by default the last one.
if len(results.times("points")):
    points = results.points()
    places, mass = points.places, points["mass"]
    centre = mass @ places / mass.sum()
    print(f"{len(points)} points at t = {points.time:.4g} s, centre of mass at "
          f"x = {centre[0]:.4g} m, y = {centre[1]:.4g} m")
    # A section in 2-D, the plan in 3-D.
    drawn = below.scatter(places[:, 0], places[:, 2 if axes == "xz" else 1], c=points["speed"],
                          s=1)
    figure.colorbar(drawn, ax=below, label="speed [m/s]")
    below.set(xlabel="x [m]", ylabel="z [m]" if axes == "xz" else "y [m]")

# 4. Maps of a 3-D run: grids with easting and northing, NaN where there was no soil.
if "maximum-thickness" in results.names_of_maps():
    grid = results.map("maximum-thickness")
    row, column = numpy.unravel_index(numpy.nanargmax(grid.values), grid.values.shape)
    east, north = grid.place(row, column)
    area = numpy.count_nonzero(grid.values > 0.5) * grid.dx * grid.dy
    print(f"largest thickness {grid.values[row, column]:.4g} m at easting {east:.0f} m, northing "
          f"{north:.0f} m; {area / 1e4:.4g} ha had more than 0.5 m of soil")

figure.savefig("read_run.png", dpi=120)
print("read_run.png has the pictures.")

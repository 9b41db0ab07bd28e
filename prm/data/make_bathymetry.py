#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write bathymetry.asc, the sea floor of prm/slope.prm and prm/slope-3d.prm.

A continental slope by formula, no place on Earth: an upper slope of 2 degrees,
a slope of 7 degrees, a flat of 1 degree, and a canyon that winds down to it.
Esri ASCII grid of 4.8 km x 2.8 km in cells of 20 m, heights in metres:

    python3 make_bathymetry.py > bathymetry.asc
"""

import math

CELL = 20.0  # m
COLUMNS, ROWS = 240, 140
EASTING, NORTHING = 512000, 6740000  # of the lower left corner, m


def bend(x):
    """Integral of a step from 0 to 1 at x = 0, smooth over 120 m."""
    return 120.0 * math.log1p(math.exp(x / 120.0))


def step(x):
    """From 0 to 1, smooth over 180 m."""
    return 1.0 / (1.0 + math.exp(-x / 180.0))


def height(x, y):
    """Of the sea floor [m], x m east and y m north of the corner."""
    upper, slope, flat = (math.tan(math.radians(a)) for a in (2.0, 7.0, 1.0))
    floor = (-220.0 - upper * x - (slope - upper) * bend(x - 600.0)
             + (slope - flat) * bend(x - 2400.0))
    depth = 35.0 * step(x - 900.0) * step(2900.0 - x)
    axis = 1400.0 + 150.0 * math.sin(2.0 * math.pi * x / 3000.0)
    return floor - depth * math.exp(-((y - axis) / 170.0) ** 2)


def main():
    print(f"ncols {COLUMNS}\nnrows {ROWS}\nxllcorner {EASTING}\n"
          f"yllcorner {NORTHING}\ncellsize {CELL:g}\nNODATA_value -9999")
    for row in reversed(range(ROWS)):  # from north to south
        print(" ".join(f"{height((i + 0.5) * CELL, (row + 0.5) * CELL):.2f}"
                       for i in range(COLUMNS)))


if __name__ == "__main__":
    main()

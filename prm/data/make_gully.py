#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write gully.asc, the sea floor of prm/own-slope.prm.

A slope that dips to the west-north-west, by formula, no place on Earth: a shelf of
1.5 degrees, a slope of 6 degrees with a gully, a flat of 0.8 degrees. Esri ASCII grid
in degrees (WGS 84), 4.0 km x 3.0 km, as surveys publish them; heights in metres:

    python3 make_gully.py > gully.asc
"""

import math

CELL = 0.0002  # degrees
COLUMNS, ROWS = 240, 136
LONGITUDE, LATITUDE = 15.4760, 40.9864  # of the lower left corner, degrees
EAST, NORTH = 84139.0, 111040.0  # m per degree at 41 degrees north
DESCENT = math.radians(22.5)  # of the way down, from west to north


def bend(s):
    """Integral of a step from 0 to 1 at s = 0, smooth over 100 m."""
    return 100.0 * math.log1p(math.exp(s / 100.0))


def step(s):
    """From 0 to 1, smooth over 150 m."""
    return 1.0 / (1.0 + math.exp(-s / 150.0))


def height(east, north):
    """Of the sea floor [m], in m east and north of the middle of the raster."""
    down = -east * math.cos(DESCENT) + north * math.sin(DESCENT) + 1700.0
    across = east * math.sin(DESCENT) + north * math.cos(DESCENT)
    shelf, slope, flat = (math.tan(math.radians(a)) for a in (1.5, 6.0, 0.8))
    floor = (-180.0 - shelf * down - (slope - shelf) * bend(down - 500.0)
             + (slope - flat) * bend(down - 2200.0))
    gully = 25.0 * step(down - 900.0) * step(2700.0 - down)
    axis = 120.0 * math.sin(2.0 * math.pi * down / 2500.0)
    return floor - gully * math.exp(-((across - axis) / 160.0) ** 2)


def main():
    print(f"ncols {COLUMNS}\nnrows {ROWS}\nxllcorner {LONGITUDE:.4f}\n"
          f"yllcorner {LATITUDE:.4f}\ncellsize {CELL:g}\nNODATA_value -9999")
    for row in reversed(range(ROWS)):  # from north to south
        print(" ".join(
            f"{height((i + 0.5 - COLUMNS / 2) * CELL * EAST, (row + 0.5 - ROWS / 2) * CELL * NORTH):.2f}"
            for i in range(COLUMNS)))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Change of the height of the sea floor at three times.

    /usr/bin/python3 tsunami.py PICTURE.png FOLDER

FOLDER holds the output of prm/slope-3d.prm with 'Output/Plan interval', and the
files of talus-tsunami.
"""

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


def read_dtopo(path):
    """Header, and an array (blocks, rows from the north, columns)."""
    with open(path) as stream:
        head = {}
        for _ in range(9):
            value, label = stream.readline().split()
            head[label] = float(value)
        values = numpy.loadtxt(stream)
    return head, values.reshape(int(head["mt"]), int(head["my"]), -1)


def main():
    picture, folder = sys.argv[1:]
    head, dz = read_dtopo(os.path.join(folder, "tsunami-source.tt3"))
    ground = read_grid(os.path.join(folder, "maps", "ground.asc"))
    rows, columns = ground.values.shape
    extent = [ground.west / 1e3, (ground.west + columns * ground.dx) / 1e3,
              ground.south / 1e3, (ground.south + rows * ground.dy) / 1e3]
    relief = LightSource(315, 35).hillshade(ground.values, vert_exag=4,
                                            dx=ground.dx, dy=ground.dy)
    blocks = numpy.linspace(0, len(dz) - 1, 4).round().astype(int)[1:]
    figure, panels = plt.subplots(3, 1, figsize=(7, 8), constrained_layout=True,
                                  sharex=True)
    largest = abs(dz).max()
    for panel, k in zip(panels, blocks):
        panel.imshow(relief, extent=extent, cmap="gray", vmin=-0.2, vmax=1.2)
        shown = numpy.where(abs(dz[k]) > 0.01 * largest, dz[k], numpy.nan)
        image = panel.imshow(shown, extent=extent, cmap="RdBu_r",
                             vmin=-largest, vmax=largest, alpha=0.9)
        panel.set(title=f"t = {k * head['dt']:g} s", ylabel="northing [km]")
        panel.ticklabel_format(useOffset=False, style="plain")
    panels[-1].set(xlabel="easting [km]")
    figure.colorbar(image, ax=panels, label="change of the sea floor dz [m]",
                    shrink=0.6)
    figure.savefig(picture, dpi=110, metadata={"Software": None})


main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus-new chose: a map, and the section along the path."""

import numpy

from talus_tools.new_case.path import lengths
from talus_tools.new_case.write import Mesh
from talus_tools.report.page import BLUE, COLORS, plt

KILOMETRE = 1000.


def contours(axes, case, box):
    """Shaded relief and heights."""
    margin = 0.1 * max(box[2] - box[0], box[3] - box[1])
    west, south, east, north = (box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin)
    heights = case.floor.part(west, south, east, north)
    every = max(1, max(heights.shape) // 800)
    heights = heights[::every, ::every]
    left = max(west, case.floor.west)
    top = min(north, case.floor.north)
    step = every * case.floor.cell
    extent = (left / KILOMETRE, (left + heights.shape[1] * step) / KILOMETRE,
              (top - heights.shape[0] * step) / KILOMETRE, top / KILOMETRE)
    image = axes.imshow(heights, extent=extent, cmap="Blues_r")
    levels = axes.contour(heights, 12, extent=extent, origin="upper", colors="black",
                          linewidths=0.4)
    axes.clabel(levels, fontsize=6, fmt="%.0f")
    axes.figure.colorbar(image, ax=axes, label="height [m]", shrink=0.8)


def draw_map(axes, case):
    """Release area, path, stations and mesh on the sea floor."""
    mesh = Mesh(case, 3)
    (west, east), (south, north) = mesh.plan
    contours(axes, case, (west, south, east, north))
    x, y = [west, east, east, west, west], [south, south, north, north, south]
    axes.plot(numpy.array(x) / KILOMETRE, numpy.array(y) / KILOMETRE, "k--", lw=1, label="mesh")
    for i, polygon in enumerate(case.release.polygons):
        axes.fill(*(polygon.corners.T / KILOMETRE), fc="none", ec=COLORS[1], lw=1.5,
                  label=None if i else "release")
    axes.plot(*(case.line.T / KILOMETRE), color=COLORS[2], lw=1.2, label="steepest path, section")
    for name, place in case.stations().items():
        axes.plot(*(place / KILOMETRE), "o", ms=3, color=COLORS[2])
        axes.annotate(name, place / KILOMETRE, (4, 4), textcoords="offset points", fontsize=7)
    axes.set(xlabel="easting [km]", ylabel="northing [km]", aspect="equal")
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.legend(fontsize=7)


def draw_section(axes, case):
    """Mudline and slip surface along the path."""
    way = lengths(case.path)
    heights = case.floor.at(case.path)
    slip = heights - case.slip_depths(case.path, case.toe)
    axes.fill_between(way, slip, heights, where=slip < heights, color=COLORS[1], alpha=0.5, lw=0,
                      label="released soil")
    axes.plot(way, heights, color=BLUE, lw=1, label="sea floor")
    axes.plot(way, slip, "k", lw=0.6, label="slip surface, bed")
    for name, place in case.stations().items():
        x = way[numpy.linalg.norm(case.path - place, axis=1).argmin()]
        axes.axvline(x, color=COLORS[2], lw=0.5)
        axes.annotate(name, (x, heights.max()), (2, -4), textcoords="offset points", fontsize=7)
    axes.set(xlabel="along the path [m]", ylabel="height [m]")
    axes.legend(fontsize=7)


def draw(case, path):
    """The picture of a case as PNG, without a date."""
    figure, (above, below) = plt.subplots(2, figsize=(8, 9), height_ratios=(2, 1),
                                          layout="constrained")
    draw_map(above, case)
    draw_section(below, case)
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)

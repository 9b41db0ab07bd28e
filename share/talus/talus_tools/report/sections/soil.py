# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the soil; in 3-D of a section along x through its middle."""

import numpy
from matplotlib.collections import LineCollection, PolyCollection

from talus_tools.report.page import WIDTH, Folded, Section, embed, subplots
from talus_tools.report.sections.cut import cut_points, cut_surface, middle, rectangles
from talus_tools.vtu import VtuSeries

SPEED = "speed [m/s]"
N_FRAMES = 5


def boxes(corners, values, colors, limits):
    """The points as boxes with these colours."""
    drawn = PolyCollection(rectangles(corners, values), linewidths=0.4, edgecolors="face")
    drawn.set_array(colors)
    drawn.set_clim(*limits)
    return drawn


def frame(all_corners, n):
    """Window (x0, x1, y0, y1) of the soil at all times and the height [inch] of n pictures of
    it, in true proportions if that gives more than a strip."""
    places = numpy.concatenate([c.reshape(-1, 3)[:, :2] for c in all_corners])
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * (high - low) + 1e-9
    low, high = low - margin, high + margin
    true = 0.82 * WIDTH * (high[1] - low[1]) / (high[0] - low[0])
    return (low[0], high[0], low[1], high[1] + 0.05 * (high[1] - low[1])), n * min(
        max(true, 1.0), 3.6)


def outlines(run, time, z):
    """Surfaces of obstacles nearest to this time."""
    series = run.series("obstacles")
    if series is None:
        return []
    corners, _ = series.read(series.nearest(time))
    return [LineCollection(cut_surface(corners, z), colors="black", linewidths=1)]


def plane(run, series):
    """In 3-D the z through the soil at the last time, in 2-D None."""
    if run.dimension == 2:
        return None
    corners, values = series.read(series.times[-1])
    return middle(corners, values.get("mass [kg]", numpy.ones(len(corners))))


def frames(run, series, z):
    """The speed at up to five times, the first and the last among them."""
    chosen = numpy.unique(numpy.rint(numpy.linspace(
        0, len(series.times) - 1, min(N_FRAMES, len(series.times)))).astype(int))
    times = series.times[chosen]
    states = [cut_points(*series.read(time), z) for time in times]
    fastest = max(numpy.percentile(values[SPEED], 99.5) for _, values in states
                  if len(values[SPEED]))
    window, height = frame([corners for corners, _ in states], len(times))
    figure, rows = subplots(len(times), height=height + 0.5, sharex=True, squeeze=False)
    for axes, time, (corners, values) in zip(rows[:, 0], times, states):
        drawn = axes.add_collection(boxes(corners, values, values[SPEED], (0, fastest or 1)))
        for lines in outlines(run, time, z):
            axes.add_collection(lines)
        axes.set(xlim=window[:2], ylim=window[2:], ylabel="y [m]")
        axes.set_title(f"t = {time:.4g} s")
        axes.grid(False)
    rows[-1, 0].set_xlabel("x [m]")
    figure.colorbar(drawn, ax=rows[:, 0], label="speed [m/s]", pad=0.01, extend="max",
                    aspect=12 * len(times))
    return embed(figure, f"The soil, coloured by speed; the scale ends where 99.5 % of the points "
                 f"are slower. {exaggeration(window, height / len(times))} Obstacles are black "
                 "lines.", "png")


def exaggeration(window, height):
    """In words, by about how much heights are stretched."""
    ratio = (height / (window[3] - window[2])) / (0.82 * WIDTH / (window[1] - window[0]))
    if ratio < 1.3:
        return "Heights and lengths are about to the same scale."
    return f"Heights are drawn about {ratio:.2g} times as large as lengths."


def sheared(run, series, z):
    """Where the soil was sheared, at the end."""
    corners, values = cut_points(*series.read(series.times[-1]), z)
    names = [n for n in values if n.startswith(("plastic strain", "plastic shear strain"))]
    if not names or not values[names[0]].max() > 0:
        return []
    window, height = frame([corners], 1)
    figure, axes = subplots(height=height + 0.6)
    limit = numpy.percentile(values[names[0]], 98) or values[names[0]].max()
    drawn = axes.add_collection(boxes(corners, values, values[names[0]], (0, limit)))
    drawn.set_cmap("magma")
    for lines in outlines(run, series.times[-1], z):
        axes.add_collection(lines)
    axes.set(xlim=window[:2], ylim=window[2:], xlabel="x [m]", ylabel="y [m]")
    axes.grid(False)
    name = names[0].split(" [")[0]
    figure.colorbar(drawn, ax=axes, label=f"{name} [-]", pad=0.01, extend="max")
    return [embed(figure, f"Where the soil was sheared at t = {series.times[-1]:.4g} s "
                  f"({name}): bright bands are slip surfaces and remoulded soil, dark blocks "
                  "travelled as a whole.", "png")]


def soil(run):
    """Where the points were written."""
    series = run.series("points")
    if series is None:
        return None
    z = plane(run, series)
    where = "" if z is None else f"Section at z = {z:.4g} m, through the soil's centre of mass. "
    file = "points.pvd" if isinstance(series, VtuSeries) else "points.xdmf"
    return Section("soil", "The soil in section",
                   f"{where}For all times and fields open {file} in ParaView.",
                   sheared(run, series, z)
                   + [Folded("The soil at some times", [frames(run, series, z)])])

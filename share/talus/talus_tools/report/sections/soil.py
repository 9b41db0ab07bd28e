# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the soil; in 3-D of a section along the way of the slide."""

import numpy
from matplotlib.collections import LineCollection, PolyCollection

from talus_tools.report.page import WIDTH, Folded, Section, embed, subplots
from talus_tools.report.sections.cut import cut_points, cut_surface
from talus_tools.report.way import label_of, way_of

SPEED = "speed [m/s]"
N_FRAMES = 5


def boxes(outlines, colors, limits):
    """The points as boxes with these outlines and colours."""
    drawn = PolyCollection(outlines, linewidths=0.4, edgecolors="face")
    drawn.set_array(colors)
    drawn.set_clim(*limits)
    return drawn


def frame(all_outlines, n):
    """Window (x0, x1, y0, y1) of outlines, shape (points, corners, 2 or 3), at all times and the
    height [inch] of n pictures of it, in true proportions if that gives more than a strip."""
    places = numpy.concatenate([c[..., :2].reshape(-1, 2) for c in all_outlines])
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * (high - low) + 1e-9
    low, high = low - margin, high + margin
    true = 0.82 * WIDTH * (high[1] - low[1]) / (high[0] - low[0])
    return (low[0], high[0], low[1], high[1] + 0.05 * (high[1] - low[1])), n * min(
        max(true, 1.0), 3.6)


def surfaces(run, time, way):
    """Surfaces of obstacles nearest to this time."""
    series = run.series("obstacles")
    if series is None:
        return []
    corners, _ = series.read(series.nearest(time))
    return [LineCollection(cut_surface(corners, way), colors="black", linewidths=1)]


def frames(run, series, way):
    """The speed at up to five times, the first and the last among them."""
    chosen = numpy.unique(numpy.rint(numpy.linspace(
        0, len(series.times) - 1, min(N_FRAMES, len(series.times)))).astype(int))
    times = series.times[chosen]
    states = [cut_points(*series.read(time), way) for time in times]
    fastest = max(numpy.percentile(values[SPEED], 99.5) for _, values in states
                  if len(values[SPEED]))
    window, height = frame([outlines for outlines, _ in states], len(times))
    figure, rows = subplots(len(times), height=height + 0.5, sharex=True, squeeze=False)
    for axes, time, (outlines, values) in zip(rows[:, 0], times, states):
        drawn = axes.add_collection(boxes(outlines, values[SPEED], (0, fastest or 1)))
        for lines in surfaces(run, time, way):
            axes.add_collection(lines)
        axes.set(xlim=window[:2], ylim=window[2:], ylabel="y [m]")
        axes.set_title(f"t = {time:.4g} s")
        axes.grid(False)
    rows[-1, 0].set_xlabel(label_of(way))
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


# Fields at the end: (beginnings of the name, colours, sentence on the field at a time).
AT_THE_END = [
    (("plastic strain", "plastic shear strain"), "magma",
     "Where the soil was sheared at {} ({}): bright bands are slip surfaces and remoulded soil, "
     "dark blocks travelled as a whole."),
    (("pore pressure ratio",), "viridis",
     "At {} the excess pore pressure over the weight of the soil above at rest ({} r_u): at 1 "
     "friction is lost."),
]


def at_the_end(run, series, way, starts, colors, sentence):
    """Picture of a field at the end; none where it is not written or nowhere above zero."""
    outlines, values = cut_points(*series.read(series.times[-1]), way)
    names = [n for n in values if n.startswith(starts)]
    if not names or not values[names[0]].max() > 0:
        return []
    window, height = frame([outlines], 1)
    figure, axes = subplots(height=height + 0.6)
    limit = numpy.percentile(values[names[0]], 98) or values[names[0]].max()
    drawn = axes.add_collection(boxes(outlines, values[names[0]], (0, limit)))
    drawn.set_cmap(colors)
    for lines in surfaces(run, series.times[-1], way):
        axes.add_collection(lines)
    axes.set(xlim=window[:2], ylim=window[2:], xlabel=label_of(way), ylabel="y [m]")
    axes.grid(False)
    name = names[0].split(" [")[0]
    figure.colorbar(drawn, ax=axes, label=f"{name} [-]", pad=0.01, extend="max")
    return [embed(figure, sentence.format(f"t = {series.times[-1]:.4g} s", name), "png")]


def soil(run):
    """Where the points were written."""
    series = run.series("points")
    if series is None:
        return None
    way = way_of(run)
    where = "" if way is None else f"Upright section along {way.name}. "
    return Section("soil", "The soil in section",
                   f"{where}For all times and fields open points.pvd in ParaView.",
                   [picture for field in AT_THE_END
                    for picture in at_the_end(run, series, way, *field)]
                   + [Folded("The soil at some times", [frames(run, series, way)])])

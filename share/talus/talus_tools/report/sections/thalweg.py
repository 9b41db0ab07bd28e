# SPDX-License-Identifier: LGPL-2.1-or-later
"""What profile.csv tells: thickness and velocity over place and time, and the deposit."""

import numpy

from talus_tools.report.page import BLUE, GREY, Cell, Rows, Section, embed, subplots
from talus_tools.units import show

THICKNESS, VELOCITY = "thickness [m]", "depth-mean velocity [m/s]"
TABLE_HEAD = ["quantity", "largest", "at x =", "at t =", "what it means"]


def places_of(values):
    """The regular places behind values, the index of each, and their distance."""
    unique = numpy.unique(values)
    step = numpy.diff(unique).min() if len(unique) > 1 else 1.0
    index = numpy.rint((values - unique[0]) / step).astype(int)
    return unique[0] + step * numpy.arange(index.max() + 1), index, step


def over_time(table, column, choose):
    """Values of a column by time and place along x; where several (in 3-D across the slope)
    share a place, the one that choose (a ufunc) takes."""
    times, t = numpy.unique(table["time [s]"], return_inverse=True)
    x, i, step = places_of(table["x [m]"])
    values = numpy.full((len(times), len(x)), numpy.nan)
    with numpy.errstate(invalid="ignore"):
        choose.at(values, (t, i), table[column])
    return times, x, step, values


def edges(values, step=None):
    """Edges of the cells about these centres; of times, the cell begins at its time."""
    if step:
        return numpy.append(values - step / 2, values[-1] + step / 2)
    return numpy.append(values, 2 * values[-1] - values[-2])


def diagram(run):
    """Thickness and velocity, place along the page, time upwards."""
    table = run.tables["profile"]
    figure, both = subplots(1, 2, height=3.4, sharey=True)
    for axes, column, colors, label in ((both[0], THICKNESS, "viridis", "thickness [m]"),
                                        (both[1], VELOCITY, "magma", "velocity along x [m/s]")):
        times, x, step, values = over_time(table, column, numpy.fmax)
        axes.grid(False)
        # A few columns at the front, with single points in them, must not take the scale.
        image = axes.pcolormesh(edges(x, step), edges(times), values, cmap=colors,
                                vmin=min(0, numpy.nanpercentile(values, 0.5)),
                                vmax=numpy.nanpercentile(values, 99.5), rasterized=True)
        axes.set_xlabel("x [m]")
        axes.set_ylim(times[0], edges(times)[-1])
        figure.colorbar(image, ax=axes, label=label, pad=0.02, extend="max")
    both[0].set_ylabel("time [s]")
    across = "" if run.dimension == 2 else " Largest values across the slope."
    return embed(figure, "Thalweg–time diagrams: read upwards, the soil spreads along x. The "
                 "slope of its right edge tells how fast the front is; an edge that runs straight "
                 "up has stopped. White: no soil." + across, "png")


def ground_of(table):
    """x and lowest ground of the columns; the bottom of the mesh where there is no terrain."""
    if "ground [m]" not in table:
        x = numpy.unique(table["x [m]"])
        return x, numpy.full(len(x), table["lowest [m]"].min())
    x, i, _ = places_of(table["x [m]"])
    ground = numpy.full(len(x), numpy.nan)
    numpy.fmin.at(ground, i, table["ground [m]"])
    return x[numpy.isfinite(ground)], ground[numpy.isfinite(ground)]


def thickness_at(table, time, x):
    """Thickness at these places and this time, 0 where there is no soil; in 3-D the largest
    across the slope."""
    now = table["time [s]"] == time
    values = numpy.zeros(len(x))
    numpy.maximum.at(values, numpy.searchsorted(x, table["x [m]"][now] - 1e-9 * numpy.ptp(x)),
                     table[THICKNESS][now])
    return values


def magnification(ground, thickest):
    """How many times as large as the bed thickness is drawn, so that it takes a third of the
    height of a picture: 1 on a bed that is nearly flat."""
    return max(1.0, float(f"{0.35 * numpy.ptp(ground) / max(thickest, 1e-12):.1g}"))


def deposit(run):
    """Thickness at the start and at the end over the bed. A layer of some metres on a bed that
    falls by hundreds is seen only if its thickness is drawn larger than the bed."""
    table = run.tables["profile"]
    times = numpy.unique(table["time [s]"])
    x, ground = ground_of(table)
    start, end = (thickness_at(table, time, x) for time in (times[0], times[-1]))
    thickest = max(start.max(), end.max(), 1e-12)
    factor = magnification(ground, thickest)
    figure, axes = subplots(height=2.9)
    axes.plot(x, ground + factor * start, color=GREY, ls="--",
              label=f"t = {times[0]:.4g} s")
    axes.fill_between(x, ground, ground + factor * end, color=BLUE, alpha=0.4, lw=0)
    axes.plot(x, ground + factor * end, color=BLUE, label=f"t = {times[-1]:.4g} s")
    axes.plot(x, ground, color="black", lw=1, label="bed")
    axes.set(xlabel="x [m]", ylabel="height of the bed [m]", xlim=(x[0], x[-1]))
    if factor > 1:
        scale_bar(axes, thickest, factor)
    axes.legend(loc="upper right")
    window = axes.get_window_extent()
    ratio = (numpy.ptp(axes.get_xlim()) / window.width) / (numpy.ptp(axes.get_ylim())
                                                           / window.height)
    across = "" if run.dimension == 2 else ", the largest across the slope,"
    drawn = (f"is drawn {factor:g} times as large as heights of the bed" if factor > 1 else
             "and heights are to the same scale")
    return embed(figure, f"Thickness of the soil{across} over the bed at the start (dashed) and "
                 f"at the end. Thickness {drawn}; heights are drawn about {ratio:.2g} times as "
                 "large as lengths.")


def scale_bar(axes, thickest, factor):
    """A bar of a round thickness at the left edge."""
    size = 10 ** numpy.floor(numpy.log10(thickest))
    size *= 5 if 5 * size <= thickest else 2 if 2 * size <= thickest else 1
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    x, y = left + 0.02 * (right - left), low + 0.06 * (high - low)
    axes.plot([x, x], [y, y + factor * size], color="black", lw=3, solid_capstyle="butt")
    axes.text(x + 0.008 * (right - left), y + factor * size / 2, f"{size:g} m of soil",
              va="center", fontsize=8)


def extremes(run):
    """Largest thickness and velocity with their places."""
    table, rows = run.tables["profile"], []
    for column, name, sentence in (
            (THICKNESS, "thickness of the soil",
             "How deep whatever stands there is buried at most."),
            (VELOCITY, "mean velocity over the depth",
             "With density and thickness, what a drag formula needs.")):
        at = int(numpy.argmax(table[column]))
        rows.append([name, Cell(show(table[column][at], column.split("[")[1][:-1]),
                                repr(float(table[column][at])), column),
                     show(table["x [m]"][at], "m"), show(table["time [s]"][at], "s"), sentence])
    return Rows(TABLE_HEAD, rows)


def thalweg(run):
    """Where profile.csv is; the diagrams need two times."""
    table = run.tables["profile"]
    if table is None:
        return None
    parts = [diagram(run)] if len(numpy.unique(table["time [s]"])) > 1 else []
    parts.append(deposit(run))
    parts.append(extremes(run))
    return Section("thalweg", "Thickness and velocity along the slope",
                   "Sums over the columns of the mesh, by profile.csv: thickness is the volume of "
                   "the soil in a column over its area.", parts)

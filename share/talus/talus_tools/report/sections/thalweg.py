# SPDX-License-Identifier: LGPL-2.1-or-later
"""What profile.csv tells: thickness and velocity over place and time, the deposit, and in
3-D maps of it."""

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


def envelope(table, time):
    """x, lowest and highest of the soil at this time; in 3-D over the width."""
    now = table["time [s]"] == time
    x, i, step = places_of(table["x [m]"][now])
    low, high = numpy.full(len(x), numpy.nan), numpy.full(len(x), numpy.nan)
    numpy.fmin.at(low, i, table["lowest [m]"][now])
    numpy.fmax.at(high, i, table["highest [m]"][now])
    return x, low, high, step


def deposit(run):
    """The soil at the end over that at the start."""
    table = run.tables["profile"]
    times = numpy.unique(table["time [s]"])
    figure, axes = subplots(height=2.5)
    x, low, high, _ = envelope(table, times[0])
    axes.plot(x, high, color=GREY, ls="--", label=f"surface at t = {times[0]:.4g} s")
    x, low, high, _ = envelope(table, times[-1])
    axes.fill_between(x, low, high, color=BLUE, alpha=0.35, lw=0)
    axes.plot(x, high, color=BLUE, label=f"soil at t = {times[-1]:.4g} s")
    if "ground [m]" in table:
        ground, first = numpy.unique(table["x [m]"], return_index=True)
        axes.plot(ground, table["ground [m]"][first], color="black", lw=1, label="ground")
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.legend(loc="upper right")
    aspect = axes.get_window_extent()
    ratio = (numpy.ptp(axes.get_xlim()) / aspect.width) / (numpy.ptp(axes.get_ylim())
                                                           / aspect.height)
    return embed(figure, "The soil at the end, from its lowest to its highest edge, and its "
                 f"surface at the start. Heights are drawn about {ratio:.2g} times as large as "
                 "lengths.")


def plan(run):
    """In 3-D: the thickness at the end from above."""
    table = run.tables["profile"]
    now = table["time [s]"] == table["time [s]"][-1]
    x, i, step = places_of(table["x [m]"][now])
    z, k, _ = places_of(table["z [m]"][now])
    values = numpy.full((len(z), len(x)), numpy.nan)
    values[k, i] = table[THICKNESS][now]
    figure, axes = subplots(height=2.4)
    axes.grid(False)
    image = axes.pcolormesh(edges(x, step), edges(z, step), values, rasterized=True)
    axes.set(xlabel="x [m]", ylabel="z [m]")
    figure.colorbar(image, ax=axes, label="thickness [m]", pad=0.01)
    return embed(figure, "Thickness of the soil at the end, seen from above.", "png")


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
    if run.dimension == 3:
        parts.append(plan(run))
    parts.append(extremes(run))
    return Section("thalweg", "Thickness and velocity along the slope",
                   "Sums over the columns of the mesh, by profile.csv: thickness is the volume of "
                   "the soil in a column over its area.", parts)

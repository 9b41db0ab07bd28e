# SPDX-License-Identifier: LGPL-2.1-or-later
"""What profile.csv tells: thickness and velocity over place and time, and the deposit; in 3-D
along the way of the slide."""

import dataclasses

import numpy

from talus_tools.report.page import BLUE, GREY, Cell, Rows, Section, embed, subplots
from talus_tools.report.on_map import on_map
from talus_tools.report.way import label_of, way_of
from talus_tools.units import show

THICKNESS, VELOCITY = "thickness [m]", "depth-mean velocity [m/s]"
VELOCITY_Z = "depth-mean velocity z [m/s]"


def places_of(values):
    """The regular places behind values, the index of each, and their distance."""
    unique = numpy.unique(values)
    step = numpy.diff(unique).min() if len(unique) > 1 else 1.0
    index = numpy.rint((values - unique[0]) / step).astype(int)
    return unique[0] + step * numpy.arange(index.max() + 1), index, step


@dataclasses.dataclass
class Columns:
    """Rows of profile.csv: time [s]; distance along the section and from it [m]; thickness [m],
    velocity [m/s], in 3-D speed, and height of the ground [m]. `places`: along the section [m],
    evenly; `index`: which of them a column belongs to."""
    time: numpy.ndarray
    index: numpy.ndarray
    along: numpy.ndarray
    away: numpy.ndarray
    thickness: numpy.ndarray
    velocity: numpy.ndarray
    ground: numpy.ndarray
    places: numpy.ndarray
    label: str

    @property
    def step(self):
        """Distance of the places [m]."""
        return self.places[1] - self.places[0] if len(self.places) > 1 else 1.0

    def times(self):
        """All times [s], in their order."""
        return numpy.unique(self.time)

    def over_time(self, values):
        """Values by time and place, shape (times, places); where several columns share a place,
        the largest one."""
        times, t = numpy.unique(self.time, return_inverse=True)
        result = numpy.full((len(times), len(self.places)), numpy.nan)
        with numpy.errstate(invalid="ignore"):
            numpy.fmax.at(result, (t, self.index), values)
        return result

    def bed(self):
        """Where soil was at any time, distances along the section and heights of the ground:
        those of the column that is nearest to the section, for each place."""
        order = numpy.lexsort((self.ground, self.away, self.index))
        _, first = numpy.unique(self.index[order], return_index=True)
        return self.along[order][first], self.ground[order][first]

    def thickness_at(self, time):
        """Largest thickness at this time at the places of bed(), 0 where there is no soil."""
        result = numpy.zeros(len(self.places))
        now = self.time == time
        numpy.maximum.at(result, self.index[now], self.thickness[now])
        return result[numpy.unique(self.index)]


def columns_of(run, way):
    """The columns along x, in 3-D along a way; heights of the ground are those of the bottom of
    the mesh where there is no terrain."""
    table = run.tables["profile"]
    x, index, step = places_of(table["x [m]"])
    along, away, velocity = table["x [m]"], numpy.zeros(len(table)), table[VELOCITY]
    if way:
        along, away, _ = way.project(numpy.stack([table["x [m]"], table["z [m]"]], axis=-1))
        step = way.width(step)
        index = numpy.rint((along - along.min()) / step).astype(int)
        x = along.min() + step * numpy.arange(index.max() + 1)
        velocity = numpy.hypot(velocity, table[VELOCITY_Z])
    ground = (table["ground [m]"] if "ground [m]" in table else
              numpy.full(len(table), table["lowest [m]"].min()))
    return Columns(table["time [s]"], index, along, away, table[THICKNESS], velocity, ground,
                   x, label_of(way))


def edges(values, step=None):
    """Edges of the cells about these centres; of times, the cell begins at its time."""
    if step:
        return numpy.append(values - step / 2, values[-1] + step / 2)
    return numpy.append(values, 2 * values[-1] - values[-2])


def diagram(columns, way):
    """Thickness and velocity, place along the page, time upwards."""
    figure, both = subplots(1, 2, height=3.4, sharey=True)
    times = columns.times()
    velocity = "mean speed over the depth [m/s]" if way else "velocity along x [m/s]"
    for axes, values, colors, label in (
            (both[0], columns.thickness, "viridis", "thickness [m]"),
            (both[1], columns.velocity, "magma", velocity)):
        axes.grid(False)
        # A few columns at the front, with single points in them, must not take the scale.
        image = axes.pcolormesh(edges(columns.places, columns.step), edges(times),
                                columns.over_time(values), cmap=colors,
                                vmin=min(0, numpy.nanpercentile(values, 0.5)),
                                vmax=max(0, numpy.nanpercentile(values, 99.5)), rasterized=True)
        axes.set_xlabel(columns.label)
        axes.set_ylim(times[0], edges(times)[-1])
        figure.colorbar(image, ax=axes, label=label, pad=0.02,
                        extend="max" if values.min() >= 0 else "both")
    both[0].set_ylabel("time [s]")
    where = "along the way. Largest values across it." if way else "along x."
    return embed(figure, "Thalweg–time diagrams: read upwards, the soil spreads. The slope of the "
                 "edge of the soil tells how fast the front is; an edge that runs straight up has "
                 f"stopped. White: no soil. Places are {where}", "png")


def magnification(ground, thickest):
    """How many times as large as the bed thickness is drawn, so that it takes a third of the
    height of a picture: 1 on a bed that is nearly flat."""
    return max(1.0, float(f"{0.35 * numpy.ptp(ground) / max(thickest, 1e-12):.1g}"))


def deposit(columns, way):
    """Thickness at the start and at the end over the bed. A layer of some metres on a bed that
    falls by hundreds is seen only if its thickness is drawn larger than the bed."""
    times = columns.times()
    x, ground = columns.bed()
    start, end = (columns.thickness_at(time) for time in (times[0], times[-1]))
    thickest = max(start.max(), end.max(), 1e-12)
    factor = magnification(ground, thickest)
    figure, axes = subplots(height=2.9)
    axes.plot(x, ground + factor * start, color=GREY, ls="--",
              label=f"t = {times[0]:.4g} s")
    axes.fill_between(x, ground, ground + factor * end, color=BLUE, alpha=0.4, lw=0)
    axes.plot(x, ground + factor * end, color=BLUE, label=f"t = {times[-1]:.4g} s")
    axes.plot(x, ground, color="black", lw=1, label="bed")
    axes.set(xlabel=columns.label, ylabel="height of the bed [m]", xlim=(x[0], x[-1]))
    if factor > 1:
        scale_bar(axes, thickest, factor)
    axes.legend(loc="upper right")
    window = axes.get_window_extent()
    ratio = (numpy.ptp(axes.get_xlim()) / window.width) / (numpy.ptp(axes.get_ylim())
                                                           / window.height)
    across = ", the largest across the way," if way else ""
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


def extremes(run, columns, way):
    """Largest thickness and velocity with their places."""
    table, rows = run.tables["profile"], []
    for column, values, name, sentence in (
            (THICKNESS, columns.thickness, "thickness of the soil",
             "How deep whatever stands there is buried at most."),
            (VELOCITY, columns.velocity, "mean velocity over the depth",
             "With density and thickness, what a drag formula needs.")):
        at = int(numpy.argmax(numpy.abs(values)))
        cells = [show(columns.along[at], "m")]
        if way:
            east, north = on_map(run, table["x [m]"][at], table["z [m]"][at])
            cells.append(f"E\xa0{east:.0f}, N\xa0{north:.0f}")
        rows.append([name, Cell(show(values[at], column.split("[")[1][:-1]),
                                repr(float(values[at])), column),
                     *cells, show(table["time [s]"][at], "s"), sentence])
    where = ["along the way", "on the map"] if way else ["at x ="]
    return Rows(["quantity", "largest", *where, "at t =", "what it means"], rows)


def thalweg(run):
    """Where profile.csv is; the diagrams need two times."""
    if run.tables["profile"] is None:
        return None
    way = way_of(run)
    columns = columns_of(run, way)
    parts = [diagram(columns, way)] if len(columns.times()) > 1 else []
    parts += [deposit(columns, way), extremes(run, columns, way)]
    along = f", along {way.name}" if way else ""
    return Section("thalweg", "Thickness and velocity along the slope",
                   f"Of the columns of the mesh, by profile.csv{along}: thickness is the volume of "
                   "the soil in a column over its area.", parts)

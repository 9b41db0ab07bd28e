# SPDX-License-Identifier: LGPL-2.1-or-later
"""Maps: the bathymetry in shaded relief with a quantity over it, in 2-D lines over x."""

import dataclasses
import os

import numpy
from matplotlib.colors import LightSource

from talus_tools.errors import UserError
from talus_tools.esri import read_grid
from talus_tools.report.page import (COLORS, WIDTH, Cell, Folded, Rows, Section, embed,
                                     subplots)
from talus_tools.report.places import draw_places, places_of
from talus_tools.units import plain, scaled, show

# Name of the file: (unit, colours, what it means), in the order of the page.
MEANINGS = {
    "maximum-thickness": ("m", "viridis", "How deep a place is buried at most."),
    "maximum-speed": ("m/s", "magma", "The largest mean speed over the depth."),
    "maximum-momentum-flux": ("N/m", "plasma", "Density, thickness and speed squared: what "
                              "loads whatever stands there."),
    "maximum-bed-shear": ("Pa", "cividis", "Shear stress on the bed: what erodes it."),
    "arrival-time": ("s", "YlGnBu_r", "When the soil first is as thick as the name says."),
    "time-of-maximum": ("s", "YlGnBu_r", "When the largest value was reached."),
    "final-thickness": ("m", "viridis", "At the last time, in the release area, too."),
    "thickness-at-start": ("m", "viridis", "Before anything moved."),
    "final-mass": ("kg/m^2", "viridis", "Mass per area at the last time."),
    "largest-pore-pressure-ratio": ("", "viridis", "At the last time, largest over the depth: the "
                                    "excess pore pressure over the weight of the soil above at "
                                    "rest."),
    "excess-pore-pressure-at-the-bed": ("Pa", "viridis", "At the last time, at the base of the "
                                        "soil."),
    "erosion": ("m", "RdBu_r", "Thickness that a place lost; below zero, what it gained."),
}
GROUND = "ground"
# The same of columns of maps.csv.
FIRST_COLUMNS = ("thickness at start", "maximum thickness", "final thickness", "maximum speed",
                 "arrival time")
# Maps that a reader looks for first; the others are folded.
FIRST = ("maximum-thickness", "maximum-speed", "arrival-time")
TABLE_HEAD = ["quantity", "largest", "where", "covered", "what it means"]


def meaning(name):
    """Unit, colours and sentence by the longest name that the file's begins with."""
    known = [key for key in MEANINGS if name.startswith(key)]
    return MEANINGS[max(known, key=len)] if known else ("", "viridis", "")


def order(name):
    """Place of a map on the page: as in MEANINGS, others behind."""
    known = [i for i, key in enumerate(MEANINGS) if name.startswith(key)]
    return (known[-1] if known else len(MEANINGS), name)


def title(name):
    """As people say it."""
    return name.replace("-", " ")


def note_on_thin_soil(run):
    """What of thin soil is not counted."""
    return ("Speed, momentum flux, bed shear and impact pressure are 0 where soil is thinner than "
            f"{run.smallest_thickness('Maps'):g} m ('Maps/Smallest thickness').")


def read_maps(folder):
    """{name: Grid} of all rasters of a folder; the ground must have the same cells."""
    grids = {entry[:-4]: read_grid(os.path.join(folder, entry))
             for entry in sorted(os.listdir(folder)) if entry.endswith(".asc")}
    ground = grids.get(GROUND)
    for name, grid in grids.items():
        if ground and not grid.is_aligned_with(ground):
            raise UserError(f"'{os.path.join(folder, name)}.asc' has other cells than "
                            f"'{GROUND}.asc' beside it; both are expected to be of the same run.")
    return grids


def visible(values):
    """What is drawn over the ground: neither nothing nor zero."""
    return numpy.ma.masked_where(~numpy.isfinite(values) | (values == 0), values)


def window(grids, places=()):
    """(first row, last row, first column, last column) of the cells where anything happens,
    with a margin, so that a small slide is seen in a large bathymetry; places (easting,
    northing) that are not far from there are within it, too."""
    some = next(iter(grids.values()))
    hit = numpy.zeros(some.values.shape, dtype=bool)
    for name, grid in grids.items():
        if name != GROUND and grid.values.shape == hit.shape:
            hit |= ~numpy.ma.getmaskarray(visible(grid.values))
    if not hit.any():
        return 0, hit.shape[0], 0, hit.shape[1]
    ranges = [(there[0], there[-1]) for there in
              (numpy.flatnonzero(hit.any(axis=axis)) for axis in (1, 0))]
    near = [cell for cell in (some.cell(*place) for place in places)
            if all(2 * low - high <= i <= 2 * high - low
                   for i, (low, high) in zip(cell, ranges))]
    result = []
    for axis, (low, high) in enumerate(ranges):
        low = min([low, *(cell[axis] for cell in near)])
        high = max([high, *(cell[axis] for cell in near)])
        margin = 3 + (high - low) // 6
        result += [max(0, low - margin), min(hit.shape[axis], high + 1 + margin)]
    return tuple(result)


def relief(axes, ground):
    """Shaded relief with contours of the height."""
    heights, extent = ground.values, ground.extent()
    filled = numpy.where(numpy.isfinite(heights), heights, numpy.nanmean(heights))
    # A slope of a degree must be seen as well as one of thirty.
    steep = numpy.hypot(*numpy.gradient(filled, ground.dy, ground.dx)).max() or 1
    shade = LightSource(azdeg=315, altdeg=45).hillshade(
        filled, vert_exag=0.7 / steep, dx=ground.dx, dy=ground.dy)
    axes.imshow(shade, cmap="gray", vmin=-0.6, vmax=1.05, extent=extent, interpolation="bilinear")
    if numpy.ptp(filled) > 0:
        lines = axes.contour(filled, levels=8, colors="#4a565f", linewidths=0.5, linestyles="solid",
                             extent=extent, origin="upper")
        axes.clabel(lines, fontsize=6.5, fmt="%g")


def draw_ground(axes, ground, extent):
    """Relief of those cells of the ground that lie within a window (west, east, south, north)."""
    west, east, south, north = extent
    top, left = numpy.clip(ground.cell(west, north), 0, None)
    bottom, right = ground.cell(east, south)
    part = ground.part(top, min(bottom + 1, ground.values.shape[0]), left,
                       min(right + 1, ground.values.shape[1]))
    if min(part.values.shape) > 1:
        relief(axes, part)


def limits(values, unit):
    """Ends of the scale of colours: both signs alike, times from the first, all else from
    zero to where 99.5 % of the cells are below."""
    if not values.count():
        return {}
    low, high = values.min(), numpy.percentile(values.compressed(), 99.5)
    size = max(abs(low), abs(high))
    if low < 0 < high:
        return {"vmin": -size, "vmax": size}
    return {"vmin": low if unit == "s" else min(low, 0), "vmax": max(high, low)}


def draw(axes, grid, ground, part, colors, **options):
    """A grid, and below it the ground if it is known; part: see window()."""
    shown = grid.part(*part)
    if ground and min(shown.values.shape) > 1:
        relief(axes, ground.part(*part))
    axes.set(xlabel="easting [m]", ylabel="northing [m]")
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.grid(False)
    return axes.imshow(visible(shown.values), cmap=colors, extent=shown.extent(), alpha=0.82,
                       interpolation="nearest", **options)


def height_of(grid, part):
    """Height of a map over the width of the page [inch]."""
    shape = (part[1] - part[0]) * grid.dy / ((part[3] - part[2]) * grid.dx)
    return min(max(0.8 * WIDTH * shape + 0.6, 2.2), 6.5)


def picture(name, grids, part, places):
    """One map."""
    grid, (unit, colors, sentence) = grids[name], meaning(name)
    places = places.within(grid.part(*part).extent())
    factor, unit = scaled(numpy.nanmax(numpy.abs(grid.values), initial=0), unit)
    shown = dataclasses.replace(grid, values=grid.values / factor)
    figure, axes = subplots(height=height_of(grid, part))
    image = draw(axes, shown, grids.get(GROUND), part, colors,
                 **limits(visible(shown.values), unit))
    draw_places(axes, places)
    figure.colorbar(image, ax=axes, label=f"{title(name)} [{unit}]".replace(" []", ""), pad=0.01)
    over = " over the shaded bathymetry; contours: its height [m]" if GROUND in grids else ""
    return embed(figure, f"{title(name).capitalize()}{over}. {sentence}"
                 + places.legend(), "png")


def row(name, grid):
    """Largest value, its place, and the area with a value."""
    unit, _, sentence = meaning(name)
    values = visible(grid.values)
    if not values.count():
        return [title(name), "nowhere", "–", "–", sentence]
    at = numpy.unravel_index(numpy.ma.argmax(values), values.shape)
    east, north = grid.place(*at)
    area = values.count() * grid.dx * grid.dy
    return [title(name), Cell(show(values[at], unit), repr(float(values[at])), name),
            f"E\xa0{east:.0f}, N\xa0{north:.0f}",
            f"{plain(area / 1e6)} km²" if area >= 1e5 else f"{plain(area)} m²", sentence]


def plan_maps(run):
    """In 3-D, the rasters in the folder maps."""
    grids = read_maps(run.path("maps"))
    names = sorted((name for name in grids if name != GROUND), key=order)
    if not names:
        return None
    places = places_of(run, grids)
    part = window(grids, places.points())
    first = [name for start in FIRST for name in names if name.startswith(start)][:len(FIRST)]
    others = [name for name in names if name not in first]
    parts = [picture(name, grids, part, places) for name in first]
    parts.append(Rows(TABLE_HEAD, [row(name, grids[name]) for name in first or names]))
    if first and others:
        parts.append(Folded(f"{len(others)} more maps",
                            [Rows(TABLE_HEAD, [row(name, grids[name]) for name in others])]
                            + [picture(name, grids, part, places) for name in others]))
    elif others:
        parts += [picture(name, grids, part, places) for name in others]
    return Section("maps", "Maps",
                   "What happened at each place over the whole run, on the raster of the "
                   "bathymetry. The same rasters are in the folder maps, for any geographic "
                   "information system. " + note_on_thin_soil(run), parts)


def section_rows(table, names):
    """Largest value of each column, and where."""
    rows = []
    for name in names:
        if not numpy.isfinite(table[name]).any():
            continue
        at = int(numpy.nanargmax(table[name]))
        text, _, unit = name.partition(" [")
        rows.append([text, Cell(show(table[name][at], unit.rstrip("]")),
                                repr(float(table[name][at])), name),
                     f"x = {plain(table['x [m]'][at])} m",
                     meaning(text.replace(" ", "-"))[2]])
    return rows


def section_maps(run):
    """In 2-D, the columns of maps.csv over x: those that a reader looks for first, and the
    others, folded."""
    table = run.tables["maps"]
    names = [name for name in table.names if name not in ("x [m]", "ground [m]")]
    first = [name for name in names if name.startswith(FIRST_COLUMNS)]
    others = [name for name in names if name not in first]
    parts = over_x(table, first) if first else []
    if others:
        parts.append(Folded(f"{len(others)} more quantities", over_x(table, others)))
    return Section("maps", "Largest values and arrival along the slope",
                   "What happened at each place over the whole run, as in maps.csv. "
                   + note_on_thin_soil(run), parts)


def over_x(table, names):
    """Columns over x, those of one unit together, and their largest values."""
    units = list(dict.fromkeys(name.partition(" [")[2].rstrip("]") for name in names))
    figure, rows = subplots(len(units), height=0.5 + 1.9 * len(units), sharex=True, squeeze=False)
    for axes, unit in zip(rows[:, 0], units):
        mine = [name for name in names if name.partition(" [")[2].rstrip("]") == unit]
        for name, color in zip(mine, COLORS * 3):
            axes.plot(table["x [m]"], table[name], color=color, label=name.partition(" [")[0])
        axes.set_ylabel(f"[{unit}]")
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    rows[-1, 0].set_xlabel("x [m]")
    return [embed(figure, "Over x; a gap is where the soil never was."),
            Rows(["quantity", "largest", "where", "what it means"], section_rows(table, names))]


def maps(run):
    """Where the run has written maps."""
    if run.tables["maps"]:
        return section_maps(run)
    return plan_maps(run) if os.path.isdir(run.path("maps")) else None

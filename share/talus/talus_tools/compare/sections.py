# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of the comparison, each a function of the pair of runs that returns a Section or
None."""

import numpy

from talus_tools.report.headline import headline
from talus_tools.report.notices import notices
from talus_tools.report.page import (BLUE, RED, WIDTH, Cell, Folded, Lines, Rows, Section, embed,
                                     subplots)
from talus_tools.report.places import draw_places, places_of, structure_names
from talus_tools.report.sections.lines import DISTANCE, FIRST as FIRST_ON_LINES, has_soil
from talus_tools.report.sections.maps import (FIRST, FIRST_COLUMNS, GROUND, draw, limits, meaning,
                                              title, visible, window)
from talus_tools.report.sections.stations import THICKNESS, columns_of_stations
from talus_tools.report.sections.thalweg import columns_of, magnification
from talus_tools.report.way import way_of
from talus_tools.tables import read_lines
from talus_tools.units import plain, scaled, show, unit_of

STYLES = ({"color": BLUE}, {"color": RED, "ls": "--"})
# Columns over time by table.
HISTORIES = {"runout": ("front along path [m]", "rear along path [m]",
                        "speed of the centre [m/s]"),
             "statistics": ("front x [m]", "centre velocity x [m/s]", "maximum speed [m/s]",
                            "kinetic energy [J]", "friction work [J]", "gravity work [J]")}
DIFFERENCE = "B − A"


def per_cent(a, b):
    """The difference as a share of A."""
    return f"{plain(100 * (b - a) / abs(a), 3)} %" if a != 0 else "–"


def numbers(pair):
    """The headline numbers of both."""
    a, b = ({tile.name: tile for tile in headline(run)} for run in pair.runs)
    rows = []
    for name in (name for name in a if name in b):
        values = [float(tiles[name].value) for tiles in (a, b)]
        difference = values[1] - values[0]
        rows.append([name, *(Cell(tiles[name].text, tiles[name].value, f"{letter} {name}")
                             for letter, tiles in zip("AB", (a, b))),
                     Cell(show(difference, a[name].unit), repr(difference), f"{DIFFERENCE} {name}"),
                     per_cent(*values)])
    times = [run.time for run in pair.runs]
    said = [f"A ends at t = {plain(times[0])} s, B at t = {plain(times[1])} s: numbers and maps "
            "“at the end” are those of different times."] if abs(
                times[1] - times[0]) > 0.01 * max(times) else []
    return Section("numbers", "Headline numbers", "The tiles of both reports.",
                   [Lines(said), Rows(["quantity", *pair.labels, DIFFERENCE, "of A"], rows)])


def differing(pair):
    """Parameters and program that differ."""
    rows = [[name.replace("/", " / "), *values] for name, *values in pair.changed_entries()]
    versions = [run.versions[0] if run.versions else "not told" for run in pair.runs]
    if versions[0] != versions[1]:
        rows.insert(0, ["program", *versions])
    parts = [Rows(["entry", *pair.labels], rows)] if rows else [
        Lines(["Nothing: program and parameters are the same."])]
    return Section("differing", "What differs", "Program and parameters, but for the folder.",
                   parts)


def time_histories(pair):
    """Histories of both over time, with the largest distance between them."""
    parts = []
    for file, columns in HISTORIES.items():
        tables = pair.tables(file)
        names = [name for name in columns if tables and all(name in table for table in tables)]
        parts += curves(pair, tables, names, "time [s]")
    return Section("histories", "Histories", "Of the slide as a whole.", parts)


def curves(pair, tables, names, along):
    """Pictures of columns of both tables, three in a row, and the largest differences."""
    rows_of_axes = -(-len(names) // 3)
    if not names:
        return []
    figure, grid = subplots(rows_of_axes, 3, height=0.4 + 2.2 * rows_of_axes, squeeze=False)
    rows = []
    for axes, name in zip(grid.flat, names):
        unit = unit_of(name, pair.a.dimension)
        factor, shown = scaled(max(numpy.nanmax(numpy.abs(t[name]), initial=0) for t in tables),
                               unit)
        for table, label, style in zip(tables, pair.labels, STYLES):
            axes.plot(table[along], table[name] / factor, label=label, lw=1.3, **style)
        axes.set_title(f"{name.partition(' [')[0]} [{shown}]".replace(" []", ""))
        axes.set_xlabel(along)
        rows.append(largest_difference(tables, name, along, unit))
    for axes in grid.flat[len(names):]:
        axes.set_axis_off()
    return [embed(figure, f"{pair.labels[0]} in blue, {pair.labels[1]} in red and dashed."),
            Rows(["quantity", "largest " + DIFFERENCE, f"at {along.partition(' [')[0]}"], rows)]


def largest_difference(tables, name, along, unit):
    """Row with the largest difference of B and A over the places or times of A that B has."""
    a, b = tables
    inside = (a[along] >= b[along].min()) & (a[along] <= b[along].max())
    difference = numpy.interp(a[along], b[along], b[name]) - a[name]
    difference[~inside | ~numpy.isfinite(difference)] = 0
    at = int(numpy.argmax(numpy.abs(difference)))
    return [name.partition(" [")[0], Cell(show(difference[at], unit), repr(float(difference[at])),
                                          f"{DIFFERENCE} {name}"),
            show(a[along][at], along.partition("[")[2].rstrip("]"))]


def difference_of(name, a, b):
    """B − A: no soil counts as 0, but has no time."""
    values = ([grid.values for grid in (a, b)] if meaning(name)[0] == "s" else
              [numpy.nan_to_num(grid.values) for grid in (a, b)])
    return type(a)(values[1] - values[0], a.west, a.south, a.dx, a.dy)


def three_maps(pair, name, grids, ground, part, places):
    """A and B in the same colours, and below them their difference."""
    a, b = grids
    unit, colors, _ = meaning(name)
    difference = difference_of(name, a, b)
    shape = (part[1] - part[0]) * a.dy / ((part[3] - part[2]) * a.dx)
    height = min(max(0.42 * WIDTH * shape + 0.7, 1.9), 4.5)
    figure, axes = subplots(2, 2, height=2 * height, squeeze=False)
    both = numpy.ma.concatenate([visible(a.values).ravel(), visible(b.values).ravel()])
    for one, grid, label in zip(axes[0], grids, pair.labels):
        image = draw(one, grid, ground, part, colors, **limits(both, unit))
        draw_places(one, places)
        one.set_title(label)
        figure.colorbar(image, ax=one, label=f"{title(name)} [{unit}]", pad=0.01)
    size = numpy.nanmax(numpy.abs(difference.values), initial=0) or 1
    image = draw(axes[1, 0], difference, ground, part, "RdBu_r", vmin=-size, vmax=size)
    draw_places(axes[1, 0], places)
    axes[1, 0].set_title(DIFFERENCE)
    for one in (*axes[0], axes[1, 0]):
        one.locator_params(nbins=4)
    figure.colorbar(image, ax=axes[1, 0], label=f"{DIFFERENCE} [{unit}]", pad=0.01)
    histogram(axes[1, 1], difference, unit)
    return embed(figure, f"{title(name).capitalize()} of both and the difference: red where B has "
                 "more." + places.legend(), "png")


def histogram(axes, difference, unit):
    """Areas by difference."""
    values = difference.values[numpy.isfinite(difference.values) & (difference.values != 0)]
    if not len(values):
        axes.set_axis_off()
        axes.text(0.5, 0.5, "no difference anywhere", ha="center", transform=axes.transAxes)
        return
    area = difference.dx * difference.dy / 1e4
    axes.hist(values, bins=40, weights=numpy.full(len(values), area), color="#5b6670")
    axes.set(xlabel=f"{DIFFERENCE} [{unit}]", ylabel="area [ha]")
    axes.set_title("area by difference")


def row(name, a, b):
    """Largest values, largest difference, and the area that both cover."""
    unit = meaning(name)[0]
    there = [~numpy.ma.getmaskarray(visible(grid.values)) for grid in (a, b)]
    values = numpy.nan_to_num(difference_of(name, a, b).values)
    at = numpy.unravel_index(numpy.argmax(numpy.abs(values)), values.shape)
    east, north = a.place(*at)
    either = numpy.count_nonzero(there[0] | there[1])
    shared = numpy.count_nonzero(there[0] & there[1]) / either if either else 1
    return [title(name),
            *(show(numpy.nanmax(grid.values[mask], initial=0), unit)
              for grid, mask in zip((a, b), there)),
            Cell(show(values[at], unit), repr(float(values[at])), f"{DIFFERENCE} {name}"),
            f"E\xa0{east:.0f}, N\xa0{north:.0f}", f"{plain(100 * shared, 3)} %"]


def maps(pair):
    """In 3-D the rasters, in 2-D the columns of maps.csv."""
    tables = pair.tables("maps")
    if tables:
        names = [name for name in tables[0].names
                 if name.startswith(FIRST_COLUMNS) and name in tables[1]]
        return Section("maps", "Largest values and arrival along the slope", "As in maps.csv.",
                       curves(pair, tables, names, "x [m]"))
    grids = pair.maps()
    ground, _ = grids.pop(GROUND, (None, None))
    names = [name for start in (*FIRST, "final-thickness") for name in grids
             if name.startswith(start)]
    if not names:
        return None
    places = places_of(pair.a, {name: a for name, (a, _) in grids.items()})
    part = window({f"{k} {name}": grid for name in names for k, grid in enumerate(grids[name])},
                  places.points())
    places = places.within(grids[names[0]][0].part(*part).extent())
    said = "" if pair.has_same_cells() else (
        " The rasters differ: B is taken at the centres of the cells of A.")
    return Section("maps", "Maps", "What happened at each place over the whole run." + said,
                   [three_maps(pair, name, grids[name], ground, part, places) for name in names]
                   + [Rows(["quantity", "largest in A", "largest in B", "largest " + DIFFERENCE,
                            "there", "area in common"],
                           [row(name, *grids[name]) for name in names])])


def deposit(pair):
    """The thickness at the end of both, over the bed; in 3-D along the way of A."""
    if not pair.tables("profile"):
        return None
    way = way_of(pair.a)
    both = [columns_of(run, way) for run in pair.runs]
    ends = [columns.times()[-1] for columns in both]
    beds = [columns.bed() for columns in both]
    layers = [columns.thickness_at(end) for columns, end in zip(both, ends)]
    factor = magnification(numpy.concatenate([bed[1] for bed in beds]),
                           max(layer.max() for layer in layers))
    figure, axes = subplots(height=2.9)
    for (x, ground), layer, end, label, style in zip(beds, layers, ends, pair.labels, STYLES):
        axes.plot(x, ground, color="black", lw=1)
        axes.plot(x, ground + factor * layer, label=f"{label}, t = {end:.4g} s", **style)
    axes.set(xlabel=both[0].label, ylabel="height of the bed [m]")
    axes.legend(loc="upper right")
    along = (f" Along {way.name} of A, largest thickness across it." if way else "")
    return Section("deposit", "Thickness at the end", "Over the bed, which is black." + along,
                   [embed(figure, f"Thickness is drawn {factor:g} times as large as heights of the "
                          "bed." if factor > 1 else "Thickness and heights are to the same "
                          "scale.")])


def forces(pair):
    """Forces on structures that both have."""
    tables = pair.tables("obstacles")
    if not tables:
        return None
    both = [name for name in structure_names(pair.a).values()
            if name in structure_names(pair.b).values()]
    names = [f"{name} force {axis} [N]" for name in both for axis in "xyz"[:pair.a.dimension]]
    names = [name for name in names if all(name in table for table in tables)]
    return Section("forces", "Forces on structures", "Means over each row of the table.",
                   curves(pair, tables, names, "time [s]")) if names else None


def stations(pair):
    """Thickness at the stations that both have."""
    tables = pair.tables("stations")
    if not tables:
        return None
    names = [name + THICKNESS for name in columns_of_stations(pair.a)
             if name + THICKNESS in tables[1]]
    names = [name for name in names if any(table[name].any() for table in tables)]
    return Section("stations", "Thickness at stations", "Of those that soil reached.",
                   curves(pair, tables, names, "time [s]")) if names else None


def lines(pair):
    """What a reader looks for first along the lines that both have."""
    both = [read_lines(run.path("lines.csv")) if run.has("lines.csv") else {} for run in pair.runs]
    parts = []
    for line in (line for line in both[0] if line in both[1]):
        tables = [groups[line] for groups in both]
        names = [name for name in tables[0] if name.startswith(FIRST_ON_LINES)
                 and name in tables[1] and any(has_soil(table, name) for table in tables)]
        distance = next(name for name in tables[0] if name.startswith(DISTANCE))
        if names:
            parts += [Lines([f"Along {line or 'the line'}:"]),
                      *curves(pair, tables, names, distance)]
    return Section("lines", "Along lines", "Largest values of the whole run along the lines that "
                   "both have and soil reached.", parts) if parts else None


def told(pair):
    """The notices of both reports."""
    return Section("notices-of-both", "Notices", "What to know of each run before its numbers are "
                   "used.", [Folded(label + f" ({len(notices(run))})",
                                    [Lines(notices(run) or ["None."])])
                             for label, run in zip(pair.labels, pair.runs)])


SECTIONS = [numbers, differing, maps, deposit, time_histories, forces, stations, lines,
            told]

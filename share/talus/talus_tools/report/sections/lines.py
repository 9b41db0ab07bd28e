# SPDX-License-Identifier: LGPL-2.1-or-later
"""Envelopes along lines on the ground: lines.csv."""

import numpy

from talus_tools.errors import UserError
from talus_tools.report.page import COLORS, Cell, Folded, Lines, Rows, Section, embed, subplots
from talus_tools.report.sections.maps import note_on_thin_soil
from talus_tools.tables import read_lines
from talus_tools.units import plain, show

DISTANCE = "distance"
# What a reader looks for first; pictures of the rest are folded.
FIRST = ("maximum thickness", "maximum speed", "maximum impact pressure", "arrival time")


def has_soil(columns, quantity):
    """Whether a quantity is anything but zero or missing somewhere on a line."""
    return bool(numpy.nan_to_num(columns[quantity]).any())


def picture(groups, distance, quantities):
    """One diagram per quantity, with all lines in it."""
    figure, rows = subplots(len(quantities), height=0.5 + 1.8 * len(quantities), sharex=True,
                            squeeze=False)
    for axes, quantity in zip(rows[:, 0], quantities):
        for (line, columns), color in zip(groups.items(), COLORS * 3):
            axes.plot(columns[distance], columns[quantity], color=color, label=line or None)
        axes.set_title(quantity)
    if any(groups):
        rows[0, 0].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    rows[-1, 0].set_xlabel(distance)
    return embed(figure, "Along each line: the largest values of the whole run.")


def rows_of(groups, distance, quantities):
    """Largest value of each quantity on each line, and where."""
    rows = []
    for line, columns in groups.items():
        for quantity in quantities:
            values = columns[quantity]
            if not has_soil(columns, quantity):
                continue
            at = int(numpy.nanargmax(values))
            text, _, unit = quantity.partition(" [")
            rows.append([line or "–", text, Cell(show(values[at], unit.rstrip("]")),
                                                 repr(float(values[at])), quantity),
                         f"{plain(columns[distance][at])} m"])
    return rows


def parts_of(groups, distance, quantities, missed):
    """Pictures and table of the quantities that are not zero everywhere; `missed`: names of the
    lines that no soil reached."""
    said = [f"No soil reached the line{'s' if len(missed) > 1 else ''} {', '.join(missed)}."
            ] if missed else []
    first = [name for start in FIRST for name in quantities if name.startswith(start)]
    rest = [name for name in quantities if name not in first]
    pictures = [picture(groups, distance, first)] if first else []
    if rest:
        pictures.append(Folded("Other quantities along lines", [picture(groups, distance, rest)]))
    table = Rows(["line", "quantity", "largest", "at distance"],
                 rows_of(groups, distance, quantities))
    return [Lines(said), *pictures, *([table] if quantities else [])]


def lines(run):
    """Where lines.csv has rows."""
    groups = read_lines(run.path("lines.csv")) if run.has("lines.csv") else {}
    if not groups:
        return None
    names = list(next(iter(groups.values())))
    distances = [name for name in names if name.startswith(DISTANCE)]
    if not distances:
        raise UserError(f"'{run.path('lines.csv')}' has no column '{DISTANCE} [m]', over which its "
                        "quantities are to be drawn.")
    places = ("x [m]", "y [m]", "z [m]", "easting [m]", "northing [m]")
    quantities = [name for name in names if name not in places and name not in distances]
    quantities = [name for name in quantities
                  if any(has_soil(columns, name) for columns in groups.values())]
    missed = [name or "line" for name, columns in groups.items()
              if not any(has_soil(columns, quantity) for quantity in quantities)]
    return Section("lines", "Along lines", "Cables, pipelines and other lines on the ground, from "
                   "their first corner on. " + note_on_thin_soil(run), parts_of(groups, distances[0], quantities, missed))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Histories at stations, and envelopes along lines."""

import numpy

from talus_tools.report.page import COLORS, Cell, Lines, Rows, Section, embed, subplots
from talus_tools.report.on_map import station_names
from talus_tools.units import show, unit_of

TIME, THICKNESS = "time [s]", " thickness [m]"
MOST = 6  # stations in one picture


def columns_of_stations(run):
    """{station: {quantity with unit: column}}. The table has the same quantities of one station
    after another, in the order of the parameters; a name alone may fit columns of two stations."""
    table, names = run.tables["stations"], station_names(run)
    n = (len(table.names) - 1) // max(len(names), 1)
    blocks = {name: table.names[1 + n * i:1 + n * (i + 1)] for i, name in enumerate(names)}
    return {name: {column[len(name) + 1:]: column for column in block}
            for name, block in blocks.items()
            if name + THICKNESS in block and all(c.startswith(name + " ") for c in block)}


def histories(table, columns):
    """One picture per quantity, with at most MOST stations in each."""
    quantities = list(dict.fromkeys(q for own in columns.values() for q in own))
    names = list(columns)[:MOST]
    figure, rows = subplots(len(quantities), height=0.5 + 1.7 * len(quantities), sharex=True,
                            squeeze=False)
    for axes, quantity in zip(rows[:, 0], quantities):
        for name, color in zip(names, COLORS):
            if quantity in columns[name]:
                axes.plot(table[TIME], table[columns[name][quantity]], color=color, label=name,
                          lw=1.2)
        axes.set_title(quantity)
        axes.set_xlim(0, table[TIME][-1])
    rows[0, 0].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    rows[-1, 0].set_xlabel("time [s]")
    rest = len(columns) - len(names)
    more = f" {rest} more are in stations.csv and in the table." if rest > 0 else ""
    return embed(figure, "Histories at the stations." + more)


def arrival(table, column):
    """The time of the first row with soil, as text."""
    there = numpy.flatnonzero(table[column] > 0)
    return show(table[TIME][there[0]], "s") if len(there) else "never"


def rows_of(table, columns, dimension):
    """Largest magnitude of each quantity, with its time."""
    rows = []
    for name, own in columns.items():
        for quantity, column in own.items():
            values = numpy.nan_to_num(table[column])
            at = int(numpy.argmax(numpy.abs(values)))
            rows.append([name, quantity.partition(" [")[0],
                         Cell(show(values[at], unit_of(column, dimension)),
                              repr(float(values[at])), column),
                         show(table[TIME][at], "s"),
                         arrival(table, own[THICKNESS[1:]])])
    return rows


def stations(run):
    """Where stations.csv is. Stations that no soil reached are told in one sentence."""
    table = run.tables["stations"]
    columns = columns_of_stations(run) if table else {}
    if not columns:
        return None
    reached = {name: own for name, own in columns.items() if table[own[THICKNESS[1:]]].any()}
    parts = [histories(table, reached)] if reached and len(table) > 1 else []
    if reached:
        parts.append(Rows(["station", "quantity", "largest", "at t =", "soil from"],
                          rows_of(table, reached, run.dimension)))
    never = [name for name in columns if name not in reached]
    if never:
        parts.append(Lines([f"No soil reached the station{'s' * (len(never) > 1)} "
                            f"{', '.join(never)}."]))
    return Section("stations", "Histories at stations",
                   "What passes over each station; soil is there from its arrival on.", parts)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows "at the start, at the end, largest" of tables, as several sections have them."""

from talus_tools.report.page import Cell, Rows
from talus_tools.units import largest, show, unit_of

HEAD = ["quantity", "at the start", "at the end", "largest", "at t =", "what it means"]


def cell(table, column, i, dimension):
    """The value of a column in row i."""
    value = table[column][i]
    return Cell(show(value, unit_of(column, dimension)), repr(float(value)), column)


def summary(run, meanings, table=None):
    """Rows of columns of a table, by default statistics.csv; meanings: {column: (name,
    sentence)}. Columns that the run does not have are left out."""
    table, rows = table or run.statistics, []
    for column, (name, sentence) in meanings.items():
        if column not in table:
            continue
        at = largest(table[column])
        rows.append([name] + [cell(table, column, i, run.dimension) for i in (0, -1, at)]
                    + [show(table["time [s]"][at], "s"), sentence])
    return Rows(HEAD, rows)

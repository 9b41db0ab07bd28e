# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two runs, and what they have in common."""

import os

import numpy

from talus_tools.errors import UserError
from talus_tools.esri import Grid
from talus_tools.report.run import Run
from talus_tools.report.sections.maps import GROUND, read_maps
from talus_tools.texts import shown


class Pair:
    """Runs A and B; `labels` tell them apart on the page."""

    def __init__(self, first, second):
        self.a, self.b = self.runs = Run(first), Run(second)
        if self.a.dimension != self.b.dimension:
            raise UserError(f"'{first}' is a run in {self.a.dimension} dimensions, '{second}' one "
                            f"in {self.b.dimension}. Two runs of the same dimension were "
                            "expected.")
        self.labels = [f"{letter}: {shown(os.path.basename(os.path.abspath(run.folder)))}"
                       for letter, run in zip("AB", self.runs)]

    def tables(self, name):
        """The same table of both; None where one has none."""
        tables = [run.tables[name] for run in self.runs]
        return tables if all(tables) else None

    def changed_entries(self):
        """(name, value of A, value of B) of the parameters that differ, but for the folder."""
        a, b = self.a.entries, self.b.entries
        return [(name, a.get(name, "–"), b.get(name, "–")) for name in {**a, **b}
                if a.get(name) != b.get(name) and name != "Output/Folder"]

    def maps(self):
        """{name: (Grid of A, Grid of B on the cells of A)} of all rasters that both have."""
        if not all(os.path.isdir(run.path("maps")) for run in self.runs):
            return {}
        a, b = (read_maps(run.path("maps")) for run in self.runs)
        return {name: (grid, on_cells_of(grid, b[name])) for name, grid in a.items() if name in b}

    def has_same_cells(self):
        """Whether the rasters of both have the same cells."""
        grounds = [read_maps(run.path("maps"))[GROUND] for run in self.runs]
        return grounds[0].is_aligned_with(grounds[1])


def on_cells_of(cells, grid):
    """A grid at the centres of the cells of another one; NaN outside of it."""
    if grid.is_aligned_with(cells):
        return grid
    east, north = cells.place(*numpy.indices(cells.values.shape))
    west, right, south, top = grid.extent()
    row = numpy.floor((top - north) / grid.dy).astype(int)
    column = numpy.floor((east - west) / grid.dx).astype(int)
    inside = (east >= west) & (east < right) & (north > south) & (north <= top)
    values = numpy.full(cells.values.shape, numpy.nan)
    values[inside] = grid.values[row[inside], column[inside]]
    return Grid(values, cells.west, cells.south, cells.dx, cells.dy)

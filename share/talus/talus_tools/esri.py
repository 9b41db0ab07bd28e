# SPDX-License-Identifier: LGPL-2.1-or-later
"""Esri ASCII grids, as talus reads and writes them."""

import dataclasses

import numpy

from talus_tools.errors import UserError
from talus_tools.texts import read_text

KEYS = {"ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx",
        "dy", "nodata_value"}


@dataclasses.dataclass
class Grid:
    """Values of cells, shape (rows, columns), the northernmost row first, NaN where there are
    none; west and south edge and size of a cell [m]."""
    values: numpy.ndarray
    west: float
    south: float
    dx: float
    dy: float

    def extent(self):
        """West, east, south and north edge [m]."""
        rows, columns = self.values.shape
        return (self.west, self.west + columns * self.dx, self.south, self.south + rows * self.dy)

    def place(self, row, column):
        """Easting and northing of the centre of a cell [m]."""
        return (self.west + (column + 0.5) * self.dx,
                self.south + (len(self.values) - row - 0.5) * self.dy)

    def part(self, top, bottom, left, right):
        """Rows from top to bottom and columns from left to right, the last ones not included."""
        return Grid(self.values[top:bottom, left:right], self.west + left * self.dx,
                    self.south + (len(self.values) - bottom) * self.dy, self.dx, self.dy)

    def cell(self, east, north):
        """Row and column of the cell of a place, which may lie outside of the grid."""
        return (int(len(self.values) - 1 - (north - self.south) // self.dy),
                int((east - self.west) // self.dx))

    def is_aligned_with(self, other):
        """Whether both have the same cells."""
        return (self.values.shape == other.values.shape
                and numpy.allclose(self.extent(), other.extent()))


def split(path):
    """The header as {key: number} and the words behind it."""
    try:
        words = read_text(path).split()
        header, at = {}, 0
        while at + 1 < len(words) and words[at].lower() in KEYS:
            header[words[at].lower()] = float(words[at + 1])
            at += 2
    except ValueError as error:
        raise UserError(f"'{path}' is no Esri ASCII grid: {error} in the header.") from error
    return header, words[at:]


def read_grid(path):
    """Read a grid; a header or a number of values that does not fit is an error."""
    header, words = split(path)
    try:
        columns, rows = int(header["ncols"]), int(header["nrows"])
        dx = header.get("dx", header.get("cellsize"))
        dy = header.get("dy", header.get("cellsize"))
        west = header["xllcorner"] if "xllcorner" in header else header["xllcenter"] - dx / 2
        south = header["yllcorner"] if "yllcorner" in header else header["yllcenter"] - dy / 2
        values = numpy.array(words, dtype=float)
    except (KeyError, TypeError, ValueError) as error:
        raise UserError(f"'{path}' is no Esri ASCII grid: the header wants ncols, nrows, "
                        "xllcorner, yllcorner and cellsize, each with a number, and numbers behind "
                        f"it ({error}).") from error
    if len(values) != rows * columns:
        raise UserError(f"'{path}' has {len(values)} values; {rows} rows of {columns} are "
                        "expected. It may still be being written, or have been cut off.")
    values[values == header.get("nodata_value", -9999)] = numpy.nan
    return Grid(values.reshape(rows, columns), west, south, dx, dy)


def write_grid(path, grid, digits=6):
    """Write a grid; NaN becomes -9999."""
    rows, columns = grid.values.shape
    step = (f"cellsize {grid.dx!r}\n" if grid.dx == grid.dy else
            f"dx {grid.dx!r}\ndy {grid.dy!r}\n")
    with open(path, "w", encoding="ascii") as stream:
        stream.write(f"ncols {columns}\nnrows {rows}\nxllcorner {grid.west!r}\n"
                     f"yllcorner {grid.south!r}\n{step}NODATA_value -9999\n")
        for row in numpy.where(numpy.isnan(grid.values), -9999, grid.values):
            stream.write(" ".join(f"{value:.{digits}g}" for value in row) + "\n")

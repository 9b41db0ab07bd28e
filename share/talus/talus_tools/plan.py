# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plan series of a run: the soil in each column of the maps in time."""

import dataclasses
import warnings

import numpy

from talus_tools.errors import UserError
from talus_tools.tables import header, read_table
from talus_tools.texts import LENIENT, read_text


@dataclasses.dataclass
class Cells:
    """Cells of the columns, numbered row by row from the north, each row from west to east: west
    and south edge, width and height of a cell [m]. In 2-D there is one row, of height 0."""
    west: float
    south: float
    dx: float
    dy: float
    columns: int
    rows: int

    def x(self):
        """Easting of the centre of each column [m]."""
        return self.west + (numpy.arange(self.columns) + 0.5) * self.dx

    def y(self):
        """Northing of the centre of each row [m], the northernmost first."""
        return self.south + (self.rows - numpy.arange(self.rows) - 0.5) * self.dy

    def middle(self):
        """Easting and northing of the middle [m]."""
        return (self.west + 0.5 * self.columns * self.dx, self.south + 0.5 * self.rows * self.dy)


@dataclasses.dataclass
class Soil:
    """Soil at one time [s]: numbers of the columns with soil, their volumes [m^3; in 2-D m^2] and
    depth-mean velocities, shape (columns, 2 or 3) [m/s]; of the whole soil the volume, the mass
    [kg; in 2-D kg/m] and the velocity [m/s]."""
    time: float
    columns: numpy.ndarray
    volumes: numpy.ndarray
    velocities: numpy.ndarray
    volume: float
    mass: float
    velocity: numpy.ndarray


class PlanSeries:
    """Series plan.csv with the cells of plan-cells.csv. `states`: Soil by time; `map`: coordinate
    system of the cells as well-known text, empty if it is not known."""

    def __init__(self, results):
        self.path = results.path("plan.csv")
        for name in ("plan.csv", "plan-cells.csv"):
            if not results.has(name):
                raise UserError(f"'{results.folder}' has no '{name}', the soil in the cells of the "
                                "maps in time. Set 'Output/Plan interval', and run talus again.")
        cells = read_table(results.path("plan-cells.csv"))
        self.cells = Cells(*(cells[name][0] for name in ("west", "south", "dx", "dy")),
                           int(cells["columns"][0]), int(cells["rows"][0]))
        names = header(self.path)
        self.dim = len(names) - 4
        self.map = (read_text(results.path("plan-cells.prj")).strip()
                    if results.has("plan-cells.prj") else "")
        self.states = self.split(read_numbers(self.path, len(names)))

    @property
    def area(self):
        """Section of a column [m^2; in 2-D m]."""
        return self.cells.dx * (self.cells.dy if self.dim == 3 else 1)

    def split(self, rows):
        """States of a table. Each begins with the row of the whole soil, column -1. A last state
        whose columns lack soil is still being written, and left out."""
        starts = numpy.flatnonzero(rows[:, 1] == -1)
        ends = [*starts[1:], len(rows)]
        if len(starts) and abs(rows[starts[-1] + 1:, 3].sum()
                               - rows[starts[-1], 3]) > 1e-9 * abs(rows[starts[-1], 3]):
            starts = starts[:-1]
        if not len(starts):
            raise UserError(f"'{self.path}' has no complete state yet. A run writes the first one "
                            "when it starts to move; wait for it, or look for its error in "
                            "log.txt.")
        result = []
        for start, end in zip(starts, ends):
            whole, columns = rows[start], rows[start + 1:end]
            velocity = whole[4:] / whole[3] if whole[3] > 0 else numpy.zeros(self.dim)
            result.append(Soil(whole[0], columns[:, 1].astype(int), columns[:, 2].copy(),
                               columns[:, 4:] / columns[:, 3:4], whole[2], whole[3], velocity))
        return result

    def column(self, east, north):
        """Number of the column around a place on the map; in 2-D the northing is ignored."""
        column = int((east - self.cells.west) // self.cells.dx)
        row = (int(self.cells.rows - 1 - (north - self.cells.south) // self.cells.dy)
               if self.dim == 3 else 0)
        if not (0 <= column < self.cells.columns and 0 <= row < self.cells.rows):
            raise UserError(f"The place {east:g}, {north:g} is outside of the cells of "
                            f"'{self.path}'. Give map coordinates, m.")
        return row * self.cells.columns + column

    def history(self, east, north=0):
        """Times [s], thickness [m] and depth-mean velocity, shape (times, 2 or 3) [m/s], of the
        soil in the column around a place; zeros without soil."""
        column = self.column(east, north)
        thickness = numpy.zeros(len(self.states))
        velocity = numpy.zeros((len(self.states), self.dim))
        for i, soil in enumerate(self.states):
            at = numpy.searchsorted(soil.columns, column)
            if at < len(soil.columns) and soil.columns[at] == column:
                thickness[i] = soil.volumes[at] / self.area
                velocity[i] = soil.velocities[at]
        return numpy.array([soil.time for soil in self.states]), thickness, velocity

    def thickness(self, soil):
        """Thickness of the soil, shape (rows, columns) [m]."""
        result = numpy.zeros(self.cells.rows * self.cells.columns)
        result[soil.columns] = soil.volumes / self.area
        return result.reshape(self.cells.rows, self.cells.columns)


def read_numbers(path, n_columns):
    """Rows of a table of numbers; a line without its end is still being written, and left out."""
    try:
        with open(path, **LENIENT) as stream, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a table without rows
            stream.readline()
            rows = numpy.loadtxt((line for line in stream if line.endswith("\n")), delimiter=",",
                                 ndmin=2)
    except OSError as error:
        raise UserError(f"'{path}' cannot be read: {error.strerror}.") from error
    except ValueError as error:
        raise UserError(f"'{path}' is damaged: {error}. Run talus again.") from error
    if rows.size and rows.shape[1] != n_columns:
        raise UserError(f"'{path}' has rows of {rows.shape[1]} numbers, where the header names "
                        f"{n_columns}. Run talus again.")
    return rows.reshape(-1, max(n_columns, 4))

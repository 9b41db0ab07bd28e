# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results of a run in its output folder: parameters, tables, fields and maps."""

import glob
import os

import numpy

from talus_tools.errors import UserError
from talus_tools.esri import read_grid
from talus_tools.parameters import read_parameters
from talus_tools.plan import PlanSeries
from talus_tools.tables import find_column, read_lines, read_table
from talus_tools.vtu import VtuSeries


def read(folder):
    """Open the results of a run, finished or not, in its output folder."""
    return Results(folder)


class Fields:
    """Fields at one time. `time` [s]; `corners`: vertices of the cells, or the points
    themselves, shape (cells, vertices, 3) [m]; `places`: their centres, shape (cells, 3) [m].
    fields["speed [m/s]"], or fields["speed"], is an array of one value per cell, or a row."""

    def __init__(self, path, time, corners, values):
        self.path, self.time, self.corners, self.values = path, time, corners, values
        self.names = list(values)

    def __contains__(self, name):
        return find_column(self.names, name) is not None

    def __getitem__(self, name):
        found = find_column(self.names, name)
        if found is None:
            raise UserError(f"'{self.path}' has no field '{name}' at t = {self.time:g} s; it has "
                            f"{', '.join(self.names)}.")
        return self.values[found]

    def __len__(self):
        return len(self.corners)

    @property
    def places(self):
        """Centres of the cells, shape (cells, 3) [m]."""
        return self.corners.mean(axis=1)


class Results:
    """Results in an output folder. `parameters`: {entry: text}, as the run understood them,
    for example parameters["Grid/Cell size"]. Fields and maps are read when asked for."""

    def __init__(self, folder):
        self.folder = os.fspath(folder)
        self.check_folder()
        self.parameters = read_parameters(self.path("parameters.prm"))

    def path(self, name):
        """Path of a file of the run."""
        return os.path.join(self.folder, name)

    def has(self, name):
        """Whether the run has this file."""
        return os.path.isfile(self.path(name))

    def check_folder(self):
        """Errors that a user makes: no folder, or the wrong one."""
        if not os.path.isdir(self.folder):
            raise UserError(f"'{self.folder}' is no folder. Name the output folder of a run, "
                            "Output/Folder in its parameters.")
        if not self.has("parameters.prm"):
            raise UserError(f"'{self.folder}' has no parameters.prm, so it is no output folder of "
                            "talus.")

    def names_of(self, pattern):
        """Names of the files like `pattern`, without their ending."""
        paths = glob.glob(os.path.join(glob.escape(self.folder), pattern))
        return sorted(os.path.splitext(os.path.basename(path))[0] for path in paths)

    def names_of_tables(self):
        """Names of the tables."""
        return self.names_of("*.csv")

    def table(self, name):
        """The table NAME.csv, with its columns by name: table["time [s]"] or table["time"]."""
        if not self.has(name + ".csv"):
            raise UserError(f"'{self.folder}' has no table '{name}.csv'; it has "
                            f"{', '.join(self.names_of_tables()) or 'none'}.")
        return read_table(self.path(name + ".csv"))

    def lines(self):
        """{line: {column: values}} of the table lines.csv."""
        if not self.has("lines.csv"):
            raise UserError(f"'{self.folder}' has no table 'lines.csv'.")
        return read_lines(self.path("lines.csv"))

    def plan(self):
        """The series plan.csv: soil by column and time; plan().history(east, north)."""
        return PlanSeries(self)

    def series(self, name):
        """Fields by time; None where there are none."""
        if not self.has(name + ".pvd"):
            return None
        series = VtuSeries(self.path(name + ".pvd"))
        return series if len(series.times) else None

    def times(self, name="points"):
        """Times of the outputs of the points, the grid, the obstacles or the facets [s]."""
        series = self.series(name)
        return numpy.empty(0) if series is None else series.times

    def fields(self, name, time=numpy.inf):
        """Fields of "points", "grid", "obstacles" or "facets" at the output nearest to this time
        [s]; by default the last one."""
        series = self.series(name)
        if series is None:
            raise UserError(f"'{self.folder}' has no fields '{name}.pvd' with an output.")
        nearest = series.times[-1] if time == numpy.inf else series.nearest(time)
        return Fields(self.path(name), nearest, *series.read(nearest))

    def points(self, time=numpy.inf):
        """Fields of the points at the output nearest to this time [s]."""
        return self.fields("points", time)

    def names_of_maps(self):
        """Names of the maps, for example maximum-thickness."""
        return self.names_of("maps/*.asc")

    def map(self, name):
        """The map maps/NAME.asc: `values`, shape (rows, columns), the northernmost row first,
        NaN where there is no soil; `west`, `south`, `dx`, `dy` [m]."""
        if not self.has(f"maps/{name}.asc"):
            raise UserError(f"'{self.folder}' has no map 'maps/{name}.asc'; it has "
                            f"{', '.join(self.names_of_maps()) or 'none'}. Maps in GeoTIFF are read by other "
                            "programs.")
        return read_grid(self.path(f"maps/{name}.asc"))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results of a member that a study compares: one number of a table or of a map each."""

import dataclasses
import glob
import os
import re

import numpy

from talus_tools.errors import UserError
from talus_tools.esri import read_grid
from talus_tools.tables import header, read_table, split_unit


@dataclasses.dataclass
class Quantity:
    """One number of a column of a table."""
    name: str
    file: str
    column: str
    take: str

    def label(self):
        """Name with the unit of the column, of a settling time s."""
        if self.take == "settling time":
            return self.name + " [s]"
        unit = re.search(r" \[.*\]$", self.column)
        return self.name + (unit[0] if unit else "")

    def files(self):
        """Files of a run that hold the number."""
        return [self.file]

    def is_found(self, member, has_finished):
        """Whether the table has the column. False if the table does not exist yet; a UserError
        if the column is missing, or if the member has finished without the table."""
        path = member.path(self.file)
        names = header(path)
        if self.column in names:
            return True
        if names:
            raise UserError(f"'{path}' has no column '{self.column}', which the quantity "
                            f"'{self.name}' asks for; it has {', '.join(names)}.")
        if has_finished:
            raise UserError(f"{member.name} has finished without '{path}', which the quantity "
                            f"'{self.name}' asks for. Let its case write that table, or "
                            f"correct 'Quantities/{self.name}/File'.")
        return False

    def value(self, member):
        """The number of a finished member."""
        table = read_table(member.path(self.file))
        column = table[self.column]
        if self.take == "final":
            return float(column[-1])
        if self.take == "settling time":
            distance = abs(column - column[-1])
            outside = numpy.flatnonzero(distance > 0.02 * distance[0])
            return float(table["time [s]"][outside[-1] + 1 if len(outside) else 0])
        return float(numpy.nanmax(column) if self.take == "maximum" else numpy.nanmin(column))


def maps_of(member):
    """Names of the maps that a member has written, as of the rasters of a 3-D run."""
    names = [split_unit(name)[0].replace(" ", "-") for name in header(member.path("maps.csv"))
             if name != "x [m]"]
    paths = glob.glob(os.path.join(glob.escape(member.path("maps")), "*.asc"))
    return names + sorted(os.path.basename(path)[:-len(".asc")] for path in paths)


@dataclasses.dataclass
class ExceedanceMap:
    """Map of 'Exceedance/Map'; members without any map have no exceedance maps."""
    map: str

    def is_found(self, member, has_finished):
        """As of a quantity."""
        names = maps_of(member)
        if self.map in names or (has_finished and not names):
            return True
        if has_finished or (names and os.path.isfile(member.path("maps.csv"))):
            raise UserError(f"{member.name} has no map '{self.map}', which 'Exceedance/Map' asks "
                            f"for; it has {', '.join(names)}.")
        return False

    def value(self, _):
        """No number is taken."""


@dataclasses.dataclass
class MapQuantity:
    """One number of a map: the value at a place, or the overlap with an observed deposit.

    `place`: x [m] in 2-D, easting and northing [m] in 3-D; or None. `outline`: the two ends of the
    deposit [m] in 2-D, the path of a raster in 3-D; or None. A cell belongs to a deposit where the
    map, or the raster, is above `threshold`."""
    name: str
    map: str
    place: list
    outline: object
    threshold: float

    def label(self):
        """Name with the unit."""
        return self.name + (" [-]" if self.outline else "")

    def files(self):
        """Files of a run that hold the number."""
        return ["maps.csv", f"maps/{self.map}.asc"]

    def raster(self, member):
        """Path of the map of a 3-D run."""
        return member.path(f"maps/{self.map}.asc")

    def is_found(self, member, has_finished):
        """Whether the map exists; see Quantity."""
        names = maps_of(member)
        if self.map in names:
            return True
        # The table of a section has all maps from the first row on, a folder one after another.
        if has_finished or (names and os.path.isfile(member.path("maps.csv"))):
            raise UserError(f"{member.name} has no map '{self.map}', which the quantity "
                            f"'{self.name}' asks for; it has {', '.join(names) or 'none'}. Correct "
                            "the name of the map, or set 'Maps/Write' = true in the section "
                            "'Parameters'.")
        return False

    def value(self, member):
        """The number of a finished member."""
        if os.path.isfile(self.raster(member)):
            return self.value_in_plan(read_grid(self.raster(member)))
        return self.value_in_section(read_table(member.path("maps.csv")))

    def value_in_section(self, table):
        """Value by the columns of maps.csv, whose width is the smallest distance of two."""
        start = self.map.replace("-", " ") + " ["
        columns = [name for name in table.names if name.startswith(start)]
        if not columns:
            raise UserError(f"'{table.path}' has no column '{start}…]', which the quantity "
                            f"'{self.name}' asks for.")
        x, values = table["x [m]"], numpy.nan_to_num(table[columns[0]])
        width = numpy.diff(x).min() if len(x) > 1 else 1.0
        if self.place:
            nearest = numpy.abs(x - self.place[0]).argmin()
            return float(values[nearest] if abs(x[nearest] - self.place[0]) <= width else 0)
        if isinstance(self.outline, str):
            raise UserError(f"The quantity '{self.name}' names the raster '{self.outline}', but "
                            "the case is a section. Give the two ends x of the deposit [m].")
        left, right = self.outline
        covered = numpy.clip(numpy.minimum(x + width / 2, right)
                             - numpy.maximum(x - width / 2, left), 0, None)
        has_soil = values > self.threshold
        both = covered[has_soil].sum()
        return float(both / (right - left + has_soil.sum() * width - both))

    def value_in_plan(self, grid):
        """Value by the cells of a raster."""
        if self.place:
            row, column = grid.cell(*self.place)
            rows, columns = grid.values.shape
            if len(self.place) != 2 or not (0 <= row < rows and 0 <= column < columns):
                raise UserError(f"The quantity '{self.name}' asks for the place {self.place}, "
                                "which is not easting and northing within the map.")
            return float(numpy.nan_to_num(grid.values[row, column]))
        observed = read_grid(self.outline) if isinstance(self.outline, str) else None
        if observed is None or not observed.is_aligned_with(grid):
            raise UserError(f"The quantity '{self.name}' compares with '{self.outline}', where a "
                            "raster with the cells of the maps was expected.")
        one, other = (numpy.nan_to_num(values) > self.threshold
                      for values in (grid.values, observed.values))
        return float((one & other).sum() / max((one | other).sum(), 1))

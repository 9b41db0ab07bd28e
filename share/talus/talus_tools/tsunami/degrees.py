# SPDX-License-Identifier: LGPL-2.1-or-later
"""The motion of the sea floor on longitude and latitude, degrees, in WGS 84."""

import dataclasses
import math

import numpy

from talus_tools.errors import UserError
from talus_tools.gis import system_of, transformed, wgs_84
from talus_tools.plan import Cells


def transformation(words, is_inverse=False):
    """Function from places on the map, shape (n, 2) [m], to degrees, or the inverse one. Places
    that the other system does not have are infinite."""
    system = system_of(words) if words else None
    if system is None or not system.IsProjected() or system.GetLinearUnits() != 1:
        raise UserError("The source was asked for in degrees, but the coordinate system of the "
                        "map is not known, or not in metres: it is that of the raster of "
                        "'Maps/Raster', or of the first surface with a raster. Run talus on a "
                        "raster with a coordinate system, or leave out --degrees.")
    systems = [system, wgs_84()]
    return lambda places: transformed(places, *(systems[::-1] if is_inverse else systems))


def whole_turns(longitude, middle):
    """Longitude within 180 degrees of `middle`."""
    return middle + numpy.remainder(longitude - middle + 180, 360) - 180


def grid_of(x, y):
    """All places with these coordinates, shape (rows * columns, 2)."""
    return numpy.stack(numpy.meshgrid(x, y), axis=-1).reshape(-1, 2)


def frame(cells, to_degrees):
    """Cells in degrees that cover `cells` with one more cell on each side. A cell in the middle is
    as large as before, whatever the angle between map and meridian."""
    east, north = cells.middle()
    half = 0.5 * numpy.array([cells.dx, cells.dy])
    cross = to_degrees([(east - half[0], north), (east + half[0], north), (east, north - half[1]),
                        (east, north + half[1])])
    x, y = cells.x(), cells.y()
    edge = numpy.concatenate([grid_of(x, y[[0, -1]]), grid_of(x[[0, -1]], y)])
    places = to_degrees([(east, north), *edge])
    if not numpy.isfinite(places).all():
        raise UserError("The source was asked for in degrees, but the map of the mesh has no "
                        "longitude and latitude everywhere. Check the coordinate system of the "
                        "raster and 'Grid/Origin'.")
    places[:, 0] = whole_turns(places[:, 0], places[0, 0])

    def length(one, other):
        """In units of a degree of latitude."""
        shrink = math.cos(math.radians(0.5 * (one[1] + other[1])))
        return math.hypot(math.remainder(other[0] - one[0], 360) * shrink, other[1] - one[1])

    dx = length(cross[0], cross[1]) / math.cos(math.radians(places[0, 1]))
    dy = length(cross[2], cross[3])
    lower, upper = places.min(axis=0), places.max(axis=0)
    columns, rows = (math.ceil((upper[i] - lower[i]) / d) + 3 for i, d in enumerate((dx, dy)))
    west, south = 0.5 * (lower + upper) - 0.5 * numpy.array([columns * dx, rows * dy])
    return Cells(west, south, dx, dy, columns, rows)


def interpolated(cells, values, places):
    """Values at places on the map, linear between the centres of the cells, zero outside."""
    with numpy.errstate(invalid="ignore"):
        column = (places[:, 0] - cells.x()[0]) / cells.dx
        row = (cells.y()[0] - places[:, 1]) / cells.dy
    found = numpy.isfinite(column) & numpy.isfinite(row)
    result = numpy.zeros(len(places))
    for right in (0, 1):
        for down in (0, 1):
            i, j = (numpy.floor(numpy.where(found, at, -9)) + step
                    for at, step in ((column, right), (row, down)))
            inside = found & (i >= 0) & (i < cells.columns) & (j >= 0) & (j < cells.rows)
            weight = (1 - abs(column[inside] - i[inside])) * (1 - abs(row[inside] - j[inside]))
            result[inside] += weight * values[j[inside].astype(int), i[inside].astype(int)]
    return result


def centres_on_map(cells, words):
    """Places on the map, shape (n, 2) [m], of the centres of cells in degrees."""
    degrees = grid_of(whole_turns(cells.x(), 0), cells.y())
    return transformation(words, is_inverse=True)(degrees)


def on_degrees(motion, words):
    """The motion on degrees, from a map with the coordinate system `words`. The volume stays up to
    the error of interpolation. Longitudes continue beyond 180 degrees where the cells lie on both
    sides."""
    cells = frame(motion.cells, transformation(words))
    places = centres_on_map(cells, words)

    def change(k):
        return interpolated(motion.cells, motion.change(k), places).reshape(cells.rows,
                                                                            cells.columns)

    return dataclasses.replace(motion, cells=cells, change=change, in_degrees=True)


def heights_on_degrees(cells, heights, degrees, words):
    """Heights on `cells` of the map, on cells in degrees; outside, those of the nearest edge."""
    places = centres_on_map(degrees, words)
    for i, centres in enumerate((cells.x(), cells.y())):
        places[:, i] = places[:, i].clip(centres.min(), centres.max())
    return interpolated(cells, heights, places).reshape(degrees.rows, degrees.columns)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The release area of a new case."""

import dataclasses

import numpy

from talus_tools.errors import UserError
from talus_tools.gis import Polygon, read_polygons, system_of, transformed

STEEPEST_SIDE = 0.2  # of the release, height over length: soil hardly leaves a steeper pocket
GENTLEST_SIDE = 0.05


@dataclasses.dataclass
class Release:
    """Polygons on the map [m], with a depth [m] each; `field`: where the file has the depth, empty
    if it is one number. `is_on_map`: whether the file has the coordinates of the map."""
    path: str
    polygons: list
    field: str
    is_on_map: bool

    @property
    def depth(self):
        """Largest depth [m]."""
        return max(polygon.number for polygon in self.polygons)

    @property
    def largest(self):
        """Polygon with the most soil."""
        return max(self.polygons, key=lambda polygon: polygon.area() * polygon.number)

    def corners(self):
        """Corners of all polygons, shape (n, 2)."""
        return numpy.concatenate([polygon.corners for polygon in self.polygons])

    def size(self):
        """Side of a square with the area of the largest polygon [m]."""
        return self.largest.area()**0.5

    def inside(self, place):
        """Distance to the nearest outline [m], positive inside as in talus, and the depth [m] of
        the nearest polygon."""
        return max((inside(polygon.corners, place), polygon.number) for polygon in self.polygons)

    def is_near(self, place):
        """Whether a place is in the area, or nearer than a fourth of its size."""
        return self.inside(place)[0] > -0.25 * self.size()


def inside(corners, place):
    """Distance of a place to an outline [m], negative outside."""
    one, other = corners, numpy.roll(corners, -1, axis=0)
    along, away = other - one, place - one
    t = numpy.clip((along * away).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    distance = numpy.linalg.norm(away - t[:, None] * along, axis=1).min()
    crosses = (one[:, 1] > place[1]) != (other[:, 1] > place[1])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        x = one[:, 0] + (place[1] - one[:, 1]) * along[:, 0] / along[:, 1]
    return distance if (crosses & (place[0] < x)).sum() % 2 else -distance


def read_release(path, depth):
    """Polygons in the coordinates of the file, their system, and the field with the depths.
    `depth`: metres, or the name of the field."""
    try:
        number, field = float(depth), ""
    except ValueError:
        number, field = None, depth
    polygons, system = read_polygons(path, field)
    for polygon in polygons:
        polygon.number = polygon.number if field else number
        if not 0 < polygon.number < numpy.inf:
            raise UserError(f"The depth of the release is {polygon.number:g} m, where more than "
                            "0 is expected. Correct it.")
    return polygons, system, field


def on_map(path, polygons, system, field, raster, code):
    """The release on the map of a case."""
    target = system_of(f"EPSG:{code}") if code else raster.system
    moved = [Polygon(transformed(polygon.corners, system, target), polygon.number)
             for polygon in polygons]
    if not all(numpy.isfinite(polygon.corners).all() for polygon in moved):
        raise UserError(f"'{path}' has corners without a place on the map of '{raster.path}'. "
                        "Check the coordinate systems of both files.")
    is_on_map = system is None or target is None or bool(system.IsSame(target))
    if not is_on_map and not code:
        raise UserError(f"'{path}' is not on the map of '{raster.path}', which has no EPSG code. "
                        "Save the polygon in the coordinate system of the raster.")
    return Release(path, moved, field, is_on_map)

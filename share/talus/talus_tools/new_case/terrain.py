# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sea floor around a release area, on a map in metres."""

import dataclasses

import numpy
from osgeo import gdal
from scipy.ndimage import gaussian_filter, map_coordinates

from talus_tools.errors import UserError
from talus_tools.gis import MOST_CELLS, extent, system_of, transformed

MARGIN_CELLS = 3


@dataclasses.dataclass
class SeaFloor:
    """Heights [m] of square cells, shape (rows, columns), the northernmost row first, NaN without
    data; west and north edge and size of a cell [m]."""
    values: numpy.ndarray
    west: float
    north: float
    cell: float

    @property
    def east(self):
        """East edge [m]."""
        return self.west + self.values.shape[1] * self.cell

    @property
    def south(self):
        """South edge [m]."""
        return self.north - self.values.shape[0] * self.cell

    def at(self, places):
        """Heights at places, shape (n, 2) [m], linear between the middles of cells; NaN where
        there are none."""
        places = numpy.atleast_2d(places)
        return map_coordinates(
            self.values, [(self.north - places[:, 1]) / self.cell - 0.5,
                          (places[:, 0] - self.west) / self.cell - 0.5],
            order=1, mode="constant", cval=numpy.nan)

    def part(self, west, south, east, north):
        """Values of the cells whose middles lie in a box, an array that may be empty."""
        i, j = (int(numpy.clip(round((edge - self.west) / self.cell), 0, self.values.shape[1]))
                for edge in (west, east))
        k, m = (int(numpy.clip(round((self.north - edge) / self.cell), 0, self.values.shape[0]))
                for edge in (north, south))
        return self.values[k:m, i:j]

    def smooth(self, length):
        """The sea floor averaged over a length [m], with Gaussian weights; gaps stay gaps."""
        known = numpy.isfinite(self.values)
        sigma = length / self.cell
        weights = gaussian_filter(known.astype(float), sigma)
        sums = gaussian_filter(numpy.where(known, self.values, 0), sigma)
        values = numpy.where(known, sums / numpy.maximum(weights, 1e-9), numpy.nan)
        return dataclasses.replace(self, values=values)


def read_sea_floor(raster, code, box):
    """Heights within `box` [m] (west, south, east, north on the map of the EPSG code, None for the
    raster's own map)."""
    target = None if code is None else system_of(f"EPSG:{code}")
    is_own = target is None or raster.system is None or raster.system.IsProjected()
    west, south, east, north = extent(raster)
    if is_own:
        cell = min((east - west) / raster.dataset.RasterXSize,
                   (north - south) / raster.dataset.RasterYSize)
        box = (max(box[0], west), max(box[1], south), min(box[2], east), min(box[3], north))
    else:
        middle = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
        (x, y), = transformed([middle], target, raster.system)
        dx, dy = raster.dataset.GetGeoTransform()[1], -raster.dataset.GetGeoTransform()[5]
        ends = transformed([(x - dx / 2, y), (x + dx / 2, y), (x, y - dy / 2), (x, y + dy / 2)],
                           raster.system, target)
        cell = min(numpy.linalg.norm(ends[1] - ends[0]), numpy.linalg.norm(ends[3] - ends[2]))
        corners = transformed(outline_of(west, south, east, north), raster.system, target)
        corners = corners[numpy.isfinite(corners).all(axis=1)]
        box = (max(box[0], corners[:, 0].min()), max(box[1], corners[:, 1].min()),
               min(box[2], corners[:, 0].max()), min(box[3], corners[:, 1].max()))
    if not (box[0] < box[2] and box[1] < box[3]):
        raise UserError(f"'{raster.path}' has no heights at the release area. Check both files and "
                        "their coordinate systems.")
    cell = max(cell, ((box[2] - box[0]) * (box[3] - box[1]) / MOST_CELLS)**0.5)
    return warp(raster, None if is_own else target, box, cell)


def outline_of(west, south, east, north, n=20):
    """Places along the edge of a box, shape (4 n, 2)."""
    t = numpy.linspace(0, 1, n)
    x, y = west + t * (east - west), south + t * (north - south)
    return numpy.concatenate([numpy.stack([x, 0 * t + edge], 1) for edge in (south, north)]
                             + [numpy.stack([0 * t + edge, y], 1) for edge in (west, east)])


def warp(raster, target, box, cell):
    """Cells of `cell` [m] in a box; by the mean over a cell where the raster is finer."""
    own = raster.dataset.GetGeoTransform()[1]
    is_finer = target is None and cell > 1.5 * own
    try:
        found = gdal.Warp("", raster.dataset, format="MEM", xRes=cell, yRes=cell, outputBounds=box,
                          dstSRS=target, srcSRS=raster.system, outputType=gdal.GDT_Float64,
                          dstNodata=numpy.nan, resampleAlg="average" if is_finer else "bilinear")
    except RuntimeError as error:
        raise UserError(f"'{raster.path}' cannot be projected: {error}.") from error
    band = raster.dataset.GetRasterBand(1)
    values = found.GetRasterBand(1).ReadAsArray()
    values = (values * (band.GetScale() or 1) + (band.GetOffset() or 0)) * raster.unit
    west, _, _, north, _, _ = found.GetGeoTransform()
    return SeaFloor(values, west, north, cell)

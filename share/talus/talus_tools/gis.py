# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rasters and polygons of a GIS on a map in metres, by GDAL."""

import dataclasses
import math

import numpy
from osgeo import gdal, ogr, osr

from talus_tools.errors import UserError

gdal.UseExceptions()
ogr.UseExceptions()
osr.UseExceptions()

METRES = {"": 1, "m": 1, "metre": 1, "metres": 1, "meter": 1, "meters": 1, "ft": 0.3048,
          "foot": 0.3048, "feet": 0.3048, "us survey foot": 1200 / 3937, "fathom": 1.8288,
          "fathoms": 1.8288, "cm": 0.01, "km": 1000}
NAMES = ("elevation", "z", "Band1")  # of the heights in a file with several rasters
MOST_CELLS = 4_000_000
GEOCLAW = {b"mx": b"ncols", b"my": b"nrows", b"xlower": b"xllcenter", b"ylower": b"yllcenter",
           b"nodatavalue": b"nodata_value"}


@dataclasses.dataclass
class Raster:
    """An open raster: dataset of GDAL, coordinate system or None, size of a height's unit [m]."""
    path: str
    dataset: gdal.Dataset
    system: osr.SpatialReference
    unit: float

    @property
    def is_in_degrees(self):
        """Whether the places are degrees."""
        return self.system is not None and bool(self.system.IsGeographic())


def traditional(system):
    """The system with easting or longitude first."""
    if system is not None:
        system = system.Clone()
        system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    return system


def wgs_84():
    """Longitude and latitude, degrees."""
    return system_of("EPSG:4326")


def system_of(words):
    """Coordinate system of a text, with longitude or easting first; None if unknown to GDAL."""
    system = osr.SpatialReference()
    try:
        system.SetFromUserInput(words)
    except RuntimeError:
        return None
    return traditional(system)


class Quiet:
    """GDAL prints no error in a block of this."""

    def __enter__(self):
        gdal.PushErrorHandler("CPLQuietErrorHandler")

    def __exit__(self, *_):
        gdal.PopErrorHandler()


def are_degrees(west, east, south, north):
    """Whether these can only be degrees, as in a file that does not say its system."""
    return -180 <= west < east <= 360 and -90 <= south < north <= 90 and east - west < 90


def geoclaw_as_esri_grid(path):
    """GeoClaw's topography of type 3, which has the number before the keyword, as an Esri ASCII
    grid; None for another file."""
    head = []
    try:
        with open(path, "rb") as stream:
            for line in stream:
                *numbers, keyword = line.split() if len(line) < 200 else [b""]
                if not numbers or not keyword[:1].isalpha():
                    break
                [float(number) for number in numbers]
                keywords = ([GEOCLAW.get(keyword.lower(), keyword.lower())] if len(numbers) == 1
                            else [b"dx", b"dy"])
                head += [key + b" " + number + b"\n" for key, number in zip(keywords, numbers)]
            return b"".join([*head, line, stream.read()]) if head else None
    except (OSError, ValueError):
        return None


def open_raster(path):
    """Open a raster of heights in any format of GDAL, or a topography of GeoClaw."""
    name = path
    if (text := geoclaw_as_esri_grid(path)) is not None:
        name = f"/vsimem/{path}.asc"
        gdal.FileFromMemBuffer(name, text)
    try:
        dataset = gdal.Open(name)
        parts = {name.rsplit(":", 1)[-1]: name for name, _ in dataset.GetSubDatasets()}
        if parts and not dataset.RasterCount:
            chosen = next((name for name in NAMES if name in parts), None)
            if chosen is None:
                raise UserError(f"'{path}' has the rasters {', '.join(parts)}, and none of the "
                                "names elevation, z and Band1. Save the heights to a file of "
                                "their own.")
            dataset = gdal.Open(parts[chosen])
    except RuntimeError as error:
        raise UserError(f"'{path}' cannot be read as a raster: {error}. Give a file of heights "
                        "that GDAL reads (GeoTIFF, Esri ASCII grid, netCDF).") from error
    unit = (dataset.GetRasterBand(1).GetUnitType() or "").strip().lower()
    if unit not in METRES:
        raise UserError(f"'{path}' has heights in '{unit}', which is not known. Convert them to "
                        "metres (gdal_calc.py).")
    system = traditional(dataset.GetSpatialRef())
    raster = Raster(path, dataset, system, METRES[unit])
    west, south, east, north = extent(raster)
    if system is None and are_degrees(west, east, south, north):
        raster.system = wgs_84()
    return raster


def extent(raster):
    """West, south, east, north edge in the raster's own system."""
    west, dx, skew, north, _, dy = raster.dataset.GetGeoTransform()
    if skew or dy >= 0:
        raise UserError(f"'{raster.path}' is turned or has its first row in the south. Save it "
                        "with rows from west to east, the northernmost first (gdalwarp).")
    return (west, north + dy * raster.dataset.RasterYSize,
            west + dx * raster.dataset.RasterXSize, north)


def transformed(places, source, target):
    """Places, shape (n, 2), in another coordinate system; infinite where there are none."""
    if source is None or target is None or source.IsSame(target):
        return numpy.asarray(places, dtype=float)
    with Quiet():
        transform = osr.CoordinateTransformation(source, target)
        return numpy.array(transform.TransformPoints(numpy.asarray(places).tolist()))[:, :2]


def utm_code(longitude, latitude):
    """EPSG code of the zone of UTM (WGS 84) of a place in degrees."""
    zone = int(math.floor((longitude + 180) / 6)) % 60 + 1
    return (32600 if latitude >= 0 else 32700) + zone


def words_of(code):
    """Map of an EPSG code in the language of parameter files."""
    for base, letter in ((32600, "N"), (32700, "S")):
        if base < code <= base + 60:
            return f"UTM {code - base}{letter}"
    return f"EPSG:{code}"


def map_of(raster, places):
    """EPSG code of the map in metres of a case around `places`, shape (n, 2), in the system of the
    raster. None: the raster is used as it is, on a map of metres without a code."""
    system = raster.system
    if system is None or (system.IsProjected() and abs(system.GetLinearUnits() - 1) < 1e-9):
        code = None
        if system is not None:
            system.AutoIdentifyEPSG()
            code = system.GetAuthorityCode(None)
        return int(code) if code else None
    (longitude, latitude), = transformed([numpy.mean(places, axis=0)], system, wgs_84())
    return utm_code(longitude, latitude)


@dataclasses.dataclass
class Polygon:
    """Corners, shape (n, 2), the first not repeated, and a number [unit of the field] or None."""
    corners: numpy.ndarray
    number: float

    def area(self):
        """Area, square of the unit of the corners."""
        x, y = self.corners.T
        return 0.5 * abs((x * numpy.roll(y, -1) - numpy.roll(x, -1) * y).sum())

    def middle(self):
        """Centre of the area."""
        start = self.corners[0]
        x, y = (self.corners - start).T
        cross = x * numpy.roll(y, -1) - numpy.roll(x, -1) * y
        return start + numpy.array([((x + numpy.roll(x, -1)) * cross).sum(),
                                    ((y + numpy.roll(y, -1)) * cross).sum()]) / (3 * cross.sum())


def parts_of(geometry):
    """Polygons of a geometry and its parts."""
    if geometry is None:
        return
    if ogr.GT_Flatten(geometry.GetGeometryType()) == ogr.wkbPolygon:
        yield geometry
    elif geometry.GetGeometryCount():
        for i in range(geometry.GetGeometryCount()):
            yield from parts_of(geometry.GetGeometryRef(i))


def read_polygons(path, field=None):
    """Polygons of a file of vectors, and their coordinate system or None. `field`: name of the
    number of each."""
    try:
        file = gdal.OpenEx(path, gdal.OF_VECTOR)
    except RuntimeError as error:
        raise UserError(f"'{path}' cannot be read as polygons: {error}. Give a file of vectors "
                        "(GeoJSON, shapefile, GeoPackage, KML).") from error
    polygons, system = [], None
    for layer in (file.GetLayer(i) for i in range(file.GetLayerCount())):
        for feature in layer:
            at = feature.GetFieldIndex(field) if field else -1
            number = (feature.GetFieldAsDouble(at)
                      if at >= 0 and feature.IsFieldSetAndNotNull(at) else None)
            for part in parts_of(feature.GetGeometryRef()):
                if part.GetGeometryCount() != 1:
                    raise UserError(f"'{path}' has a polygon with a hole, where an outline is "
                                    "expected. Remove the hole.")
                corners = numpy.array(part.GetGeometryRef(0).GetPoints())[:-1, :2]
                polygons.append(Polygon(corners, number))
        if polygons and system is None:
            system = traditional(layer.GetSpatialRef())
    if not polygons:
        raise UserError(f"'{path}' has no polygon. Save the release area as a polygon.")
    if field and any(polygon.number is None for polygon in polygons):
        raise UserError(f"'{path}' has a polygon without a number in the field '{field}'. Give a "
                        "depth in metres for all of them, or the name of a field that each has.")
    x = numpy.concatenate([polygon.corners for polygon in polygons])
    if system is None and are_degrees(*x[:, 0][[x[:, 0].argmin(), x[:, 0].argmax()]],
                                      x[:, 1].min(), x[:, 1].max()):
        system = wgs_84()
    return polygons, system

# SPDX-License-Identifier: LGPL-2.1-or-later
"""talus-new and talus-screen on planes whose paths, volumes and factors are known.

Usage: new_case.py TALUS ROOT FOLDER [SUITE]
"""

import json
import math
import re
import subprocess

import numpy
from osgeo import gdal, ogr, osr

from tools_case import TALUS, Case, main

from talus_tools import gis

gdal.UseExceptions()
ogr.UseExceptions()

EAST, NORTH, N, CELL = 500_000., 4_000_000., 400, 10.  # west and north edge, m
DEPTH = 12.


def plane(east, north, tangent, azimuth, top=-100.):
    """Height [m] of a plane that falls towards an azimuth [degrees, clockwise from the north]."""
    angle = math.radians(azimuth)
    return (top - tangent * ((east - EAST - 2000) * math.sin(angle)
                             + (north - NORTH + 2000) * math.cos(angle)))


def write_raster(path, heights, west=EAST, north=NORTH, cell=CELL, code=32633):
    """A GeoTIFF."""
    rows, columns = heights.shape
    file = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 1, gdal.GDT_Float64)
    file.SetGeoTransform((west, cell, 0, north, 0, -cell))
    system = osr.SpatialReference()
    system.ImportFromEPSG(code)
    file.SetProjection(system.ExportToWkt())
    file.GetRasterBand(1).WriteArray(heights)


def slope(path, tangent=0.08, azimuth=90., n=N):
    """A plane on UTM 33N."""
    x = (numpy.arange(n) + 0.5) * CELL
    east, north = numpy.meshgrid(EAST + x, NORTH - x)
    write_raster(path, plane(east, north, tangent, azimuth))


def write_polygons(path, driver, rings, depths=None, code=32633):
    """Polygons, with a depth each in the field 'd0'."""
    system = osr.SpatialReference()
    system.ImportFromEPSG(code)
    system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    file = ogr.GetDriverByName(driver).CreateDataSource(str(path))
    layer = file.CreateLayer("release", system, ogr.wkbPolygon)
    layer.CreateField(ogr.FieldDefn("d0", ogr.OFTReal))
    for i, corners in enumerate(rings):
        ring = ogr.Geometry(ogr.wkbLinearRing)
        for corner in [*corners, corners[0]]:
            ring.AddPoint_2D(*corner)
        polygon = ogr.Geometry(ogr.wkbPolygon)
        polygon.AddGeometry(ring)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetGeometry(polygon)
        if depths:
            feature.SetField("d0", depths[i])
        layer.CreateFeature(feature)


def square(east, north, side):
    """Corners of a square around a place."""
    h = side / 2
    return [(east - h, north - h), (east + h, north - h), (east + h, north + h),
            (east - h, north + h)]


def frustum(side, depth, rise):
    """Volume [m^3] of a square pocket with sides that rise inwards."""
    inner = side - 2 * depth / rise
    return depth / 3 * (side**2 + side * inner + inner**2)


MIDDLE = (EAST + 1500, NORTH - 2000)


class NewCase(Case):
    def new(self, *options):
        result = self.tool("talus-new", *options, "--output", self.folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def validate(self, name, *settings):
        """What talus says about the cases; none of the remarks forbids the use of results."""
        said = []
        for what in ("3d", "section"):
            result = subprocess.run(
                [TALUS, "--validate", self.folder / f"{name}-{what}.prm", *settings],
                capture_output=True, text=True, timeout=300)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertNotIn("Remark", result.stdout)
            said.append(result.stdout)
        return said

    def entry(self, name, entry):
        """The value of an entry of a parameter file, without its comment."""
        text = (self.folder / name).read_text()
        return re.search(rf"set {re.escape(entry)} *= ([^#\n]*)", text)[1].strip()

    def test_path_and_volume_on_planes(self):
        """The steepest path of a plane is straight, and where the sea floor falls along an axis
        of the map, the volume with sides of 0.2 is that of a frustum."""
        for azimuth in (0, 90, 250):
            name = f"plane{azimuth}"
            slope(self.folder / f"{name}.tif", azimuth=azimuth)
            write_polygons(self.folder / f"{name}.shp", "ESRI Shapefile", [square(*MIDDLE, 400)])
            said = self.new(self.folder / f"{name}.tif", self.folder / f"{name}.shp", DEPTH,
                            "--sides", 0.2, "--reach", 900)
            volume = float(re.search(r"Release: (\S+) m", said)[1])
            self.assertAlmostEqual(volume / frustum(400, DEPTH, 0.2), 1, delta=0.01)
            corners = numpy.array([[float(x) for x in place.split(",")] for place in
                                   self.entry(f"{name}-section.prm", "Section").split(";")])
            way = corners[-1] - corners[0]
            self.assertEqual(len(corners), 2)
            self.assertAlmostEqual(math.degrees(math.atan2(way[0], way[1])) % 360, azimuth,
                                   delta=0.1)
            self.assertIn("rises by", said)  # the pocket has a lip

    def test_no_lip_by_default(self):
        """Towards the toe the bed rises no more than the sea floor falls."""
        slope(self.folder / "lip.tif", tangent=0.1)
        write_polygons(self.folder / "lip.shp", "ESRI Shapefile", [square(*MIDDLE, 600)])
        said = self.new(self.folder / "lip.tif", self.folder / "lip.shp", DEPTH)
        self.assertNotIn("rises by", said)
        toe = float(self.entry("lip-section.prm", "Expression").rsplit(",", 1)[0].rsplit(",", 1)[1]
                    .split("*")[0])
        self.assertLess(toe, 0.1 + 0.05 * DEPTH / 100)
        self.assertGreater(toe, 0.08)

    def test_shapefile_in_metres(self):
        """Two polygons with a depth each; the first point-steps of the cases are valid."""
        slope(self.folder / "two.tif", azimuth=60)
        write_polygons(self.folder / "two.shp", "ESRI Shapefile",
                       [square(*MIDDLE, 400), square(MIDDLE[0] + 300, MIDDLE[1] - 450, 300)],
                       [DEPTH, 8.])
        said = self.new(self.folder / "two.tif", self.folder / "two.shp", "d0", "--reach", 1500)
        self.assertIn("the polygon with the most soil", said)
        volume = float(re.search(r"Release: (\S+) m", said)[1])
        self.assertAlmostEqual(
            volume / (frustum(400, DEPTH, 0.2) + frustum(300, 8., 0.2)), 1, delta=0.01)
        self.validate("two")
        self.assertGreater((self.folder / "two.png").stat().st_size, 10_000)

    def test_degrees(self):
        """A raster in degrees and GeoJSON are brought to UTM."""
        rows, columns, cell = 300, 400, 1e-4
        y, x = numpy.mgrid[0:rows, 0:columns]
        write_raster(self.folder / "degrees.tif", -200. - 0.7 * x, 15.3, 41., cell, 4326)
        ring = square(15.315, 40.985, 0.004)
        (self.folder / "degrees.geojson").write_text(json.dumps(
            {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}))
        said = self.new(self.folder / "degrees.tif", self.folder / "degrees.geojson", DEPTH)
        self.assertIn("on the map UTM 33N", said)
        self.validate("degrees")
        # 1 degree is 84 km here: the sea floor falls by 0.083 to the east.
        corners = [[float(x) for x in place.split(",")] for place in
                   self.entry("degrees-section.prm", "Section").split(";")]
        self.assertGreater(corners[-1][0], corners[0][0] + 1000)

    def test_run(self):
        """The section runs as it is written."""
        slope(self.folder / "run.tif")
        write_polygons(self.folder / "run.shp", "ESRI Shapefile", [square(*MIDDLE, 400)])
        self.new(self.folder / "run.tif", self.folder / "run.shp", DEPTH, "--cells", 2)
        result = subprocess.run(
            [TALUS, self.folder / "run-section.prm", "--output", self.folder / "run", "--set",
             "End time=5"], capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.folder / "run" / "statistics.csv").exists())

    def test_refused(self):
        slope(self.folder / "a.tif", n=100)
        write_polygons(self.folder / "a.shp", "ESRI Shapefile", [square(EAST + 500, NORTH - 500,
                                                                        200)])
        write_polygons(self.folder / "far.shp", "ESRI Shapefile", [square(EAST + 1e5, NORTH, 200)])
        for arguments, words in (
                (["no.tif", "a.shp", 5], "cannot be read as a raster"),
                (["a.tif", "no.shp", 5], "cannot be read as polygons"),
                (["a.tif", "a.shp", "depth"], "a number in the field 'depth'"),
                (["a.tif", "a.shp", 0], "where more than 0 is expected"),
                (["a.tif", "far.shp", 5], "no heights at the release area"),
                (["a.tif", "a.shp", 5, "--density", 1000], "where more than the water"),
                (["a.tif", "a.shp", 5, "--cells", 0], "no number above 0")):
            names = [self.folder / word if "." in str(word) else word for word in arguments]
            self.assert_sentence(self.tool("talus-new", *names, "--output", self.folder / "no"),
                                 words)
        flat = self.folder / "flat.tif"
        slope(flat, tangent=0, n=100)
        self.assert_sentence(self.tool("talus-new", flat, self.folder / "a.shp", 5), "no slope")
        self.new(self.folder / "a.tif", self.folder / "a.shp", 5)
        self.assert_sentence(self.tool("talus-new", self.folder / "a.tif", self.folder / "a.shp", 5,
                                       "--output", self.folder), "is there already")


class Screen(Case):
    STRENGTH = (2000., 1500.)

    def factors(self, path, *options):
        result = self.tool("talus-screen", path, *options, "--output", self.folder / "out")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        name = str(self.folder / "out" / (path.stem + "-safety.tif"))
        return gdal.Open(name), gdal.Open(name).ReadAsArray(), result.stdout

    def exact(self, tangent, depth, horizontal=0.):
        """Closed form of the infinite slope, with forces along the slope."""
        angle = math.atan(tangent)
        weight = 9.81 * depth * math.cos(angle)
        return (self.STRENGTH[0] + self.STRENGTH[1] * depth) / (
            weight * (625. * math.sin(angle) + 1650. * horizontal * math.cos(angle)))

    def test_plane(self):
        path = self.folder / "plane.tif"
        slope(path, azimuth=30)
        for depth, horizontal in ((10., 0.), (5., 0.1), (40., 0.05)):
            for options in ([], ["--length", 90]):
                file, factors, _ = self.factors(path, "--depths", depth, "--horizontal",
                                                horizontal, *options)
                inner = factors[8:-8, 8:-8]  # means beyond the edges are one-sided
                exact = self.exact(0.08, depth, horizontal)
                self.assertLess(abs(inner / exact - 1).max(), 1e-12)
        self.assertEqual(file.GetGeoTransform(), (EAST, CELL, 0, NORTH, 0, -CELL))
        self.assertTrue(osr.SpatialReference(file.GetProjection()).IsProjected())
        # The deepest surface has the least factor.
        _, factors, said = self.factors(path, "--depths", "5,40,10")
        self.assertAlmostEqual(factors[50, 50] / self.exact(0.08, 40.), 1, 10)
        self.assertIn("1: 0.0 %", said)

    def test_topography_of_geoclaw(self):
        """Numbers of a topography of type 3 belong to the centres of cells."""
        slope(self.folder / "same.tif", 0.2, 130., 40)
        heights = gdal.Open(str(self.folder / "same.tif")).ReadAsArray()
        path = self.folder / "same.tt3"
        path.write_text("\n".join([
            f"{40:9d} mx", f"{40:9d} my", f"{EAST + CELL / 2!r} xlower",
            f"{NORTH - 39.5 * CELL!r} ylower", f"{CELL} cellsize", "-9999 nodata_value",
            *(" ".join(map(repr, row)) for row in heights.tolist())]))
        one, other = (gis.open_raster(str(self.folder / name)) for name in ("same.tif", path))
        self.assertEqual(gis.extent(one), gis.extent(other))
        # GDAL keeps the numbers of a text in single precision: 3e-5 m at 300 m.
        self.assertLess(abs(one.dataset.ReadAsArray() - other.dataset.ReadAsArray()).max(), 3e-5)

    def test_table_gaps_and_flats(self):
        path = self.folder / "flat.tif"
        heights = numpy.full((50, 60), -100.)
        heights[20, 30] = numpy.nan
        write_raster(path, heights)
        table = self.folder / "strength.csv"
        table.write_text("depth [m],undrained shear strength [Pa]\n0,1000\n20,21000\n")
        _, factors, _ = self.factors(path, "--depths", "10", "--strength", table)
        self.assertEqual(factors[5, 5], 100)
        self.assertTrue(math.isnan(factors[20, 31]))
        _, factors, _ = self.factors(path, "--depths", "10", "--strength", table, "--horizontal",
                                     0.2)
        self.assertAlmostEqual(factors[5, 5], 11000 / (1650 * 9.81 * 10 * 0.2), 12)

    def test_degrees(self):
        """Distances on the ellipsoid: a degree of longitude is 111 320 m cos(latitude), roughly."""
        path = self.folder / "degrees.tif"
        _, x = numpy.mgrid[0:100, 0:100]
        write_raster(path, -200. - 0.7 * x, 15.3, 41., 1e-4, 4326)
        _, factors, _ = self.factors(path, "--depths", 10)
        radius = 6378137 / math.sqrt(1 - 6.69437999014e-3 * math.sin(math.radians(40.995))**2)
        tangent = 0.7 / (math.radians(1e-4) * radius * math.cos(math.radians(40.995)))
        self.assertAlmostEqual(factors[50, 50] / self.exact(tangent, 10.), 1, delta=1e-6)

    def test_refused(self):
        path = self.folder / "plane.tif"
        slope(path, n=20)
        for options, words in ((["--depths", "a"], "separated by commas"),
                               (["--depths", "0"], "numbers above 0"),
                               (["--strength", "5"], "two numbers A,B"),
                               (["--strength=-5,0"], "is not above 0"),
                               (["--output", "/dev/null/a"], "cannot be written")):
            self.assert_sentence(self.tool("talus-screen", path, *options), words)
        self.assert_sentence(self.tool("talus-screen", self.folder / "no.tif"), "cannot be read")


if __name__ == "__main__":
    main()

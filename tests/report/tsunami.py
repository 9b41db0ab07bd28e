# SPDX-License-Identifier: LGPL-2.1-or-later
"""talus-tsunami: degrees and netCDF against closed forms, damaged series and refused input.

Usage: tsunami.py TALUS ROOT FOLDER [SUITE]
"""

import math
import runpy
import sys
from types import SimpleNamespace
from unittest import mock

import numpy
from osgeo import gdal

from tools_case import Case, main

from talus_tools import gis
from talus_tools.errors import UserError
from talus_tools.plan import Cells
from talus_tools.results import read
from talus_tools.tsunami.degrees import heights_on_degrees, on_degrees, transformation
from talus_tools.tsunami.motion import Motion
from talus_tools.tsunami.write import write_netcdf

gdal.UseExceptions()
A, E2 = 6378137., 6.69437999014e-3  # WGS 84, m and -
UTM_33N = """PROJCS["WGS_1984_UTM_Zone_33N",GEOGCS["GCS_WGS_1984",
DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],
PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],
PROJECTION["Transverse_Mercator"],PARAMETER["False_Easting",500000.0],
PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",15.0],
PARAMETER["Scale_Factor",0.9996],PARAMETER["Latitude_Of_Origin",0.0],
UNIT["Meter",1.0]]"""


def radius_along(latitude):
    """Radius of curvature along the meridian [m]; latitude in degrees."""
    return A * (1 - E2) / (1 - E2 * numpy.sin(numpy.radians(latitude))**2)**1.5


def radius_across(latitude):
    """Radius of curvature across the meridian [m]; latitude in degrees."""
    return A / numpy.sqrt(1 - E2 * numpy.sin(numpy.radians(latitude))**2)


def northing_on_central_meridian(latitude):
    """Northing in UTM: 0.9996 times the length of the meridian from the equator [m], by
    Simpson's rule."""
    n = 2000
    weights = numpy.array([1, *[4, 2] * (n // 2 - 1), 4, 1])
    return (0.9996 * math.radians(latitude) / (3 * n)
            * (weights * radius_along(latitude * numpy.arange(n + 1) / n)).sum())


def hill(latitude):
    """A hill of 3 m, 400 m wide, with its top on the central meridian of UTM zone 33, on cells
    of 50 m; twice as high in block 1."""
    north = northing_on_central_meridian(latitude)
    # The top is not in the middle.
    cells = Cells(5e5 - 1700, north - 1900, 50., 50., 80, 80)
    x, y = numpy.meshgrid(cells.x() - 5e5, cells.y() - north)
    return Motion(cells, 0., 1., 2, lambda k: (k + 1) * 3 * numpy.exp(-(x**2 + y**2) / 400**2))


class Degrees(Case):
    def test_values_and_volume_of_a_hill(self):
        """Where the top lies follows from the definition of UTM, heights from distances on the
        ellipsoid, which the map shortens by 0.9996. Half a cell off would change values by
        0.16 m."""
        for latitude in (5., 67.3):
            for words in ("EPSG:32633", UTM_33N):
                motion = on_degrees(hill(latitude), words)
                cells, values = motion.cells, motion.change(1)
                self.assertTrue(motion.in_degrees)
                self.assertEqual(values.shape, (cells.rows, cells.columns))
                radians = math.radians(1)
                self.assertAlmostEqual(
                    cells.dx * radians * math.cos(latitude * radians) * radius_across(latitude),
                    50, delta=0.5)
                self.assertAlmostEqual(cells.dy * radians * radius_along(latitude), 50, delta=0.5)
                x, y = numpy.meshgrid(cells.x(), cells.y())
                east = (x - 15) * radians * numpy.cos(y * radians) * radius_across(latitude)
                north = (y - latitude) * radians * radius_along(latitude)
                exact = 6 * numpy.exp(-(east**2 + north**2) * (0.9996 / 400)**2)
                # Linear interpolation is wrong by h^2/8 times the second derivatives.
                self.assertLess(abs(values - exact).max(), 0.06)
                volume = (values * cells.dx * cells.dy * radians**2 * numpy.cos(y * radians)
                          * radius_along(y) * radius_across(y)).sum()
                self.assertAlmostEqual(volume / (6 * math.pi * (400 / 0.9996)**2), 1, delta=2e-3)

    def test_across_the_date_line(self):
        """Fiji: 180 degrees lies in UTM zone 60 south, at the eastern edge."""
        (east, north), = transformation("EPSG:32760", is_inverse=True)([(180., -17.)])
        cells = Cells(east - 500, north - 500, 100., 100., 10, 10)
        motion = on_degrees(Motion(cells, 0., 1., 1, lambda k: numpy.ones((10, 10))), "EPSG:32760")
        self.assertLess(motion.cells.columns, 16)
        middle = motion.cells.columns // 2
        self.assertAlmostEqual(abs(motion.cells.x()[middle]), 180, delta=2e-3)
        self.assertAlmostEqual(motion.change(0)[motion.cells.rows // 2, middle], 1, 12)

    def test_maps_that_are_none(self):
        for words in ("", "EPSG:999999", "EPSG:4326"):
            with self.assertRaises(UserError):
                on_degrees(hill(5.), words)


class Netcdf(Case):
    def test_read_back(self):
        """Rows of netCDF go north, rows of a raster south."""
        c = 1 / 3
        motion = Motion(Cells(100., 50., 10., 4., 3, 2), 7., .5, 2, lambda k: k * c * numpy.array(
            [[0., 1., 2.], [-3., -4., -5.]]))
        path = str(self.folder / "motion.nc")
        write_netcdf(path, motion)
        group = gdal.OpenEx(path, gdal.OF_MULTIDIM_RASTER).GetRootGroup()

        def values(name):
            return group.OpenMDArray(name).ReadAsArray().tolist()

        self.assertEqual(values("x"), [105, 115, 125])
        self.assertEqual(values("y"), [52, 56])
        self.assertEqual(values("time"), [7, 7.5])
        self.assertEqual(values("dz"), [[[0] * 3] * 2, [[-3 * c, -4 * c, -5 * c], [0, c, 2 * c]]])
        self.assertEqual([group.OpenMDArray(name).GetUnit() for name in ("x", "time", "dz")],
                         ["m", "s", "m"])
        # Another name: the library keeps files that are open.
        path = str(self.folder / "degrees.nc")
        write_netcdf(path, on_degrees(hill(5.), "EPSG:32633"))
        group = gdal.OpenEx(path, gdal.OF_MULTIDIM_RASTER).GetRootGroup()
        self.assertEqual([group.OpenMDArray(name).GetUnit() for name in ("lon", "lat")],
                         ["degrees_east", "degrees_north"])
        self.assertEqual(group.OpenMDArray("lat").ReadAsArray()[0],
                         on_degrees(hill(5.), "EPSG:32633").cells.y()[-1])
        with self.assertRaisesRegex(UserError, "could not be written"):
            write_netcdf("/no/such/folder/a.nc", motion)


class Series(Case):
    """A plan series that a run might have written: 1 m^3 moves by a cell."""
    HEAD = "time [s],column,volume [m^3],mass [kg],momentum x [N s],momentum y [N s],momentum z [N s]"
    ROWS = ["0,-1,4,8,0,0,0", "0,0,4,8,0,0,0",
            "1,-1,4,8,8,0,-8", "1,0,3,6,8,0,-8", "1,1,1,2,0,0,0"]

    def run_folder(self, rows, name="run"):
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        (folder / "parameters.prm").write_text(
            "subsection Output\n set Plan interval = 1\nend\n"
            "subsection Gravity\n set Magnitude = 9.81\nend\n")
        (folder / "plan-cells.csv").write_text(
            "west [m],south [m],dx [m],dy [m],columns,rows\n100,200,2,1,3,2\n")
        (folder / "plan.csv").write_text("\n".join([self.HEAD, *rows]))
        return folder

    def test_blocks(self):
        folder = self.run_folder([*self.ROWS, ""])
        result = self.tool("talus-tsunami", folder, "--water-depth", "10")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual((folder / "tsunami-source.tt3").read_text().split("\n"),
                         ["3 mx", "2 my", "2 mt", "101 xlower", "200.5 ylower", "1 t0", "2 dx",
                          "1 dy", "1 dt", *["0 0 0"] * 2, "-0.5 0.5 0", "0 0 0", ""])
        table = (folder / "tsunami-source.csv").read_text().split("\n")
        self.assertEqual([float(number) for number in table[2].split(",")],
                         [1, 1, 1, 0, 0, 1, -1, 1, -1, math.sqrt(2) / math.sqrt(9.81 * 10)])

    def test_history(self):
        series = read(self.run_folder([*self.ROWS, ""])).plan()
        for place, thickness, speed in (((101, 201.5), [2, 1.5], [0, 8 / 6]),
                                        ((103.9, 201), [0, 0.5], [0, 0]),
                                        ((101, 200.5), [0, 0], [0, 0])):
            times, depth, velocity = series.history(*place)
            self.assertEqual(times.tolist(), [0, 1])
            self.assertEqual(depth.tolist(), thickness)
            self.assertEqual(velocity[:, 0].tolist(), speed)
            self.assertEqual(velocity[:, 2].tolist(), [-v for v in speed])
        for place in ((99, 201), (107, 201), (101, 199), (101, 203)):
            with self.assertRaisesRegex(UserError, "outside of the cells"):
                series.history(*place)

    def test_state_that_is_being_written(self):
        """A last state without all of its soil is left out, with or without a whole last line."""
        for rows in ([*self.ROWS[:4], ""], self.ROWS):
            folder = self.run_folder(rows)
            self.assertEqual(self.tool("talus-tsunami", folder).returncode, 0)
            self.assertIn("1 mt\n", (folder / "tsunami-source.tt3").read_text())

    def floor(self, folder):
        """Maps of a sea floor that falls by 1 m per metre to the east, with soil in the west."""
        (folder / "maps").mkdir(exist_ok=True)
        head = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ndx 2\ndy 1\nnodata_value -9999\n"
        (folder / "maps" / "ground.asc").write_text(head + "-14 -15 -17\n" * 2)
        (folder / "maps" / "thickness-at-start.asc").write_text(head + "1 -9999 -9999\n" * 2)
        with (folder / "parameters.prm").open("a") as file:
            file.write("subsection Stations\n set Points = cable: 3, 1 | buoy: 4.5, 0.5\nend\n"
                       "subsection Grid\n set Origin = 100, 202, 0\nend\n")

    def set_by(self, folder):
        """What setrun.py sets. Clawpack is not at hand; in its place stand objects that take every
        attribute, and have lists for the pairs that Clawpack has."""
        pairs = {name: [0, 0] for name in ("lower", "upper", "num_cells", "bc_lower", "bc_upper")}
        data = SimpleNamespace(ClawRunData=lambda package, dim: SimpleNamespace(
            clawdata=SimpleNamespace(**pairs), amrdata=SimpleNamespace(),
            geo_data=SimpleNamespace(), refinement_data=SimpleNamespace(),
            topo_data=SimpleNamespace(topofiles=[]), dtopo_data=SimpleNamespace(dtopofiles=[]),
            qinit_data=SimpleNamespace(), gaugedata=SimpleNamespace(gauges=[])))
        modules = {"clawpack": SimpleNamespace(), "clawpack.clawutil": SimpleNamespace(data=data)}
        with mock.patch.dict(sys.modules, modules):
            return runpy.run_path(str(folder / "setrun.py"))["setrun"]()

    def test_geoclaw(self):
        """The topography is the ground and the soil on it, at the centres of the cells; the domain
        lies within, and stations are gauges."""
        folder = self.run_folder([*self.ROWS, ""])
        self.floor(folder)
        result = self.tool("talus-tsunami", folder, "--geoclaw", "--sea-level", "2")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        raster = gis.open_raster(str(folder / "topography.tt3"))
        self.assertEqual(raster.dataset.ReadAsArray().tolist(), [[-13, -15, -17]] * 2)
        self.assertEqual(gis.extent(raster), (100, 200, 106, 202))
        case = self.set_by(folder)
        self.assertEqual((case.clawdata.lower, case.clawdata.upper), ([101, 200.5], [105, 201.5]))
        self.assertEqual(case.clawdata.num_cells, [2, 1])
        self.assertEqual(case.topo_data.topofiles, [[3, "topography.tt3"]])
        self.assertEqual(case.dtopo_data.dtopofiles, [[3, "tsunami-source.tt3"]])
        self.assertEqual((case.geo_data.coordinate_system, case.geo_data.sea_level), (1, 2))
        self.assertEqual([gauge[:3] for gauge in case.gaugedata.gauges],
                         [[1, 103, 201], [2, 104.5, 201.5]])
        # Twice the way of 6.32 m at sqrt(9.81 * 19) m/s after the last block, at 2 s.
        self.assertEqual(case.clawdata.tfinal, 3)

    def test_geoclaw_in_degrees(self):
        """Linear interpolation of a plane is exact; outside, the plane ends level."""
        x, y = numpy.meshgrid(*(numpy.arange(3) * 100. + c for c in (5e5, 6.5e6)))
        cells = Cells(5e5 - 50, 6.5e6 - 50, 100., 100., 3, 3)
        degrees = on_degrees(Motion(cells, 0., 1., 1, lambda k: 0 * x), "EPSG:32633").cells
        heights = heights_on_degrees(cells, (0.1 * x - 0.2 * y)[::-1], degrees, "EPSG:32633")
        places = transformation("EPSG:32633", is_inverse=True)(
            numpy.stack(numpy.meshgrid(degrees.x(), degrees.y()), axis=-1).reshape(-1, 2))
        exact = (0.1 * places[:, 0].clip(5e5, 5e5 + 200)
                 - 0.2 * places[:, 1].clip(6.5e6, 6.5e6 + 200)).reshape(heights.shape)
        self.assertLess(abs(heights - exact).max(), 1e-6)

    def test_geoclaw_refused(self):
        folder = self.run_folder([*self.ROWS, ""], "dry")
        self.assert_sentence(self.tool("talus-tsunami", folder, "--geoclaw"),
                             "has no map 'maps/ground.asc'", "Maps/Write")
        self.floor(folder)
        self.assert_sentence(self.tool("talus-tsunami", folder, "--geoclaw", "--sea-level", "-20"),
                             "at -15 m and higher", "--sea-level")
        ground = folder / "maps" / "ground.asc"
        ground.write_text(ground.read_text().replace("-17", "-9999"))
        self.assert_sentence(self.tool("talus-tsunami", folder, "--geoclaw"), "2 cells without")

    def test_refused(self):
        folder = self.run_folder([*self.ROWS, ""])
        for options, words in ((["--width", "3"], "has a width of its own"),
                               (["--interval", "0.25"], "Give a longer --interval"),
                               (["--interval", "x"], "options cannot be understood"),
                               (["--start-time", "-1"], "no number above 0"),
                               (["--degrees"], "coordinate system of the map is not known"),
                               (["--output", "/dev/null/a"], "cannot be made")):
            self.assert_sentence(self.tool("talus-tsunami", folder, *options), words)
        for rows, words in (([], "no complete state yet"), (["0,-1,4", ""], "rows of 3 numbers"),
                            (["0,a,4,8,0,0,0", ""], "is damaged")):
            result = self.tool("talus-tsunami", self.run_folder(rows, "bad"))
            self.assert_sentence(result, words)
            self.assertTrue(result.stderr.startswith("talus-tsunami: "), result.stderr)
        (folder / "plan-cells.csv").write_text(
            "west [m],south [m],dx [m],dy [m],columns,rows\n100,200,2,1,3000,20000\n")
        self.assert_sentence(self.tool("talus-tsunami", folder), "where 10000000 are the most")
        (folder / "plan.csv").unlink()
        self.assert_sentence(self.tool("talus-tsunami", folder), "'Output/Plan interval'")


if __name__ == "__main__":
    main()

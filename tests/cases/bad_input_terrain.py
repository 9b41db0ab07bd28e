# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus says to rasters and surfaces that are none; run by bad_input.py."""

from bad_input_case import Case



class BadInputTerrain(Case):
    HEAD = "ncols 3\nnrows 3\nxllcorner -5\nyllcorner -5\ncellsize 5\n"
    ROWS = "1 1 1\n1 1 1\n1 1 1\n"
    BED = ["Surfaces/Names=bed", "Obstacles/Names=bottom",
           "Obstacles/bottom/Shape=terrain", "Obstacles/bottom/Surface=bed",
           "Bodies/block/Lower corner=1,1"]
    FILE = BED + ["Surfaces/bed/File=bed.asc", "Surfaces/bed/Section=0,0; 5,0"]

    def refuse_raster(self, content, *words):
        (self.folder / "bed.asc").write_bytes(content.encode("latin-1"))
        self.refuse_set(self.FILE, "bed.asc", *words)

    def test_good_raster_runs(self):
        (self.folder / "bed.asc").write_text(self.HEAD + self.ROWS)
        result = self.run_file(settings=self.FILE)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_bed_below_the_mesh_is_told(self):
        """Where the bed leaves a mesh whose bottom is free, soil would, too."""
        words = "The surface of the obstacle 'bottom' goes up to"
        for rows, bottom, told in ((self.ROWS, "free", False),
                                   ("1 1 -20\n" * 3, "free", True),
                                   ("1 1 -20\n" * 3, "roller", False)):
            with self.subTest(rows=rows, bottom=bottom):
                (self.folder / "bed.asc").write_text(self.HEAD + rows)
                result = self.run_file(settings=self.FILE + [
                    "Boundaries/Bottom=" + bottom])
                self.assertEqual(result.returncode, 0, result.stderr)
                log = next(self.folder.rglob("log.txt")).read_text()
                self.assertEqual(words in log, told, log)

    def test_rasters(self):
        for content, *words in (
                ("", "cannot be read or is empty"),
                ("CDF\x01...", "no Esri ASCII grid", "GDAL"),
                ("II*\0...", "no Esri ASCII grid", "GDAL"),
                ("<html>", "no Esri ASCII grid", "GDAL"),
                (self.HEAD + "1 1 1\n1 1\n1 1 1\n", "line 7", "row 2 has 2"),
                (self.HEAD + "1 1 1\n1 a 1\n1 1 1\n", "line 7", "'a'",
                 "column 2"),
                (self.HEAD + "1 1 1\n", "1 rows of values, where 3"),
                ("ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 5\n1\n",
                 "needs two of both"),
                # Where the mesh is there is no value, or no map.
                (self.HEAD + "1 1 1\n1 -9999 1\n1 1 1\n", "has no value at",
                 "easting", "mesh smaller"),
                (self.HEAD.replace("-5", "6e5") + self.ROWS, "has no value at",
                 "from 600000 m to 600015 m"),
                ("ncols 3\nnrows 3\nxllcorner 4\nyllcorner 63\ncellsize "
                 "0.004\n" + self.ROWS, "has no value at",
                 "raster in degrees needs a `Projection`")):
            with self.subTest(content):
                self.refuse_raster(content, *words)

    def test_projections(self):
        (self.folder / "bed.asc").write_text(self.HEAD + self.ROWS)
        for settings, *words in (
                (["Projection=UTM 33"], "'Surfaces/bed/Projection' = 'UTM 33'",
                 "hemisphere"),
                (["Projection=UTM 33N"], "lengths would be wrong by"),
                (["Projection=EPSG:4326"], "in metres that GDAL knows"),
                (["Cell size=5"], "'Surfaces/bed/Cell size' is 5 m",
                 "`Projection`")):
            with self.subTest(settings):
                self.refuse_set(self.FILE + ["Surfaces/bed/" + s
                                             for s in settings], *words)
        # By the file beside it.
        (self.folder / "bed.prj").write_text(
            'GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",'
            '6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],'
            'UNIT["Degree",0.0174532925199433]]')
        self.refuse_set(self.FILE, "bed.asc", "is in degrees", "UTM 31N")

    def test_surfaces(self):
        layer = ["Bodies/block/Shape=layer", "Bodies/block/Lower surface=0"]
        for settings, *words in (
                (["Surfaces/Names=x"], "'Surfaces/Names' lists 'x'", "word"),
                (["Surfaces/Names=bed"], "none of the entries `File`, `Expression` and `Outline`"),
                (self.FILE + ["Surfaces/bed/Expression=1"],
                 "more than one of the entries"),
                (self.BED + ["Surfaces/bed/File=bed.asc"],
                 "'Surfaces/bed/Section'", "two corners"),
                (self.FILE + ["Surfaces/bed/Section=0,0; 1"],
                 "'Surfaces/bed/Section' contains '1'"),
                (self.FILE + ["Surfaces/bed/Section=1,0; 1,0"],
                 "twice in a row"),
                (self.BED + ["Surfaces/bed/Expression=2*q"],
                 "'Surfaces/bed/Expression' = '2*q' cannot be understood: "
                 "Unexpected token \"q\""),
                (self.BED + ["Surfaces/bed/Expression=(2*x"],
                 "Missing parenthesis. Expected an expression in x"),
                (self.BED + ["Surfaces/bed/Outline=0,0; 1,0; 0,1"],
                 "corners x, z of the mesh", "'Surfaces/bed/Coordinates' = map"),
                (self.BED + ["Surfaces/bed/Outline=0,0; 1,0; 0,1",
                             "Surfaces/bed/Coordinates=map"],
                 "the outline is cut along one", "two corners"),
                (self.BED + ["Surfaces/bed/Expression=1", "Surfaces/bed/Attribute=depth"],
                 "'Surfaces/bed/Attribute' is 'depth'", "`File`"),
                (self.FILE + ["Surfaces/bed/Attribute=depth"], "is a raster"),
                (self.BED + ["Surfaces/bed/Expression=1", "Surfaces/bed/Quantity=other"],
                 "'Surfaces/bed/Quantity' is 'other'", "`File`"),
                (["Surfaces/Names=depth"], "'Surfaces/Names' lists 'depth'", "word"),
                (["Gravity/Horizontal coefficient=0.1, 0.2"], "at most 1 were expected"),
                (layer, "'Bodies/block/Upper surface' is empty",
                 "'Surfaces/Names'"),
                (layer + ["Bodies/block/Upper surface=mudline"],
                 "'Bodies/block/Upper surface' = 'mudline'", "understood"),
                (layer + ["Bodies/block/Upper surface=3 + x"],
                 "above the top of the mesh", "'Grid/Upper corner'"),
                (layer + ["Bodies/block/Upper surface=2", "Constants=x1=2",
                          "Bodies/block/Upper corner=1,5"],
                 "'Bodies/block/Upper corner'", "beyond the lower corner")):
            with self.subTest(settings):
                self.refuse_set(settings, *words)

    def test_sections_that_turn_back(self):
        (self.folder / "bed.asc").write_text(self.HEAD + self.ROWS)
        for section, *words in (
                ("0,0; 5,0; 0,0", "turns back at its corner 2, (5 0) m"),
                ("0,0; 5,0; 0,0.001", "turns back at its corner 2"),
                ("0,0; 5,0; 5,4; 3,4; 3,-1", "crosses or touches itself")):
            with self.subTest(section):
                self.refuse_set(self.FILE + [f"Surfaces/bed/Section={section}"],
                                "'Surfaces/bed/Section'", *words)
        result = self.run_file(settings=self.FILE + [
            "Surfaces/bed/Section=0,0; 2,0; 4,4"])
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_layers_without_thickness(self):
        for upper, lower in (("1", "1"), ("1+0.1*x", "1+0.1*x"), ("0.5", "1"),
                             ("1+0.5*sin(x)", "1+0.5*sin(x)")):
            with self.subTest(upper):
                self.refuse_set(self.layer(upper, lower), "The layer 'block' has "
                                "no thickness", "'Bodies/block/Upper surface'")

    def layer(self, upper, lower):
        return ["Bodies/block/Shape=layer", f"Bodies/block/Upper surface={upper}",
                f"Bodies/block/Lower surface={lower}"]

    def test_remarks(self):
        """What is allowed but seldom meant."""
        pipe = ["Obstacles/Names=bed, pipe", "Obstacles/bed/Shape=half-plane",
                "Obstacles/bed/Normal=0,1", "Obstacles/pipe/Shape=ball",
                "Obstacles/pipe/Radius=1", "Bodies/block/Lower corner=1,0"]
        slope = "ncols 2\nnrows 2\nxllcorner -10\nyllcorner -10\ncellsize 20\n"
        (self.folder / "up.asc").write_text(slope + "-1 3\n-1 3\n")
        raster = ["Surfaces/Names=bed", "Surfaces/bed/File=up.asc"]
        clay = ["Materials/clay/Law=von Mises",
                "Materials/clay/Poisson's ratio=0.49"]
        for settings, *words in (
                (clay[:1] + ["Materials/clay/Young's modulus=1e3"],
                 "Body 'block': the soil is too soft: rho' g H/G = "),
                (["Materials/Names=clay, sand"],
                 "Section /Materials/sand: no body is made of this material"),
                (self.layer("2-0.5*x", "0.5*x-0.2"), "lies above the upper surface",
                 "by up to 0.3 m, at x = 2.5 m"),
                (self.layer("1", "-1"),
                 "50 % of the layer lie beyond this face", "'Grid/Lower corner'"),
                (self.layer("1.5", "0"), "ends in a free face of 1.5 m"),
                (["Materials/clay/Density=1e-6"], "0.1 to 30000 kg/m^3"),
                (self.layer("1.5", "0"), "Body 'block': the soil is 1.5 cells of 1 m"),
                (pipe + ["Obstacles/pipe/Centre=2,-1.2", "Grid/Lower corner=0,-4"],
                 "(do not use the results): Obstacle 'pipe': no part lies"),
                (pipe + ["Obstacles/pipe/Centre=2,-9"],
                 "Obstacle 'pipe': no part lies"),
                (pipe + ["Obstacles/pipe/Centre=2,3", "Obstacles/pipe/Radius=0.9"],
                 "Obstacle 'pipe': only 1.8 m along x, less than two cells of 1 m"),
                (clay + pipe[:3] + ["Obstacles/Names=bed",
                                    "Obstacles/bed/Friction coefficient=1.9"],
                 "Obstacle 'bed': there is no 'Maximum shear stress'", "1.9 times"),
                (raster + ["Surfaces/bed/Section=-5,0; 5,0"], "'bed' rises",
                 "'Surfaces/bed/Section'")):
            with self.subTest(words):
                result = self.run_file(settings=settings + ["End time=0"])
                self.assertEqual(result.returncode, 0, result.stderr)
                for word in words:
                    self.assertIn(word, result.stdout)
                self.assertRegex(result.stdout, "Remark 1( .*)?: ")
        # Nearly the same, as it is meant.
        for settings in (
                self.layer("2", "0") + ["Bodies/block/Lower corner=0,0",
                                        "Bodies/block/Upper corner=4,0"],
                raster + ["Surfaces/bed/Section=5,0; -5,0"],
                pipe + ["Obstacles/pipe/Centre=0.5,3.9"],
                clay + pipe[:3] + ["Obstacles/Names=bed"], # rough on purpose
                clay + pipe[:3] + ["Obstacles/Names=bed",
                                   "Obstacles/bed/Friction coefficient=1.9",
                                   "Obstacles/bed/Maximum shear stress=1e3"]):
            with self.subTest(settings):
                result = self.run_file(settings=settings + ["End time=0"])
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertNotIn("Remark", result.stdout)

    def test_maps_and_stations(self):
        for settings, *words in (
                (["Maps/Write=true", "Maps/Raster=bed"],
                 "'Maps/Raster' is 'bed'", "no surface with a raster"),
                (["Maps/Write=true", "Maps/Cell size=1e-9"],
                 "'Maps/Cell size' larger"),
                (["Stations/Points=3"], "'Stations/Points' contains '3'",
                 "'name: place'"),
                (["Stations/Points=a: 1, 2"], "contains '1, 2'",
                 "one number, x"),
                (["Stations/Points=a: 1e9"], "'a' has a place '1e9' outside"),
                (["Stations/Points=a: 1 | a: 2"],
                 "two entries of the name 'a'"),
                (["Stations/Points=a: 1; 2"], "2 places", "one was expected"),
                (["Stations/Points=a: 1", "Stations/Coordinates=map"],
                 "'Stations/Coordinates' is 'map'", "section"),
                (["Stations/Lines=a: 1; 1"], "'a' has no length")):
            with self.subTest(settings):
                self.refuse_set(settings, *words)

    def test_numbers_out_of_any_range(self):
        station, maps = ["Stations/Points=a: 2"], ["Maps/Write=true"]
        for settings, *words in (
                (maps + ["Maps/Cell size=1e29"], "'Maps/Cell size' is 1e+29",
                 "4 m of the mesh"),
                (maps + ["Maps/Arrival thresholds=1, 5"],
                 "'Maps/Arrival thresholds' is 5", "4 m high"),
                (maps + ["Maps/Arrival thresholds=1, 0.5, 1"], "1 m twice"),
                (maps + ["Maps/Smallest thickness=1e29"],
                 "'Maps/Smallest thickness'", "cannot reach"),
                (["Stations/Lines=a: 1; 2", "Stations/Width=1e-8"],
                 "'Stations/Lines'", "100000000 places", "'Stations/Width'"),
                (station + ["Stations/Width=1e29"], "'Stations/Width' is 1e+29"),
                (station + ["Stations/Width=1e-300"], "'Stations/Width' is 1e-300"),
                (station + ["Stations/Drag coefficient=1e29"],
                 "'Drag coefficient'", "from 0 to 1000"),
                (station + ["Stations/Bearing factor=1e29"],
                 "'Bearing factor'", "from 0 to 1000"),
                (["Water/Added mass coefficient=1e29"],
                 "'Added mass coefficient'", "from 0 to 1000"),
                (["Water/Density=1e29"], "'Density'", "to 100000"),
                (["Grid/Origin=1e29,0,0"], "'Origin'", "1e+09"),
                (self.FILE + ["Surfaces/bed/Section=0,0; 1e29,0"],
                 "'1e29,0'", "at most 1e9 m")):
            with self.subTest(settings):
                self.refuse_set(settings, *words)
        obstacle = ["Obstacles/Names=pipe", "Obstacles/pipe/Shape=ball",
                    "Obstacles/pipe/Centre=3.5,3.5",
                    "Obstacles/pipe/Radius=0.25"]
        for setting, *words in (
                ("Velocity=1e29;0", "'Obstacles/pipe/Velocity'", "t = 0 s"),
                ("Centre=1e300,0", "'Obstacles/pipe/Centre'", "1e+30"),
                ("Normal=0,0", "'Obstacles/pipe/Normal'",
                 "no direction")):
            with self.subTest(setting):
                self.refuse_set(obstacle + ["Obstacles/pipe/" + setting]
                                + ["Obstacles/pipe/Shape=half-plane"]
                                * setting.startswith("Normal"), *words)

    def test_routes_of_pipes(self):
        """In a section whose raster reaches from -5 to 10 m of the map."""
        (self.folder / "bed.asc").write_text(self.HEAD + self.ROWS)
        (self.folder / "degrees.geojson").write_text(
            '{"type": "LineString", "coordinates": [[15.1, 41], [15.2, 41]]}')
        route = "Obstacles/pipe/Route="
        pipe = [entry for entry in self.FILE if "Names" not in entry] + [
            "Obstacles/Names=bottom, pipe", "Obstacles/pipe/Shape=pipe",
            "Obstacles/pipe/Coordinates=map", "Obstacles/pipe/Radius=1",
            "Obstacles/pipe/Height of axis=bed + 1"]
        for settings, *words in (
                (["Surfaces/Names=bed", route + "1,1; 2,2"],
                 "'Obstacles/pipe/Route'", "does not cross the section"),
                (["Surfaces/Names=bed", route + "1e8,1; 1e8,-1"],
                 "'Obstacles/pipe/Height of axis'", "has no value"),
                (["Surfaces/Names=bed", route + "1e29,1; 1e29,-1"],
                 "'Obstacles/pipe/Route' contains '1e29,1'", "at most 1e9 m"),
                (["Surfaces/Names=bed", route + "none.geojson"],
                 "none.geojson", "cannot be read"),
                (["Surfaces/Names=bed", route + "none.shp"], "none.shp",
                 "cannot be read"),
                (["Surfaces/Names=bed", route + "degrees.geojson"],
                 "'Obstacles/pipe/Route'", "in degrees", "`Projection`"),
                (["Surfaces/Names=bed, base", "Surfaces/base/File=bed.asc",
                  "Surfaces/base/Section=0,0; 0,5", route + "3,-1; 3,1"],
                 "'Obstacles/pipe/Route'", "two lines",
                 "'Surfaces/base/Section'"),
                (["Surfaces/Names=bed", route + "3,-1; 3,1",
                  "Grid/Coordinates=map"],
                 "'Grid/Coordinates' is 'map'", "two-dimensional"),
                (["Surfaces/Names=bed", route + "3,-1; 3,1",
                  "Stations/Coordinates=map", "Stations/Points=a: 3, 0"],
                 "'Stations/Coordinates' is 'map'", "two-dimensional")):
            with self.subTest(settings):
                self.refuse_set(pipe + settings, *words)

    def test_rasters_of_no_ground(self):
        for content, *words in (
                (self.HEAD + "1 1 1\n1 9.97e36 1\n1 1 1\n",
                 "heights from 1 to 9.97e+36 m", "is 9.97e+36 a value for no data",
                 "nodata_value 9.97e+36"),
                (self.HEAD + "nodata_value 0\n1 1 1\n1 -9999 1\n1 1 1\n",
                 "heights from -9999 to 1 m", "does not declare?", "nodata_value -9999 in"),
                (self.HEAD.replace("size 5", "size 1e300") + self.ROWS,
                 "reaches to 3e+300 m", "head"),
                (self.HEAD.replace("ncols 3", "ncols 1000000000")
                 .replace("nrows 3", "nrows 1000000000") + self.ROWS, "")):
            with self.subTest(content):
                self.refuse_raster(content, *words)
        for name in ("/dev/zero", ".", "/dev/null", "missing.asc"):
            self.refuse_set(self.BED + ["Surfaces/bed/File=" + name,
                                        "Surfaces/bed/Section=0,0; 5,0"],
                            "cannot be read", "existing file")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Maps, stations and lines of short slides.

Usage: maps.py TALUS FOLDER MPIEXEC PRM_FOLDER.
"""

import csv
import math
import struct
import sys
import unittest
import zlib

from ranks_case import TALUS, Case


NAMES = ["ground", "erosion", "final-thickness", "final-mass", "thickness-at-start",
         "arrival-time-0.5-m", "arrival-time-1-m",
         *[f"{what}maximum-{of}" for what in ("", "time-of-")
           for of in ("thickness", "speed", "momentum-flux", "bed-shear")],
         "largest-pore-pressure-ratio", "excess-pore-pressure-at-the-bed"]
UNDRAINED = ["Materials/clay/Pore water/Drainage=undrained",
             "Materials/clay/Pore water/Stiffness=1e6"]


def read_table(path):
    with open(path) as file:
        return [{k: v if k == "line" else float(v or "nan") for k, v in row.items()}
                for row in csv.DictReader(file)]


def read_raster(path):
    """Head and the values by column and row; None where there is no datum."""
    lines = path.read_text().splitlines()
    n = sum(line[0].isalpha() for line in lines)
    head = {key: float(value) for key, value in map(str.split, lines[:n])}
    rows = [[None if float(v) == head["nodata_value"] else float(v)
             for v in line.split()] for line in lines[n:]]
    assert len(rows) == head["nrows"]
    assert all(len(row) == head["ncols"] for row in rows)
    return head, rows


# As GIS write it beside a grid.
UTM_33N = """PROJCS["WGS_1984_UTM_Zone_33N",GEOGCS["GCS_WGS_1984",
DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],
PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],
PROJECTION["Transverse_Mercator"],PARAMETER["False_Easting",500000.0],
PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",15.0],
PARAMETER["Scale_Factor",0.9996],PARAMETER["Latitude_Of_Origin",0.0],
UNIT["Meter",1.0]]"""


def read_tiff(path):
    """Tags by number, and the values: strips of doubles, by the standard."""
    data = path.read_bytes()
    assert data[:4] == b"II*\0"
    start, = struct.unpack("<I", data[4:8])
    n, = struct.unpack_from("<H", data, start)
    tags = {}
    for i in range(n):
        tag, kind, count = struct.unpack_from("<HHI", data, start + 2 + 12 * i)
        form = f"<{count}{' BsHI       d'[kind]}"
        at = start + 10 + 12 * i
        if struct.calcsize(form) > 4:
            at, = struct.unpack_from("<I", data, at)
        value = struct.unpack_from(form, data, at)
        if kind == 2:
            value = value[0].rstrip(b"\0 ").decode()
        tags[tag] = value[0] if count == 1 and kind != 2 else value
    # 64 bits, deflated, floating point.
    assert (tags[258], tags[259], tags[339]) == (64, 8, 3)
    as_tuple = [v if isinstance(v, tuple) else (v,)
                for v in (tags[273], tags[279])]
    strips = b"".join(zlib.decompress(data[at:at + size])
                      for at, size in zip(*as_tuple))
    tags["values"] = list(struct.unpack(f"<{len(strips) // 8}d", strips))
    return tags


class Maps(Case):
    SLIDE = ["Grid/Cell size=0.8", "End time=4", "Output/Field interval=0.5",
             "Output/Statistics interval=0.5", "Output/Write points=false",
             "Output/Write grid=false", "Maps/Write=true",
             "Maps/Arrival thresholds=0.5, 1"]

    def assert_close(self, a, b, tolerance):
        self.assertTrue(abs(a - b) <= tolerance * max(1, abs(a))
                        or (math.isnan(a) and math.isnan(b)), (a, b))

    def assert_same_table(self, a, b, tolerance):
        self.assertEqual(len(a), len(b))
        for row, other in zip(a, b):
            self.assertEqual(list(row), list(other))
            for key in row:
                # Of a maximum that stays, the last digits say when it was.
                if not key.startswith(("line", "time of")):
                    self.assert_close(row[key], other[key], tolerance)

    def check_against_profile(self, folder):
        """Columns are those of the profile, whose rows are some samples."""
        maps = {round(row["x [m]"], 6): row
                for row in read_table(folder / "maps.csv")}
        profile = read_table(folder / "profile.csv")
        last = profile[-1]["time [s]"]
        for row in profile:
            column = maps[round(row["x [m]"], 6)]
            self.assertGreaterEqual(column["maximum thickness [m]"],
                                    row["thickness [m]"] * (1 - 1e-12))
            if row["thickness [m]"] > 0.08:
                self.assertGreaterEqual(
                    column["maximum speed [m/s]"],
                    abs(row["depth-mean velocity [m/s]"]) * (1 - 1e-12))
            if row["time [s]"] == last:
                self.assert_close(column["final thickness [m]"],
                                  row["thickness [m]"], 1e-12)
            if row["time [s]"] == 0:
                self.assert_close(column["thickness at start [m]"],
                                  row["thickness [m]"], 1e-12)
        return maps

    def check_stations(self, folder):
        """Stations in the middle of columns of the profile."""
        profile = {(row["time [s]"], round(row["x [m]"], 6)): row
                   for row in read_table(folder / "profile.csv")}
        n = 0
        for row in read_table(folder / "stations.csv"):
            for name, x in (("toe", 30.8), ("far", 40.4)):
                column = profile.get((row["time [s]"], x))
                thickness = row[f"{name} thickness [m]"]
                if column is None:
                    self.assertEqual(thickness, 0)
                    continue
                n += 1
                self.assert_close(thickness, column["thickness [m]"], 1e-12)
                self.assert_close(row[f"{name} depth-mean velocity x [m/s]"],
                                  column["depth-mean velocity [m/s]"], 1e-12)
                u = math.hypot(row[f"{name} depth-mean velocity x [m/s]"],
                               row[f"{name} depth-mean velocity y [m/s]"])
                self.assert_close(row[f"{name} flux [m^2/s]"], thickness * u,
                                  1e-12)
                s_u = row[f"{name} shear strength [Pa]"]
                pressure = row[f"{name} impact pressure [Pa]"]
                flux = row[f"{name} momentum flux [N/m]"]
                self.assert_close(pressure, 0.5 * 0.4 * flux / thickness
                                  + 11.9 * s_u, 1e-9)
        self.assertGreater(n, 10)

    def test_slide(self):
        settings = self.SLIDE + UNDRAINED + ["Stations/Points=toe: 30.8 | far: 40.4",
                                 "Stations/Lines=all: -9.2; 60.4",
                                 "Stations/Drag coefficient=0.4",
                                 "Stations/Bearing factor=11.9"]
        folder = self.run_talus("one", "landslide-quick.prm", settings)
        maps = self.check_against_profile(folder)
        self.check_stations(folder)
        # All soil is on the map.
        statistics = read_table(folder / "statistics.csv")
        self.assert_close(
            0.8 * sum(c["final mass [kg/m^2]"] for c in maps.values()),
            statistics[-1]["mass [kg]"], 1e-12)
        for column in maps.values():
            self.assertLessEqual(column["maximum bed shear [Pa]"],
                                 1000 * (1 + 1e-9))
        self.assert_close(max(c["maximum bed shear [Pa]"]
                              for c in maps.values()), 1000, 1e-9)
        self.check_line(folder, maps)
        other = self.run_talus("two", "landslide-quick.prm", settings, 2)
        for name in ("maps.csv", "stations.csv", "lines.csv"):
            self.assert_same_table(read_table(folder / name),
                                   read_table(other / name), 1e-9)

    def check_line(self, folder, maps):
        """A line over the mesh's columns sees what the map sees."""
        n = 0
        for row in read_table(folder / "lines.csv"):
            self.assertEqual(row["line"], "all")
            self.assert_close(row["distance [m]"], row["x [m]"] + 9.2, 1e-9)
            column = maps.get(round(row["x [m]"], 6))
            if column is not None:
                n += 1
                for key in ("maximum speed [m/s]", "arrival time 0.5 m [s]"):
                    self.assert_close(row[key], column[key], 1e-9)
        self.assertGreater(n, 0)

    def test_few_samples(self):
        """Cheaper, and never more than with all. Samples of two distances
        of motion are taken at other times, so only samples of every step are
        an upper bound."""
        every = self.run_talus("every", "landslide-quick.prm", self.SLIDE + [
            "Maps/Motion between samples=0"])
        some = self.run_talus("some", "landslide-quick.prm", self.SLIDE + [
            "Maps/Motion between samples=0.5"])
        for a, b in zip(read_table(every / "maps.csv"),
                        read_table(some / "maps.csv")):
            self.assertGreaterEqual(a["maximum speed [m/s]"],
                                    b["maximum speed [m/s]"])
            self.assert_close(a["final thickness [m]"],
                              b["final thickness [m]"], 0)

    def test_rasters(self):
        """In 3-D, on the map, where z points south; a line in map coordinates
        sees what a station in those of the mesh sees."""
        settings = UNDRAINED + ["Grid/Cell size=1.2", "End time=0.3",
                    "Output/Field interval=0.1", "Maps/Write=true",
                    "Maps/Arrival thresholds=0.5, 1", "Maps/Cell size=2.4",
                    "Grid/Origin=5e5, 6.5e6, -100",
                    "Stations/Coordinates=map",
                    "Stations/Points=a: 500006, 6499998",
                    "Stations/Lines=a: 500006, 6499998; 500006, 6499999"]
        folder = self.run_talus("one", "landslide-3d.prm", settings)
        rasters = {name: read_raster(folder / "maps" / f"{name}.asc")
                   for name in NAMES}
        self.assertEqual(sorted(p.stem for p in (folder / "maps").iterdir()),
                         sorted(NAMES))
        head, ground = rasters["ground"]
        self.assertEqual({h for row in ground for h in row}, {-100.})
        self.assertEqual(head["cellsize"], 2.4)
        profile = read_table(folder / "profile.csv")
        last = profile[-1]["time [s]"]
        # A cell of the map is 2 x 2 columns of the profile.
        expected = {}
        for row in profile:
            if row["time [s]"] == last:
                i = int((5e5 + row["x [m]"] - head["xllcorner"]) / 2.4)
                north = head["yllcorner"] + head["nrows"] * 2.4
                j = int((north - (6.5e6 - row["z [m]"])) / 2.4)
                expected[i, j] = (expected.get((i, j), 0)
                                  + row["thickness [m]"] / 4)
        found = {(i, j): h
                 for j, row in enumerate(rasters["final-thickness"][1])
                 for i, h in enumerate(row) if h}
        self.assertEqual(found.keys(), expected.keys())
        for cell in expected:
            self.assert_close(found[cell], expected[cell], 1e-9)
        station = read_table(folder / "stations.csv")[-1]
        line = read_table(folder / "lines.csv")[0]
        self.assertEqual((line["x [m]"], line["z [m]"]), (6, 2))
        self.assertGreater(station["a thickness [m]"], 1)
        self.assert_close(line["final thickness [m]"],
                          station["a thickness [m]"], 1e-12)
        self.assertIn("maximum speed", (folder / "maps.vtu").read_text())
        other = self.run_talus("two", "landslide-3d.prm", settings, 2)
        for name in NAMES:
            a, b = rasters[name], read_raster(other / "maps" / f"{name}.asc")
            self.assertEqual(a[0], b[0])
            for row, other_row in zip(a[1], b[1]):
                for x, y in zip(row, other_row):
                    self.assertEqual(x is None, y is None)
                    if x is not None and not name.startswith("time-of"):
                        self.assert_close(x, y, 1e-9)

    def test_geotiff(self):
        """The same numbers at the same places, with the map of the input."""
        rows = "".join(" ".join(["-100"] * 40) + "\n" for _ in range(40))
        (self.folder / "sea.asc").write_text(
            "ncols 40\nnrows 40\nxllcorner 499990\nyllcorner 6499930\n"
            "dx 3\ndy 2.5\nnodata_value -1\n" + rows)
        (self.folder / "sea.prj").write_text(UTM_33N)
        settings = ["Grid/Cell size=1.2", "End time=0.1", "Maps/Write=true",
                    "Maps/Write GeoTIFF=true", "Grid/Origin=5e5, 6.5e6, -100",
                    "Surfaces/Names=sea",
                    f"Surfaces/sea/File={self.folder / 'sea.asc'}"]
        folder = self.run_talus("run", "landslide-3d.prm", settings)
        names = sorted(p.stem for p in (folder / "maps").glob("*.asc"))
        self.assertIn("maximum-thickness", names)
        self.assertEqual(
            names, sorted(p.stem for p in (folder / "maps").glob("*.tif")))
        for name in names:
            head, values = read_raster(folder / "maps" / f"{name}.asc")
            tags = read_tiff(folder / "maps" / f"{name}.tif")
            self.assertEqual(tags[42113], "-9999")
            self.assertEqual(tags["values"], [
                -9999. if v is None else v for row in values for v in row])
            self.assertEqual((tags[256], tags[257]),
                             (head["ncols"], head["nrows"]))
            self.assertEqual(tags[33550][:2], (head["dx"], head["dy"]))
            north = head["yllcorner"] + head["nrows"] * head["dy"]
            self.assertEqual(tags[33922],
                             (0, 0, 0, head["xllcorner"], north, 0))
            # GeoKeys: a map, of areas, whose central meridian is at 15 E.
            keys = {tags[34735][i]: tags[34735][i + 1:i + 4]
                    for i in range(4, len(tags[34735]), 4)}
            self.assertEqual((keys[1024][2], keys[1025][2]), (1, 1))
            self.assertTrue(keys[3072][2] == 32633
                            or 15. in tags[34736], (keys, tags.get(34736)))
        # In a new run without maps they go.
        self.run_talus("run", "landslide-3d.prm", settings[:2])
        self.assertFalse(list((folder / "maps").glob("*.tif")))

    def test_earlier_maps_go(self):
        settings = ["Grid/Cell size=1.2", "End time=0.01", "Maps/Write=true"]
        folder = self.run_talus("run", "landslide-3d.prm", settings)
        (folder / "maps" / "mine.asc").write_text("of the user")
        self.run_talus("run", "landslide-3d.prm", settings[:2])
        self.assertEqual([p.name for p in (folder / "maps").iterdir()],
                         ["mine.asc"])
        self.assertFalse((folder / "maps.vtu").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

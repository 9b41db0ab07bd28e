# SPDX-License-Identifier: LGPL-2.1-or-later
"""Maps, stations and lines of short slides.

Usage: maps.py TALUS FOLDER MPIEXEC PRM_FOLDER.
"""

import csv
import math
import sys
import unittest

from ranks_case import Case


NAMES = ["ground", "erosion", "final-thickness", "final-mass", "thickness-at-start",
         "arrival-time-0.5-m", "arrival-time-1-m",
         *[f"{what}maximum-{of}" for what in ("", "time-of-")
           for of in ("thickness", "speed", "momentum-flux", "bed-shear")]]


def read_table(path):
    with open(path) as file:
        return [{k: v if k == "line" else float(v) for k, v in row.items()}
                for row in csv.DictReader(file)]


def read_raster(path):
    """Head and the values by column and row; None where there is no datum."""
    lines = path.read_text().splitlines()
    head = {key: float(value) for key, value in map(str.split, lines[:6])}
    rows = [[None if float(v) == head["nodata_value"] else float(v)
             for v in line.split()] for line in lines[6:]]
    assert len(rows) == head["nrows"]
    assert all(len(row) == head["ncols"] for row in rows)
    return head, rows


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
        settings = self.SLIDE + ["Stations/Points=toe: 30.8 | far: 40.4",
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
        """Cheaper, and never more than with all."""
        every = self.run_talus("every", "landslide-quick.prm", self.SLIDE)
        some = self.run_talus("some", "landslide-quick.prm", self.SLIDE + [
            "Maps/Steps between samples=7"])
        for a, b in zip(read_table(every / "maps.csv"),
                        read_table(some / "maps.csv")):
            self.assertGreaterEqual(a["maximum speed [m/s]"],
                                    b["maximum speed [m/s]"])
            self.assert_close(a["final thickness [m]"],
                              b["final thickness [m]"], 0)

    def test_rasters(self):
        """In 3-D, on the map, where z points south; a line in map coordinates
        sees what a station in those of the mesh sees."""
        settings = ["Grid/Cell size=1.2", "End time=0.3",
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

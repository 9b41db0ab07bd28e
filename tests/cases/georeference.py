# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs on bathymetry in degrees, which is projected on reading.

Usage: georeference.py TALUS FOLDER MPIEXEC.
"""

import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import unittest

TALUS = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()
MPIEXEC = sys.argv[3]

# A raster of 1.2'' in zone 33, at 16.2 degrees east and 67.1 degrees north.
WEST, SOUTH, N, CELL = 16.2, 67.1, 60, 1 / 3000


def transverse_mercator(longitude, latitude):
    """Easting and northing in UTM 33N by Krueger's series, to the millimetre."""
    a, f = 6378137.0, 1 / 298.257223563
    n, e = f / (2 - f), math.sqrt(f * (2 - f))
    alpha = [n / 2 - 2 / 3 * n**2 + 5 / 16 * n**3, 13 / 48 * n**2 - 3 / 5 * n**3,
             61 / 240 * n**3]
    sine = math.sin(math.radians(latitude))
    t = math.sinh(math.atanh(sine) - e * math.atanh(e * sine))
    away = math.radians(longitude - 15)
    xi = math.atan2(t, math.cos(away))
    eta = math.asinh(math.sin(away) / math.hypot(t, math.cos(away)))
    x, y = eta, xi
    for j, c in enumerate(alpha, 1):
        x += c * math.cos(2 * j * xi) * math.sinh(2 * j * eta)
        y += c * math.sin(2 * j * xi) * math.cosh(2 * j * eta)
    scale = 0.9996 * a / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    return 500000 + scale * x, scale * y


MIDDLE = transverse_mercator(WEST + N * CELL / 2, SOUTH + N * CELL / 2)
# North-western corner of the mesh on the map.
EAST, NORTH = math.floor(MIDDLE[0]) - 150, math.floor(MIDDLE[1]) + 150


def plane(easting, northing):
    return -300 - 0.1 * (easting - MIDDLE[0]) + 0.05 * (northing - MIDDLE[1])


BED = """
set Title = Degrees
set Dimension = {dim}
set End time = 0.5
subsection Grid
  set Lower corner = 0, -360{zero}
  set Upper corner = 300, -240{width}
  set Cell size = 20
  set Origin = {east}, {north}, 0
end
subsection Surfaces
  set Names = {names}mudline
  subsection mudline
    set File = degrees.asc
    set Projection = UTM 33N
    {entry}
  end
  {more}
end
subsection Obstacles
  set Names = bed
  subsection bed
    set Shape = terrain
    set Surface = mudline - 30{pocket}
  end
end
subsection Bodies
  set Names = clay
  subsection clay
    set Shape = layer
    set Upper surface = mudline
    set Lower surface = mudline - 31
    set Lower corner = 80, 0{near}
    set Upper corner = 220, 0{far}
    set Filling = clipped
    set Material = clay
  end
end
subsection Materials
  set Names = clay
  subsection clay
    set Law = von Mises
    set Density = 700
    set Young's modulus = 1e6
    set Poisson's ratio = 0.49
    set Undrained shear strength = 20e3
  end
end
subsection Maps
  set Write = true
end
"""


class Georeference(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        rows = [" ".join("%.9f" % plane(*transverse_mercator(
            WEST + (i + 0.5) * CELL, SOUTH + (N - r - 0.5) * CELL))
            for i in range(N)) for r in range(N)]
        (self.folder / "degrees.asc").write_text(
            f"ncols {N}\nnrows {N}\nxllcorner {WEST}\nyllcorner {SOUTH}\n"
            f"cellsize {CELL!r}\n" + "\n".join(rows) + "\n")

    def start(self, n_ranks=1, names="", more="", pocket="", **values):
        (self.folder / "case.prm").write_text(
            BED.format(east=EAST, north=NORTH, names=names, more=more,
                       pocket=pocket, **values))
        launcher = [MPIEXEC, "-n", str(n_ranks)] if n_ranks > 1 else []
        return subprocess.run(
            [*launcher, TALUS, self.folder / "case.prm", "--overwrite",
             "--output", self.folder / "run"],
            capture_output=True, text=True, timeout=600)

    def run_talus(self, n_ranks=1, **values):
        result = self.start(n_ranks, **values)
        self.assertEqual(result.returncode, 0, result.stderr)

    def check_projection(self):
        """A GIS knows the map of each raster by the file beside it."""
        rasters = list((self.folder / "run/maps").glob("*.asc"))
        self.assertGreater(len(rasters), 5)
        for raster in rasters:
            words = raster.with_suffix(".prj").read_text()
            self.assertTrue(words.startswith('PROJCS["'), words)
            self.assertIn("WGS_1984_UTM_Zone_", words)
            self.assertIn('PROJECTION["Transverse_Mercator"]', words)

    def check_map(self, spacing=None):
        """The ground, on cells in metres, is the plane 30 m deeper."""
        lines = (self.folder / "run/maps/ground.asc").read_text().splitlines()
        head = {key.lower(): float(value)
                for key, value in map(str.split, lines[:6])}
        if spacing is None:
            # The width of the cells is the smaller side, in their middle.
            west, east = (transverse_mercator(WEST + (N / 2 + i) * CELL,
                                              SOUTH + N / 2 * CELL)
                          for i in (-0.5, 0.5))
            spacing = math.dist(west, east)
        self.assertAlmostEqual(head["cellsize"], spacing, delta=1e-6)
        # Outside of the mesh the ground is as high as at its edge.
        margin = spacing / 2
        n = 0
        for r, line in enumerate(lines[6:]):
            for i, value in enumerate(map(float, line.split())):
                x = head["xllcorner"] + (i + 0.5) * head["cellsize"]
                y = head["yllcorner"] + (head["nrows"] - r - 0.5) * head["cellsize"]
                if (margin <= x - EAST <= 300 - margin
                        and margin <= NORTH - y <= 300 - margin):
                    self.assertAlmostEqual(value, plane(x, y) - 30, delta=1e-4)
                    n += 1
        self.assertGreater(n, 350)

    def test_three_dimensions(self):
        for n_ranks, entry in ((1, ""), (2, "set Cell size = 10")):
            shutil.rmtree(self.folder / "run", ignore_errors=True)
            self.run_talus(n_ranks, dim=3, zero=", 0", width=", 300",
                           near=", 80", far=", 220", entry=entry)
            self.check_map(10 if entry else None)
            self.check_projection()

    def test_section(self):
        self.run_talus(dim=2, zero="", width="", near="", far="",
                       entry=f"set Section = {EAST},{NORTH}; "
                             f"{EAST + 300},{NORTH - 300}")
        with open(self.folder / "run/maps.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 5)
        for row in rows:
            # Along the line to the south-east.
            away = float(row["x [m]"]) / math.sqrt(2)
            self.assertAlmostEqual(float(row["ground [m]"]),
                                   plane(EAST + away, NORTH - away) - 30,
                                   delta=1e-4)


    def test_outlines(self):
        """An area in degrees is the one that is given by its corners on the map."""
        # Corners in degrees, around the middle.
        places = [(WEST + (N / 2 + i) * CELL, SOUTH + (N / 2 + j) * CELL)
                  for i, j in ((-6, -3), (7, -2), (1, 3))]
        ring = places + places[:1]
        (self.folder / "area.geojson").write_text(json.dumps(
            {"type": "Polygon", "coordinates": [ring]}))
        (self.folder / "area.kml").write_text(
            '<kml xmlns="http://www.opengis.net/kml/2.2"><Placemark><Polygon>'
            "<outerBoundaryIs><LinearRing><coordinates>"
            + " ".join("%.12f,%.12f" % place for place in ring) +
            "</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>"
            "</kml>")
        corners = "; ".join("%.9f,%.9f" % transverse_mercator(*place)
                            for place in places)
        grounds = []
        for entries in (f"set Outline = {corners}\n set Coordinates = map",
                        "set File = area.geojson\n set Projection = UTM 33N",
                        "set File = area.kml\n set Projection = UTM 33N"):
            self.run_talus(dim=3, zero=", 0", width=", 300", near=", 80",
                           far=", 220", entry="set Cell size = 10",
                           names="area, ",
                           more=f"subsection area\n {entries}\n end",
                           pocket=" - min(5, max(0, area))")
            grounds.append(list(map(float, (self.folder / "run/maps/ground.asc")
                                    .read_text().split()[12:])))
        by_corners, by_geojson, by_kml = grounds
        self.assertEqual(len(by_corners), len(by_geojson))
        for a, b, c in zip(by_corners, by_geojson, by_kml):
            self.assertAlmostEqual(a, b, delta=1e-3)  # as the series above
            self.assertAlmostEqual(b, c, delta=1e-6)  # twelve decimals
        # The area is not without effect.
        self.run_talus(dim=3, zero=", 0", width=", 300", near=", 80",
                       far=", 220", entry="set Cell size = 10")
        without = map(float, (self.folder / "run/maps/ground.asc")
                      .read_text().split()[12:])
        self.assertAlmostEqual(max(a - b for a, b in zip(without, by_corners)),
                               5, delta=1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is written of obstacles for ParaView.

Usage: obstacle_files.py TALUS FOLDER MPIEXEC PRM_FOLDER.
"""

import array
import base64
import csv
import math
import pathlib
import struct
import sys
import unittest
import xml.etree.ElementTree
import zlib

from ranks_case import Case, PRM

HERE = pathlib.Path(__file__).resolve().parent

# A row for each step, so that its forces are those of the step.
EACH_STEP = ["Output/Statistics interval=1e-9", "Output/Write points=false",
             "Output/Write grid=false", "Output/Runout=false"]
TYPES = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}


def values(element):
    head = struct.unpack("<4I", base64.b64decode(element.text.strip()[:24]))
    assert head[0] == 1
    data = zlib.decompress(base64.b64decode(element.text.strip()[24:]))
    numbers = array.array(TYPES[element.get("type")], data)
    n = int(element.get("NumberOfComponents") or 1)
    if n == 1:
        return list(numbers)
    return [tuple(numbers[i:i + n]) for i in range(0, len(numbers), n)]


def cells_of(piece):
    """The cells of a piece of a file: a list of dictionaries, with the corners of each."""
    vertices = values(piece.find("Points/DataArray"))
    mesh = {a.get("Name"): values(a) for a in piece.findall("Cells/DataArray")}
    data = {a.get("Name"): values(a) for a in piece.findall("CellData/DataArray")}
    cells, first = [], 0
    for i, last in enumerate(mesh["offsets"]):
        cell = {name: column[i] for name, column in data.items()}
        cell["corners"] = [vertices[v]
                           for v in mesh["connectivity"][first:last]]
        cell["type"] = mesh["types"][i]
        first = last
        cells.append(cell)
    return cells


def read_vtu(path):
    """Time and cells of all ranks, each of which has a piece."""
    root = xml.etree.ElementTree.parse(path).getroot()
    cells = [cell for piece in root.iter("Piece") for cell in cells_of(piece)]
    return float(root.find(".//FieldData/DataArray").text), cells


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def measure(corners):
    """Length of a line, area of a triangle or plane quadrilateral."""
    if len(corners) == 2:
        return math.dist(*corners)
    a = minus(corners[2], corners[0])
    b = minus(corners[-1], corners[1 if len(corners) == 4 else 0])
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
             a[0] * b[1] - a[1] * b[0])
    return 0.5 * math.hypot(*cross)


class ObstacleFiles(Case):
    def rows(self, folder):
        with open(folder / "obstacles.csv") as lines:
            return list(csv.DictReader(lines))

    def series(self, folder, name):
        """By time, the cells of all ranks."""
        result = {}
        for path in sorted(folder.glob(name + "-*.vtu")):
            time, cells = read_vtu(path)
            result[time] = result.get(time, []) + cells
        return result

    def force(self, cells):
        total = [0, 0, 0]
        for cell in cells:
            for d in range(3):
                total[d] += cell["traction [Pa]"][d] * measure(cell["corners"])
        return total

    def assert_facets_carry_the_force(self, folder, name, axes):
        rows = {float(row["time [s]"]): row for row in self.rows(folder)}
        series = self.series(folder, "facets")
        self.assertGreater(len(series), 1)
        for time, cells in series.items():
            force = self.force(cells)
            size = math.hypot(*force)
            self.assertGreater(size, 0)
            for d, axis in enumerate(axes):
                self.assertAlmostEqual(
                    force[d] / size,
                    float(rows[time][f"{name} force {axis} [N]"]) / size,
                    delta=2e-6)
        return series

    def test_force_is_the_integral_of_the_traction(self):
        settings = EACH_STEP + ["End time=0.1", "Output/Field interval=0.05"]
        file = PRM / "verification" / "block-on-plane.prm"
        one = self.assert_facets_carry_the_force(
            self.run_talus("one", file, settings), "plane", "xy")
        two = self.assert_facets_carry_the_force(
            self.run_talus("two", file, settings, 2), "plane", "xy")
        self.assertEqual(list(one), list(two))
        for time in one:
            def cells(series):
                return sorted(series[time], key=lambda cell: cell["corners"])
            self.assertEqual(len(one[time]), len(two[time]))
            for a, b in zip(cells(one), cells(two)):
                self.assertEqual(a["corners"], b["corners"])
                self.assertAlmostEqual(a["normal pressure [Pa]"],
                                       b["normal pressure [Pa]"], delta=0.01)

    def test_contact_area_of_steep_ground(self):
        """A layer of 16 m in plan; end facets are longer where the ground is steep."""
        for slope in 30, 45, 55:
            folder = self.run_talus(f"ground-{slope}", HERE / "layer-on-ground.prm",
                                    [f"Constants=S={slope}", "Output/Write points=false",
                                     "Output/Write grid=false"])
            with open(folder / "statistics.csv", newline="") as stream:
                row = list(csv.DictReader(stream))[-1]
            exact = 16 / math.cos(math.radians(slope))
            for column in "contact area [m]", "footprint [m]":
                self.assertAlmostEqual(float(row[column]) / exact, 1, delta=0.015)

    def test_contact_area_of_ripples_finer_than_cells(self):
        """Ripples of 1 m x 3 m under cells of 2 m."""
        heights = [34 + 0.5 * math.sin(2 * math.pi * (0.5 * i + 0.25) / 3)
                   for i in range(100)]
        (self.folder / "ripples.asc").write_text(
            "ncols 100\nnrows 4\nxllcorner -2.5\nyllcorner -1\ncellsize 0.5\n"
            + 4 * (" ".join(map(str, heights)) + "\n"))
        folder = self.run_talus(
            "ripples", HERE / "layer-on-ground.prm",
            ["Surfaces/ground/Expression=", "Grid/Cell size=2", "End time=0.5",
             f"Surfaces/ground/File={self.folder}/ripples.asc",
             "Surfaces/ground/Section=0,0; 40,0", "Bodies/soil/Filling=clipped",
             "Output/Write points=false", "Output/Write grid=false"])
        self.assertIn("smoothed over the smallest cells", (folder / "log.txt").read_text())
        with open(folder / "statistics.csv", newline="") as stream:
            row = list(csv.DictReader(stream))[-1]
        self.assertAlmostEqual(
            float(row["contact area [m]"]) / float(row["footprint [m]"]), 1, delta=0.05)

    def test_stresses_of_a_block_that_slides(self):
        """The cap, and no slip of a block that sticks."""
        file = PRM / "verification" / "block-on-plane.prm"
        for cap, slides in (("1e3", True), ("1e12", False)):
            folder = self.run_talus(
                "cap-" + cap, file,
                EACH_STEP + ["End time=0.2", "Output/Field interval=0.2",
                             "Obstacles/plane/Friction coefficient=10",
                             "Obstacles/plane/Maximum shear stress=" + cap])
            for cell in self.series(folder, "facets").popitem()[1]:
                self.assertEqual(cell["type"], 3)  # a line
                if slides and cell["gap [m]"] == 0:
                    self.assertAlmostEqual(
                        cell["shear stress [Pa]"] * cell["area [m]"],
                        1e3 * cell["contact area [m]"],
                        delta=1e-3 * cell["area [m]"])
                    self.assertGreater(
                        math.hypot(*cell["slip velocity [m/s]"]), 0.1)
                elif not slides:
                    self.assertLess(
                        math.hypot(*cell["slip velocity [m/s]"]), 0.02)

    def test_surfaces(self):
        """Those at rest once, and those that move where they are."""
        file = PRM / "pipeline.prm"
        settings = ["Grid/Refinement boxes=", "End time=0.1",
                    "Output/Field interval=0.05", "Obstacles/pipe/Radius=0.6"]
        for name, moves in (("rest", []),
                            ("moves", ["Obstacles/pipe/Velocity=3;0"])):
            series = self.series(
                self.run_talus(name, file, settings + moves), "obstacles")
            self.assertEqual(len(series) > 1, bool(moves))
            for time, cells in series.items():
                x = 108.66 + (3 * time if moves else 0)
                for cell in cells:
                    self.assertEqual(cell["type"], 3)  # a line
                    self.assertEqual(cell["maximum shear stress [Pa]"], 500)
                    for corner in cell["corners"]:
                        self.assertAlmostEqual(
                            math.dist(corner, (x, 0.3, 0)), 0.6, delta=6e-3)
                # Above the bottom of the mesh, y = 0.
                self.assertAlmostEqual(
                    sum(measure(cell["corners"]) for cell in cells),
                    0.6 * (math.pi + 2 * math.asin(0.5)), delta=0.01)

    def test_rectangles_in_space(self):
        folder = self.run_talus(
            "3d", HERE / "block-on-plane-3d.prm",
            EACH_STEP + ["End time=0.02", "Output/Field interval=0.01"])
        series = self.assert_facets_carry_the_force(folder, "plane", "xyz")
        for cells in series.values():
            for cell in cells:
                self.assertEqual(cell["type"], 9)  # a quadrilateral
                self.assertAlmostEqual(measure(cell["corners"]),
                                       cell["area [m^2]"], delta=1e-6)


    def test_log_tells_what_obstacles_take(self):
        """Half of a body, whatever the filling."""
        for filling in ("clipped", "centres"):
            folder = self.run_talus(
                filling, PRM / "verification" / "block-on-plane.prm",
                ["End time=1e-5", "Bodies/block/Filling=" + filling,
                 "Bodies/block/Vertices=0,-0.5;2,-0.5;2,0.5;0,0.5",
                 "Obstacles/plane/Normal=0,1"])
            self.assertIn("The obstacles take 1 m^2 of the body 'block', 50 % "
                          "of the body", (folder / "log.txt").read_text())
            with open(folder / "statistics.csv") as lines:
                mass = float(next(csv.DictReader(lines))["mass [kg]"])
            self.assertAlmostEqual(mass, 2000 * (2 - 1), delta=1e-6)


# In 3-D, so that all kinds of files are written.
FAR = """\
set Dimension = 3
set End time  = 0.05
subsection Grid
  set Lower corner = %(a)r, 0, 0
  set Upper corner = %(b)r, 4, 4
  set Cell size    = 1
end
subsection Bodies
  set Names = block
  subsection block
    set Shape        = box
    set Lower corner = %(c)r, 1, 1
    set Upper corner = %(d)r, 2, 3
    set Material     = clay
    set Initial velocity = 0.1; 0; 0
  end
end
subsection Materials
  set Names = clay
  subsection clay
    set Law             = linear elastic
    set Young's modulus = 1e6
  end
end
subsection Obstacles
  set Names = plane
  subsection plane
    set Shape  = half-plane
    set Point  = %(c)r, 1.05, 0
    set Normal = 0.1, 1, 0
  end
end
subsection Maps
  set Write = true
end
subsection Output
  set Runout         = false
  set Field interval = 0.05
end
"""


class LargeCoordinates(Case):
    """At 5 000 km from the origin, where single precision has steps of half a metre,
    files show what they show at the origin, to the 1e-9 m of double precision."""

    def places(self, shift, boxes):
        name = f"{shift}-{boxes}"
        file = self.folder / "far.prm"
        file.write_text(FAR % {k: shift + x for k, x in zip("abcd", (0, 6, 1, 3))})
        folder = self.run_talus(name, file,
                                [f"Output/Boxes as cells={boxes}"])
        result = {}
        for path in sorted(folder.glob("*.vtu")):
            result[path.name] = [x for cell in read_vtu(path)[1]
                                 for x in cell["corners"]]
        with open(folder / "statistics.csv") as lines:
            result["statistics.csv"] = [(float(row["centre x [m]"]), 0, 0)
                                        for row in csv.DictReader(lines)]
        return result

    def test_no_file_loses_digits(self):
        for boxes in ("true", "false"):
            near = self.places(0, boxes)
            far = self.places(5000000, boxes)
            self.assertEqual(list(near), list(far))
            for kind in ("points", "grid", "obstacles", "facets", "maps"):
                self.assertTrue(any(kind in name for name in near), near.keys())
            for name, places in near.items():
                self.assertGreater(len(places), 0, name)
                self.assertEqual(len(places), len(far[name]), name)
                for x, y in zip(places, far[name]):
                    # That of the first is in single precision.
                    self.assertLess(max(abs(y[0] - 5e6 - x[0]), abs(y[1] - x[1]),
                                        abs(y[2] - x[2])), 1e-6, (name, x, y))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])

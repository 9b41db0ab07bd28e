# SPDX-License-Identifier: LGPL-2.1-or-later
"""Source of a tsunami model: volumes, places, times, ranks and resumed runs.

Usage: tsunami.py TALUS FOLDER MPIEXEC PRM_FOLDER.
"""

import csv
import math
import subprocess
import sys
import time
import unittest

from ranks_case import PRM, TALUS, Case

TOOL = PRM.parent / "share" / "talus" / "talus-tsunami"


def read_dtopo(path):
    """Header, and the blocks as lists of rows, the northernmost row first."""
    lines = path.read_text().splitlines()
    head = {label: float(value) for value, label in map(str.split, lines[:9])}
    rows = [[float(number) for number in line.split()] for line in lines[9:]]
    n = int(head["my"])
    assert len(rows) == n * head["mt"], (len(rows), head)
    assert all(len(row) == head["mx"] for row in rows)
    return head, [rows[i:i + n] for i in range(0, len(rows), n)]


def read_table(path):
    with open(path) as file:
        return [{k: float(v or "nan") for k, v in row.items()}
                for row in csv.DictReader(file)]


def read_raster(path):
    """Head and the values by row; zeros where there is no soil."""
    lines = path.read_text().splitlines()
    n = sum(line[0].isalpha() for line in lines)
    head = {key: float(value) for key, value in map(str.split, lines[:n])}
    return head, [[0. if float(v) == head["nodata_value"] else float(v)
                   for v in line.split()] for line in lines[n:]]


class Tsunami(Case):
    SECTION = ["Grid/Cell size=0.8", "End time=2", "Output/Write points=false",
               "Output/Write grid=false", "Maps/Write=true",
               "Output/Plan interval=0.5"]
    SECTION_OPTIONS = ["--width", "40", "--water-depth", "100"]
    SLIDE_3D = ["Grid/Cell size=1.2", "End time=0.35", "Maps/Write=true",
                "Maps/Cell size=2.4", "Output/Field interval=0.1",
                "Grid/Origin=5e5, 6.5e6, -100", "Output/Plan interval=0.1"]

    def tool(self, folder, options):
        """Make the source of a run, by the first line of the tool."""
        return subprocess.run([TOOL, folder, *options], capture_output=True,
                              text=True, timeout=300)

    def make_source(self, folder, options):
        """Make the source without an error; return the folder."""
        result = self.tool(folder, options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return folder

    def check_volumes(self, head, blocks, table, soil):
        """The sum of a block is the change of the volume of the soil."""
        area = head["dx"] * head["dy"]
        self.assertEqual(len(table), len(blocks))
        for block, row in zip(blocks, table):
            total = area * math.fsum(map(math.fsum, block))
            self.assertLessEqual(
                abs(total - row["change of soil volume [m^3]"]), 1e-12 * soil)
            self.assertLessEqual(abs(row["closure [m^3]"]), 1e-12 * soil)
            raised = area * math.fsum(v for r in block for v in r if v > 0)
            self.assertLessEqual(abs(raised - row["volume raised [m^3]"]),
                                 1e-12 * soil)
        self.assertEqual(set(map(tuple, blocks[0])), {(0.,) * len(blocks[0][0])})
        self.assertGreater(table[-1]["volume raised [m^3]"], 1e-3 * soil)

    def check_sums(self, folder, statistics):
        """The whole soil, column -1, is the soil of the statistics and the sum
        over the columns, at all times that both tables have."""
        rows = read_table(folder / "plan.csv")
        known = {row["time [s]"]: row for row in statistics}
        times = {row["time [s]"] for row in rows} & set(known)
        self.assertGreater(len(times), 3)
        for time_ in times:
            now = [row for row in rows if row["time [s]"] == time_]
            self.assertEqual([row["column"] for row in now],
                             sorted({row["column"] for row in now}))
            whole, *columns = now
            self.assertEqual(whole["column"], -1)
            for name, exact in (("mass [kg/m]", "mass [kg]"),
                                ("momentum x [N s/m]", "momentum x [kg m/s]"),
                                ("volume [m^2]", None)):
                scale = max(abs(whole[name]), 1e-9)
                total = math.fsum(row[name] for row in columns)
                self.assertLessEqual(abs(total - whole[name]), 1e-12 * scale, name)
                if exact:
                    self.assertLessEqual(abs(known[time_][exact] - whole[name]),
                                         1e-12 * scale, name)

    def test_section(self):
        folder = self.make_source(
            self.run_talus("one", "landslide-quick.prm", self.SECTION),
            self.SECTION_OPTIONS)
        head, blocks = read_dtopo(folder / "tsunami-source.tt3")
        table = read_table(folder / "tsunami-source.csv")
        maps = {round(row["x [m]"], 9): row
                for row in read_table(folder / "maps.csv")}
        statistics = read_table(folder / "statistics.csv")
        self.check_volumes(head, blocks, table, 40 * sum(
            0.8 * row["thickness at start [m]"] for row in maps.values()))
        # Time of the tsunami run 0 is before the slide: t0 is an interval.
        self.assertEqual((head["mt"], head["t0"], head["dt"]), (5, .5, .5))
        self.assertEqual(head["dy"] * head["my"], 40)
        self.assertAlmostEqual(head["ylower"], -20 + head["dy"] / 2, 12)
        # Numbers lie on centres of cells: the last block is that of the maps.
        found = 0
        for i, change in enumerate(blocks[-1][0]):
            column = maps.get(round(head["xlower"] + i * head["dx"], 9))
            exact = (column["final thickness [m]"]
                     - column["thickness at start [m]"]) if column else 0.
            self.assertLessEqual(abs(change - exact), 2e-15)
            found += change != 0
        self.assertGreater(found, 40)
        for block in blocks:
            self.assertEqual(len(set(map(tuple, block))), 1)
        self.check_sums(folder, statistics)
        # The centre of mass: velocity at the end, acceleration from rest.
        self.assertAlmostEqual(table[-1]["centre velocity x [m/s]"],
                               statistics[-1]["centre velocity x [m/s]"], 9)
        for k in range(1, 5):
            self.assertAlmostEqual(
                table[k]["centre acceleration x [m/s^2]"],
                (table[k]["centre velocity x [m/s]"]
                 - table[k - 1]["centre velocity x [m/s]"]) / 0.5, 12)
        self.assertGreater(table[-1]["speed over sqrt(g d) [-]"],
                           table[-1]["centre velocity x [m/s]"]
                           / math.sqrt(981) * (1 - 1e-12))

    def test_slide_3d(self):
        options = ["--start-time", "60"]
        folder = self.make_source(
            self.run_talus("one", "landslide-3d.prm", self.SLIDE_3D), options)
        head, blocks = read_dtopo(folder / "tsunami-source.tt3")
        grid, start = read_raster(folder / "maps" / "thickness-at-start.asc")
        _, final = read_raster(folder / "maps" / "final-thickness.asc")
        self.check_volumes(head, blocks,
                           read_table(folder / "tsunami-source.csv"),
                           2.4**2 * sum(map(sum, start)))
        # Blocks at 0, 0.1, 0.2, 0.3 s, and the end in place of the next one.
        self.assertEqual((head["mt"], head["t0"], head["dt"]), (5, 60, .1))
        self.assertEqual((head["mx"], head["my"]),
                         (grid["ncols"], grid["nrows"]))
        # Half a cell from the corner of the raster.
        self.assertAlmostEqual(head["xlower"], grid["xllcorner"] + 1.2, 9)
        self.assertAlmostEqual(head["ylower"], grid["yllcorner"] + 1.2, 9)
        changed = 0
        for rows in zip(blocks[-1], start, final):
            for change, before, after in zip(*rows):
                self.assertLessEqual(abs(change - (after - before)), 2e-15)
                changed += change != 0
        self.assertGreater(changed, 20)
        other = self.make_source(
            self.run_talus("two", "landslide-3d.prm", self.SLIDE_3D, 2), options)
        other_head, other_blocks = read_dtopo(other / "tsunami-source.tt3")
        self.assertEqual(head, other_head)
        for rows in zip(sum(blocks, []), sum(other_blocks, [])):
            for a, b in zip(*rows):
                self.assertLessEqual(abs(a - b), 1e-9)

    def test_resumed(self):
        """Killed after a checkpoint with some states: the same files bit by bit."""
        whole = self.run_talus("whole", "landslide-quick.prm", self.SECTION)
        command = [TALUS, PRM / "landslide-quick.prm", "--output", "killed", *[
            o for s in self.SECTION + ["Checkpoint/Step interval=50"]
            for o in ("--set", s)]]
        checkpoints = self.folder / "killed" / "checkpoints"
        with subprocess.Popen(command, cwd=self.folder,
                              stdout=subprocess.DEVNULL) as process:
            while process.poll() is None and not [
                    p for p in checkpoints.glob("*[0-9]") if int(p.name) > 600]:
                time.sleep(0.002)
            process.kill()
        steps = [int(p.name) for p in checkpoints.glob("*[0-9]")]
        self.assertLess(max(steps), 1000, "the run had nearly ended")
        subprocess.run([*command, "--resume"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL, timeout=600)
        for folder in (whole, self.folder / "killed"):
            self.make_source(folder, self.SECTION_OPTIONS)
        for name in ("plan.csv", "plan-cells.csv", "tsunami-source.tt3",
                     "tsunami-source.csv"):
            self.assertEqual((whole / name).read_bytes(),
                             (self.folder / "killed" / name).read_bytes(), name)

    def test_netcdf(self):
        """Read back by GDAL in report/tsunami.Netcdf; here the file is there."""
        folder = self.make_source(
            self.run_talus("run", "landslide-quick.prm",
                           self.SECTION + ["End time=0.6"]),
            self.SECTION_OPTIONS + ["--netcdf"])
        content = (folder / "tsunami-source.nc").read_bytes()
        self.assertEqual(content[:4], b"\x89HDF")
        # The next run without a series removes the files.
        self.run_talus("run", "landslide-quick.prm", self.SECTION[:4])
        for name in ("tsunami*", "plan*"):
            self.assertEqual(list(folder.glob(name)), [])

    def test_refused(self):
        for file, settings, words in (
                ("landslide-3d.prm", self.SLIDE_3D + ["Maps/Cell size=1e-3"],
                 "The maps would have"),
                ("landslide-quick.prm", ["Tsunami source/Write=true"],
                 "`talus-tsunami FOLDER` makes the source"),
                ("landslide-3d.prm", self.SLIDE_3D + ["Maps/Raster=lost"],
                 "no surface with a raster")):
            result = self.start("run", 1, settings, file)
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, result.stderr)
        folder = self.run_talus("run", "landslide-quick.prm",
                                self.SECTION + ["End time=0.6"])
        for options, words in (
                ([], "Give the width of the slide"),
                (["--width", "1e30"], "are the most"),
                (self.SECTION_OPTIONS + ["--degrees"], "section has no place on a map"),
                (self.SECTION_OPTIONS + ["--interval", "1e-6"],
                 "Give a longer --interval")):
            result = self.tool(folder, options)
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

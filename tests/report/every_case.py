# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every tool on the result of every shipped case, of an interrupted one, of two ranks, and of
slides towards -x and -z: no traceback, and the same number wherever a number appears.

Usage: every_case.py TALUS ROOT FOLDER [SUITE]
"""

import ast
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy

from tools_case import ROOT, SHARE, TALUS, Case, main, read_csv
from report import Page

import talus

LAUNCHER = os.environ.get("TALUS_LAUNCHER", "mpirun -np 2").split()
# Settings that make each case of prm a run of seconds; the last one is the end time.
CASES = {
    "bar": ["End time=40"],
    "first-slope": ["Grid/Cell size=1", "End time=4"],
    "landslide": ["Grid/Cell size=1", "End time=5"],
    "landslide-3d": ["Grid/Cell size=1.6", "Grid/Upper corner=280, 8, 1.6", "End time=1"],
    "landslide-inclined": ["Grid/Cell size=1.6", "End time=5"],
    "landslide-quick": ["Grid/Cell size=1", "End time=5"],
    "landslide-trigger": ["Grid/Cell size=1", "Trigger/Start time=0.1", "End time=4"],
    "own-slope": ["Grid/Cell size=25", "End time=15"],
    "pipe-on-springs": ["Grid/Cell size=1.2", "End time=12"],
    "pipeline": ["Grid/Cell size=1.2", "End time=12"],
    "sand-slope": ["Grid/Cell size=4", "End time=16"],
    "sediment-slope": ["Grid/Cell size=4", "End time=16"],
    "slab-failure": ["Grid/Cell size=2", "End time=3"],
    "slope": ["Grid/Cell size=10", "End time=50"],
    "slope-3d": ["Grid/Cell size=40", "End time=30"],
    "slope-stability": ["Grid/Cell size=16", "End time=25"],
}
WEST = ["Grid/Cell size=1", "Gravity/Slope angle=-4",
        "Bodies/slope/Vertices=50,0; 80,0; 72,4; 58,4", "Maps/Write=true",
        "Stations/Points=x: 45 | x thickness: 10", "End time=4"]
# The block of the case goes down to -z, over a cable.
NORTH = ["Surfaces/plane/Expression=0.36*z", "Grid/Lower corner=-3, -4, -10",
         "Grid/Upper corner=3, 3, 3", "Maps/Write=true", "Stations/Points=near: 0, -2 | far: 0, -9",
         "Stations/Lines=cable: -2, -2.5; 2, -2.5", "Stations/Drag coefficient=0.5", "End time=2"]
PIPE = """set Length = 400
set Element size = 1
subsection Pipe
  set Outer diameter = 0.6
  set Wall thickness = 0.02
end
subsection Lateral springs
  set Stiffness           = 1e5
  set Ultimate resistance = 4e3
end
subsection Load
  LOAD
end
"""


def finite(values):
    """Those that are numbers."""
    return values[numpy.isfinite(values)]


class EveryTool(Case):
    def run_case(self, name, file, settings, *options, launcher=()):
        folder = self.folder / name
        result = subprocess.run(
            [*launcher, TALUS, file, "--output", folder, *options,
             *[o for s in settings for o in ("--set", s)]],
            capture_output=True, text=True, timeout=300, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return folder

    def succeeds(self, name, *arguments, **options):
        """What a tool prints; it has no error and no warning."""
        result = self.tool(name, *arguments, **options)
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.args)
        return result.stdout

    def use_all(self, folder):
        """All tools that read a finished or interrupted run."""
        self.succeeds("talus-report", folder)
        page = Page(folder)
        results = talus.read(folder)
        self.read_all(results)
        tiles = self.check_tiles(page, results)
        self.check_budget(page, results)
        self.compare(folder, tiles)
        self.check_example(folder, results)
        film = folder / "film.gif"
        if len(results.times("points")) > 1:
            self.succeeds("talus-animate", folder, "--output", film, "--most", 3)
            self.assertGreater(film.stat().st_size, 1000)
        else:
            self.assert_sentence(self.tool("talus-animate", folder, "--output", film),
                                 "no fields at two times")
        return page, tiles

    def read_all(self, results):
        """Tables, fields and maps by the readers for Python, with the sums of the tables."""
        for name in results.names_of_tables():
            table, rows = results.table(name), read_csv(results.path(name + ".csv"))
            self.assertEqual(len(table), len(rows))
            for column in table.names:
                if column == "line":
                    self.assertEqual(table[column].tolist(), [row[column] for row in rows])
                else:
                    self.assertEqual(str(table[column][-1]),
                                     str(float(rows[-1][column] or "nan")))
        for name in ("points", "grid", "obstacles", "facets"):
            for at in results.times(name):
                results.fields(name, at)
        for name in results.names_of_maps():
            self.assertTrue(results.map(name).values.size)
        statistics, points = results.table("statistics"), results.points()
        row = numpy.argmin(abs(statistics["time"] - points.time))
        self.assertAlmostEqual(points["mass"].sum() / statistics["mass"][row], 1, delta=1e-5)

    def check_tiles(self, page, results):
        """The tiles by the tables; {name: number}."""
        tiles = {e[0].text: float(e[1].get("data-value")) for e in page.root.iter("div")
                 if e.get("class") == "tile"}
        table, expected = results.table("runout"), {}
        if finite(table["runout"]).size:
            expected["runout"] = finite(table["runout"])[-1]
        if numpy.nanmax(table["largest depth-mean speed"]) > 0:
            expected["largest speed"] = numpy.nanmax(table["largest depth-mean speed"])
        rows = read_csv(results.path("profile.csv"))
        axes = [name for name in ("x [m]", "z [m]") if name in rows[0]]

        def soil(at):
            return {tuple(f"{float(row[axis]):.4f}" for axis in axes): float(row["thickness [m]"])
                    for row in rows if row["time [s]"] == at}
        start, end = soil(rows[0]["time [s]"]), soil(rows[-1]["time [s]"])
        outside = [thickness for place, thickness in end.items()
                   if start.get(place, 0) <= 0.01 * max(start.values())]
        if outside:
            expected["thickness of the deposit"] = max(outside)
        found = {name: value for name, value in tiles.items()
                 if not name.startswith(("factor of safety", "largest force on", "at rest",
                                         "arrival at"))}
        self.assertEqual(found, expected)
        rests = results.table("statistics")["at rest"][-1]
        self.assertEqual({name: value == 0 for name, value in tiles.items()
                          if name.startswith("at rest")},
                         {"at rest from": False} if rests else {"at rest": True})
        obstacles = results.table("obstacles") if results.has("obstacles.csv") else None
        for name, value in tiles.items():
            if name.startswith("largest force on"):
                name = name.removeprefix("largest force on ")
                force = numpy.sqrt(sum(obstacles[f"{name} force {axis}"]**2 for axis in "xyz"
                                       if f"{name} force {axis}" in obstacles))
                self.assertAlmostEqual(value, force.max(), delta=1e-9 * value)
            if name.startswith("arrival at "):
                rows = [row for row in read_csv(results.path("lines.csv"))
                        if row["line"] == name.removeprefix("arrival at ")]
                column = next(c for c in rows[0] if c.startswith("arrival time"))
                self.assertEqual(value, min(float(row[column]) for row in rows
                                            if math.isfinite(float(row[column] or "nan"))))
        return tiles

    def check_budget(self, page, results):
        """Largest mass, kinetic energy and speeds of the page, and the largest values of maps."""
        statistics, runout = results.table("statistics"), results.table("runout")
        for table, column in ((statistics, "mass [kg]"), (statistics, "kinetic energy [J]"),
                              (runout, "speed of the centre [m/s]")):
            self.assertEqual(float(page.values[column]), numpy.abs(table[column]).max(), column)
        for name in results.names_of_maps():
            if name in page.values:
                self.assertEqual(float(page.values[name]),
                                 finite(results.map(name).values).max(), name)

    def compare(self, folder, tiles):
        """A run with itself: the tiles of the report, and no difference."""
        self.succeeds("talus-compare", folder, folder, "--output", folder / "compare.html")
        values = Page(folder, "compare.html").values
        for name, value in tiles.items():
            self.assertEqual(float(values[f"A {name}"]), value)
        self.assertEqual({float(value) for column, value in values.items()
                          if column.startswith("B − A")}, {0})

    def check_example(self, folder, results):
        """examples/read_run.py prints the largest speed of runout.csv."""
        said = subprocess.run([sys.executable, SHARE / "examples/read_run.py", folder],
                              capture_output=True, text=True, timeout=100, cwd=self.folder)
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        number = float(re.search(r"largest speed of the centre: (\S+) m/s", said.stdout)[1])
        self.assertAlmostEqual(number, results.table("runout")["speed of the centre"].max(),
                               delta=1e-3 * number)

    def study(self, name, file, settings, quantities=""):
        """Two members, with these and half of the end time; rows of study.csv."""
        *others, end = settings
        end = float(end.partition("=")[2])
        study = self.folder / f"{name}.prm"
        lines = []
        for entry, value in (s.split("=", 1) for s in others):
            *sections, entry = entry.split("/")
            lines += [f"subsection {s}" for s in ["Parameters", *sections]]
            lines += [f"set {entry} = {value}"] + ["end"] * (1 + len(sections))
        study.write_text("\n".join([
            f"set Case = {file}", f"set Program = {TALUS}", "set Number at once = 2",
            f"set Output folder = {self.folder / (name + '-study')}", *lines, quantities,
            f"subsection Design\nset Kind = grid\nend\nsubsection Varied\nset Names = end\n"
            f"subsection end\nset Parameter = End time\nset Values = {end / 2}, {end}\nend\nend"]))
        self.succeeds("talus-study", study, cwd=ROOT)
        return read_csv(self.folder / f"{name}-study" / "study.csv")

    def pipe(self, folder, load):
        settings = self.folder / "pipe.prm"
        settings.write_text(PIPE.replace("LOAD", load))
        self.assertIn("largest deflection", self.succeeds("talus-pipe", folder, settings))

    def check(self, name):
        file, settings = ROOT / "prm" / f"{name}.prm", CASES[name]
        folder = self.run_case(name, file, settings)
        page, _ = self.use_all(folder)
        short = f"End time={float(settings[-1].partition('=')[2]) / 10}"
        rows = self.study(name, file, [*settings[:-1], short])
        for k, row in enumerate(rows, 1):
            member = talus.read(self.folder / f"{name}-study" / f"member-{k:04d}")
            self.assertEqual(float(row["runout [m]"]), member.table("runout")["runout"][-1])
        return folder, page


class Texts(EveryTool):
    def test_table_has_all_cases(self):
        self.assertEqual({path.stem for path in (ROOT / "prm").glob("*.prm")}, set(CASES))

    def test_programs_for_paraview(self):
        """The syntax; report.Others draws with ParaView where it is installed."""
        ast.parse((SHARE / "paraview.py").read_text(encoding="utf-8"))


class Shipped(EveryTool):
    """The cases in 2-D."""


class Shipped3d(EveryTool):
    """The cases in 3-D, and that of static stages."""


def shipped(name):
    """The test of one case."""
    def test(self):
        self.check(name)
    return test


for case in CASES:
    if case not in ("pipeline", "pipe-on-springs"):
        is_3d = case in ("landslide-3d", "own-slope", "slope-3d", "slope-stability")
        setattr(Shipped3d if is_3d else Shipped, "test_" + case.replace("-", "_"), shipped(case))


class Pipes(EveryTool):
    """The cases with a pipe, which talus-pipe reads, too."""

    def test_pipeline(self):
        folder, _ = self.check("pipeline")
        self.pipe(folder, "set Obstacle = pipe\nset Width = 100")

    def test_pipe_on_springs(self):
        """The springs of a pipe with a mass are no obstacles of their own."""
        folder, page = self.check("pipe-on-springs")
        self.pipe(folder, "set Obstacle = pipe\nset Width = 100")
        force = talus.read(folder).table("obstacles")["pipe force x [N]"]
        self.assertEqual(abs(float(page.values["pipe force x [N]"])), abs(force).max())
        self.assertNotIn("pipe spring:", page.said("obstacles"))

    def test_any_name(self):
        """Names that look like columns of the table."""
        names = ["pipe", "spring", "x friction", "a least mean"]
        settings = ["Obstacles/Names=" + ", ".join(names)]
        for k, name in enumerate(names):
            settings += [f"Obstacles/{name}/{entry}" for entry in (
                "Shape=ball", f"Centre={52 + 6 * k}, 1", "Radius=1", "Mass=600", "Free axes=x",
                "Spring stiffness=5e4, 0")]
        folder = self.run_case("names", ROOT / "prm/first-slope.prm",
                               ["Grid/Cell size=1", *settings, "End time=3"])
        page, tiles = self.use_all(folder)
        self.assertEqual([name for name in tiles if name.startswith("largest force")],
                         ["largest force on pipe", "largest force on spring"])
        for name in names:
            self.assertIn(f"{name}: the soil", page.said("obstacles"))


class Interrupted(EveryTool):
    def test_killed_and_resumed(self):
        file = ROOT / "prm/first-slope.prm"
        settings = ["Grid/Cell size=1", "Checkpoint/Step interval=200", "End time=20"]
        folder = self.folder / "killed"
        with subprocess.Popen([TALUS, file, "--output", folder,
                               *[o for s in settings for o in ("--set", s)]],
                              stdout=subprocess.DEVNULL) as process:
            end = time.time() + 60
            while not list(folder.glob("checkpoints/*[0-9]")) and time.time() < end:
                time.sleep(0.01)
            process.send_signal(signal.SIGKILL)
        page, _ = self.use_all(folder)
        self.assertIn("The run has not finished", page.said("notices"))
        page, _ = self.use_all(self.run_case("killed", file, settings, "--resume"))
        self.assertNotIn("has not finished", page.said("notices"))


class Ranks(EveryTool):
    def test_two_ranks(self):
        """The page has the numbers of one rank, to round-off."""
        file, settings = ROOT / "prm/first-slope.prm", ["Grid/Cell size=1", "End time=4"]
        one = self.run_case("one", file, settings)
        two = self.run_case("two", file, settings, launcher=LAUNCHER)
        tiles = [self.use_all(folder)[1] for folder in (one, two)]
        self.assertEqual(tiles[0].keys(), tiles[1].keys())
        for name, value in tiles[0].items():
            self.assertAlmostEqual(tiles[1][name], value, delta=1e-6 * abs(value))


class Directions(EveryTool):
    def test_towards_minus_x(self):
        """The mirror image of a slide has its runout and speed; stations whose names look like
        columns."""
        file = ROOT / "prm/first-slope.prm"
        folder = self.run_case("west", file, WEST)
        page, tiles = self.use_all(folder)
        mirror = self.run_case("east", file, ["Grid/Cell size=1", WEST[-1]])
        _, others = self.use_all(mirror)
        self.assertGreater(tiles["runout"], 3)
        for name, value in tiles.items():
            self.assertAlmostEqual(value, others[name], delta=0.02 * abs(others[name]), msg=name)
        stations = talus.read(folder).table("stations")
        self.assertGreater(stations["x thickness [m]"].max(), 0)
        self.assertEqual(float(page.values["x thickness [m]"]), stations["x thickness [m]"].max())
        self.assertIn("No soil reached the station x thickness.", page.said("stations"))
        rows = self.study("west", file, WEST)
        self.succeeds("talus-study", self.folder / "west.prm", "--collect", cwd=ROOT)
        self.assertEqual(read_csv(self.folder / "west-study" / "study.csv"), rows)
        self.assertEqual(float(rows[1]["runout [m]"]), tiles["runout"])

    def test_towards_minus_z(self):
        """A block of 1 m in 3-D on a plane with slope 0.36 and friction 0.1, to the north."""
        file = ROOT / "tests/cases/block-downhill-3d.prm"
        folder = self.run_case("north", file, NORTH)
        page, tiles = self.use_all(folder)
        # Acceleration along the plane, and its part in plan.
        angle = numpy.arctan(0.36)
        speed = 2 * 9.81 * (numpy.sin(angle) - 0.1 * numpy.cos(angle)) * numpy.cos(angle)
        self.assertAlmostEqual(tiles["largest speed"] / speed, 1, delta=0.05)
        self.assertIn("along the way of the centre of mass", page.said("thalweg"))
        self.assertIn("cable maximum thickness", page.said("lines"))
        self.assertEqual(set(talus.read(folder).table("lines")["line"]), {"cable"})
        self.pipe(folder, "set Source = line\nset Line = cable")
        rows = self.study("north", file, NORTH, "subsection Quantities\nset Names = a, b\n"
                          "subsection b\nset Map = maximum-speed\nset Place = 0, 3\nend\nend")
        self.assertEqual(float(rows[1]["a [m]"]), tiles["runout"])
        self.assertGreater(float(rows[1]["b"]), 1)


class Damaged(EveryTool):
    """Rows without numbers, and texts that are no UTF-8."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = cls.slide("whole", "Obstacles/Names=pipe", "Obstacles/pipe/Shape=ball",
                              "Obstacles/pipe/Centre=53, 1", "Obstacles/pipe/Radius=1",
                              "Stations/Points=a: 52", "Maps/Write=true",
                              "Boundaries/Write forces=true", "Output/Field interval=2",
                              "Output/Boxes as cells=false")

    def copy(self):
        """A fresh copy of the run."""
        folder = self.folder / "copy"
        shutil.rmtree(folder, ignore_errors=True)
        return shutil.copytree(self.whole, folder)

    def test_last_row_without_numbers(self):
        """In all tables, with the time and without: a report, a comparison, and a notice where
        the row is left out."""
        for word, keeps_time in (("nan", True), ("nan", False), ("inf", False)):
            folder = self.copy()
            for path in folder.glob("*.csv"):
                *rows, last = path.read_text().splitlines()
                cells = last.split(",")
                cells = [cells[0] if keeps_time else word, *[word] * (len(cells) - 1)]
                path.write_text("\n".join([*rows, ",".join(cells)]) + "\n")
            self.succeeds("talus-report", folder)
            said = Page(folder).said("notices")
            for path in folder.glob("*.csv"):
                if not keeps_time or path.name in ("profile.csv", "statistics.csv"):
                    self.assertIn(f"1 row of {path.name} with values that are not numbers was "
                                  "left out", said)
            self.succeeds("talus-compare", folder, self.whole, "--output", folder / "c.html")

    def recoded(self, folder, change):
        """All texts of a run as an editor or an older version may have written them."""
        for path in [*folder.glob("*.csv"), *folder.glob("*.txt"), folder / "parameters.prm"]:
            path.write_bytes(change(path.read_bytes()))
        return folder

    def test_byte_order_mark(self):
        self.use_all(self.recoded(self.copy(), lambda data: b"\xef\xbb\xbf" + data))

    def test_windows_letters(self):
        """Names and titles in Windows' cp1252, in a folder of that name."""
        def change(data):
            return data.replace(b"pipe", b"r\xf6hre").replace(
                b"set Title", b"set Title = S\xe3o Miguel, 5\xb0\n# ", 1)
        folder = self.recoded(self.copy(), change)
        named = os.path.join(os.fsencode(self.folder), b"S\xe3o")
        shutil.rmtree(named, ignore_errors=True)
        os.rename(folder, named)
        name = os.fsdecode(named)
        self.succeeds("talus-report", name, errors="surrogateescape")
        self.succeeds("talus-compare", name, name, "--output", self.folder / "c.html")
        with open(os.path.join(name, "report.html"), encoding="utf-8") as stream:
            text = stream.read()
        self.assertIn("S\ufffdo Miguel, 5\ufffd", text)
        self.assertIn("largest force on r\ufffdhre", text)
        self.assertEqual(talus.read(name).parameters["Title"], "S\ufffdo Miguel, 5\ufffd")

    def test_files_of_the_user(self):
        """A study is read with a byte order mark; other bytes than UTF-8 are told with the line,
        in a case, too."""
        file = self.folder / "case.prm"
        file.write_bytes(b"\xef\xbb\xbf" + (ROOT / "prm/first-slope.prm").read_bytes())
        rows = self.study("mark", file, ["Grid/Cell size=2", "End time=1"])
        self.assertEqual([row["status"] for row in rows], ["finished"] * 2)
        study = self.folder / "mark.prm"
        study.write_bytes(b"\xef\xbb\xbf" + study.read_bytes())
        self.succeeds("talus-study", study, cwd=ROOT)
        file.write_bytes(b"set End time = 1\nset Title = S\xe3o\n")
        self.assert_sentence(self.tool("talus-study", study, cwd=ROOT),
                             "case.prm', line 2, is not UTF-8")
        study.write_bytes(study.read_bytes() + b"\n# \xe3\n")
        self.assert_sentence(self.tool("talus-study", study, cwd=ROOT), "mark.prm', line",
                             "is not UTF-8")


if __name__ == "__main__":
    main()

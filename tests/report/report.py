# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reports of runs of all kinds: what must be on the page, with the numbers of the tables.

Usage: report.py TALUS ROOT FOLDER [SUITE]
"""

import fcntl
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import types
import unittest
import xml.etree.ElementTree

import numpy
from PIL import Image

from tools_case import COARSE, ROOT, SHARE, TALUS, Case, main, read_csv

from talus_tools.compare.pair import on_cells_of
from talus_tools.errors import UserError
from talus_tools.esri import read_grid
from talus_tools.parameters import Defaults, read_parameters
from talus_tools.report.film import entries, painted, palette_image, rasters
from talus_tools.report.on_map import stations_of
from talus_tools.report.places import routes_of
from talus_tools.report.run import Run
from talus_tools.report.sections.bands import Layer
from talus_tools.report.sections.cut import cut_points, cut_surface
from talus_tools.report.sections.safety import line_of_motion, mechanism
from talus_tools.report.sections.thalweg import columns_of
from talus_tools.report.way import Way, way_of
from talus_tools.report.write import write_report

ALWAYS = ["notices", "what-was-run", "runout", "thalweg", "mass", "momentum", "energy", "fracture",
          "log"]


class Page:
    """What a report or comparison says; it is XML, too."""

    def __init__(self, folder, name="report.html"):
        self.text = (folder / name).read_text()
        body = self.text.replace("<!DOCTYPE html>", "", 1)
        body = re.sub(r'<(meta [^>]*[^/])>', r'<\1 />', body)
        self.root = xml.etree.ElementTree.fromstring(body)
        self.sections = {s.get("id"): s for s in self.root.iter("section")}
        self.values = {e.get("data-column"): e.get("data-value") for e in self.root.iter("td")
                       if e.get("data-column")}

    def said(self, section):
        """All words of a section."""
        return " ".join(" ".join(self.sections[section].itertext()).split())

    def pictures(self, section):
        """Sources of its pictures."""
        return [e.get("src") for e in self.sections[section].iter("img")]


class ReportCase(Case):
    def report(self, folder):
        path, _ = write_report(str(folder))
        self.assertEqual(path, str(folder / "report.html"))
        return Page(folder)

    def assert_has(self, page, *more):
        self.assertEqual(set(page.sections), {*ALWAYS, *more})
        for section in page.sections:
            for source in page.pictures(section):
                self.assertRegex(source, r"^data:image/(png|svg\+xml);base64,\w")


class Report(ReportCase):
    def test_2d_run_has_the_numbers_of_its_tables(self):
        folder = self.slide("slope")
        page = self.report(folder)
        self.assert_has(page, "soil", "motion")
        # Results first, settings last.
        order = list(page.sections)
        self.assertEqual([order[1], order[-2], order[-1]], ["motion", "log", "what-was-run"])
        self.assertLess(order.index("runout"), order.index("mass"))
        last = read_csv(folder / "statistics.csv")[-1]
        cells = [e.get("data-value") for e in page.sections["runout"].iter("td")
                 if e.get("data-column") == "front x [m]"]
        self.assertEqual(float(cells[1]), float(last["front x [m]"]))
        self.assertIn("The soil still moves at the end", page.said("notices"))
        self.assertIn("Grid / Cell size 1 0.2", page.said("what-was-run"))
        self.assertIn("git revision", page.said("what-was-run"))
        self.assertIn("did not change by a single bit", page.said("mass"))

        # Submerged weight, seabed and nothing else: the budget of momentum closes.
        rows = {row[0].text: row[1].text for row in page.sections["momentum"].iter("tr")
                if len(row) == 3}
        rest = float(rows["the rest"].split()[0].replace("−", "-"))
        gravity, unit = rows["impulse of gravity"].split()[:2]
        self.assertEqual(unit, "t")
        factor = 1000 if rows["the rest"].split()[1] == "t" else 1
        self.assertLess(abs(rest * factor), 0.02 * float(gravity) * 1000)
        self.needs_nothing_else(page)
        # By the command, again the same.
        result = self.tool("talus-report", folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn(f"Open {folder / 'report.html'} in a browser.", result.stdout)
        self.assertEqual(page.text, Page(folder).text)

    def needs_nothing_else(self, page):
        outside = re.sub(r"base64,[\w+/=]*", "", page.text)
        for word in ("http:", "https:", "<script ", "<link", "@import", "url(", "fetch(",
                     "XMLHttpRequest", "import("):
            self.assertNotIn(word, outside)

    def test_without_runout_and_fields(self):
        page = self.report(self.slide("bare", "Output/Runout=false", "Output/Write points=false",
                                      "Output/Write grid=false"))
        self.assertNotIn("thalweg", page.sections)
        self.assertNotIn("soil", page.sections)
        self.assertNotIn("motion", page.sections)
        self.assertNotIn("front x [m]", page.values)

    def test_obstacles_and_faces(self):
        folder = self.slide("pipe", "Obstacles/Names=pipe", "Obstacles/pipe/Shape=ball",
                            "Obstacles/pipe/Centre=53,1", "Obstacles/pipe/Radius=1",
                            "Output/Boxes as cells=false",
                            "Boundaries/Write forces=true")
        page = self.report(folder)
        self.assert_has(page, "soil", "motion", "obstacles", "faces")
        self.assertIn("largest force on pipe", "".join(page.root.itertext()))
        # The pipe limits no shear stress; ParaView finds no scale for infinite values.
        _, values = Run(str(folder)).series("obstacles").read(0)
        self.assertFalse(numpy.isinf(values["maximum shear stress [Pa]"]).any())
        self.assertTrue(numpy.isnan(values["maximum shear stress [Pa]"]).all())
        forces = [float(row["pipe force x [N]"]) for row in read_csv(folder / "obstacles.csv")]
        self.assertGreater(max(forces), 0)
        self.assertEqual(float(page.values["pipe force x [N]"]), max(forces))
        self.assertIn("the soil touches it from", page.said("obstacles"))

    def test_points_at_limits_of_splitting(self):
        words = "stretched too far and could not be split"
        page = self.report(self.slide("split"))
        self.assertNotIn(words, page.said("notices"))
        self.assertNotIn("without a split", page.said("log"))
        self.assertEqual(float(page.values["points at generation limit"]), 0)
        folder = self.slide("unsplit", "Splitting/Maximum generation=0")
        page = self.report(folder)
        counts = [float(row["points at generation limit"])
                  for row in read_csv(folder / "statistics.csv")]
        self.assertIn(f"Up to {max(counts):.0f} points were {words}", page.said("notices"))
        self.assertIn("Raise that number", page.said("notices"))
        self.assertEqual(float(page.values["points at generation limit"]), max(counts))
        self.assertIn("without a split", page.said("log"))
        self.assertEqual((folder / "log.txt").read_text().count("without a split"), 1)

    def test_end_at_rest(self):
        """A run that ends before its end time, since the soil is at rest, has finished."""
        folder = self.slide("rest", "End time=200", "Output/Write points=false",
                            "Output/Write grid=false")
        last = read_csv(folder / "statistics.csv")[-1]
        self.assertLess(float(last["time [s]"]), 100)
        page = self.report(folder)
        self.assertNotIn("has not finished", page.said("notices"))
        self.assertNotIn("still moves", page.said("notices"))
        runout = read_csv(folder / "runout.csv")
        values = [e.get("data-value") for e in page.sections["runout"].iter("td")
                  if e.get("data-column") == "runout [m]"]
        self.assertEqual(float(values[1]), float(runout[-1]["runout [m]"]))
        tiles = "".join(page.root.itertext())
        self.assertIn("Of the front from its start, along the way of the slide", tiles)

    def test_inflow(self):
        """What enters belongs to the balances of mass and energy."""
        folder = self.slide("inflow", "Grid/Cell size=0.25", "End time=1",
                            file="verification/plug-inflow.prm")
        page = self.report(folder)
        for words in ("soil was lost or made", "stretched too far", "does not close"):
            self.assertNotIn(words, page.said("notices"))
        entered = float(read_csv(folder / "statistics.csv")[-1]["inflow mass [kg]"])
        self.assertAlmostEqual(entered, 1000, 9)
        self.assertEqual(float(page.values["inflow mass [kg]"]), entered)
        self.assertIn("less what entered, changed by at most", page.said("mass"))
        self.assertIn("nothing but round-off", page.said("mass"))
        self.assertIn("impulse of inflow", page.said("momentum"))

    def test_outflow(self):
        """Soil that left is told, and no error of mass."""
        folder = self.slide("outflow", "Grid/Upper corner=54, 6", "Boundaries/Right=outflow",
                            "End time=8")
        last = read_csv(folder / "statistics.csv")[-1]
        left = float(last["outflow mass [kg]"])
        self.assertGreater(left, 0)
        page = self.report(folder)
        self.assertRegex(page.said("notices"), r"[\d.]+ % of the soil left the mesh")
        self.assertNotIn("soil was lost or made", page.said("notices"))
        self.assertEqual(float(page.values["outflow mass [kg]"]), left)
        self.assertIn("The mass, with what left,", page.said("mass"))
        self.assertIn("impulse of outflow", page.said("momentum"))

    def test_stages(self):
        folder = self.slide("stages", "Stages=equilibrium, strength reduction",
                            "Materials/mud/Undrained shear strength=8e3",
                            "Boundaries/Seabed/Maximum shear stress=5e3")
        page = self.report(folder)
        self.assertIn("safety", page.sections)
        factor = re.search(r"factor of safety is ([\d.]+)", (folder / "log.txt").read_text())[1]
        self.assertIn(factor.rstrip("."), page.said("safety"))
        self.assertEqual(len(page.pictures("safety")), 1)

    def test_pore_water(self):
        """Undrained soil, whose pressure is drawn."""
        folder = self.slide("pore", "Materials/mud/Pore water/Drainage=undrained",
                            "Materials/mud/Pore water/Stiffness=1e6",
                            "Materials/mud/Pore water/Coefficient of consolidation=1e-6")
        page = self.report(folder)
        rows = read_csv(folder / "statistics.csv")
        for column in ("largest excess pore pressure [Pa]", "largest pore pressure ratio [-]"):
            self.assertEqual(float(page.values[column]), max(float(row[column]) for row in rows))
        for words in ("Pore water of 'mud': undrained", "K_f of 1e+06 Pa", "undrained is right."):
            self.assertIn(words, page.said("pore-water"))
        self.assertEqual(len(page.pictures("soil")), 3)
        self.assertNotIn("pore-water", self.report(self.slide("slope")).sections)

    def test_shear_bands(self):
        """Softening soil, with the critical length of the weak layer below the slab."""
        folder = self.slide("bands", "Stages=dynamics", "Output/Boxes as cells=false",
                            "End time=0.2", "Grid/Cell size=0.5", "Output/Runout=true",
                            file="verification/shear-band.prm")
        self.assertIn("--weak-layer, with the names", self.report(folder).said("bands"))
        result = self.tool("talus-report", folder, "--slab", "slab", "--weak-layer", "weak")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = Page(folder)
        self.assertIn("longer than the critical length runs away", page.said("bands"))
        rows = read_csv(folder / "bands.csv")
        for column in list(rows[0])[1:]:
            self.assertEqual(float(page.values[column]), max(float(row[column]) for row in rows))
        self.assert_sentence(self.tool("talus-report", folder, "--slab", "slab"), "go together")
        self.assert_sentence(self.tool("talus-report", folder, "--slab", "slab", "--weak-layer",
                                       "week"), "'Bodies/week/Material'", "name two of its bodies")

    def test_critical_length(self):
        """L_cr = 2 (1 - r)/r l_u, or (2/r) sqrt(2 l_d^2 (1 - r + r ln r)) under Bingham."""
        entries = read_parameters(ROOT / "prm" / "verification" / "shear-band.prm")
        self.assertAlmostEqual(Layer(entries, "slab", "weak").critical_length(), 46.02, 2)
        weak = "Materials/weak/"
        entries[weak + "Softening displacement"] = ""
        entries[weak + "Hardening modulus"] = "-60e3"
        self.assertAlmostEqual(Layer(entries, "slab", "weak").critical_length(), 46.02, 2)
        entries[weak + "Law"] = "Bingham"
        entries[weak + "Remoulded strength ratio"] = str(1500 / 3500)
        entries[weak + "Softening displacement"] = "0.15"
        self.assertAlmostEqual(Layer(entries, "slab", "weak").critical_length(), 50.56, 2)
        entries["Gravity/Slope angle"] = "2"
        self.assertEqual(Layer(entries, "slab", "weak").critical_length(), math.inf)
        entries["Gravity/Slope angle"] = "10"
        self.assertEqual(Layer(entries, "slab", "weak").critical_length(), 0)

    def test_defaults_of_obstacles(self):
        """By their own section of the reference; what it lacks, by that of bodies."""
        reference = self.folder / "reference.prm"
        body = "subsection Bodies\nsubsection soil\nset Shape = box\nset Radius = 1\nend\nend\n"
        obstacle = ("subsection Obstacles\nsubsection wall\nset Shape = ball\n"
                    "set Friction coefficient = 0.3\nend\nend\n")
        for text, shape, friction in ((body, "box", None), (body + obstacle, "ball", "0.3")):
            reference.write_text(text)
            defaults = Defaults(reference)
            self.assertEqual([defaults.of(f"Obstacles/pipe/{name}", {}) for name in
                              ("Shape", "Radius", "Friction coefficient")],
                             [shape, "1", friction])

    def test_3d(self):
        folder = self.slide("3d", "Output/Boxes as cells=false", "Grid/Cell size=0.8",
                            "End time=0.1", file="landslide-3d.prm")
        page = self.report(folder)
        self.assert_has(page, "soil", "motion")
        self.assertIn("Upright section along the", page.said("soil"))
        self.assertEqual(page.said("what-was-run").count("not known"), 0)


class Interrupted(ReportCase):
    def kill(self, name):
        """A run that was killed behind its first checkpoints."""
        folder = self.folder / name
        settings = [*COARSE, "End time=20", "Checkpoint/Step interval=200"]
        process = subprocess.Popen(
            [TALUS, ROOT / "prm" / "first-slope.prm", "--output", folder,
             *[o for s in settings for o in ("--set", s)]], stdout=subprocess.DEVNULL)
        end = time.time() + 60
        while not list(folder.glob("checkpoints/*[0-9]")) and time.time() < end:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        return folder

    def test_killed_and_resumed(self):
        folder = self.kill("killed")
        page = self.report(folder)
        self.assertIn("The run has not finished", page.said("notices"))
        self.assertIn("killed, or failed", page.said("notices"))
        subprocess.run([TALUS, ROOT / "prm" / "first-slope.prm", "--output", folder, "--resume",
                        *[o for s in [*COARSE, "End time=20", "Checkpoint/Step interval=200"]
                          for o in ("--set", s)]], check=True, stdout=subprocess.DEVNULL)
        page = self.report(folder)
        self.assertNotIn("has not finished", page.said("notices"))
        self.assertIn("Resumed at t =", page.said("log"))

    def test_in_progress(self):
        """The lock is held and the last line is not complete."""
        folder = self.slide("progress")
        parameters = folder / "parameters.prm"
        parameters.write_text(re.sub(r"set End time( *)= 4", r"set End time\1= 40",
                                     parameters.read_text()))
        table = folder / "statistics.csv"
        lines = table.read_text().splitlines(keepends=True)
        table.write_text("".join(lines[:-1]) + lines[-1][:-3])
        with open(folder / "lock", "rb") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            page = self.report(folder)
        self.assertIn("It is still running.", page.said("notices"))
        self.assertIn("The last line of statistics.csv is not complete", page.said("notices"))

    def test_just_begun(self):
        """One row, and tables that have only their header."""
        folder = self.slide("begun")
        for name in ("statistics.csv", "profile.csv"):
            lines = (folder / name).read_text().splitlines(keepends=True)
            n = 2 if name == "statistics.csv" else 1
            (folder / name).write_text("".join(lines[:n]))
        self.assertIn("It was killed", self.report(folder).said("notices"))


    def test_empty_tables(self):
        """As a full disk leaves them: each is told."""
        folder = self.slide("empty")
        header, _ = (folder / "profile.csv").read_text().split("\n", 1)
        for content, size in (("", 0), (header[:20], 20), (header + "\n", len(header) + 1)):
            for name in ("profile.csv", "lines.csv", "obstacles.csv"):
                (folder / name).write_text(content)
            page = self.report(folder)
            self.assertNotIn("thalweg", page.sections)
            for name in ("profile.csv", "lines.csv", "obstacles.csv"):
                self.assertIn(f"{name} has no complete row ({size} bytes)", page.said("notices"))


class Maps(ReportCase):
    def write_grid(self, folder, name, values, columns=3):
        folder.mkdir(exist_ok=True)
        (folder / f"{name}.asc").write_text(
            f"ncols {columns}\nnrows {len(values) // columns}\nxllcorner 412000\n"
            "yllcorner 6538000\ncellsize 20\nNODATA_value -9999\n" + " ".join(map(str, values)))

    def test_rasters(self):
        folder = self.slide("3d", "Grid/Cell size=0.8", "End time=0.1", file="landslide-3d.prm")
        maps = folder / "maps"
        self.write_grid(maps, "ground", [-100, -101, -103, -101, -102, -103, -103, -104, -105])
        self.write_grid(maps, "maximum-thickness", [0, 0, 0, 0, 1, 4.25, 0, -9999, 0])
        self.write_grid(maps, "arrival-time-0.1m", [-9999] * 4 + [7, 9] + [-9999] * 3)
        self.write_grid(maps, "erosion", [-9999] * 9)
        page = self.report(folder)
        self.assertEqual(len(page.pictures("maps")), 3)
        self.assertEqual(page.values["maximum-thickness"], "4.25")
        # The easternmost cell of the middle row; two cells have soil.
        self.assertIn("4.25 m E 412050, N 6538030 800 m²", page.said("maps"))
        self.assertIn("erosion nowhere", page.said("maps"))
        self.assert_styles(maps)
        self.write_grid(maps, "erosion", [1] * 6)
        with self.assertRaisesRegex(UserError, "erosion.* other cells"):
            write_report(str(folder))
        (maps / "erosion.asc").write_text("ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\n"
                                          "cellsize 20\n1 2 3")
        with self.assertRaisesRegex(UserError, "erosion.* 3 values; 3 rows of 3"):
            write_report(str(folder))

    def assert_styles(self, maps):
        """A style of QGIS beside each raster, with the limits of the values; one that a user has
        changed stays."""
        self.assertEqual({p.stem for p in maps.glob("*.qml")}, {p.stem for p in maps.glob("*.asc")})
        root = xml.etree.ElementTree.parse(maps / "maximum-thickness.qml").getroot()
        items = [float(item.get("value")) for item in root.iter("item")]
        self.assertEqual((items[0], len(items)), (0, 9))
        self.assertAlmostEqual(items[-1], numpy.percentile([1, 4.25], 99.5))
        root = xml.etree.ElementTree.parse(maps / "ground.qml").getroot()
        self.assertEqual(root.find("pipe/rasterrenderer").get("type"), "hillshade")
        own = "<!DOCTYPE qgis><qgis/>"
        (maps / "ground.qml").write_text(own)
        (maps / "erosion.qml").unlink()
        write_report(str(maps.parent))
        self.assertEqual((maps / "ground.qml").read_text(), own)
        self.assertTrue((maps / "erosion.qml").exists())

    def test_smallest_thickness(self):
        run = Run(str(self.slide("thin", "Maps/Smallest thickness=0.25")))
        self.assertEqual([run.smallest_thickness(section) for section in ("Maps", "Runout")],
                         [0.25, 0.1])

    def test_lines_over_x_and_stations(self):
        folder = self.slide("2d", "Stations/Points=A: 20 | A 2: 90")
        (folder / "maps.csv").write_text(
            "x [m],maximum thickness [m],arrival time 0.1 m [s]\n0,0,nan\n1,2.5,3\n2,0.5,7\n")
        (folder / "stations.csv").write_text(
            "time [s],A thickness [m],A speed [m/s],A 2 thickness [m],A 2 speed [m/s]\n"
            "0,0,0,0,0\n1,0.5,1.5,0,0\n2,0.25,3.5,0,0\n")
        (folder / "lines.csv").write_text(
            "line,distance [m],thickness at start [m],maximum bed shear [Pa],"
            "maximum thickness [m]\n"
            "cable,0,0,0,0.5\ncable,10,0,3,0.75\npipe,0,0,0,nan\npipe,5,0,0,0\n")
        page = self.report(folder)
        self.assertIn("cable maximum thickness 0.75 m 10 m", page.said("lines"))
        # A tenth of a cell of 1 m, or what the user says.
        for section in ("lines", "maps"):
            self.assertIn("0 where soil is thinner than 0.1 m", page.said(section))
        # What is zero everywhere is not drawn, and what is looked for first comes first.
        self.assertNotIn("thickness at start", page.said("lines"))
        self.assertIn("No soil reached the line pipe.", page.said("lines"))
        self.assertEqual(len(page.pictures("lines")), 2)
        folded = [i for d in page.sections["lines"].iter("details") for i in d.iter("img")]
        self.assertEqual(len(folded), 1)
        self.assertIn("maximum thickness 2.5 m x = 1 m", page.said("maps"))
        self.assertEqual(page.values["A speed [m/s]"], "3.5")
        self.assertNotIn("A 2 thickness", page.said("stations"))
        self.assertIn("No soil reached the station A 2.", page.said("stations"))


def centre(grid, values):
    """Easting and northing of the centre of what a grid holds."""
    weights = numpy.nan_to_num(values)
    places = grid.place(*numpy.indices(values.shape))
    return [numpy.sum(place * weights) / weights.sum() for place in places]


class Films(Case):
    """Frames of the slider and of talus-animate."""

    def test_painted_area(self):
        """Parallelograms cover their area, without holes, whatever their size."""
        for size in (0.5, 2.0, 11.0):
            x, y = numpy.meshgrid(numpy.arange(0, 22, size), numpy.arange(0, 22, size))
            corner = numpy.stack([x.ravel(), y.ravel()], axis=-1)[:, None]
            quads = corner + size * numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]])
            index = painted(numpy.zeros((60, 80), dtype=numpy.uint8), quads,
                            numpy.full(len(quads), 7, dtype=numpy.uint8), (-9, 31, -5, 25))
            self.assertTrue(numpy.all(index[7:49, 19:61] == 7), size)
            self.assertAlmostEqual(numpy.count_nonzero(index), 4 * 22**2, delta=4 * 45)

    def test_colours(self):
        """No soil is transparent, the largest value has the last colour, and no value is drawn
        as a structure."""
        index = entries(numpy.array([numpy.nan, 0, 1e-9, 5, 10, 1000]), 10)
        self.assertEqual(index.tolist(), [0, 0, 1, 127, 254, 254])
        image = palette_image(index[None], "viridis").convert("RGB")
        self.assertEqual(image.getpixel((4, 0)), (253, 231, 36))

    def test_animate(self):
        """One picture per time of the fields, each different from the one before."""
        folder = self.slide("film")
        film = folder / "film.gif"
        result = self.tool("talus-animate", folder, "--output", film, "--fps", 5)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with Image.open(film) as gif:
            self.assertEqual(gif.n_frames, len(list(folder.glob("points-*.vtu"))))
            gif.seek(1)
            self.assertEqual(gif.info["duration"], 200)
            pictures = []
            for k in range(gif.n_frames):
                gif.seek(k)
                pictures.append(numpy.asarray(gif.convert("RGB")).astype(int))
        for one, other in zip(pictures, pictures[1:]):
            self.assertGreater(numpy.count_nonzero(numpy.abs(one - other).max(axis=2) > 30), 500)
        # Where there is ffmpeg it makes a film, too; else the GIF is what is made.
        result = self.tool("talus-animate", folder, "--most", 3)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        name = "animation.mp4" if shutil.which("ffmpeg") else "animation.gif"
        self.assertIn(f"3 pictures are in {folder / name}", result.stdout)
        self.assertGreater(os.path.getsize(folder / name), 5000)

    def test_animate_refuses(self):
        folder = self.slide("still", "Output/Write points=false", "Output/Runout=false")
        self.assert_sentence(self.tool("talus-animate", folder), "no fields at two times")
        for options, words in ((("--output", "film.avi"), "film.avi"), (("--fps", "0"), "--fps 0"),
                               (("--most", "1"), "--most 1")):
            self.assert_sentence(self.tool("talus-animate", folder, *options), words)
        self.assert_sentence(self.tool("talus-animate", folder, "--output", "film.mp4",
                                       env={"PATH": "/nowhere"}), "ffmpeg", ".gif")


class Places(unittest.TestCase):
    def test_stations_by_mesh_and_map(self):
        for coordinates, place in (("mesh", "200, 50"), ("map", "1200, 1950")):
            run = types.SimpleNamespace(entries={
                "Grid/Origin": "1000, 2000, -5", "Stations/Coordinates": coordinates,
                "Stations/Points": f"A: {place} | B 2: {place}"})
            self.assertEqual({name: tuple(at) for name, at in stations_of(run).items()},
                             {"A": (1200, 1950), "B 2": (1200, 1950)})


class Ways(ReportCase):
    """Lengthwise sections follow the way of the slide in plan."""

    def bent(self):
        """3 m along x, then along z."""
        return Way(numpy.array([[0.0, 0.0], [3.0, 0.0], [3.0, 5.0]]), "", "")

    def test_project(self):
        places = numpy.array([[-2.0, 1.0], [1.0, -1.0], [4.0, 2.0], [3.0, 9.0]])
        along, away, direction = self.bent().project(places)
        self.assertEqual(along.tolist(), [-2, 1, 5, 12])
        self.assertEqual(away.tolist(), [1, 1, 1, 0])
        self.assertEqual(direction.tolist(), [[1, 0], [1, 0], [0, 1], [0, 1]])

    def test_cut(self):
        """A plane y = x + 2 z is met along the way with its own slopes, without gaps."""
        corners = numpy.array([[[x, x + 2 * z, z] for x, z in triangle] for triangle in
                               ([[-9.1, -9.2], [9.3, -9.4], [-9.5, 9.6]],
                                [[9.3, -9.4], [-9.5, 9.6], [9.7, 9.8]])])
        lines = cut_surface(corners, self.bent())
        for s, y in lines.reshape(-1, 2):
            self.assertAlmostEqual(y, s if s < 3 else 3 + 2 * (s - 3), places=12)
        ends = lines[lines[:, :, 0].min(axis=1).argsort()][:, :, 0]
        self.assertAlmostEqual(numpy.abs(numpy.diff(ends, axis=1)).sum(), numpy.ptp(ends))
        self.assertGreater(numpy.ptp(ends), 20)

    def downhill(self, name, *settings):
        """A block that slides to the west-north-west on a plane of 20 degrees."""
        return self.slide(name, "Output/Boxes as cells=false", "Grid/Cell size=0.5", "End time=2",
                          *settings, file="../tests/cases/block-downhill-3d.prm")

    def test_west_north_west(self):
        folder = self.downhill("downhill")
        run = Run(str(folder))
        way = way_of(run)
        columns = columns_of(run, way)
        # The bed falls along the way as the plane does, tan(20 degrees); along x it is 0.336.
        places, bed = columns.bed()
        self.assertAlmostEqual(numpy.polyfit(places, bed, 1)[0], -math.tan(math.pi / 9),
                               delta=0.003)
        # Front and rear are those of runout.csv, where the way is computed in the program.
        last = read_csv(folder / "runout.csv")[-1]
        table = run.tables["profile"]
        thick = (table["time [s]"] == 2) & (table["thickness [m]"] >= 0.05)
        along, _, _ = way.project(numpy.stack([table["x [m]"], table["z [m]"]], axis=-1)[thick])
        self.assertAlmostEqual(along.max() + 0.25, float(last["front along path [m]"]))
        self.assertAlmostEqual(along.min() - 0.25, float(last["rear along path [m]"]))
        # The section goes through the block: it is as long there as its sides of 2 m, which the
        # way crosses at 22.5 degrees, and 1 m high, less what the plane is inclined.
        outlines, _ = cut_points(*run.series("points").read(2), way)
        self.assertAlmostEqual(numpy.ptp(outlines[..., 0]), 2 / math.cos(math.pi / 8), delta=0.3)
        page = self.report(folder)
        for section in ("thalweg", "soil"):
            self.assertIn("along the way of the centre of mass", page.said(section))

    def test_way_ends_where_soil_leaves(self):
        """The centre of mass of the rest goes back up the slope."""
        centre = numpy.array([0.0, 5, 9, 14, 12, 3, -4])
        run = types.SimpleNamespace(dimension=3, entries={"Grid/Cell size": "1"}, statistics={
            "centre x [m]": -centre, "centre z [m]": numpy.full(7, 2.0),
            "mass [kg]": numpy.array([100, 100, 100, 99.5, 80, 50, 20])})
        self.assertEqual(way_of(run).corners.tolist(), [[0, 2], [-5, 2], [-9, 2], [-14, 2]])
        run.statistics["mass [kg]"] = numpy.full(7, 100.0)
        self.assertEqual(len(way_of(run).corners), 6)

    def test_mechanism(self):
        """Points of 1 m that fail towards -x and +z, without an outline of their own: the section
        goes through their middle, along the diagonal."""
        places = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(5.0)]), axis=-1).reshape(-1, 1, 3)
        motion = numpy.tile([-0.6, -0.5, 0.6], (len(places), 1))
        values = {"mechanism [-]": motion, "box length [m]": numpy.ones((len(places), 3))}
        way = line_of_motion(places, motion)
        numpy.testing.assert_allclose(way.corners, [[2, 2], [2 - 0.5**0.5, 2 + 0.5**0.5]])
        outlines, found = cut_points(places, values, way)
        # Those on the diagonal and beside it, in all five layers.
        self.assertEqual(len(outlines), 5 * (5 + 4 + 4))
        self.assertEqual(len(found["mechanism [-]"]), len(outlines))
        self.assertAlmostEqual(numpy.ptp(outlines[..., 0]), 5 * 2**0.5)
        run = types.SimpleNamespace(dimension=3, entries={}, series=lambda name: (
            types.SimpleNamespace(times=[0.0], read=lambda time: (places, values))))
        (figure,) = mechanism(run, "mechanism", "How it fails.")
        self.assertIn("along the mean motion", figure.caption)

    def test_path_of_the_user(self):
        """In coordinates of the map, from east to west."""
        folder = self.downhill("path", "Grid/Origin=1000, 2000, 0", "Runout/Coordinates=map",
                               "Runout/Path=1002, 1999; 998, 1999", "End time=0.3")
        run = Run(str(folder))
        self.assertEqual(way_of(run).corners.tolist(), [[2, 1], [-2, 1]])
        self.assertIn("along the path of the section Runout", self.report(folder).said("soil"))

    def test_compare(self):
        """The deposit of two 3-D runs over the bed along the way of the first."""
        a, b = self.downhill("a"), self.downhill("b", "Obstacles/ground/Friction coefficient=0.2")
        page = self.folder / "compare.html"
        result = self.tool("talus-compare", a, b, "--output", page)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = Page(self.folder, page.name)
        self.assertIn("Along the way of the centre of mass of A", page.said("deposit"))
        self.assertEqual(len(page.pictures("deposit")), 1)


class Compare(Case):
    """talus-compare."""

    def compare(self, a, b):
        page = self.folder / "compare.html"
        result = self.tool("talus-compare", a, b, "--output", page)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return Page(self.folder, page.name)

    def test_numbers_and_histories(self):
        a = self.slide("a")
        b = self.slide("b", "Materials/mud/Undrained shear strength=1000", "End time=3")
        page = self.compare(a, b)
        tables = [read_csv(folder / "statistics.csv") for folder in (a, b)]
        runouts = [float(read_csv(folder / "runout.csv")[-1]["runout [m]"]) for folder in (a, b)]
        self.assertGreater(min(runouts), 1)
        self.assertEqual(float(page.values["A runout"]), runouts[0])
        self.assertEqual(float(page.values["B − A runout"]), runouts[1] - runouts[0])
        self.assertIn("Materials / mud / Undrained shear strength 2e3 1000",
                      page.said("differing"))
        self.assertIn("B at t = 3 s: numbers and maps “at the end” are those of different times",
                      page.said("numbers"))
        # The largest distance of the fronts at a time of A that B has, too.
        times, values = ([[float(row[name]) for row in table] for table in tables]
                         for name in ("time [s]", "front x [m]"))
        distance = [other - own for time, own, other in
                    zip(times[0], values[0], numpy.interp(times[0], times[1], values[1]))
                    if time <= times[1][-1]]
        self.assertEqual(float(page.values["B − A front x [m]"]),
                         max(distance, key=abs))
        self.assertEqual(len(page.pictures("histories")), 2)
        self.assertNotIn("<script", page.text)

        same = self.compare(a, a)
        self.assertIn("program and parameters are the same", same.said("differing"))
        self.assertEqual({float(value) for column, value in same.values.items()
                          if column.startswith("B − A")}, {0})

    def test_maps(self):
        """Cells of 20 m, and others of 10 m that cover a part of them."""
        a = self.slide("3d", "Grid/Cell size=0.8", "End time=0.1", file="landslide-3d.prm")
        b = self.folder / "3d-b"
        shutil.copytree(a, b)
        for folder, size, west, south, ground, thickness in (
                (a, 20, 412000, 6538000, [-1, -2, -3, -4], [0, 4, 0, -9999]),
                (b, 10, 412024, 6537996, [-2] * 4, [1.5, 0, -9999, 3])):
            (folder / "maps").mkdir()
            for name, values in (("ground", ground), ("maximum-thickness", thickness)):
                (folder / "maps" / f"{name}.asc").write_text(
                    f"ncols 2\nnrows 2\nxllcorner {west}\nyllcorner {south}\ncellsize {size}\n"
                    "NODATA_value -9999\n" + " ".join(map(str, values)))
        for folder, thickness in ((a, 0.75), (b, 1.75)):
            (folder / "lines.csv").write_text(
                "line,distance [m],x [m],z [m],maximum thickness [m]\n"
                f"cable,0,0,0,0.5\ncable,10,10,0,{thickness}\npipe,0,0,5,0\npipe,9,9,5,0\n")
        # Of the centres of A's cells only the south-eastern one is in a cell of B, the
        # north-western one.
        grids = [read_grid(folder / "maps" / "maximum-thickness.asc") for folder in (a, b)]
        taken = on_cells_of(*grids).values
        numpy.testing.assert_array_equal(taken, [[numpy.nan, numpy.nan], [numpy.nan, 1.5]])
        page = self.compare(a, b)
        self.assertIn("The rasters differ", page.said("maps"))
        self.assertIn("maximum thickness 4 m 1.5 m −4 m E 412030, N 6538030 0 %",
                      page.said("maps"))
        self.assertIn("maximum thickness 1 m 10 m", page.said("lines"))
        self.assertNotIn("pipe", page.said("lines"))

    def test_refused(self):
        plane = self.slide("plane")
        space = self.slide("space", "Grid/Cell size=0.8", "End time=0.1", file="landslide-3d.prm")
        self.assert_sentence(self.tool("talus-compare", plane, space), "2 dimensions",
                             "same dimension")
        self.assert_sentence(self.tool("talus-compare", plane, self.folder), "parameters.prm")
        self.assert_sentence(self.tool("talus-compare", plane, plane, "--output",
                                       self.folder / "none" / "page.html"), "cannot be written")


class Others(Case):
    """What is in share/talus for other programs."""

    def test_read_run(self):
        folder = self.slide("slope")
        result = subprocess.run([sys.executable, SHARE / "examples" / "read_run.py", folder],
                                capture_output=True, text=True, timeout=100, cwd=self.folder,
                                check=True)
        table = read_csv(folder / "statistics.csv")
        largest = max(table, key=lambda row: abs(float(row["centre velocity x [m/s]"])))
        self.assertIn(f"{float(largest['centre velocity x [m/s]']):.4g} m/s at t = "
                      f"{float(largest['time [s]']):.4g} s", result.stdout)
        self.assertIn(f"{table[-1]['points']} points at t = 4 s", result.stdout)
        self.assertIn(f"x = {float(table[-1]['centre x [m]']):.4g} m", result.stdout)
        self.assertGreater(os.path.getsize(self.folder / "read_run.png"), 10_000)

    def draw(self, *arguments):
        """What pvpython says on a display of its own. The display's key is in the folder of the
        test, since xvfb-run fails where something else tidies up the system's temporary folder.
        Without -noreset the server starts anew whenever its last window is closed, and may refuse
        the next one."""
        return subprocess.run(["xvfb-run", "-n", str(100 + os.getpid() % 30000), "-a",
                               "-s", "-screen 0 1280x1024x24 -noreset", "--auth-file",
                               self.folder / "Xauthority", "pvpython", *arguments],
                              capture_output=True, text=True, timeout=200, cwd=self.folder,
                              check=False)

    @unittest.skipUnless(shutil.which("pvpython") and shutil.which("xvfb-run"), "SKIPPED: pvpython "
                         "or xvfb-run was not found, so ParaView has not drawn a run")
    def test_paraview(self):
        folder = self.slide("slope", "Output/Boxes as cells=false", "Grid/Cell size=10",
                            "End time=20", "Output/Field interval=10", file="slope.prm")
        picture = self.folder / "view.png"
        probe = self.folder / "probe.py"
        probe.write_text("from paraview import simple\nsimple.Show(simple.Sphere())\n"
                         "simple.SaveScreenshot('sphere.png')\n", encoding="utf-8")
        result = self.draw(probe)
        if result.returncode or not (self.folder / "sphere.png").is_file():
            self.skipTest(f"SKIPPED: ParaView cannot draw a sphere here: {result.stderr}")
        result = self.draw(SHARE / "paraview.py", folder, picture, "20")
        self.maxDiff = None
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with Image.open(picture) as image:
            pixels = numpy.asarray(image.convert("RGB")).astype(int).reshape(-1, 3)
        # Soil in more than one colour of its scale, and the dark line of the bed.
        soil = numpy.unique(pixels[numpy.ptp(pixels, axis=1) > 60] // 16, axis=0)
        self.assertGreater(len(soil), 8)
        self.assertGreater(numpy.count_nonzero(pixels.max(axis=1) < 60), 1000)


class Slopes(ReportCase):
    """From the raster to the report: prm/slope.prm and prm/slope-3d.prm on coarse cells."""

    def run_slope(self, name, *settings):
        return self.slide(name, "Output/Boxes as cells=false", *settings, file=f"{name}.prm")

    def assert_mass(self, folder, mass_in_maps):
        """That of the table to 0.1 %."""
        mass = float(read_csv(folder / "statistics.csv")[-1]["mass [kg]"])
        self.assertLess(abs(mass_in_maps - mass), 1e-3 * mass)

    def lost_energy(self, folder, time):
        """Over the work of gravity until then."""
        row = next(row for row in read_csv(folder / "statistics.csv")
                   if float(row["time [s]"]) >= time)
        return float(row["energy remainder [J]"]) / float(row["gravity work [J]"])

    def assert_first_look(self, page):
        """Three maps with what the reader knows the place by; the others are folded."""
        maps = page.sections["maps"]
        folded = [e for d in maps.iter("details") for e in d.iter("img")]
        shown = [e.get("alt") for e in maps.iter("img") if e not in folded]
        self.assertEqual([alt.split(" over ")[0] for alt in shown],
                         ["Maximum thickness", "Maximum speed", "Arrival time 0.5 m"])
        self.assertGreater(len(folded), 5)
        for alt in shown:
            self.assertIn("red outline: release area; violet: pipeline; triangles: stations",
                          alt.lower())
        self.assertIn("No soil reached the stations canyon, flat.", page.said("stations"))

    def assert_places(self, folder):
        """Of 'Stations/Points' and 'Lines' and 'Grid/Origin = 512000, 6742800'."""
        run = Run(str(folder))
        self.assertEqual({name: tuple(place) for name, place in stations_of(run).items()},
                         {"canyon": (514200, 6741450), "flat": (515000, 6741450)})
        route = routes_of(run)["pipeline"]
        self.assertEqual((tuple(route[0]), tuple(route[-1])),
                         ((515000, 6742200), (515000, 6740700)))
        # The soil of a frame covers the same area as in the map at that time.
        (time,), cells = [40], read_grid(folder / "maps" / "final-thickness.asc")
        table = Run(str(folder)).tables["profile"]
        times = numpy.unique(table["time [s]"])
        self.assertGreaterEqual(times[-1], time)
        (thickness, _), grid = rasters(run, times[-1:])
        self.assertAlmostEqual(numpy.nansum(thickness) * grid.dx * grid.dy
                               / (numpy.nansum(cells.values) * cells.dx * cells.dy), 1, delta=1e-3)
        for axis in (0, 1):
            self.assertAlmostEqual(centre(grid, thickness[0])[axis],
                                   centre(cells, cells.values)[axis], delta=1)

    def test_section(self):
        folder = self.run_slope("slope", "Grid/Cell size=8", "End time=115",
                                "Output/Field interval=20")
        page = self.report(folder)
        self.assert_has(page, "soil", "motion", "maps", "stations", "obstacles")
        # The bed falls by 200 m, the soil is some 10 m thick.
        for section in ("motion", "thalweg"):
            self.assertRegex(page.said(section), "drawn [2-9] times as large as heights")
        self.assertIn("largest force on structure", "".join(page.root.itertext()))
        self.assertNotIn("largest force on bed", "".join(page.root.itertext()))
        columns = read_csv(folder / "maps.csv")
        width = float(columns[1]["x [m]"]) - float(columns[0]["x [m]"])
        self.assert_mass(folder, sum(float(c["final mass [kg/m^2]"]) for c in columns) * width)
        # What the impact then costs goes down with the size of the cells.
        self.assertTrue(0 <= self.lost_energy(folder, 85) <= 0.0055)

        forces = read_csv(folder / "obstacles.csv")
        least = min(float(row["structure force x [N]"]) for row in forces)
        largest = max(float(row["structure force x [N]"]) for row in forces)
        self.assertGreater(largest, 1e5)
        self.assertGreaterEqual(least, 0)
        stations = read_csv(folder / "stations.csv")
        speed = max(float(row["structure depth-mean velocity x [m/s]"]) for row in stations)
        self.assertGreater(speed, 5)
        # The bed passes 4 kPa at most, and in the middle of the slide all of it. Its
        # facets are inclined, so that a column has a little more bed than it is wide.
        shear = [float(c["maximum bed shear [Pa]"]) for c in columns]
        self.assertLess(max(shear), 1.05 * 4e3)
        self.assertGreater(sorted(shear)[len(shear) // 2], 0.98 * 4e3)

    def test_map(self):
        folder = self.run_slope("slope-3d", "Grid/Cell size=20", "End time=40",
                                "Output/Field interval=20")
        page = self.report(folder)
        self.assert_has(page, "soil", "motion", "maps", "stations", "lines", "obstacles")
        self.assert_first_look(page)
        self.assert_places(folder)

        grids = {file.stem: read_grid(file) for file in (folder / "maps").glob("*.asc")}
        mass = grids["final-mass"]
        self.assert_mass(folder, numpy.nansum(mass.values) * mass.dx * mass.dy)
        self.assertTrue(0 <= self.lost_energy(folder, 39) <= 0.03)
        self.assertTrue(mass.is_aligned_with(grids["ground"]))
        thickness, final = grids["maximum-thickness"].values, grids["final-thickness"].values
        self.assertTrue(numpy.all(thickness[final > 0] >= final[final > 0]))
        shear = grids["maximum-bed-shear"].values
        # The bed is inclined by up to 20 degrees there.
        self.assertLess(numpy.nanmax(shear), 4e3 / math.cos(math.radians(20)))
        self.assertGreater(numpy.nanmedian(shear[shear > 0]), 0.5 * 4e3)
        # The canyon leads the slide down the slope, to the east.
        east, _ = mass.place(*numpy.unravel_index(numpy.nanargmax(mass.values),
                                                  mass.values.shape))
        self.assertGreater(east, 513150)


class Refused(Case):
    def test_folders_without_results(self):
        self.assert_sentence(self.tool("talus-report", self.folder), "no parameters.prm")
        self.assert_sentence(self.tool("talus-report", self.folder / "none"), "is no folder")

    def test_damaged_tables(self):
        folder = self.slide("damaged")
        lines = (folder / "statistics.csv").read_text().splitlines()
        lines[2] = lines[2].replace(",", ";")
        (folder / "statistics.csv").write_text("\n".join(lines) + "\n")
        with self.assertRaisesRegex(UserError, "line 3, is not .* numbers"):
            write_report(str(folder))
        (folder / "statistics.csv").write_text(lines[0] + "\n")
        with self.assertRaisesRegex(UserError, "no complete row yet"):
            write_report(str(folder))
        (folder / "statistics.csv").unlink()
        with self.assertRaisesRegex(UserError, "no statistics.csv.*log.txt"):
            write_report(str(folder))
        self.assertFalse((folder / "report.html").exists())


# Moves the slider of a page as a hand would, and plays it from there.
MOVE = """<script>
const input = document.querySelector("input[type=range]");
input.value = WHERE;
input.dispatchEvent(new Event("input"));
if (PLAY) { document.querySelector(".slider button").click(); }
</script></body>"""


@unittest.skipUnless(shutil.which("chromium"), "SKIPPED: chromium was not found, so no browser "
                     "has drawn the page")
class Browser(Case):
    def chromium(self, page, *options):
        """What chromium prints of a page."""
        return subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu",
                               f"--user-data-dir={self.folder / 'profile'}", *options,
                               page.as_uri()], check=True, timeout=100, capture_output=True,
                              text=True).stdout

    def moved(self, folder, where, play=False):
        """Times of the frames that are shown, and the words beside the slider, after a move."""
        page = folder / "moved.html"
        page.write_text((folder / "report.html").read_text().replace(
            "</body>", MOVE.replace("WHERE", str(where)).replace("PLAY", str(play).lower())))
        found = self.chromium(page, "--virtual-time-budget=10000", "--dump-dom")
        frames = re.findall(r'<img class="frame"[^>]*alt="([^"]*)"([^>]*)>', found)
        self.assertGreaterEqual(len(frames), 2)
        return ([alt for alt, rest in frames if "hidden" not in rest],
                re.search(r"<output>([^<]*)</output>", found)[1])

    def test_chromium_draws_it(self):
        folder = self.slide("slope")
        self.assertEqual(self.tool("talus-report", folder).returncode, 0)
        picture = self.folder / "page.png"
        self.chromium(folder / "report.html", f"--screenshot={picture}",
                      "--window-size=1200,4000")
        # An empty page of this size has 20 kB.
        self.assertGreater(os.path.getsize(picture), 100_000)

        times = re.findall("<li>(t = [^<]* s)</li>", (folder / "report.html").read_text())
        self.assertEqual(times[0], "t = 0 s")
        for where in (0, 2, len(times) - 1):
            self.assertEqual(self.moved(folder, where), ([times[where]], times[where]))
        # Played from the first time it stops at the last one.
        self.assertEqual(self.moved(folder, 0, play=True), ([times[-1]], times[-1]))


if __name__ == "__main__":
    main()

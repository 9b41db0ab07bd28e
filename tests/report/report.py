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
import time
import unittest
import xml.etree.ElementTree

import numpy

from tools_case import COARSE, ROOT, TALUS, Case, main, read_csv

from talus_tools.errors import UserError
from talus_tools.esri import read_grid
from talus_tools.hdf5 import h5py
from talus_tools.report.write import write_report

ALWAYS = ["notices", "what-was-run", "runout", "thalweg", "mass", "momentum", "energy", "fracture",
          "log"]


class Page:
    """What a report says; it is XML, too."""

    def __init__(self, folder):
        self.text = (folder / "report.html").read_text()
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
        self.assert_has(page, "soil")
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
        # By the command, again the same; and the same pictures from HDF5, where positions
        # have the same single precision.
        result = self.tool("talus-report", folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn(f"Open {folder / 'report.html'} in a browser.", result.stdout)
        self.assertEqual(page.text, Page(folder).text)
        other = self.report(self.slide("hdf5", "Output/Format=hdf5"))
        if h5py:
            self.assert_has(other, "soil")
            self.assertEqual(page.pictures("soil"), other.pictures("soil"))
        else:
            self.assert_has(other)
            self.assertIn("h5py was not found", other.said("notices"))

    def needs_nothing_else(self, page):
        outside = re.sub(r"base64,[\w+/=]*", "", page.text)
        for word in ("http:", "https:", "<script", "<link", "@import", "url("):
            self.assertNotIn(word, outside)

    def test_without_runout_and_fields(self):
        page = self.report(self.slide("bare", "Output/Runout=false", "Output/Write points=false",
                                      "Output/Write grid=false"))
        self.assertNotIn("thalweg", page.sections)
        self.assertNotIn("soil", page.sections)
        self.assertNotIn("front x [m]", page.values)

    def test_obstacles_and_faces(self):
        folder = self.slide("pipe", "Obstacles/Names=pipe", "Obstacles/pipe/Shape=ball",
                            "Obstacles/pipe/Centre=53,1", "Obstacles/pipe/Radius=1",
                            "Output/Boxes as cells=false",
                            "Boundaries/Write forces=true")
        page = self.report(folder)
        self.assert_has(page, "soil", "obstacles", "faces")
        forces = [float(row["pipe force x [N]"]) for row in read_csv(folder / "obstacles.csv")]
        self.assertGreater(max(forces), 0)
        self.assertEqual(float(page.values["pipe force x [N]"]), max(forces))
        self.assertIn("the soil touches it from", page.said("obstacles"))

    def test_points_at_limits_of_splitting(self):
        words = "stretched too far and could not be split"
        page = self.report(self.slide("split"))
        self.assertNotIn(words, page.said("notices"))
        self.assertNotIn("cannot be split", page.said("log"))
        self.assertEqual(float(page.values["points at generation limit"]), 0)
        folder = self.slide("unsplit", "Splitting/Maximum generation=0")
        page = self.report(folder)
        counts = [float(row["points at generation limit"])
                  for row in read_csv(folder / "statistics.csv")]
        self.assertIn(f"Up to {max(counts):.0f} points were {words}", page.said("notices"))
        self.assertIn("Raise that number", page.said("notices"))
        self.assertEqual(float(page.values["points at generation limit"]), max(counts))
        self.assertIn("cannot be split", page.said("log"))
        self.assertEqual((folder / "log.txt").read_text().count("cannot be split"), 1)

    def test_stages(self):
        folder = self.slide("stages", "Stages=equilibrium, strength reduction",
                            "Materials/mud/Undrained shear strength=8e3",
                            "Boundaries/Seabed/Maximum shear stress=5e3")
        page = self.report(folder)
        self.assertIn("safety", page.sections)
        factor = re.search(r"factor of safety is ([\d.]+)", (folder / "log.txt").read_text())[1]
        self.assertIn(factor.rstrip("."), page.said("safety"))
        self.assertEqual(len(page.pictures("safety")), 1)

    def test_3d(self):
        folder = self.slide("3d", "Output/Boxes as cells=false", "Grid/Cell size=0.8",
                            "End time=0.1", file="landslide-3d.prm")
        page = self.report(folder)
        self.assert_has(page, "soil")
        self.assertIn("Section at z =", page.said("soil"))
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
        self.write_grid(maps, "erosion", [1] * 6)
        with self.assertRaisesRegex(UserError, "erosion.* other cells"):
            write_report(str(folder))
        (maps / "erosion.asc").write_text("ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\n"
                                          "cellsize 20\n1 2 3")
        with self.assertRaisesRegex(UserError, "erosion.* 3 values; 3 rows of 3"):
            write_report(str(folder))

    def test_lines_over_x_and_stations(self):
        folder = self.slide("2d")
        (folder / "maps.csv").write_text(
            "x [m],maximum thickness [m],arrival time 0.1 m [s]\n0,0,nan\n1,2.5,3\n2,0.5,7\n")
        (folder / "stations.csv").write_text(
            "time [s],A thickness [m],A speed [m/s],A 2 thickness [m],A 2 speed [m/s]\n"
            "0,0,0,0,0\n1,0.5,1.5,0,0\n2,0.25,3.5,0,0\n")
        (folder / "lines.csv").write_text(
            "line,distance [m],maximum thickness [m]\n"
            "cable,0,0.5\ncable,10,0.75\npipe,0,nan\n")
        page = self.report(folder)
        self.assertIn("cable maximum thickness 0.75 m 10 m", page.said("lines"))
        self.assertIn("maximum thickness 2.5 m x = 1 m", page.said("maps"))
        self.assertEqual(page.values["A speed [m/s]"], "3.5")
        self.assertIn("A 2 thickness 0 m 0 s never", page.said("stations"))


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

    def test_section(self):
        folder = self.run_slope("slope", "Grid/Cell size=8", "End time=115",
                                "Output/Field interval=20")
        page = self.report(folder)
        self.assert_has(page, "soil", "maps", "stations", "obstacles")
        columns = read_csv(folder / "maps.csv")
        width = float(columns[1]["x [m]"]) - float(columns[0]["x [m]"])
        self.assert_mass(folder, sum(float(c["final mass [kg/m^2]"]) for c in columns) * width)
        # What the impact then costs goes down with the size of the cells.
        self.assertTrue(0 <= self.lost_energy(folder, 85) <= 0.005)

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
        self.assert_has(page, "soil", "maps", "stations", "lines", "obstacles")
        self.assertGreaterEqual(len(page.pictures("maps")), 5)

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


class Browser(Case):
    @unittest.skipUnless(shutil.which("chromium"), "SKIPPED: chromium was not found, so no browser "
                         "has drawn the page")
    def test_chromium_draws_it(self):
        folder = self.slide("slope")
        self.assertEqual(self.tool("talus-report", folder).returncode, 0)
        picture = self.folder / "page.png"
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu",
                        f"--user-data-dir={self.folder / 'profile'}",
                        f"--screenshot={picture}", "--window-size=1200,4000",
                        (folder / "report.html").as_uri()], check=True, timeout=60,
                       capture_output=True)
        # An empty page of this size has 20 kB.
        self.assertGreater(os.path.getsize(picture), 100_000)


if __name__ == "__main__":
    main()

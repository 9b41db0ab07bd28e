# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole runs on several ranks and on meshes that follow the soil: each must
give what one rank, or a uniform mesh, gives.

Usage: ranks.py TALUS FOLDER MPIEXEC PRM_FOLDER [TestClass].
"""

import csv
import os
import pathlib
import re
import subprocess
import sys
import threading
import time
import unittest
import xml.etree.ElementTree

from bad_input_case import GOOD
from ranks_case import Case, MPIEXEC, PRM, TALUS


CASES = pathlib.Path(__file__).resolve().parent
TERSE = ["Output/Write points=false", "Output/Write grid=false",
         "Output/Write obstacles=false"]
TRACKING = ["Mesh tracking/Enabled=true", "Mesh tracking/Margin=6",
            "Mesh tracking/Interval=100", "Grid/Coarsest level=4"]
BALANCE = ["Load balance/Allowed imbalance=1.05"]
FILTER = ["Transfer/Scheme=filtered FLIP", "Transfer/Filter interval=20"]
SLIDE = ["Grid/Cell size=0.8", "End time=4"]
# Long enough for three changes of a mesh that follows the slide.
LONG_SLIDE = SLIDE + ["End time=5"]


def read_table(file):
    with open(file) as lines:
        names, *rows = csv.reader(lines)
    return {name: [float(row[i]) for row in rows]
            for i, name in enumerate(names)}


def largest(values):
    return max(abs(value) for value in values)


class Runs(Case):
    def run_on(self, n_ranks, settings, file="landslide.prm", name=None):
        """Run to the end; return the statistics, column by column."""
        name = name or f"ranks-{n_ranks}"
        folder = self.run_talus(name, file, settings, n_ranks)
        return read_table(folder / "statistics.csv")

    def forces(self, name):
        return read_table(self.folder / name / "obstacles.csv")

    def assert_same(self, found, expected, tolerance=1e-9):
        """All columns, each relative to its largest value; what measures
        round-off, relative to what it is the round-off of. A component of a
        vector, which may vanish by symmetry, relative to its largest one, and
        forces on obstacles relative to the largest force."""
        self.assertEqual(list(found), list(expected))
        self.assertGreater(len(expected["time [s]"]), 1)
        largest_force = max([0] + [largest(values)
                                   for name, values in expected.items()
                                   if name.endswith("[N]")])
        for name, values in expected.items():
            self.assertEqual(len(found[name]), len(values))
            scale = largest(values)
            if name.endswith(" conservation error [-]"):
                self.assertLess(largest(found[name]), 1e-12)
                continue
            if name == "energy remainder [J]":
                scale = max(largest(expected["gravity work [J]"]),
                            largest(expected["contact work [J]"]))
            if name.endswith(("[N]", "[N m]")):  # moments may cancel
                scale = largest_force
            elif component := re.match(r"(.*) [xyz] (\[.*)", name):
                scale = max(largest(others) for other, others
                            in expected.items()
                            if re.fullmatch(
                                re.escape(component[1]) + " [xyz] " +
                                re.escape(component[2]), other))
            error = largest(a - b for a, b in zip(found[name], values))
            self.assertLessEqual(error, tolerance * scale, name)

    def changes(self, name):
        """How often the mesh changed and cells were shared out, by the log."""
        log = (self.folder / name / "log.txt").read_text()
        return [int((re.findall(pattern, log) or ["0"])[-1])
                for pattern in (r"mesh changed (\d+) times",
                                r"shared out (\d+) times")]

    def assert_files(self, name, most_pieces):
        """points.pvd and grid.pvd name files that are there, with a piece for
        each rank that has points: ParaView complains about pieces without."""
        folder = self.folder / name
        for index in ("points.pvd", "grid.pvd"):
            times = self.references(folder / index, "DataSet", "file")
            self.assertGreaterEqual(len(times), 2)
            for at_time in times:
                tree = xml.etree.ElementTree.parse(at_time)
                pieces = list(tree.iter("Piece"))
                self.assertIn(len(pieces), range(1, most_pieces + 1))
                for piece in pieces:
                    self.assertGreater(int(piece.get("NumberOfCells")), 0, at_time)

    def references(self, file, tag, attribute):
        tree = xml.etree.ElementTree.parse(file)
        files = [file.parent / element.get(attribute)
                 for element in tree.iter(tag)]
        for other in files:
            self.assertTrue(other.is_file(), f"{file} names {other}")
        return files


class Ranks(Runs):
    def test_slide(self):
        settings = LONG_SLIDE + TRACKING + BALANCE + TERSE
        alone = self.run_on(1, settings)
        self.assertGreater(alone["splits"][-1], 100)
        self.assertGreater(alone["friction work [J]"][-1], 0)
        for n_ranks in (2, 4):
            self.assert_same(self.run_on(n_ranks, settings), alone)
            n_meshes, n_shares = self.changes(f"ranks-{n_ranks}")
            self.assertGreaterEqual(n_meshes, 3)
            # More often than the mesh changed: for the balance alone, too.
            self.assertGreater(n_shares, max(3, n_meshes))

    def test_merging(self):
        """On a mesh that changes, so that points are shared out anew."""
        settings = SLIDE + TRACKING + BALANCE + TERSE + [
            "Splitting/Shear=ignored", "Splitting/Merge=true",
            "Splitting/Merge interval=20"]
        alone = self.run_on(1, settings)
        self.assertGreater(alone["merges"][-1], 100)
        for n_ranks in (2, 4):
            self.assert_same(self.run_on(n_ranks, settings), alone)

    def test_outflow(self):
        """Soil that leaves, and its way in plan."""
        settings = TERSE + ["Grid/Upper corner=4, 2", "Boundaries/Right=outflow",
                            "End time=1.6"]
        file = "verification/block-on-incline.prm"
        alone = self.run_on(1, settings, file)
        self.assertGreater(alone["outflow mass [kg]"][-1], 1000)
        runout = read_table(self.folder / "ranks-1" / "runout.csv")
        for n_ranks in (2, 4):
            self.assert_same(self.run_on(n_ranks, settings, file), alone)
            self.assert_same(read_table(self.folder / f"ranks-{n_ranks}" / "runout.csv"),
                             runout)

    def test_inflow(self):
        """The rank with the opening makes the points, and the cells are shared
        out anew as they flow on; also through the right face."""
        left = TERSE + BALANCE
        right = left + ["Boundaries/Left=free", "Boundaries/Left velocity=",
                        "Boundaries/Right=velocity", "Boundaries/Right velocity=-1; free",
                        "Bodies/plug/Lower corner=2.5, 0", "Bodies/plug/Upper corner=3, 0.5",
                        "Bodies/plug/Initial velocity=-1; 0", "Bodies/plug/Inflow face=Right"]
        for settings, n_ranks in ((left, 2), (right, 3)):
            table = self.run_on(n_ranks, settings, "verification/plug-inflow.prm")
            for t, mass, front, rear in zip(table["time [s]"], table["mass [kg]"],
                                            table["front x [m]"], table["rear x [m]"]):
                self.assertAlmostEqual(mass / (500 + 1000 * t), 1, 11)
                end = rear - 2.53125 if settings is right else 0.46875 - front
                self.assertAlmostEqual(end, -t, 9)
            self.assertLess(largest(table["energy remainder [J]"]), 1e-8)
            self.assertEqual(table["points"][-1], 320)
            self.assertGreater(self.changes(f"ranks-{n_ranks}")[1], 1)

    def test_pore_pressure(self):
        """A slab slides on an obstacle through the cells, where ranks share places."""
        settings = TERSE + BALANCE + [
            "Gravity/Slope angle=10", "End time=2", "Materials/stiff/Young's modulus=1e6",
            "Grid/Lower corner=0, -0.5", "Grid/Upper corner=4, 2",
            "Bodies/block/Lower corner=0, 0.1", "Bodies/block/Upper corner=4, 1.1",
            "Bodies/block/K0=0.5",
            "Boundaries/Left=periodic", "Boundaries/Right=periodic",
            "Boundaries/Bottom=free", "Obstacles/Names=plane",
            "Obstacles/plane/Shape=half-plane", "Obstacles/plane/Point=0, 0.1",
            "Obstacles/plane/Normal=0, 1", "Obstacles/plane/Friction coefficient=0.5",
            "Excess pore pressure/Initial=0.2*overburden",
            "Excess pore pressure/Final=0.8*overburden",
            "Excess pore pressure/Duration=2"]
        file = "verification/block-on-incline.prm"
        alone = self.run_on(1, settings, file)
        self.assertGreater(alone["centre velocity x [m/s]"][-1], 0.1)
        self.assertGreater(alone["pore pressure work [J]"][-1], 1)
        for n_ranks in (2, 4):
            self.assert_same(self.run_on(n_ranks, settings, file), alone)

        # A slope of undrained clay, whose stiffness is that of its stress.
        slope = TERSE + BALANCE + [
            "Stages=dynamics", "End time=4", "Grid/Cell size=3", "Trigger/Duration=1"]
        alone = self.run_on(1, slope, "sediment-slope.prm")
        self.assertGreater(alone["maximum speed [m/s]"][-1], 0.05)
        self.assert_same(self.run_on(2, slope, "sediment-slope.prm"), alone)

    def test_obstacles(self):
        """A seabed through a mesh that changes; a pipe that moves."""
        slide = "landslide-inclined.prm"
        alone = self.run_on(1, SLIDE + TERSE, slide, name="uniform")
        settings = SLIDE + TRACKING + BALANCE + TERSE
        forces = [self.forces("uniform")]
        for n_ranks in (1, 3):
            self.assert_same(self.run_on(n_ranks, settings, slide), alone)
            forces.append(self.forces(f"ranks-{n_ranks}"))
            self.assert_same(forces[-1], forces[0])
        _, n_shares = self.changes("ranks-3")
        self.assertGreaterEqual(n_shares, 3)

        pipe = "verification/pipe.prm"
        settings = ["End time=0.8"] + BALANCE + TERSE
        alone = self.run_on(1, settings, pipe, name="pipe-1")
        self.assert_same(self.run_on(2, settings, pipe, name="pipe-2"), alone)
        self.assert_same(self.forces("pipe-2"), self.forces("pipe-1"))

    def test_obstacles_moved_by_forces(self):
        """A light pipe that is dragged and turned through clay."""
        pipe = "verification/pipe.prm"
        settings = ["End time=0.8", "Obstacles/pipe/Velocity=",
                    "Obstacles/pipe/Mass=80",
                    "Obstacles/pipe/Moment of inertia=10",
                    "Obstacles/pipe/Free axes=x, y, rotation",
                    "Obstacles/pipe/Maximum shear stress=500",
                    "Obstacles/pipe/Force=2e4*t; -5e3*t; 1e3*t",
                    "Obstacles/pipe/Spring stiffness=1e3, 1e3, 100",
                    "Obstacles/pipe/Spring yield force=5, 0, 0"] + BALANCE + TERSE
        alone = self.run_on(1, settings, pipe, name="body-1")
        forces = self.forces("body-1")
        self.assertGreater(forces["pipe spring slip x [m]"][-1], 1e-3)
        self.assertGreater(forces["pipe rotation [rad]"][-1], 1e-3)
        for n_ranks in (2, 3):
            name = f"body-{n_ranks}"
            self.assert_same(self.run_on(n_ranks, settings, pipe, name=name), alone)
            self.assert_same(self.forces(name), forces)

    def test_obstacles_in_three_dimensions(self):
        """A bed, and a boulder in it that the toe moves over."""
        slide = CASES / "landslide-inclined-3d.prm"
        settings = ["Grid/Cell size=1.6", "Grid/Upper corner=96,9.6,12.8",
                    "End time=1", "Obstacles/Names=bed, boulder",
                    "Obstacles/boulder/Shape=ball",
                    "Obstacles/boulder/Centre=47,-4,2",
                    "Obstacles/boulder/Radius=2"] + BALANCE + TERSE
        alone = self.run_on(1, settings, slide)
        forces = self.forces("ranks-1")
        self.assertGreater(largest(forces["boulder force z [N]"]), 1000)
        self.assert_same(self.run_on(3, settings, slide), alone)
        self.assert_same(self.forces("ranks-3"), forces)

    def test_static_stages_on_obstacles(self):
        """On the terrain of a raster; what the bed bears and what the soil then
        has, to what Newton's method leaves."""
        slope = "slope-stability.prm"
        settings = ["Stages=equilibrium, strength reduction",
                    "Grid/Cell size=20", "Grid/Upper corner=2400,-188",
                    "Materials/clay/Undrained shear strength=30e3"] + TERSE
        alone = self.run_on(1, settings, slope)
        factor = self.factor_of_safety("ranks-1")
        self.assertGreater(factor, 1)
        found = self.run_on(2, settings, slope)
        self.assertEqual(self.factor_of_safety("ranks-2"), factor)
        for name in ("elastic energy [J]", "plastic work [J]"):
            self.assertLessEqual(abs(found[name][-1] - alone[name][-1]),
                                 1e-6 * alone["elastic energy [J]"][-1], name)

    def factor_of_safety(self, name):
        log = (self.folder / name / "log.txt").read_text()
        return float(re.search(r"The factor of safety is ([\d.]+)[:.]",
                               log)[1])

    def test_three_dimensions(self):
        settings = ["Grid/Cell size=1.6", "Grid/Upper corner=280,8,6.4",
                    "Grid/Refinement boxes=20,0,-1; 45,1.5,3; 1",
                    "End time=0.8", "Mesh tracking/Enabled=true",
                    "Mesh tracking/Margin=6"] + FILTER + BALANCE + TERSE
        alone = self.run_on(1, settings, "landslide-3d.prm")
        self.assert_same(self.run_on(3, settings, "landslide-3d.prm"), alone)

    def test_water_in_three_dimensions(self):
        """Drag, added mass and the rule of hydroplaning; cells get soil and lose
        it beside the borders of ranks."""
        box = CASES / "box-in-water-3d.prm"
        alone = self.run_on(1, [], box)
        self.assertGreater(alone["drag work [J]"][-1], 1e3)
        for n_ranks in (2, 3):
            self.assert_same(self.run_on(n_ranks, [], box), alone)

    def test_displaced_at_the_start(self):
        """By up to 1.4 cells, beyond the neighbours of a rank's cells."""
        settings = ["Grid/Cell size=0.03125", "Time step/Maximum=6e-5",
                    "End time=0.002", "Output/Statistics interval=2e-4"] + TERSE
        name = "verification/manufactured-2d.prm"
        alone = self.run_on(1, settings, name)
        for n_ranks in (2, 4):
            self.assert_same(self.run_on(n_ranks, settings, name), alone)

    def test_film(self):
        """Soil thinner than a cell, whose volume at the nodes all ranks must know."""
        name = CASES / "thin-slide.prm"
        alone = self.run_on(1, ["End time=12"] + TERSE, name)
        for n_ranks in (2, 4):
            self.assert_same(self.run_on(n_ranks, ["End time=12"] + TERSE, name), alone)

    def test_budget_of_points_is_that_of_all_ranks(self):
        (self.folder / "case.prm").write_text(GOOD)
        for n_ranks in (1, 2, 3):
            # 16 points become 64, on no rank of several more than 40.
            result = self.start(f"ranks-{n_ranks}", n_ranks,
                                ["Splitting/Maximum number of points=40",
                                 "Splitting/Directions=all",
                                 "Splitting/Threshold=1.01",
                                 "Splitting/Minimum length=0", "End time=0.1",
                                 "Bodies/block/Initial velocity=10*(x-2); 0"],
                                self.folder / "case.prm")
            self.assertNotEqual(result.returncode, 0)
            self.assertIn("64 points", result.stderr)
            self.assertIn("'Splitting/Maximum number of points' = 40",
                          result.stderr)

    def test_memory_is_that_of_all_ranks_of_a_machine(self):
        most = []
        for n_ranks in (1, 2):
            result = self.start("big", n_ranks, ["Grid/Cell size=1e-5"],
                                "landslide-quick.prm")
            self.assertEqual(result.returncode, 1)
            found = re.search(r"on each rank\. (\S+) GB are available", result.stderr)
            self.assertTrue(found, result.stderr)
            most.append(float(found.group(1)))
        self.assertAlmostEqual(most[0] / most[1], 2., delta=1e-4)

    def test_parameters_from_a_pipe(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for content, status in (((PRM / "landslide-quick.prm").read_text(), 0),
                                ("no parameters\n", 1)):
            # It waits for a reader, and without one must not keep the test.
            threading.Thread(target=pipe.write_text, args=[content],
                             daemon=True).start()
            result = subprocess.run(
                [MPIEXEC, "-n", "2", TALUS, "--validate", pipe],
                cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(result.returncode, status, result.stderr)

    def test_validate_says_the_same(self):
        """Ranks share columns of the body; what depends on the machine differs."""
        said = []
        for n_ranks in (1, 3):
            result = subprocess.run(
                [MPIEXEC, "-n", str(n_ranks), TALUS, "--validate", "--set",
                 "Grid/Cell size=5", "--output", "validate", PRM / "first-slope.prm"],
                cwd=self.folder, capture_output=True, text=True, timeout=600)
            self.assertEqual(result.returncode, 0, result.stderr)
            said.append([line for line in result.stdout.splitlines() if line.startswith(
                ("Remark", "The thinnest", "The mesh")) or " is valid" in line])
        self.assertEqual(said[0], said[1])
        self.assertIn("0.8 cells of 5 m", said[0][1])
        self.assertTrue(said[0][-1].endswith(", with 1 remark."), said[0])

    def test_folder_of_another_run(self):
        """Which has several ranks; the second one has several, and one."""
        (self.folder / "case.prm").write_text(GOOD)
        first = subprocess.Popen(
            [MPIEXEC, "-n", "2", TALUS, "--set", "End time=1e6", "--output",
             "results", "case.prm"], cwd=self.folder, text=True,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(first.wait)
        self.addCleanup(first.terminate)
        log = self.folder / "results" / "log.txt"
        while not log.exists() or "time step" not in log.read_text():
            self.assertIsNone(first.poll())
            time.sleep(0.05)
        for n_ranks in (1, 2):
            result = self.start("results", n_ranks, [],
                                self.folder / "case.prm")
            self.assertNotEqual(result.returncode, 0)
            self.assertEqual(result.stderr.count("belongs to another run"), 1)
        self.assertIsNone(first.poll())

    def test_a_point_that_leaves(self):
        """One rank of four sees it: one sentence, and the state of that rank;
        besides, the launcher tells that it stopped the others."""
        result = self.start("leaves", 4,
                            SLIDE + ["Grid/Upper corner=60,8", "End time=30"],
                            "landslide.prm")
        self.assertNotEqual(result.returncode, 0)
        sentences = [line for line in result.stderr.splitlines()
                     if "talus:" in line]
        self.assertEqual(len(sentences), 1, result.stderr)
        self.assertTrue(sentences[0].startswith("talus: Point "), sentences)
        for words in ("left the mesh through the face 'Right'",
                      "Grid/Upper corner"):
            self.assertIn(words, sentences[0])
        state = re.search(r"points of rank \d are in '(.*)'\.$",
                          sentences[0]).group(1)
        self.assertIn("</VTKFile>", (self.folder / state).read_text())


class Tracking(Runs):
    def test_against_uniform_mesh(self):
        uniform = self.run_on(1, LONG_SLIDE + TERSE, name="uniform")
        for n_ranks in (1, 2):
            tracked = self.run_on(n_ranks,
                                  LONG_SLIDE + TRACKING + BALANCE + TERSE)
            self.assertGreaterEqual(self.changes(f"ranks-{n_ranks}")[0], 3)
            self.assert_same(tracked, uniform)


    def test_bodies_do_not_grow(self):
        """The mesh grows behind a free face, a prism over all of it does not.
        (Its outermost boxes see the cells behind the face: hence no rounding.)"""
        settings = ["Grid/Cell size=0.8", "End time=0.01",
                    "Boundaries/Front=free"] + TERSE
        uniform = self.run_on(1, settings, "landslide-3d.prm", "uniform")
        tracked = self.run_on(1, settings + TRACKING, "landslide-3d.prm")
        self.assertIn("'Front' was moved",
                      (self.folder / "ranks-1" / "log.txt").read_text())
        self.assertEqual(tracked["points"], uniform["points"])
        for axis in "xyz":
            for there, here in zip(tracked[f"centre {axis} [m]"],
                                   uniform[f"centre {axis} [m]"]):
                self.assertAlmostEqual(there, here, delta=1e-8)


class SofteningBed(Runs):
    """A bed that softens by slip: uniform mesh, mesh that follows the soil, and
    several ranks."""

    def compare(self, file, surface, slipped, more=()):
        settings = SLIDE + TERSE + [*more, f"{surface}/Slip to remould=2",
                                    f"{surface}/Remoulded shear stress ratio=0.2"]
        uniform = self.run_on(1, settings, file, name="uniform")
        self.assertGreater(uniform[f"slipped {slipped} [m]"][-1], 30)
        self.assertGreater(uniform[f"largest slip of {slipped} [m]"][-1], 4)
        hard = self.run_on(1, SLIDE + TERSE, file, name="hard")
        self.assertGreater(uniform["kinetic energy [J]"][-1],
                           1.1 * hard["kinetic energy [J]"][-1])
        tracked = settings + TRACKING + BALANCE
        for n_ranks in (1, 4):
            found = self.run_on(n_ranks, tracked, file)
            self.assert_same(found, uniform)
            self.assertGreaterEqual(self.changes(f"ranks-{n_ranks}")[0], 3)
            if n_ranks == 1:  # bit by bit
                for name in uniform:
                    if "slip" in name or name == "front x [m]":
                        self.assertEqual(found[name], uniform[name], name)

    def test_seabed(self):
        self.compare("landslide.prm", "Boundaries/Seabed", "seabed")

    def test_obstacle(self):
        """Strength and bed by a raster."""
        raster = self.folder / "ratio.asc"
        raster.write_text("ncols 2\nnrows 2\nxllcorner -1000\nyllcorner -1000\n"
                          "cellsize 1000\n1 1.2\n1 1.2\n")
        self.compare("landslide-inclined.prm", "Obstacles/bed", "obstacles", [
            "Surfaces/Names=ratio", f"Surfaces/ratio/File={raster}",
            "Surfaces/ratio/Section=-300,0; 280,0", "Surfaces/ratio/Quantity=other",
            "Materials/clay/Undrained shear strength=2200*ratio",
            "Obstacles/bed/Maximum shear stress=900*ratio"])


class Graded(Runs):
    """Smaller cells at the seabed, soil across hanging nodes."""

    settings = ["Grid/Cell size=1.6", "End time=1.2",
                "Grid/Refinement boxes=-10,0; 30,1.6; 2 | 25,0; 60,2.4; 1"]

    def assert_sound(self, found):
        self.assertLess(largest(found["energy remainder [J]"]),
                        0.005 * found["gravity work [J]"][-1])
        self.assertEqual(set(found["connected bodies"]), {1})
        self.assertEqual(set(found["empty interior cells"]), {0})
        self.assertEqual(set(found["empty columns"]), {0})
        self.assertGreater(found["splits"][-1], 0)

    def test_graded(self):
        settings = self.settings + BALANCE + TERSE
        alone = self.run_on(1, settings)
        self.assert_sound(alone)
        self.assert_same(self.run_on(4, settings), alone)

    def test_graded_with_convected_domains(self):
        settings = self.settings + BALANCE + TERSE + [
            "Transfer/Box rule=convected domain"]
        alone = self.run_on(1, settings)
        self.assert_sound(alone)
        self.assert_same(self.run_on(3, settings), alone)

    def test_graded_and_tracked(self):
        settings = self.settings + TRACKING + BALANCE + TERSE + [
            "Mesh tracking/Interval=20"]
        alone = self.run_on(1, settings)
        self.assert_sound(alone)
        self.assert_same(self.run_on(4, settings), alone)
        self.assertGreaterEqual(self.changes("ranks-4")[1], 2)


class GradedObstacle(Runs):
    """A bed through the mesh in small cells, the soil above it in large ones."""

    slide = "landslide-inclined.prm"

    def settings(self, box, end):
        return ["Grid/Cell size=1.6", f"Grid/Refinement boxes={box}; 1",
                f"End time={end}"] + TERSE

    def test_graded(self):
        settings = self.settings("-10,-8; 70,2.4", 2) + BALANCE
        alone = self.run_on(1, settings, self.slide)
        self.assertLess(largest(alone["energy remainder [J]"]),
                        0.006 * alone["gravity work [J]"][-1])
        self.assertEqual(set(alone["connected bodies"]), {1})
        self.assert_same(self.run_on(4, settings, self.slide), alone)
        self.assert_same(self.forces("ranks-4"), self.forces("ranks-1"))

    def test_soil_comes_to_the_bed_where_sizes_meet(self):
        for n_ranks in (1, 2):
            result = self.start(f"ranks-{n_ranks}", n_ranks,
                                self.settings("-10,-8; 52,2.4", 6), self.slide)
            self.assertNotEqual(result.returncode, 0)
            for words in ("surface of the obstacle 'bed' at (5", "different size",
                          "'Grid/Refinement boxes'"):
                self.assertIn(words, result.stderr)


class FewCells(Runs):
    """A block of one or two cells on the seabed."""

    settings = ["Grid/Lower corner=0,0", "Grid/Cell size=1",
                "Bodies/slide/Shape=box", "Bodies/slide/Lower corner=1,0",
                "End time=0.02"]

    def compare(self, n_ranks, most_pieces, settings):
        alone = self.run_on(1, settings)
        self.assert_same(self.run_on(n_ranks, settings), alone)
        self.assert_files(f"ranks-{n_ranks}", most_pieces)

    def test_fewer_points_than_ranks(self):
        self.compare(6, 2, self.settings + [
            "Grid/Upper corner=4,2", "Bodies/slide/Upper corner=3,1"])

    def test_fewer_cells_than_ranks(self):
        self.compare(6, 1, self.settings + [
            "Grid/Upper corner=2,1", "Bodies/slide/Upper corner=2,1"])

    def test_all_soil_on_one_rank(self):
        self.compare(4, 1, self.settings + [
            "Grid/Upper corner=4,2", "Bodies/slide/Upper corner=2,1"])


if __name__ == "__main__":
    names = sys.argv[5:] or ["Ranks", "Tracking", "Graded", "GradedObstacle",
                             "FewCells"]
    suite = unittest.TestSuite(
        unittest.defaultTestLoader.loadTestsFromTestCase(globals()[name])
        for name in names)
    outcome = unittest.TextTestRunner(verbosity=2).run(suite)
    sys.exit(0 if outcome.wasSuccessful() else 1)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python module talus: runs led from Python, and readers of results.

Usage: from_python.py TALUS ROOT FOLDER [SUITE]
"""

import gc
import math
import os
import re
import subprocess
import sys
import threading
import time
import unittest

import numpy

from tools_case import COARSE, ROOT, SHARE, TALUS, Case, main

# In the build folder the module has its compiled part, if that is built at all.
MODULE = TALUS.parent / "python"
sys.path.insert(0, str(MODULE if (MODULE / "talus").is_dir() else SHARE))

import talus

from talus_tools.esri import Grid, write_grid

SLIDE = ROOT / "prm/first-slope.prm"
SETTINGS = {"Grid/Cell size": 1, "End time": 4, "Output/Boxes as cells": True,
            "Checkpoint/At the end": True}
LAUNCHER = os.environ.get("TALUS_LAUNCHER", "mpirun -np 2").split()
# A stiff ball is dragged through a block of clay, 0.1 s.
PIPE = ROOT / "prm/verification/pipe.prm"
COARSE_PIPE = {"Grid/Cell size": 0.5, "End time": 0.1, "Output/Statistics interval": 0.02,
               "Output/Runout": False, "Output/Write points": False, "Output/Write grid": False}


def content(folder):
    """Bytes of all results. The log and `state.h5` have times of the clock, which the checksums
    follow, and the parameters have the name of the folder."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*")
            if path.is_file() and path.name not in ("log.txt", "lock", "parameters.prm", "state.h5",
                                                    "checksums")}


def program(folder, file, settings, *options, launcher=()):
    """A run of the program talus."""
    result = subprocess.run(
        [*launcher, TALUS, file, "--output", folder, *options,
         *[o for name, value in settings.items()
           for o in ("--set", f"{name}={str(value).lower()}")]],
        capture_output=True, text=True, timeout=300)
    if result.returncode:
        raise AssertionError(result.stderr)


class FromPython(Case):
    def run_of(self, name, settings=None, file=SLIDE, **options):
        return talus.Run(file, {**SETTINGS, **(settings or {})}, output=self.folder / name,
                         **options)

    def assert_same(self, first, second):
        """Both folders have the same results, bit by bit."""
        first, second = content(self.folder / first), content(self.folder / second)
        self.assertGreater(len(first), 5)
        self.assertEqual(set(first), set(second))
        for path, data in first.items():
            self.assertEqual(data, second[path], path)

    def assert_error(self, pattern, action, *arguments, **options):
        with self.assertRaises(talus.Error) as caught:
            action(*arguments, **options)
        self.assertRegex(str(caught.exception), pattern)
        self.assertTrue(str(caught.exception).endswith("."), caught.exception)


class Driven(FromPython):
    def test_slide_equals_that_of_the_program(self):
        program(self.folder / "program", SLIDE, SETTINGS)
        times = []
        run = self.run_of("python")
        self.assertEqual(run.time, 0)
        self.assertTrue(run.advance_to(1.3))
        self.assertTrue(1.3 <= run.time < 1.4)
        self.assertTrue(run.advance_to(callback=lambda r: times.append(r.time)))
        self.assertTrue(run.is_finished)
        self.assertEqual((run.dimension, run.end_time, run.time), (2, 4, 4))
        self.assertEqual(times[-1], 4)
        self.assertGreater(min(numpy.diff(times)), 0)
        run.close()
        self.assert_same("program", "python")

    def test_stopped_and_resumed_run_equals_the_program(self):
        program(self.folder / "whole", SLIDE, SETTINGS)
        with self.run_of("parts") as run:
            self.assertFalse(run.advance_to(callback=lambda r: r.stop() if r.time > 1 else None))
            at = run.time
            self.assertTrue(1 < at < 1.1)
        with self.run_of("parts", resume=True) as run:
            self.assertEqual(run.time, at)
            run.advance_to(2)
            path = run.checkpoint()
            self.assertTrue(os.path.isfile(os.path.join(path, "state.h5")))
        with self.run_of("parts", resume=True) as run:
            self.assertGreaterEqual(run.time, 2)
            self.assertTrue(run.advance_to())
        for folder in ("whole", "parts"):
            results = talus.read(self.folder / folder)
            self.assertEqual(results.table("statistics")["time"][-1], 4)
        tables = [{path: data for path, data in content(self.folder / folder).items()
                   if path.suffix in (".csv", ".vtu")} for folder in ("whole", "parts")]
        self.assertEqual(*tables)

    def test_two_runs_at_a_time_do_not_mix(self):
        first = self.run_of("first", {"Materials/mud/Undrained shear strength": 2500})
        second = self.run_of("second")
        while not first.is_finished:
            first.advance_to(first.time + 0.7)
            second.advance_to(second.time + 0.4)
        second.advance_to()
        for name, strength in (("first", 2500), ("second", 2000)):
            program(self.folder / ("alone-" + name), SLIDE,
                    {**SETTINGS, "Materials/mud/Undrained shear strength": strength})
            self.assert_same(name, "alone-" + name)
            self.assertEqual(float(talus.read(self.folder / name).parameters[
                "Materials/mud/Undrained shear strength"]), strength)

    def test_parameters_as_text(self):
        program(self.folder / "file", SLIDE, SETTINGS)
        with talus.Run(text=SLIDE.read_text(), settings=SETTINGS, output=self.folder / "text") as run:
            run.advance_to()
        self.assert_same("file", "text")


class State(FromPython):
    def test_points_are_views_of_the_memory(self):
        run = self.run_of("points")
        run.advance_to(1)
        points = run.points
        velocity, position, mass = points["velocity"], points["position"], points["mass"]
        self.assertEqual(velocity.shape, (2, len(mass)))
        self.assertEqual(points["edges"].shape, (2, 2, len(mass)))
        self.assertEqual(points["stress"].shape, (4, len(mass)))
        self.assertEqual((points.units["velocity"], points.units["mass"]), ("m/s", "kg"))
        for array in (velocity, position, mass):
            self.assertFalse(array.flags.owndata)
            self.assertFalse(array.flags.writeable)
        self.assertTrue(numpy.shares_memory(velocity, points["velocity"]))
        with self.assertRaises(KeyError):
            points["speed"]
        centre = (mass * position[0]).sum() / mass.sum()
        self.assertAlmostEqual(run.statistics["centre x [m]"], centre, delta=1e-9)
        self.assertAlmostEqual(run.statistics["kinetic energy [J]"],
                               (0.5 * mass * (velocity ** 2).sum(axis=0)).sum(), delta=1e-6)

    def test_arrays_outlive_steps_and_run(self):
        run = self.run_of("outlive")
        arrays = [run.points["position"]]
        run.advance_to(callback=lambda r: arrays.append(r.points["position"]))
        run.close()
        del run
        gc.collect()
        self.assertGreater(len(arrays), 50)
        # The numbers are undefined, but the memory is there.
        self.assertTrue(all(math.isfinite(float(array[0, 0])) for array in arrays))

    def test_accounts_are_those_of_the_table(self):
        run = self.run_of("accounts")
        run.advance_to()
        table = talus.read(run.folder).table("statistics")
        work, energy = run.accounts["gravity work [J]"], run.statistics["grid kinetic energy [J]"]
        self.assertGreater(work, 1e3)
        self.assertGreater(energy, 1e3)
        self.assertEqual(work, table["gravity work"][-1])
        self.assertEqual(energy, table["grid kinetic energy"][-1])

    def test_exception_of_a_callback_leaves_the_run(self):
        program(self.folder / "undisturbed", SLIDE, SETTINGS)
        run = self.run_of("disturbed")

        def fail(run):
            if run.time > 0.5:
                raise ZeroDivisionError("in the callback")

        with self.assertRaisesRegex(ZeroDivisionError, "in the callback"):
            run.advance_to(2, fail)
        self.assertTrue(0.5 < run.time < 0.6)
        run.advance_to()
        self.assert_same("undisturbed", "disturbed")


class Obstacles(FromPython):
    @staticmethod
    def drag(time):
        """As the expression in the test below."""
        return 2 * time, 0.1

    def test_velocity_of_a_function_equals_that_of_an_expression(self):
        program(self.folder / "expression", PIPE,
                {**COARSE_PIPE, "Obstacles/pipe/Velocity": "2*t; 0.1"})
        run = self.pipe("function", self.drag)
        run.advance_to()
        pipe = run.obstacles["pipe"]
        self.assertAlmostEqual(pipe.displacement[0], 0.01, delta=1e-12)
        self.assertAlmostEqual(pipe.displacement[1], 0.01, delta=1e-12)
        self.assertLess(pipe.force[0], 0)
        tables = [{path: data for path, data in content(self.folder / folder).items()
                   if path.suffix == ".csv"} for folder in ("expression", "function")]
        self.assertEqual({path.name for path in tables[0]}, {"statistics.csv", "obstacles.csv"})
        self.assertEqual(*tables)
        table = talus.read(run.folder).table("obstacles")
        self.assertAlmostEqual(table["pipe impulse x"][-1] / pipe.impulse[0], 1, delta=1e-15)

    def pipe(self, name, velocity, **options):
        return talus.Run(PIPE, {**COARSE_PIPE, "Obstacles/pipe/Velocity": ""},
                         output=self.folder / name, velocities={"pipe": velocity}, **options)

    def test_function_is_called_once_per_step_and_may_follow_the_force(self):
        times, forces = [], []

        def velocity(time):
            times.append(time)
            forces.append(run.obstacles["pipe"].force[0])
            return 1 + 1e-6 * forces[-1], 0

        run = self.pipe("follows", velocity)
        run.advance_to()
        self.assertEqual(len(times), run.n_steps)
        self.assertGreater(min(numpy.diff(times)), 0)
        self.assertEqual(forces[0], 0)
        self.assertLess(forces[-1], 0)
        self.assertAlmostEqual(run.obstacles["pipe"].velocity[0], 1 + 1e-6 * forces[-1])

    def test_errors_of_the_function(self):
        run = self.pipe("components", lambda time: [1])
        self.assert_error("has 1 components .* expected 2", run.advance_to)
        self.assert_error("cannot go on in this object", run.advance_to)
        run = self.pipe("text", lambda time: "fast")
        self.assert_error("'pipe'.*is 'fast' at t = .*list of numbers in m/s", run.advance_to)
        run = self.pipe("nan", lambda time: [math.nan, 0])
        self.assert_error("'pipe'.*nan.*at most 1e6", run.advance_to)
        run = self.pipe("raises", lambda time: [1 / 0, 0])
        with self.assertRaises(ZeroDivisionError):
            run.advance_to()
        self.assert_error("the obstacles are 'pipe'", talus.Run, PIPE, COARSE_PIPE,
                          output=self.folder / "name", velocities={"tube": self.drag})
        self.assert_error("by a function, too", talus.Run, PIPE, COARSE_PIPE,
                          output=self.folder / "two", velocities={"pipe": self.drag})


class Refused(FromPython):
    def test_errors_are_sentences_and_the_next_run_works(self):
        self.assert_error("'Cell size' is '-1'", self.run_of, "wrong", {"Grid/Cell size": -1})
        self.assert_error("no parameter 'Cell sise'", self.run_of, "wrong", {"Grid/Cell sise": 1})
        self.assert_error("no section 'Grit'", self.run_of, "wrong", {"Grit/Cell size": 1})
        self.assert_error("cannot be read", talus.Run, "missing.prm")
        self.assert_error("Give one of the two", talus.Run)
        self.assert_error("Give one of the two", talus.Run, "a.prm", text="set End time = 1")
        self.assert_error("given as text, line 2", talus.Run, text="# A line\nset End tim = 1\n")
        program(self.folder / "program", SLIDE, SETTINGS)
        with self.run_of("after") as run:
            run.advance_to()
        self.assert_same("program", "after")

    def test_use_at_the_wrong_time(self):
        run = self.run_of("used")
        self.assert_error("has not begun", run.checkpoint)
        self.assert_error("closes the run", run.advance_to, 0.1, lambda r: r.close())
        self.assert_error("advances the run", run.advance_to, 0.2, lambda r: r.advance_to())
        self.assert_error("belongs to another run",
                          lambda: self.run_of("used", overwrite=True).advance_to())
        self.assert_error("the time nan", run.advance_to, math.nan)
        run.advance_to(1)
        run.checkpoint()
        run.close()
        self.assert_error("has been closed", run.advance_to)
        self.assert_error("has been closed", lambda: run.time)
        self.assert_error("--overwrite", lambda: self.run_of("used").advance_to())
        with self.run_of("used", overwrite=True) as run:
            run.advance_to(0.1)


    def test_calls_of_two_threads(self):
        """close() waits for the calls of other threads, which then find a closed run."""
        for name, read in (("statistics", lambda run: run.statistics),
                           ("accounts", lambda run: run.accounts),
                           ("checkpoint", lambda run: run.checkpoint()),
                           ("points", lambda run: run.points["mass"].sum()),
                           ("close", lambda run: run.close() or run.time)):
            with self.subTest(name):
                run = self.run_of(name)
                run.advance_to(0.01)
                errors = []

                def loop():
                    try:
                        while True:
                            read(run)
                    except talus.Error as error:
                        errors.append(str(error))

                threads = [threading.Thread(target=loop) for i in range(2)]
                for thread in threads:
                    thread.start()
                time.sleep(0.05)
                run.close()
                for thread in threads:
                    thread.join(60)
                self.assertEqual(len(errors), 2, errors)
                for error in errors:
                    self.assertIn("has been closed", error)

    def test_run_that_advances_in_another_thread(self):
        run = self.run_of("advances")
        begun = threading.Event()
        thread = threading.Thread(target=run.advance_to, args=(2, lambda r: begun.set()))
        thread.start()
        begun.wait(60)
        for use in (lambda: run.time, lambda: run.statistics, run.checkpoint, run.close,
                    lambda: run.advance_to(3)):
            self.assert_error("advances in another thread", use)
        thread.join()
        self.assertGreater(run.time, 1.9)


class Ranks(FromPython):
    # Started on two ranks: a common run, and then a run of each rank alone.
    SCRIPT = """
import sys
import talus
file, folder, settings = sys.argv[1], sys.argv[2], eval(sys.argv[3])
run = talus.Run(file, settings, output=folder + "/common")
assert run.n_ranks == 2
rank = run.rank
run.advance_to(callback=lambda r: r.stop() if r.rank == 1 and r.time > 1 else None)
assert 1 < run.time < 1.1
run.advance_to()
n = len(run.points["mass"])
run.close()
alone = talus.Run(file, settings, output=f"{folder}/alone-{rank}", communicator="self")
assert alone.n_ranks == 1 and len(alone.points["mass"]) > n
alone.advance_to(1 + rank)
alone.advance_to()
"""

    def run_on_two_ranks(self, script, *arguments):
        return subprocess.run(
            [*LAUNCHER, sys.executable, "-c", script, *map(str, arguments)], capture_output=True,
            text=True, timeout=300, env={**os.environ, "PYTHONPATH": str(MODULE)})

    def test_common_run_and_a_run_of_each_rank(self):
        result = self.run_on_two_ranks(self.SCRIPT, SLIDE, self.folder, SETTINGS)
        self.assertEqual(result.returncode, 0, result.stderr)
        program(self.folder / "program-2", SLIDE, SETTINGS, launcher=LAUNCHER)
        program(self.folder / "program-1", SLIDE, SETTINGS)
        self.assertEqual((self.folder / "common/statistics.csv").read_bytes(),
                         (self.folder / "program-2/statistics.csv").read_bytes())
        for rank in (0, 1):
            self.assert_same(f"alone-{rank}", "program-1")
            self.assertIn("The mesh fills", (self.folder / f"alone-{rank}/log.txt").read_text())

    def test_error_of_one_rank_ends_all(self):
        result = self.run_on_two_ranks(
            "import sys, talus\nrun = talus.Run(sys.argv[1], output=sys.argv[2])\n"
            "run.advance_to(0.1)\n"
            "if run.rank == 1: raise ValueError('on one rank')\n"
            "run.advance_to(0.2)", SLIDE, self.folder / "aborted")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("on one rank", result.stderr)


class Readers(Case):
    def test_results(self):
        folder = self.slide("slide", *[setting for setting in COARSE])
        results = talus.read(folder)
        self.assertEqual(results.parameters["Grid/Cell size"], "1")
        self.assertIn("statistics", results.names_of_tables())
        table = results.table("statistics")
        self.assertEqual(table["time"].tolist(), table["time [s]"].tolist())
        self.assertEqual((table.units["time"], table.units["clipped boxes"]), ("s", ""))
        self.assertEqual(results.times("points").tolist(), [0, *results.times("points")[1:]])
        first, last = results.points(0), results.points()
        self.assertEqual((first.time, len(first)), (0, len(first.places)))
        self.assertGreaterEqual(last.time, 4)
        self.assertEqual(first["mass"].tolist(), first["mass [kg]"].tolist())
        centre = last["mass"] @ last.places / last["mass"].sum()
        self.assertAlmostEqual(centre[0], table["centre x"][-1], delta=1e-3)
        self.assertGreater(results.fields("grid", 2)["mass"].sum(), 0)

    def test_maps(self):
        folder = self.slide("map")
        (folder / "maps").mkdir()
        grid = Grid(numpy.array([[1, numpy.nan], [3, 4]]), 100.0, 200.0, 10.0, 10.0)
        write_grid(folder / "maps/maximum-thickness.asc", grid)
        results = talus.read(folder)
        self.assertEqual(results.names_of_maps(), ["maximum-thickness"])
        found = results.map("maximum-thickness")
        self.assertTrue(numpy.array_equal(found.values, grid.values, equal_nan=True))
        self.assertEqual(found.place(0, 1), (115, 215))

    def test_refused(self):
        folder = self.slide("refused")
        results = talus.read(folder)
        for pattern, action in (
                ("is no folder", lambda: talus.read(self.folder / "missing")),
                ("no parameters.prm", lambda: talus.read(self.folder)),
                ("no table 'tables.csv'; it has .*statistics", lambda: results.table("tables")),
                ("no column 'speed'", lambda: results.table("statistics")["speed"]),
                ("no fields 'facets.pvd'", lambda: results.fields("facets")),
                ("no field 'porosity' at t = 0 s", lambda: results.points(0)["porosity"]),
                ("no map 'maps/depth.asc'", lambda: results.map("depth"))):
            with self.assertRaisesRegex(talus.Error, pattern):
                action()

    def test_only_runs_need_the_compiled_part(self):
        code = ("import talus\ntalus.read\ntry:\n    talus.Run\nexcept talus.Error as error:\n"
                "    print(error)")
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                                env={**os.environ, "PYTHONPATH": str(SHARE)})
        self.assertIn("python3-talus", result.stdout, result.stderr)


class Page(FromPython):
    def test_examples_of_the_page(self):
        page = (ROOT / "doc/python.md").read_text()
        code = "\n".join(re.findall(r"```python\n(.*?)```", page, re.DOTALL))
        code = code.replace("/usr/share/talus/prm", str(ROOT / "prm"))
        self.assertGreater(len(code.splitlines()), 20)
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                                timeout=300, cwd=self.folder,
                                env={**os.environ, "PYTHONPATH": str(MODULE)})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("runout", result.stdout)


main()

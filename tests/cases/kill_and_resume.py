# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are killed or stopped, and resumed.

Usage: kill_and_resume.py TALUS PRM_FOLDER FOLDER TestClass [LAUNCHER ...],
with a launcher such as `mpirun -np 2` before each talus.
"""

import os
import random
import shutil
import signal
import time

from resume_case import (Case, EVERY, LAUNCHER, NO_CHECKPOINTS, SETTINGS,
                         descendants, main)


class KillAndResume(Case):
    N_KILLS = 20

    def kill_somewhere(self, name, rng, options):
        """Start, and kill -9 at a random moment. False if it ended before."""
        before = self.newest(name)
        process = self.start_talus(name, EVERY, options)
        if rng.random() < 0.7:
            # Where it computes and writes checkpoints ...
            while process.poll() is None and self.newest(name) == before:
                time.sleep(0.002)
            time.sleep(rng.uniform(0, 0.12))
        else:
            # ... or anywhere, also while it starts.
            time.sleep(rng.uniform(0, 0.8))
        was_running = process.poll() is None
        for pid in [*descendants(process.pid), process.pid]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        output = process.communicate()
        if not was_running:
            self.assertEqual(process.returncode, 0, output)
        return was_running

    def finish(self, name):
        options = ["--resume"] if self.checkpoints(name) else ["--overwrite"]
        self.assert_ends(self.run_talus(name, EVERY, options))
        self.assert_as_undisturbed(name)
        self.assertEqual(len(self.checkpoints(name)), 2)
        self.assertEqual(list((self.folder / name).rglob("*.part")), [])

    def test_killed_twenty_times(self):
        self.make_reference()
        rng = random.Random(20)
        kills, runs, steps = 0, 0, []
        while kills < self.N_KILLS:
            name = f"run-{runs}"
            is_resumed = bool(self.checkpoints(name))
            options = ["--resume"] if is_resumed else []
            if self.kill_somewhere(name, rng, options):
                kills += 1
                steps += self.newest(name)
            else:
                self.finish(name)
                runs += 1
        if (self.folder / f"run-{runs}").exists():
            self.finish(f"run-{runs}")
        print(f"{kills} kills in {runs + 1} runs, with these steps saved:",
              *[int(step) for step in steps])
        self.assertGreater(len(set(steps)), self.N_KILLS / 3)


class AnotherNumberOfRanks(Case):
    """From the launcher's number of ranks to one, and the other way round."""

    def assert_close(self, name):
        def columns(folder):
            text = (self.folder / folder / "statistics.csv").read_text()
            names, *rows = [line.split(",") for line in text.splitlines()]
            return {n: [float(row[i]) for row in rows]
                    for i, n in enumerate(names)}

        found, expected = columns(name), columns("reference")
        self.assertEqual(list(expected), list(found))
        for column in expected:
            if column == "split conservation error [-]":  # round-off itself
                continue
            scale = max(map(abs, expected[column]))
            self.assertEqual(len(expected[column]), len(found[column]))
            for a, b in zip(expected[column], found[column]):
                self.assertLessEqual(abs(a - b), 1e-9 * scale, column)

    def test_there_and_back(self):
        self.make_reference()
        for name, first, second in (("to-one", LAUNCHER, []),
                                    ("from-one", [], LAUNCHER)):
            self.launcher = first
            self.assert_ends(self.run_talus(
                name, ["Checkpoint/Step interval=800",
                       "Checkpoint/At the end=false"]))
            self.assertEqual(self.newest(name), ["0000000800"])
            self.launcher = second
            self.assert_ends(self.run_talus(name, [], ["--resume"]))
            self.assert_close(name)


class StopAndResume(Case):
    def assert_stopped(self, status, output, *words):
        """Its own exit status, one last sentence that says how to go on."""
        self.assertEqual(status, 75, output)
        if not LAUNCHER:  # mpirun has to say something about the status
            self.assertEqual(output[1], "")
        last = output[0].splitlines()[-1]
        for word in ("Stopped at t = ", "/checkpoints/", "--resume", *words):
            self.assertIn(word, last)

    def stop_by(self, number, options):
        process = self.start_talus("run", EVERY, options)
        before = self.newest("run")
        while process.poll() is None and self.newest("run") == before:
            time.sleep(0.01)
        process.send_signal(number)
        output = process.communicate(timeout=60)
        self.assert_stopped(process.returncode, output, number.name)

    def test_signals(self):
        self.make_reference()
        # mpirun hands on this one as it is.
        numbers = ([signal.SIGUSR1] if LAUNCHER else
                   [signal.SIGUSR1, signal.SIGTERM, signal.SIGINT])
        options = []
        for number in numbers:
            self.stop_by(number, options)
            options = ["--resume"]
        self.assert_ends(self.run_talus("run", EVERY, options))
        self.assert_as_undisturbed("run")
        log = (self.folder / "run" / "log.txt").read_text()
        self.assertEqual(log.count("Stopped at t = "), len(numbers))
        self.assertEqual(log.count("Resumed at t = "), len(numbers))

    def test_limit_of_wall_time(self):
        self.make_reference()
        limit, options, stops = 0.0002, [], 0
        while True:
            result = self.run_talus(
                "run", [f"Checkpoint/Wall time limit={limit}"], options)
            if result.returncode == 0:
                break
            limit *= 1.5
            self.assert_stopped(result.returncode,
                                (result.stdout, result.stderr), "wall time")
            options, stops = ["--resume"], stops + 1
            self.assertLess(stops, 20)
        self.assertGreater(stops, 0)
        self.assert_as_undisturbed("run")

    def test_wall_time_interval(self):
        self.make_reference()
        self.assert_ends(self.run_talus(
            "run", ["Checkpoint/Wall time interval=0.001",
                    "Checkpoint/At the end=false"]))
        self.assert_as_undisturbed("run")
        self.assertGreater(len(self.checkpoints("run")), 0)

    def test_later_end(self):
        self.assert_ends(self.run_talus("run", ["End time=1"]))
        result = self.run_talus("run", ["End time=1"], ["--resume"])
        self.assert_ends(result)
        self.assertIn("has reached its end, t = 1 s", result.stdout)
        self.make_reference()
        self.assert_ends(self.run_talus("run", [], ["--resume"]))

        def rows(name):
            text = (self.folder / name / "statistics.csv").read_text()
            return [line.split(",") for line in text.splitlines()[1:]]

        times = [float(row[0]) for row in rows("run")]
        self.assertEqual(sorted(set(times)), times)
        self.assertIn(1., times)
        self.assertEqual(times[-1], 2.)
        # Up to the shortened last step nothing differs.
        same = [row for row in rows("run") if float(row[0]) < 1.]
        self.assertEqual(same, rows("reference")[:len(same)])


class MeshThatChanges(KillAndResume):
    """The same with a mesh that follows the soil."""

    N_KILLS = 8
    settings = SETTINGS + ["Mesh tracking/Enabled=true",
                           "Mesh tracking/Margin=4",
                           "Mesh tracking/Interval=50"]


class SoilLeaves(Case):
    """A block that leaves through a face of outflow, resumed in the middle of it."""

    file = "verification/block-on-incline.prm"
    settings = ["Grid/Upper corner=4, 2", "Boundaries/Right=outflow", "End time=2",
                "Output/Field interval=0.1"]

    def test_resumed_while_it_leaves(self):
        self.make_reference()
        self.assert_ends(self.run_talus("run", ["Checkpoint/Step interval=1900",
                                                "Checkpoint/At the end=false"]))
        text = (self.folder / "run" / "statistics.csv").read_text()
        names, *rows = [line.split(",") for line in text.splitlines()]
        column = {name: [float(row[i] or "nan") for row in rows] for i, name in enumerate(names)}
        left = [mass for step, mass in zip(column["step"], column["outflow mass [kg]"])
                if step <= int(self.newest("run")[0])]
        self.assertTrue(0 < left[-1] < column["outflow mass [kg]"][-1])
        self.assert_ends(self.run_talus("run", [], ["--resume"]))
        self.assert_as_undisturbed("run")


class PointsMerged(KillAndResume):
    """Points of undrained sand that are split and merged in turn."""

    N_KILLS = 6
    settings = SETTINGS + ["End time=3", "Splitting/Shear=ignored", "Splitting/Merge=true",
                           "Splitting/Merge interval=20", "Materials/Names=clay, sand",
                           "Materials/sand/Law=Mohr-Coulomb", "Materials/sand/Density=600",
                           "Materials/sand/Young's modulus=2e5",
                           "Materials/sand/Friction angle=5",
                           "Materials/sand/Dilatancy angle=-3",
                           "Materials/sand/Dilation strain=0.5",
                           "Materials/sand/Pore water/Drainage=undrained",
                           "Materials/sand/Pore water/Largest suction=2e3",
                           "Bodies/slide/Material=sand", "Bodies/slide/K0=1",
                           "Excess pore pressure/Final=0.3*overburden",
                           "Excess pore pressure/Duration=2",
                           "Transfer/Scheme=filtered FLIP"]

    def finish(self, name):
        super().finish(name)
        lines = (self.folder / name / "statistics.csv").read_text().splitlines()
        last = dict(zip(lines[0].split(","), lines[-1].split(",")))
        self.assertGreater(int(last["merges"]), 100)


class Triggered(KillAndResume):
    """Soil and seabed that become weaker in an earthquake, in runs that are
    killed."""

    N_KILLS = 8
    settings = SETTINGS + ["Trigger/Start time=0.2", "Trigger/Duration=1.5",
                           "Trigger/Strength fraction=0.3",
                           "Trigger/Region=1-y",
                           "Trigger/Seabed shear stress fraction=0.5"]

    def setUp(self):
        super().setUp()
        record = self.folder / "record.csv"
        record.write_text("time [s],horizontal [m/s^2]\n"
                          "0,0\n0.4,2\n0.8,-3\n1.6,1\n")
        self.settings = [*self.settings, f"Ground motion/File={record}"]


class SlideOverObstacles(KillAndResume):
    """A seabed through a mesh that changes and a pipe that moves, under water."""

    N_KILLS = 5
    file = "landslide-inclined.prm"
    settings = SETTINGS + ["Mesh tracking/Enabled=true",
                           "Mesh tracking/Margin=6",
                           "Mesh tracking/Interval=50",
                           "Obstacles/bed/Velocity=0.02*t; 0",
                           "Water/Added mass coefficient=0.1",
                           "Water/Skin friction coefficient=0.01",
                           "Water/Pressure drag coefficient=1",
                           "Maps/Write=true", "Output/Plan interval=0.5",
                           "Stations/Points=toe: 35",
                           "Stations/Lines=route: 20; 60"]


class SlideMovesObstacle(KillAndResume):
    """A pillar on springs that yield, in a bed across the cells, pushed and
    turned by the slide."""

    N_KILLS = 8
    file = "landslide-inclined.prm"
    settings = SETTINGS + ["Mesh tracking/Enabled=true",
                           "Mesh tracking/Margin=6",
                           "Mesh tracking/Interval=50",
                           "Obstacles/Names=bed, pillar",
                           "Obstacles/pillar/Shape=box",
                           "Obstacles/pillar/Lower corner=49.5, -6",
                           "Obstacles/pillar/Upper corner=52.5, -1",
                           "Obstacles/pillar/Mass=5000",
                           "Obstacles/pillar/Moment of inertia=2e4",
                           "Obstacles/pillar/Free axes=x, y, rotation",
                           "Obstacles/pillar/Force=0; -1e3*t; 0",
                           "Obstacles/pillar/Spring stiffness=1e5, 1e5, 1e6",
                           "Obstacles/pillar/Spring damping=1e3, 1e3, 1e4",
                           "Obstacles/pillar/Spring yield force=1e3, 0, 0"]

    def make_reference(self):
        super().make_reference()
        lines = (self.folder / "reference" / "obstacles.csv").read_text().splitlines()
        last = dict(zip(lines[0].split(","), map(float, lines[-1].split(","))))
        self.assertGreater(last["pillar spring slip x [m]"], 1e-3)
        self.assertGreater(abs(last["pillar rotation [rad]"]), 1e-4)

    def test_resumed_where_the_pillar_has_left_its_first_cells(self):
        self.make_reference()
        once = ["Checkpoint/Step interval=1040", "Checkpoint/At the end=false"]
        self.assert_ends(self.run_talus("run", once))
        self.assertEqual(self.newest("run"), ["0000001040"])
        self.assert_ends(self.run_talus("run", once, ["--resume"]))
        self.assert_as_undisturbed("run")


class SlideOnSofteningSeabed(KillAndResume):
    """A seabed that softens by slip under a mesh that changes: places without a
    node keep their slip."""

    N_KILLS = 8
    settings = SETTINGS + ["Mesh tracking/Enabled=true",
                           "Mesh tracking/Margin=4",
                           "Mesh tracking/Interval=50",
                           "Boundaries/Seabed/Slip to remould=2",
                           "Boundaries/Seabed/Remoulded shear stress ratio=0.2",
                           "Trigger/Duration=1",
                           "Trigger/Seabed shear stress fraction=0.5",
                           "Trigger/Seabed region=20-x", "Maps/Write=true"]


class SlideOnSofteningObstacle(KillAndResume):
    """A bed across the cells that softens by slip, beside a pipe that moves."""

    N_KILLS = 8
    file = "landslide-inclined.prm"
    settings = SETTINGS + ["Mesh tracking/Enabled=true",
                           "Mesh tracking/Margin=6",
                           "Mesh tracking/Interval=50",
                           "Obstacles/Names=bed, pipe",
                           "Obstacles/pipe/Shape=ball",
                           "Obstacles/pipe/Centre=52, -3.5",
                           "Obstacles/pipe/Radius=0.8",
                           "Obstacles/pipe/Velocity=0.02; 0",
                           "Obstacles/bed/Slip to remould=2",
                           "Obstacles/bed/Remoulded shear stress ratio=0.2",
                           "Maps/Write=true"]


class DrivenAndDamped(KillAndResume):
    """Soil that the bottom drives, under growing gravity, with damping, on a
    mesh that changes."""

    N_KILLS = 8
    settings = SETTINGS + ["Boundaries/Bottom=velocity",
                           "Boundaries/Bottom velocity=0.5*t*sin(x); 0",
                           "Gravity/Ramp time=1", "Damping/Local damping=0.2",
                           "Output/Runout=false",
                           "Mesh tracking/Enabled=true",
                           "Mesh tracking/Margin=4",
                           "Mesh tracking/Interval=50"]


class ThreeDimensions(KillAndResume):
    N_KILLS = 8
    file = "landslide-3d.prm"
    settings = ["Grid/Cell size=0.8", "End time=0.5",
                "Transfer/Scheme=filtered FLIP", "Transfer/Filter interval=7",
                "Output/Field interval=0.05", "Output/Statistics interval=0.02",
                "Maps/Write=true"]


class StagesAndResume(KillAndResume):
    """Equilibrium and strength reduction before the dynamics."""

    N_KILLS = 8
    file = "landslide-trigger.prm"
    settings = ["Grid/Cell size=0.8", "End time=1", "Trigger/Start time=0.3",
                "Strength reduction/Tolerance=0.05",
                "Stages=equilibrium, strength reduction, dynamics",
                "Output/Field interval=0.1", "Output/Statistics interval=0.02"]

    def make_reference(self):
        # After every static stage there is a checkpoint, asked for or not.
        self.assert_ends(self.run_talus("reference", NO_CHECKPOINTS))

    def stop_during(self, words, number, options):
        """Send the signal once the run has said these words; exit status."""
        process = self.start_talus("run", EVERY, options)
        for line in process.stdout:
            if words in line:
                break
        process.send_signal(number)
        process.communicate(timeout=120)
        return process.returncode

    def test_stopped_during_static_stages(self):
        self.make_reference()
        options, stops = [], ["Stage 'equilibrium'",
                              "Stage 'strength reduction'"]
        for words in stops:
            # mpirun hands on this one as it is.
            number = signal.SIGUSR1 if LAUNCHER else signal.SIGTERM
            self.assertEqual(self.stop_during(words, number, options), 75)
            self.assertEqual(self.newest("run"), ["0000000000"])
            options = ["--resume"]
        self.assert_ends(self.run_talus("run", EVERY, options))
        self.assert_as_undisturbed("run")
        log = (self.folder / "run" / "log.txt").read_text()
        self.assertEqual(log.count("Stopped at t = 0 s, step 0, after the "
                                   "signal SIG"), len(stops))
        # It does not wait for the end of a stage.
        self.assertIn("The stage was stopped by a signal", log)

    def test_contact_with_obstacle(self):
        """A stage goes on with the contact that the one before it left."""
        self.file = "landslide-inclined.prm"
        self.settings = ["Stages=equilibrium, strength reduction",
                         "Grid/Cell size=1.6",
                         "Materials/clay/Undrained shear strength=25e3",
                         "Obstacles/bed/Maximum shear stress=4e3",
                         "Obstacles/bed/Friction coefficient=0.3",
                         "Strength reduction/Tolerance=0.05"]
        self.make_reference()
        stopped = self.run_talus("run", ["Checkpoint/Wall time limit=1e-5"])
        self.assertEqual(stopped.returncode, 75, stopped)
        self.assert_ends(self.run_talus("run", [], ["--resume"]))
        expected, found = self.content("reference"), self.content("run")
        self.assertIn("newton.csv", expected)
        self.assertEqual(list(expected), list(found))
        for file in expected:
            self.assertTrue(expected[file] == found[file], file)

    def assert_as_undisturbed_after_the_start(self):
        """Only at t = 0 the weight does not act without the correction of the
        well-balanced load, if no dynamics was asked for."""
        expected, found = self.content("reference"), self.content("run")
        self.assertEqual(list(expected), list(found))
        at_start = [f for f in expected if f.startswith(("grid-0000", "points-0000"))]
        self.assertNotEqual([expected.pop(f) for f in at_start],
                            [found.pop(f) for f in at_start])
        first = []
        for content in (expected, found):
            rows = content["statistics.csv"].split(b"\n")
            first.append(rows.pop(1))
            content["statistics.csv"] = rows
        self.assertNotEqual(*first)
        for file in expected:
            self.assertTrue(expected[file] == found[file], file)

    def test_dynamics_after_all(self):
        """A run that ended with its equilibrium goes on from there."""
        for first in ("equilibrium", "equilibrium, strength reduction"):
            stages = f"Stages={first}, dynamics"
            for name in ("reference", "run"):
                shutil.rmtree(self.folder / name, ignore_errors=True)
            self.assert_ends(self.run_talus("reference",
                                            [stages, *NO_CHECKPOINTS]))
            self.assert_ends(self.run_talus("run", [f"Stages={first}"]))
            again = self.run_talus("run", [f"Stages={first}"], ["--resume"])
            self.assert_ends(again)
            self.assertIn("nothing left to do", again.stdout)
            result = self.run_talus("run", [stages], ["--resume"])
            self.assert_ends(result)
            self.assertNotIn("nothing left to do", result.stdout)
            self.assert_as_undisturbed_after_the_start()

    def test_newton_table_cut_or_missing(self):
        """Nothing is put into the gap, and other tables stay as they are."""
        self.assert_ends(self.run_talus("run", ["Stages=equilibrium"]))
        table = self.folder / "run" / "newton.csv"
        whole = table.read_text()
        table.write_text(whole[:-10])
        for words in (f"only {len(whole) - 10} bytes", "cannot be read"):
            before = self.content("run", [])
            result = self.run_talus("run", ["Stages=equilibrium, dynamics"],
                                    ["--resume"])
            self.assertEqual(result.returncode, 1, result)
            self.assertIn("newton.csv', which the run is to go on with, ",
                          result.stderr)
            self.assertIn(words, result.stderr)
            self.assertEqual(self.content("run", []), before)
            table.unlink(missing_ok=True)

    def test_other_stages(self):
        """Only dynamics can be added."""
        self.assert_ends(self.run_talus("run", ["Stages=equilibrium"]))
        for stages in ("dynamics", "equilibrium, strength reduction",
                       "equilibrium, strength reduction, dynamics"):
            result = self.run_talus("run", [f"Stages={stages}"], ["--resume"])
            self.assertEqual(result.returncode, 1, result)
            for words in ("The parameter 'Stages' is ", stages,
                          "'equilibrium'"):
                self.assertIn(words, result.stderr)


class StagesOnSofteningBed(Case):
    """The strength reduction goes on with the slip that the equilibrium left."""

    file = "verification/softening-seabed.prm"
    stages = ["Stages=equilibrium, strength reduction", "Grid/Cell size=1",
              "Grid/Lower corner=-50, 0", "Grid/Upper corner=50, 7",
              "Bodies/slab/Lower corner=-50, 0", "Bodies/slab/Upper corner=50, 5",
              "Strength reduction/Tolerance=0.2", "Equilibrium/Load steps=5",
              "Trigger/Duration=0", "Trigger/Seabed shear stress fraction=1",
              "Trigger/Seabed region="]

    def make_reference(self):
        # After every static stage there is a checkpoint, asked for or not.
        self.assert_ends(self.run_talus("reference", NO_CHECKPOINTS))

    def compare(self, settings):
        self.settings = self.stages + settings
        self.make_reference()
        stopped = self.run_talus("run", ["Checkpoint/Wall time limit=1e-5"])
        self.assertEqual(stopped.returncode, 75, stopped)
        self.assert_ends(self.run_talus("run", [], ["--resume"]))
        expected, found = self.content("reference"), self.content("run")
        self.assertIn("newton.csv", expected)
        self.assertEqual(list(expected), list(found))
        for file in expected:
            self.assertTrue(expected[file] == found[file], file)

    def test_seabed(self):
        self.compare(["Boundaries/Seabed/Maximum shear stress="
                      "if(abs(x) < 6.5, 0, 3500)"])

    def test_obstacle(self):
        self.compare(["Boundaries/Bottom=free",
                      "Boundaries/Seabed/Slip to remould=0",
                      "Boundaries/Seabed/Remoulded shear stress ratio=1",
                      "Obstacles/Names=bed", "Obstacles/bed/Shape=half-plane",
                      "Obstacles/bed/Point=0, 0.2", "Obstacles/bed/Normal=0, 1",
                      "Obstacles/bed/Maximum shear stress="
                      "if(abs(x - 0.5) < 6.5, 0, 3500)",
                      "Obstacles/bed/Slip to remould=0.12427",
                      "Obstacles/bed/Remoulded shear stress ratio=0.428571428571",
                      "Bodies/slab/Lower corner=-50, 0.2",
                      "Bodies/slab/Upper corner=50, 5.2"])


if __name__ == "__main__":
    main(globals())

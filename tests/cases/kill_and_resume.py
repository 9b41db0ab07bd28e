"""Checkpoints: runs that are killed, stopped, damaged and resumed.

Usage: kill_and_resume.py TALUS PRM_FOLDER FOLDER TestClass [LAUNCHER ...], with
a launcher such as `mpirun -np 2` before each talus.
"""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time
import unittest

TALUS = pathlib.Path(sys.argv[1]).resolve()
PRM = pathlib.Path(sys.argv[2]).resolve()
FOLDER = pathlib.Path(sys.argv[3]).resolve()
LAUNCHER = sys.argv[5:]

# A slide of 1000 steps with splits, in about a second.
SETTINGS = ["Grid/Cell size=0.8", "End time=2", "Output/Field interval=0.2",
            "Output/Statistics interval=0.02"]
EVERY = ["Checkpoint/Step interval=25"]
NO_CHECKPOINTS = ["Checkpoint/Wall time interval=0",
                  "Checkpoint/At the end=false"]
# What may differ between a run and a resumed one.
NOT_COMPARED = ["log.txt", "parameters.prm"]


def descendants(pid):
    """The processes started by this one, and by those."""
    children = {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parent = (entry / "stat").read_text().rsplit(")")[1].split()[1]
            except OSError:
                continue
            children.setdefault(int(parent), []).append(int(entry.name))
    found = []
    for child in children.get(pid, []):
        found += [child] + descendants(child)
    return found


class Case(unittest.TestCase):
    launcher = LAUNCHER

    def setUp(self):
        self.folder = FOLDER / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def command(self, name, settings=(), options=(), file="landslide-quick.prm"):
        return [*self.launcher, TALUS, PRM / file, "--output", self.folder / name,
                *[o for s in [*SETTINGS, *settings] for o in ("--set", s)],
                *options]

    def run_talus(self, name, settings=(), options=(), **more):
        return subprocess.run(self.command(name, settings, options, **more),
                              capture_output=True, text=True, timeout=300)

    def start_talus(self, *arguments):
        return subprocess.Popen(self.command(*arguments), text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def assert_ends(self, result, status=0):
        self.assertEqual(result.returncode, status, result)
        self.assertEqual(result.stderr, "")

    def make_reference(self):
        self.assert_ends(self.run_talus("reference", NO_CHECKPOINTS))
        self.assertFalse((self.folder / "reference" / "checkpoints").exists())

    def checkpoints(self, name):
        """Complete ones, the newest last."""
        folder = self.folder / name / "checkpoints"
        return sorted(p for p in folder.glob("*") if p.name.isdigit())

    def newest(self, name):
        return [p.name for p in self.checkpoints(name)][-1:]

    def content(self, name, leave_out=NOT_COMPARED):
        root = self.folder / name
        return {str(p.relative_to(root)): p.read_bytes()
                for p in sorted(root.rglob("*"))
                if p.is_file() and p.name not in leave_out
                and (not leave_out or p.parent == root)}

    def assert_as_undisturbed(self, name):
        expected = self.content("reference")
        found = self.content(name)
        self.assertEqual(list(expected), list(found))
        self.assertGreater(len(expected), 20)
        for file in expected:
            self.assertTrue(expected[file] == found[file],
                            f"{file} differs from that of an undisturbed run")


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
            if column == "split ledger [-]":  # round-off itself
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
        limit = ["Checkpoint/Wall time limit=0.003"]
        options, stops = [], 0
        while True:
            result = self.run_talus("run", limit, options)
            if result.returncode == 0:
                break
            self.assert_stopped(result.returncode,
                                (result.stdout, result.stderr), "wall time")
            options, stops = ["--resume"], stops + 1
            self.assertLess(stops, 100)
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
        self.assertIn("has reached its end time, t = 1 s", result.stdout)
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


class ResumeRefused(Case):
    """Exit status 1, one helpful line, nothing touched."""

    prepared = None

    def setUp(self):
        super().setUp()
        if ResumeRefused.prepared is None:
            ResumeRefused.prepared = FOLDER / "prepared"
            shutil.rmtree(self.prepared, ignore_errors=True)
            self.assert_ends(self.run_talus(self.prepared,
                                            ["End time=0.2"] + EVERY))
        shutil.copytree(self.prepared, self.folder / "run")
        self.before = self.content("run", [])

    def refuse(self, settings, *words, options=("--resume",), **more):
        result = self.run_talus("run", settings, options, **more)
        print(f"{self.id().split('.')[-1]}: {result.stderr.rstrip()}")
        self.assertEqual(result.returncode, 1, result)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("talus: "), result.stderr)
        self.assertTrue(result.stderr.rstrip().endswith("."), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(self.content("run", []), self.before)

    def damage(self, checkpoint, file="state.h5"):
        path = self.checkpoints("run")[checkpoint] / file
        data = bytearray(path.read_bytes())
        # Far from the end, where the arrays of the points are.
        data[len(data) // 3] ^= 16
        path.write_bytes(data)
        self.before = self.content("run", [])

    def test_no_checkpoint(self):
        shutil.rmtree(self.folder / "run" / "checkpoints")
        self.before = self.content("run", [])
        self.refuse([], "no checkpoint in", "/run'", "--output",
                    "without --resume")

    def test_no_folder(self):
        result = self.run_talus("nowhere", [], ["--resume"])
        self.assertEqual(result.returncode, 1)
        self.assertIn("no checkpoint in", result.stderr)
        self.assertFalse((self.folder / "nowhere").exists())

    def test_both_damaged(self):
        self.damage(-1)
        self.damage(-2, "mesh")
        self.refuse([], "is damaged: the checksum of 'points/",
                    "mesh files do not match", "--overwrite")

    def test_empty_and_missing_files(self):
        newest, previous = self.checkpoints("run")[::-1]
        (newest / "state.h5").write_bytes(b"")
        (previous / "mesh").unlink()
        self.before = self.content("run", [])
        self.refuse([], "could not be opened", "mesh files do not match")

    def test_damaged_and_previous(self):
        self.damage(-1)
        newest, previous = self.checkpoints("run")[::-1]
        result = self.run_talus("run", ["End time=0.3"], ["--resume"])
        self.assert_ends(result)
        sentence = (f"The checkpoint '{newest}' is damaged: the checksum of "
                    "'points/")
        log = (self.folder / "run" / "log.txt").read_text()
        for text in (result.stdout, log):
            self.assertIn(sentence, text)
            self.assertIn("The run goes on from the one before.", text)
        self.assertIn(f", from '{previous}'", log)
        # It made way for one that is whole.
        self.assertNotIn(newest, self.checkpoints("run"))
        self.assert_ends(self.run_talus("run", ["End time=0.4"], ["--resume"]))

    def test_critical_parameters(self):
        for setting, *words in (
                ("Grid/Cell size=0.4", "'0.4'", "'0.8'"),
                ("Grid/Upper corner=288, 8", "'288, 8'", "'280, 8'"),
                ("Time step/CFL number=0.1", "'0.1'", "'0.2'"),
                ("Gravity/Slope angle=6", "'6'", "'5'"),
                ("Materials/clay/Poisson's ratio=0.48", "'0.49'"),
                ("Materials/clay/Undrained shear strength=2e3", "'2e3'"),
                ("Boundaries/Seabed/Maximum shear stress=9e2", "'9e2'"),
                ("Splitting/Threshold=1.5", "'1.5'", "'1.4'")):
            self.refuse([setting], "The parameter '" + setting.split("=")[0],
                        *words)

    def test_harmless_parameters(self):
        self.assert_ends(self.run_talus(
            "run", ["Title=Another", "End time=3", "Checkpoint/Step interval=7",
                    "Output/Statistics interval=0.5", "Grid/Cell size=8e-1",
                    "Output/Boxes as cells=false",
                    "Splitting/Maximum number of points=20000000"],
            ["--resume", "--validate"]))
        self.assertEqual(self.content("run", []), self.before)

    def test_other_dimension(self):
        result = subprocess.run(
            [*LAUNCHER, TALUS, PRM / "landslide-3d.prm", "--resume",
             "--output", self.folder / "run"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1, result)
        self.assertIn("Dimension = 2", result.stderr)
        self.assertIn("Dimension = 3", result.stderr)
        self.assertEqual(self.content("run", []), self.before)

    def test_end_is_over(self):
        self.refuse(["End time=0.1"], "end time is 0.1 s", "t = 0.2 s",
                    "'End time'")

    def test_statistics_missing(self):
        (self.folder / "run" / "statistics.csv").unlink()
        self.before = self.content("run", [])
        self.refuse([], "statistics.csv", "cannot be read", "bytes")

    def test_profile_too_short(self):
        (self.folder / "run" / "profile.csv").write_text("time\n")
        self.before = self.content("run", [])
        self.refuse([], "profile.csv", "only 5 bytes")

    def test_statistics_with_other_columns(self):
        path = self.folder / "run" / "statistics.csv"
        path.write_text(path.read_text().replace("time [s]", "time [h]", 1))
        self.before = self.content("run", [])
        self.refuse([], "statistics.csv", "'time [h]'", "'time [s]'")

    def test_forgotten_resume(self):
        # A finished run may be overwritten, an unfinished one is guarded.
        self.assert_ends(self.run_talus("run", ["End time=0.2"]))
        self.assertEqual(len(self.checkpoints("run")), 1)
        self.assert_ends(self.run_talus(
            "run", EVERY + ["Checkpoint/At the end=false"]))
        self.before = self.content("run", [])
        self.refuse([], "holds the checkpoint", "of a run to 2 s", "--resume",
                    "--overwrite", options=())
        self.assert_ends(self.run_talus("run", ["End time=0.1"],
                                        ["--overwrite"]))

    def test_resume_and_overwrite(self):
        self.refuse([], "--resume", "--overwrite",
                    options=("--resume", "--overwrite"))


if __name__ == "__main__":
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(
        globals()[sys.argv[4]])
    outcome = unittest.TextTestRunner(verbosity=2).run(suite)
    sys.exit(0 if outcome.wasSuccessful() else 1)

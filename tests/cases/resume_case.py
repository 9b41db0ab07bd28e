# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of checkpoints have in common."""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from fork_server import run_forked

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
    file = "landslide-quick.prm"
    settings = SETTINGS

    def setUp(self):
        self.folder = FOLDER / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def command(self, name, settings=(), options=()):
        return [*self.launcher, TALUS, PRM / self.file,
                "--output", self.folder / name,
                *[o for s in [*self.settings, *settings] for o in ("--set", s)],
                *options]

    def run_talus(self, name, settings=(), options=()):
        command = self.command(name, settings, options)
        if not self.launcher:
            return run_forked(command[1:], timeout=300)
        return subprocess.run(command, capture_output=True, text=True, timeout=300)

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
                if p.is_file() and p.name not in leave_out and p.name != "lock"
                and (not leave_out or p.parent == root)}

    def assert_as_undisturbed(self, name):
        expected = self.content("reference")
        found = self.content(name)
        self.assertEqual(list(expected), list(found))
        self.assertGreater(len(expected), 20)
        for file in expected:
            self.assertTrue(expected[file] == found[file],
                            f"{file} differs from that of an undisturbed run")


def main(classes):
    """Run the test class that the command line names."""
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(
        classes[sys.argv[4]])
    outcome = unittest.TextTestRunner(verbosity=2).run(suite)
    sys.exit(0 if outcome.wasSuccessful() else 1)

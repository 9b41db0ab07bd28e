# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of bad input share: a good input, and what must hold."""

import pathlib
import shutil
import sys
import unittest

from fork_server import run_forked

TALUS = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()

# A body of 4 x 4 points on a plane, done in some steps. Tests count its lines.
GOOD = """\
set End time = 0.01

subsection Grid
  set Lower corner = 0, 0
  set Upper corner = 4, 4
  set Cell size    = 1
end

subsection Bodies
  set Names = block
  subsection block
    set Shape        = box
    set Lower corner = 1, 0
    set Upper corner = 3, 2
    set Material     = clay
  end
end

subsection Materials
  set Names = clay
  subsection clay
    set Law             = linear elastic
    set Density         = 1000
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
  end
end

subsection Boundaries
  set Bottom = roller
end
"""

# The first line of a parameters.prm that a run has written.
RECORD = "# The parameters of this run as they were understood by"

# Weak, fast and with the longest step: what a bad run needs.
DUST = ["Materials/clay/Young's modulus=1", "Time step/CFL number=1",
        "Time step/Box safety factor=1", "Gravity/Magnitude=0", "End time=1"]


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.results = self.folder / "results"
        self.results.mkdir(parents=True)
        self.earlier = {"statistics.csv": "of an earlier run\n",
                        "parameters.prm": RECORD + "\n"}
        for name, content in self.earlier.items():
            (self.results / name).write_text(content)

    def run_talus(self, *arguments):
        return run_forked(arguments, self.folder, timeout=120)

    def run_file(self, content=GOOD, settings=(), output="results"):
        file = self.folder / "case.prm"
        file.write_text(content)
        options = [o for s in settings for o in ("--set", s)]
        return self.run_talus(*options, "--output", output, file)

    def assert_refused(self, result, *words):
        """Exit status 1, one line of stderr with all of these words."""
        print(f"{self.id().split('.')[-1]}: {result.stderr.rstrip()}")
        self.assertEqual(result.returncode, 1, result)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("talus: "), result.stderr)
        self.assertTrue(result.stderr.rstrip().endswith("."), result.stderr)
        self.assertLess(len(result.stderr), 700)
        for word in words:
            self.assertIn(word, result.stderr)

    def assert_untouched(self):
        found = {f.name: f.read_text() for f in self.results.iterdir()}
        self.assertEqual(found, self.earlier)

    def refuse(self, replace, by, *words):
        """The good file with one change is refused before anything happens."""
        self.assertEqual(GOOD.count(replace), 1)
        self.assert_refused(self.run_file(GOOD.replace(replace, by)), *words)
        self.assert_untouched()

    def refuse_set(self, settings, *words):
        self.assert_refused(self.run_file(settings=settings), *words)
        self.assert_untouched()

    def stops(self, settings, *words):
        """The run starts and stops, leaving its last state."""
        self.assert_refused(self.run_file(settings=settings), *words,
                            "results/last-state.vtu")
        last = (self.results / "last-state.vtu").read_text()
        self.assertIn("</VTKFile>", last)

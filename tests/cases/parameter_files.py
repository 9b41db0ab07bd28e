# SPDX-License-Identifier: LGPL-2.1-or-later
"""All parameter files of the project are valid, and doc/first-slope.md is true.

Usage: parameter_files.py ROOT FOLDER SUITE, with TALUS_FORK_SERVER in the environment
"""

import csv
import math
import pathlib
import re
import shutil
import sys
import unittest

from fork_server import run_forked

ROOT = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()
FIRST_SLOPE = ROOT / "prm" / "first-slope.prm"


def run(*arguments):
    return run_forked(arguments, FOLDER, timeout=600)


class ParameterFiles(unittest.TestCase):
    def test_all_are_valid(self):
        files = [file for folder in ("prm", "tests")
                 for file in sorted((ROOT / folder).rglob("*.prm"))]
        self.assertIn(FIRST_SLOPE, files)
        for file in files:
            with self.subTest(file=str(file.relative_to(ROOT))):
                result = run("--validate", file)
                self.assertEqual(result.returncode, 0, result.stderr)


class FirstSlope(unittest.TestCase):
    """What the page says of its file, and what must hold whatever the method."""

    def slide(self, name, *settings):
        """Columns of statistics.csv by name."""
        options = [o for s in settings for o in ("--set", s)]
        result = run(FIRST_SLOPE, "--overwrite", "--output", FOLDER / name,
                     "--set", "Output/Write points=false",
                     "--set", "Output/Write grid=false",
                     "--set", "End when at rest=false", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(FOLDER / name / "statistics.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        return {key: [float(row[key]) for row in rows] for key in rows[0]}

    def test_the_page_explains_every_setting(self):
        page = (ROOT / "doc" / "first-slope.md").read_text()
        settings = re.findall(r"^ *(set .*?) *$", FIRST_SLOPE.read_text(),
                              re.MULTILINE)
        self.assertEqual(len(settings), 15)
        for setting in settings:
            self.assertIn("`%s`" % setting, page)

    def test_comes_to_rest_as_it_must(self):
        slide = self.slide("first-slope")
        self.assertEqual(max(slide["empty interior cells"]), 0)
        self.assertEqual(max(slide["empty columns"]), 0)
        self.assertEqual(set(slide["connected bodies"]), {1})
        remainder = max(map(abs, slide["energy remainder [J]"]))
        self.assertLess(remainder, 0.002 * slide["gravity work [J]"][-1])
        energy = slide["grid kinetic energy [J]"]
        self.assertLess(energy[-1], 1e-3 * max(energy))
        # The area of the trapezoid, its submerged density, gravity.
        weight = 88 * 600 * 9.81 * math.sin(math.radians(4))
        # At rest since 20 s; waves in the soil change the force by 2 %.
        force = -sum(slide["seabed force x [N]"][-20:]) / 20
        self.assertLess(abs(force / weight - 1), 0.001)
        # Inertia only changes the clock.
        light = self.slide("light", "Materials/mud/Density=600",
                           "End time=%.17g" % (25 * math.sqrt(600 / 1600)))
        coarse = self.slide("coarse", "Grid/Cell size=1")
        for other, tolerance in ((light, 1e-9), (coarse, 0.01)):
            self.assertLess(abs(other["front x [m]"][-1]
                                / slide["front x [m]"][-1] - 1), tolerance)


if __name__ == "__main__":
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of talus-report and talus-study have in common."""

import csv
import pathlib
import shutil
import subprocess
import sys
import unittest

TALUS = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(sys.argv[2]).resolve()
FOLDER = pathlib.Path(sys.argv[3]).resolve()
SHARE = ROOT / "share" / "talus"
# A slope of a few hundred points, in less than a second.
COARSE = ["Grid/Cell size=1", "End time=4", "Output/Boxes as cells=true"]

sys.path.insert(0, str(SHARE))
sys.dont_write_bytecode = True


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = FOLDER / cls.__name__
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.folder.mkdir(parents=True)

    @classmethod
    def tool(cls, name, *arguments, **options):
        """Run talus-report or talus-study, with the Python that runs this test."""
        return subprocess.run([sys.executable, SHARE / name, *map(str, arguments)],
                              capture_output=True, text=True, timeout=300, **options)

    @classmethod
    def slide(cls, name, *settings, file="first-slope.prm", options=()):
        """The output folder of a run."""
        folder = cls.folder / name
        result = subprocess.run(
            [TALUS, ROOT / "prm" / file, "--output", folder, *options,
             *[o for s in [*COARSE, *settings] for o in ("--set", s)]],
            capture_output=True, text=True, timeout=300, cwd=cls.folder)
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        return folder

    def assert_sentence(self, result, *parts):
        """An error is one or more whole sentences, never a traceback."""
        self.assertEqual(result.returncode, 1, result)
        self.assertNotIn("Traceback", result.stderr)
        self.assertTrue(result.stderr.strip().endswith("."), result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)


def read_csv(path):
    """Rows as dictionaries of texts."""
    with open(path, newline="", encoding="utf-8-sig") as stream:
        return list(csv.DictReader(stream))


def main():
    """All tests of the script that calls it, or the suite that is its last argument. Status
    77 says that all of them were skipped."""
    result = unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2, exit=False).result
    if result.testsRun and len(result.skipped) == result.testsRun:
        sys.exit(77)
    sys.exit(not result.wasSuccessful())

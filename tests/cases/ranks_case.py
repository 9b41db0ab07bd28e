# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests that run talus on one and several ranks have in common.

Usage of each: SCRIPT.py TALUS FOLDER MPIEXEC PRM_FOLDER [TestClass].
"""

import pathlib
import shutil
import subprocess
import sys
import unittest

TALUS = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()
MPIEXEC = sys.argv[3]
PRM = pathlib.Path(sys.argv[4]).resolve()


class Case(unittest.TestCase):
    """Runs go to folders of their names in `self.folder`, which is empty."""

    def setUp(self):
        self.folder = FOLDER / self.id().split(".", 1)[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def start(self, name, n_ranks, settings, file):
        """Run to the end, whatever that is; the file is one of ours."""
        options = [o for s in settings for o in ("--set", s)]
        launcher = [MPIEXEC, "-n", str(n_ranks)] if n_ranks > 1 else []
        return subprocess.run(
            [*launcher, TALUS, *options, "--output", name, PRM / file],
            cwd=self.folder, capture_output=True, text=True, timeout=600)

    def run_talus(self, name, file, settings, n_ranks=1):
        """Run without an error; return the folder."""
        result = self.start(name, n_ranks, settings, file)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return self.folder / name

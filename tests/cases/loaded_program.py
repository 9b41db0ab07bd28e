# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of talus by talus-loaded, which loads the libraries once for all of them:
less than half as long as a start for what is refused at once."""

import os
import pathlib
import subprocess
import tempfile


class LoadedProgram:
    """Of the environment variable TALUS_LOADED, which ctest sets."""

    def __init__(self):
        self.process = subprocess.Popen([os.environ["TALUS_LOADED"]],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def run(self, arguments, folder="."):
        """As subprocess.run() in this folder, with the output as text."""
        arguments = [str(a) for a in arguments]
        with tempfile.TemporaryDirectory() as temporary:
            files = [pathlib.Path(temporary, name) for name in ("stdout", "stderr")]
            request = [len(arguments), pathlib.Path(folder).resolve(), *files, *arguments]
            self.process.stdin.write(b"".join(os.fsencode(str(r)) + b"\0" for r in request))
            self.process.stdin.flush()
            status = int(self.process.stdout.readline())
            return subprocess.CompletedProcess(arguments, status,
                                               *(f.read_text() for f in files))


LOADED = LoadedProgram()

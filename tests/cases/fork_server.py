# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of talus by talus-fork-server, which loads the libraries once for all."""

import functools
import os
import pathlib
import subprocess
import tempfile


@functools.lru_cache(maxsize=None)
def server():
    """That of the environment variable TALUS_FORK_SERVER, which ctest sets."""
    return subprocess.Popen([os.environ["TALUS_FORK_SERVER"]],
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def run_forked(arguments, folder=".", *, timeout):
    """As subprocess.run() in this folder, with the output as text. After the
    time-out, s, the run ends by SIGALRM."""
    arguments = [str(a) for a in arguments]
    with tempfile.TemporaryDirectory() as temporary:
        files = [pathlib.Path(temporary, name) for name in ("stdout", "stderr")]
        request = [len(arguments), timeout, pathlib.Path(folder).resolve(), *files, *arguments]
        server().stdin.write(b"".join(os.fsencode(str(r)) + b"\0" for r in request))
        server().stdin.flush()
        status = int(server().stdout.readline())
        return subprocess.CompletedProcess(arguments, status, *(f.read_text() for f in files))

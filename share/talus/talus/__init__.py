# SPDX-License-Identifier: LGPL-2.1-or-later
"""talus from Python: runs that a program leads, and readers of finished runs.

    run = talus.Run("slope.prm", {"Grid/Cell size": 5})
    run.advance_to(10)
    run.points["velocity"]              # numpy array, shape (dim, points)

    results = talus.read("output")
    results.table("statistics")["time"]

read() needs numpy alone; Run needs the compiled part, Debian's package python3-talus.
doc/python.md has examples.
"""

import os
import sys

_HERE = os.path.dirname(os.path.realpath(__file__))
# The readers are beside this package in the source tree, and in share/talus when installed.
for _folder in (os.path.join(_HERE, ".."), os.path.join(_HERE, "../../../../share/talus")):
    if os.path.isdir(os.path.join(_folder, "talus_tools")) and _folder not in sys.path:
        sys.path.append(_folder)

from talus_tools.errors import UserError as Error
from talus_tools.results import Results, read

__all__ = ["Error", "Results", "Run", "read"]


def __getattr__(name):
    """Run is loaded when it is asked for: its libraries take a second, and MPI starts."""
    if name != "Run":
        raise AttributeError(f"module 'talus' has no attribute '{name}'")
    from talus.run import Run
    return Run

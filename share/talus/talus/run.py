# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of talus that a program in Python leads."""

import collections.abc
import math
import os

from talus_tools.errors import UserError

try:
    from talus import _talus
except ImportError as error:
    raise UserError(f"The compiled part of the module talus cannot be loaded ({error}). Install "
                    "Debian's package python3-talus, or build talus with TALUS_PYTHON=ON.") from error


def as_text(value):
    """The value of a parameter as in a parameter file: true, 0.5 or 1, 2, 3."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, collections.abc.Iterable):
        return ", ".join(map(as_text, value))
    return str(value)


class Points(collections.abc.Mapping):
    """Columns of the points of this rank by name, as read-only numpy arrays: shape (points)
    for numbers, (n, points) for vectors and lists, (dim, dim, points) for tensors.

    The arrays share the memory of the run, without copies. Their values belong to the state
    until the next step; copy() keeps the values. After the next step an array holds undefined
    numbers: points move to other rows and other memory."""

    def __init__(self, run):
        self._run = run

    def __getitem__(self, name):
        return self._run._column(name)

    def __iter__(self):
        return (name for name, unit in self._run._columns())

    def __len__(self):
        return len(self._run._columns())

    @property
    def units(self):
        """Unit of each column by name; "-" if dimensionless."""
        return dict(self._run._columns())


class Run(_talus.Run):
    """A run of talus in this process; several may exist.

    The constructor reads all parameters and makes mesh and points, or loads the newest
    checkpoint. Files are written from the first advance_to() on. With MPI all ranks call the
    same functions in the same order; `points` are those of this rank, all other numbers are of
    all ranks. Errors are talus.Error with a sentence.

    file: path of a parameter file, or None
    settings: values by parameter, {"Grid/Cell size": 5}, which replace those of the file
    text: content of a parameter file, in place of `file`
    output: folder of the results, in place of Output/Folder
    resume: continue from the newest checkpoint in the folder of the results
    overwrite: begin anew even if the folder has a checkpoint of an unfinished run
    velocities: function by obstacle, velocity(time): the components of the velocity [m/s] in
        the step whose middle is at `time` [s]. Called once per step on each rank; all ranks
        must return the same. Takes the place of the obstacle's parameter Velocity.
    communicator: of mpi4py; None for all ranks of the program, "self" for this rank alone"""

    def __init__(self, file=None, settings=None, *, text=None, output="", resume=False,
                 overwrite=False, velocities=None, communicator=None):
        if (file is None) == (text is None):
            raise UserError("A run needs parameters: either `file`, the path of a parameter file, "
                            "or `text`, the content of one. Give one of the two.")
        options = _talus.Options()
        options.output_folder = os.fspath(output)
        options.resume = resume
        options.overwrite = overwrite
        for obstacle, velocity in (velocities or {}).items():
            options.prescribe_velocity(obstacle, velocity)
        overrides = [f"{name}={as_text(value)}" for name, value in (settings or {}).items()]
        super().__init__(os.fspath(file) if text is None else text, text is not None, overrides,
                         options, communicator)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()

    def advance_to(self, time=math.inf, callback=None):
        """Advance to the first step that reaches this time [s], or to the end of the run. The
        steps are those of an uninterrupted run. `callback(run)` is called after each step; an
        exception leaves the run between two steps. Return whether the time was reached: False
        after stop(), or at the limit of wall time, with a checkpoint."""
        return self._advance_to(time, None if callback is None else lambda: callback(self))

    def checkpoint(self):
        """Write a checkpoint and return its path."""
        return self._write_checkpoint()

    @property
    def points(self):
        """The points of this rank now."""
        return Points(self)

    @property
    def statistics(self):
        """{column: value}: the row that statistics.csv would have now; on the first rank."""
        return self._statistics()

    @property
    def accounts(self):
        """{name: value}: energies [J] and impulses on the soil [N s] since the start, as the
        parts of the program recorded them."""
        return self._accounts()

    @property
    def obstacles(self):
        """Obstacles by name, with displacement [m], velocity [m/s], force of the soil in the
        last step [N], moment about the reference point [N m], impulse since the start [N s] and
        contact_area [m^2]; in 2-D per metre width."""
        return {obstacle.name: obstacle for obstacle in self._obstacles()}

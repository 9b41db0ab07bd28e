# SPDX-License-Identifier: LGPL-2.1-or-later
"""All that a folder holds of a run, for a report."""

import fcntl
import hashlib
import math
import os
import re

import numpy

from talus_tools.errors import UserError
from talus_tools.parameters import Defaults, changed_entries
from talus_tools.report.log import Log
from talus_tools.results import Results
from talus_tools.texts import read_text

HERE = os.path.dirname(os.path.abspath(__file__))
# The reference of all parameters: installed beside the tools, or in the source tree.
REFERENCES = [os.path.join(HERE, "../../parameters.prm"),
              os.path.join(HERE, "../../../../doc/parameters.prm")]
# A run is at rest when its grid has less than this share of its largest kinetic energy.
REST = 1e-3
# Columns that every row needs, and columns of statistics.csv that are empty without soil.
KEYS = ("time [s]", "x [m]", "z [m]")
MAY_BE_EMPTY = ("front", "rear", "height", "centre", "densimetric")


def has_rows(path):
    """Whether a table has a complete line below its header."""
    with open(path, "rb") as stream:
        return stream.readline().endswith(b"\n") and stream.readline().endswith(b"\n")


class Run(Results):
    """Tables, parameters and log of a run; a table that is not there is None. `empty`: names
    of the tables that have no complete row; `damaged`: number of rows left out by table; `layer`: names of the bodies that are slab and weak
    layer, or None."""

    def __init__(self, folder, layer=None):
        super().__init__(folder)
        self.empty, self.damaged, self.layer = [], {}, layer
        self.tables = {name: self.read(name + ".csv") for name in
                       ("statistics", "profile", "obstacles", "boundaries", "newton", "maps",
                        "stations", "runout", "bands")}
        self.statistics = self.tables["statistics"]
        self.entries = self.parameters
        self.title = self.entries.get("Title", "")
        self.dimension = int(self.entries.get("Dimension", "2"))
        self.stages = self.entries.get("Stages", "dynamics")
        self.end_time = float(self.entries.get("End time", "0"))
        log = read_text(self.path("log.txt")) if self.has("log.txt") else ""
        self.log = Log(log, self.title)
        reference = [path for path in REFERENCES if os.path.isfile(path)]
        self.changed = changed_entries(self.entries, Defaults(reference[0])) if reference else None
        with open(self.path("parameters.prm"), "rb") as stream:
            content = stream.read()
        self.hash = hashlib.sha256(content).hexdigest()
        self.parameter_text = content.decode("utf-8-sig", errors="replace")
        self.versions = re.findall(r"^#   (.*)$", self.parameter_text, re.MULTILINE)

    def check_folder(self):
        """Errors that a user makes, besides: a run that has not begun."""
        super().check_folder()
        if not self.has("statistics.csv"):
            raise UserError(f"'{self.folder}' has no statistics.csv: the run has not begun to "
                            "move, or failed before. Its log.txt may tell.")

    def read(self, name):
        """A table, or None where the run wrote none, or none yet."""
        path = self.path(name)
        if not os.path.isfile(path):
            return None
        if name != "statistics.csv" and not has_rows(path):
            self.empty.append(name)
            return None
        return self.sound(name, self.table(name.removesuffix(".csv")))

    def sound(self, name, table):
        """The rows of a table with all numbers that time, place and budgets need; other values
        are NaN if they are not finite. None without such a row."""
        values = table.values
        values[~numpy.isfinite(values)] = numpy.nan
        needed = [column for column in table.names if column in KEYS or name == "profile.csv" or (
            name == "statistics.csv" and not column.startswith(MAY_BE_EMPTY))]
        rows = numpy.isfinite([table[column] for column in needed]).all(axis=0)
        if rows.all():
            return table
        self.damaged[name] = numpy.count_nonzero(~rows)
        if rows.any():
            return table.where(rows)
        if name == "statistics.csv":
            raise UserError(f"'{table.path}' has no row of numbers. The file was changed or "
                            "damaged: run talus again.")
        return None

    def names(self, entry):
        """Names in the list of an entry."""
        return [name.strip() for name in self.entries.get(entry, "").split(",") if name.strip()]

    def obstacle_names(self):
        """Names of the obstacles."""
        return self.names("Obstacles/Names")

    @property
    def time(self):
        """The time of the last row."""
        return self.statistics["time [s]"][-1]

    def is_finished(self):
        """Whether the end time was reached, or the run ended since the soil was at rest; without
        dynamics, whether the stages are over."""
        if "dynamics" not in self.stages or (self.is_noted_at_rest() and self.log.has_ended()):
            return True
        return self.time >= self.end_time * (1 - 1e-9)

    def is_noted_at_rest(self):
        """Whether the run itself found the soil at rest in its last row."""
        return "at rest" in self.statistics and bool(self.statistics["at rest"][-1])

    def is_at_rest(self):
        """Whether the grid hardly moves any more; None where nothing ever moved."""
        energy = self.statistics["grid kinetic energy [J]"]
        if energy.max() == 0:
            return None
        return self.is_noted_at_rest() or bool(energy[-1] <= REST * energy.max())

    def smallest_thickness(self, section):
        """Thickness from which soil counts in the tables of the section Runout or Maps [m]."""
        given = float(self.entries.get(f"{section}/Smallest thickness", "").strip() or 0)
        return given or 0.1 * float(self.entries.get("Grid/Cell size", "0"))

    def outflow(self, name, unit, kind="outflow"):
        """History of what left through outflow faces; zeros where the run has none."""
        column = f"{kind} {name} [{unit}]"
        return self.statistics[column] if column in self.statistics else numpy.zeros(
            len(self.statistics))

    def inflow(self, name, unit):
        """History of what entered through faces; zeros where nothing can."""
        return self.outflow(name, unit, "inflow")

    def balanced_mass(self):
        """History of the mass inside, plus what left, less what entered [kg]."""
        return (self.statistics["mass [kg]"] + self.outflow("mass", "kg")
                - self.inflow("mass", "kg"))

    def is_writing(self):
        """Whether a run holds the lock of the folder now."""
        try:
            with open(self.path("lock"), "rb") as stream:
                fcntl.flock(stream, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            pass
        return False

    def share_of_weight(self):
        """Weight under water over that of all the mass; None where materials differ in it."""
        shares = set()
        for name, material in self.entries.items():
            if name.startswith("Bodies/") and name.endswith("/Material"):
                start = f"Materials/{material}/"
                density = float(self.entries.get(start + "Density", "1000"))
                submerged = self.entries.get(start + "Submerged density", "").strip()
                shares.add(float(submerged) / density if submerged else 1.0)
        return shares.pop() if len(shares) == 1 else None

    def gravity(self):
        """Force along x by a constant gravity over the mass [m/s^2], less buoyancy; None where
        it is not constant or something else drives the soil, so that no closed form is at
        hand."""
        magnitude, angle, ramp = (self.entries.get("Gravity/" + name, "0") for name in
                                  ("Magnitude", "Slope angle", "Ramp time"))
        driven = any(text.strip() for name, text in self.entries.items() if
                     name.startswith("Ground motion/File") or name == "Body force/Expression")
        try:
            share = self.share_of_weight()
            if driven or float(ramp) != 0 or share is None:
                return None
            return share * float(magnitude) * math.sin(math.radians(float(angle)))
        except ValueError:
            return None

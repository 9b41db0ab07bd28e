# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a study file says, checked."""

import dataclasses
import os
import re
import shlex

from talus_tools.entries import Entries
from talus_tools.errors import UserError
from talus_tools.parameters import read_parameters
from talus_tools.study.quantities import MapQuantity, Quantity
from talus_tools.texts import read_input

# Entries and their defaults; NAME stands for the names that `Names` lists.
ENTRIES = {
    "Title": "", "Case": "", "Output folder": "", "Program": "talus", "Launcher": "",
    "Number at once": "1",
    "Design/Kind": "Latin hypercube", "Design/Members": "16", "Design/Seed": "1",
    "Varied/Names": "", "Varied/NAME/Parameter": "", "Varied/NAME/Template": "{}",
    "Varied/NAME/Values": "", "Varied/NAME/Distribution": "uniform", "Varied/NAME/Lower": "",
    "Varied/NAME/Upper": "", "Varied/NAME/Mode": "", "Varied/NAME/Mean": "",
    "Varied/NAME/Standard deviation": "",
    "Quantities/Names": "", "Quantities/NAME/File": "", "Quantities/NAME/Column": "",
    "Quantities/NAME/Take": "final",
    "Quantities/NAME/Map": "", "Quantities/NAME/Place": "", "Quantities/NAME/Outline": "",
    "Quantities/NAME/Threshold": "0.1",
    "Exceedance/Map": "maximum-thickness", "Exceedance/Thresholds": "0.1, 1",
    "Emulator/Write": "false", "Emulator/Samples": "100000",
    "Observed/Names": "", "Observed/NAME/Quantity": "", "Observed/NAME/Value": "",
    "Observed/NAME/Standard deviation": "",
}
# Sections with names of the user's.
NAMED = ("Varied", "Quantities", "Observed")
# Columns of study.csv beside the varied numbers and the quantities.
MEMBER, STATUS, MOVING, HASH, REASON = ("member", "status", "moving at the end", "hash",
                                        "reason")
# Tables of talus whose columns are all numbers.
TABLES = ("statistics.csv", "profile.csv", "obstacles.csv", "boundaries.csv", "newton.csv",
          "maps.csv", "stations.csv", "runout.csv", "bands.csv")
# File and column of a quantity that names neither: right for any direction of the slide.
RUNOUT = ("runout.csv", "runout [m]")
TAKES = ("final", "maximum", "minimum", "settling time")
KINDS = ("Latin hypercube", "grid")
# Numbers that each distribution needs, all in the unit of the parameter.
DISTRIBUTIONS = {"uniform": ("Lower", "Upper"), "normal": ("Mean", "Standard deviation"),
                 "lognormal": ("Mean", "Standard deviation"),
                 "triangular": ("Lower", "Mode", "Upper")}


@dataclasses.dataclass
class Varied:
    """A parameter that differs from member to member."""
    name: str
    parameter: str
    template: str
    distribution: str
    numbers: dict
    values: list


@dataclasses.dataclass
class Observation:
    """An observed value of a quantity, with its standard deviation."""
    name: str
    quantity: int  # index among the quantities
    value: float
    deviation: float


class Settings(Entries):
    """All of a study file; `fixed` are entries over those of the case, for all members."""

    def __init__(self, path):
        entries = read_parameters(path, read_input)
        self.fixed = {name.partition("/")[2]: value for name, value in entries.items()
                      if name.startswith("Parameters/")}
        for name, value in self.fixed.items():
            if "{" in value:
                raise UserError(f"'{path}': 'Parameters/{name} = {value}' was found, where a "
                                "value without '{' was expected. Only 'Varied/NAME/Template' has "
                                "braces, for the varied number.")
        super().__init__(path, {n: v for n, v in entries.items()
                                if not n.startswith("Parameters/")}, ENTRIES)
        self.check_section_names()
        self.check_names()
        self.title = self.get("Title")
        self.case = self.needed("Case")
        stem = os.path.splitext(os.path.basename(path))[0]
        self.folder = self.get("Output folder") or stem + "-output"
        self.program, self.launcher = self.get("Program"), shlex.split(self.get("Launcher"))
        self.at_once = self.whole("Number at once", 1)
        self.kind = self.one_of("Design/Kind", KINDS)
        self.members = self.whole("Design/Members", 1)
        self.seed = self.whole("Design/Seed", 0)
        self.varied = [self.read_varied(name) for name in self.names("Varied")]
        self.quantities = [self.read_quantity(name) for name in self.names("Quantities")] or [
            Quantity("runout", *RUNOUT, "final")]
        self.map = self.get("Exceedance/Map")
        self.thresholds = self.numbers("Exceedance/Thresholds")
        self.emulates = self.one_of("Emulator/Write", ("false", "true")) == "true"
        self.emulator_samples = self.whole("Emulator/Samples", 100, 10**7)
        self.observed = [self.read_observation(name) for name in self.names("Observed")]
        self.check_varied()
        self.check_columns()

    def default(self, name):
        """Default of an entry; NAME stands for the names of the user's."""
        return ENTRIES[re.sub(rf"^({'|'.join(NAMED)})/[^/]+/", r"\1/NAME/", name)]

    def names(self, section):
        """Names that a section lists."""
        return [n.strip() for n in self.get(section + "/Names").split(",") if n.strip()]

    def check_section_names(self):
        """A slash separates sections and cannot be part of a name."""
        for section in NAMED:
            for name in self.names(section):
                if "/" in name:
                    raise UserError(f"'{self.path}': the name '{name}' in '{section}/Names' has a "
                                    "slash, which separates sections from entries. Choose a name "
                                    "without one.")

    def columns(self):
        """Names of the columns of study.csv."""
        return [MEMBER, *(one.name for one in self.varied), STATUS,
                *(one.label() for one in self.quantities), MOVING, HASH, REASON]

    def check_columns(self):
        """Each column of study.csv has a name of its own."""
        columns = self.columns()
        for name in columns:
            if columns.count(name) > 1:
                raise UserError(f"'{self.path}': two columns of study.csv would be called "
                                f"'{name}'. Give each name in 'Varied/Names' and "
                                f"'Quantities/Names' once, and none of them as '{MEMBER}', "
                                f"'{STATUS}', '{MOVING}', '{HASH}' or '{REASON}', which every "
                                "study has.")

    def check_names(self):
        """No entry is overlooked because it is misspelt."""
        known = set(ENTRIES)
        for section in NAMED:
            for name in self.names(section):
                known |= {e.replace("NAME", name) for e in ENTRIES
                          if e.startswith(section + "/NAME/")}
        for name in self.entries:
            if name not in known:
                raise UserError(f"'{self.path}' sets '{name}', which is no entry of a study; "
                                "doc/study.md lists them. Entries of the case belong into the "
                                "section 'Parameters'; sections in 'Varied', 'Quantities' and "
                                "'Observed' need to be listed in 'Names' there.")

    def whole(self, name, least, most=10**6):
        """A whole number. Each of a million members would have its folder."""
        text = self.get(name)
        if not text.isdigit() or not least <= int(text) <= most:
            raise self.error(name, f"a whole number of at least {least} and at most {most}")
        return int(text)

    def read_varied(self, name):
        """One section of Varied."""
        start = f"Varied/{name}/"
        distribution = self.one_of(start + "Distribution", tuple(DISTRIBUTIONS))
        numbers, values = {}, self.numbers(start + "Values")
        if self.kind != "grid":
            for key in DISTRIBUTIONS[distribution]:
                numbers[key] = self.number(start + key)
        elif not values:
            raise self.error(start + "Values", "the numbers of the grid, separated by commas,")
        before, *after = self.get(start + "Template").split("{}")
        if len(after) != 1 or "{" in before + after[0]:
            raise self.error(start + "Template", "a text with {} once, which stands for the "
                             "varied number, and without other braces")
        return Varied(name, self.needed(start + "Parameter"), self.get(start + "Template"),
                      distribution, numbers, values)

    def read_quantity(self, name):
        """One section of Quantities."""
        start = f"Quantities/{name}/"
        if self.get(start + "Map"):
            return self.read_map_quantity(name)
        column = self.get(start + "Column") or RUNOUT[1]
        file = self.get(start + "File") or (
            RUNOUT[0] if column == RUNOUT[1] else "statistics.csv")
        # A launcher may write tables of its own.
        if file not in TABLES and not (self.launcher and os.path.basename(file) == file):
            raise self.error(start + "File", "a table of talus with numbers only ("
                             + ", ".join(TABLES) + ") or, with a 'Launcher', another file in the "
                             "folder of the member")
        return Quantity(name, file, column, self.one_of(start + "Take", TAKES))

    def read_map_quantity(self, name):
        """One section of Quantities that asks for a map."""
        start = f"Quantities/{name}/"
        place, outline = self.get(start + "Place"), self.get(start + "Outline")
        if bool(place) == bool(outline):
            raise UserError(f"'{self.path}': 'Quantities/{name}' asks for a map, where either "
                            "'Place' or 'Outline' was expected.")
        ends = re.fullmatch(r"\s*([-+.\deE]+)\s*,\s*([-+.\deE]+)\s*", outline)
        if ends:
            outline = self.numbers(start + "Outline")
            if not outline[0] < outline[1]:
                raise self.error(start + "Outline", "the left and the right end of the deposit [m]")
        return MapQuantity(name, self.get(start + "Map"),
                           self.numbers(start + "Place") if place else None, outline or None,
                           self.number(start + "Threshold"))

    def read_observation(self, name):
        """One section of Observed."""
        start = f"Observed/{name}/"
        names = [quantity.name for quantity in self.quantities]
        if self.get(start + "Quantity") not in names:
            raise self.error(start + "Quantity", "one of 'Quantities/Names' (" + ", ".join(names)
                             + ")")
        deviation = self.number(start + "Standard deviation")
        if not deviation > 0:
            raise self.error(start + "Standard deviation", "a positive number")
        return Observation(name, names.index(self.get(start + "Quantity")),
                           self.number(start + "Value"), deviation)

    def check_varied(self):
        """Something must vary, each parameter once, within limits that make sense."""
        if not self.varied:
            raise UserError(f"'{self.path}' varies nothing: list names in 'Varied/Names', each "
                            "with a section of that name.")
        parameters = [one.parameter for one in self.varied]
        for one in self.varied:
            if parameters.count(one.parameter) > 1:
                raise UserError(f"'{self.path}' varies '{one.parameter}' twice.")
            n, start = one.numbers, f"Varied/{one.name}/"
            order = [n[key] for key in ("Lower", "Mode", "Upper") if key in n]
            if order != sorted(order) or (order and order[0] == order[-1]):
                raise self.error(start + "Upper", "a number above 'Lower', with 'Mode' between")
            if one.parameter == "Output/Folder":
                raise self.error(start + "Parameter", "a parameter of the case (each member has a "
                                 "folder of its own)")
            if n.get("Standard deviation", 1) <= 0:
                raise self.error(start + "Standard deviation", "a positive number")
            if one.distribution == "lognormal" and n and n["Mean"] <= 0:
                raise self.error(start + "Mean", "a positive number")
            if one.distribution == "lognormal" and n and n["Standard deviation"] > 1e6 * n["Mean"]:
                raise self.error(start + "Standard deviation", "at most a million times the mean")

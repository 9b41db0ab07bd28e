# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter file of talus-pipe, checked."""

import dataclasses
import math

from talus_tools.entries import Entries
from talus_tools.errors import UserError
from talus_tools.parameters import read_parameters
from talus_tools.texts import read_input

# Entries and their defaults; an empty default is explained in doc/pipe.md.
ENTRIES = {
    "Length": "", "Element size": "", "Ends": "fixed",
    "Pipe/Outer diameter": "", "Pipe/Wall thickness": "", "Pipe/Young's modulus": "2.07e11",
    "Pipe/Yield stress": "4.5e8", "Pipe/Bending stiffness": "", "Pipe/Axial stiffness": "",
    "Pipe/Tension": "0",
    "Lateral springs/Stiffness": "", "Lateral springs/Ultimate resistance": "",
    "Axial springs/Stiffness": "0", "Axial springs/Ultimate resistance": "",
    "Load/Source": "obstacle", "Load/Obstacle": "", "Load/Column": "force x [N]",
    "Load/Width": "", "Load/Centre": "", "Load/Stations": "", "Load/Line": "",
    "Load/Route": "", "Load/Drag coefficient": "0", "Load/Bearing factor": "0",
    "Load/Shear strength": "",
    "Load/Lateral resistance in the slide": "1",
}
ENDS = ("fixed", "pinned", "free")
SOURCES = ("obstacle", "stations", "line", "plan")


@dataclasses.dataclass
class Pipe:
    """Cross-section of the pipe, in SI units."""
    diameter: float
    wall: float
    yield_stress: float
    bending_stiffness: float
    axial_stiffness: float
    tension: float

    @property
    def area(self):
        """Area of steel [m^2]."""
        return math.pi * self.wall * (self.diameter - self.wall)

    @property
    def second_moment(self):
        """Second moment of area [m^4]."""
        inner = self.diameter - 2 * self.wall
        return math.pi / 64 * (self.diameter**4 - inner**4)

    def utilisation(self, axial_force, moment):
        """Largest longitudinal stress over the yield stress [-]."""
        stress = (abs(axial_force) / self.area
                  + abs(moment) * self.diameter / (2 * self.second_moment))
        return stress / self.yield_stress


@dataclasses.dataclass
class Springs:
    """Bilinear soil springs per length of the pipe: stiffness [N/m^2], resistance [N/m]."""
    stiffness: float
    resistance: float


class Settings(Entries):
    """All entries of a parameter file of talus-pipe."""

    def __init__(self, path):
        super().__init__(path, read_parameters(path, read_input), ENTRIES)
        for name in self.entries:
            if name not in ENTRIES:
                raise UserError(f"'{path}' sets '{name}', which is no entry of talus-pipe; "
                                "doc/pipe.md lists them.")
        self.ends = self.one_of("Ends", ENDS)
        self.source = self.one_of("Load/Source", SOURCES)
        self.pipe = self.read_pipe()
        self.lateral = self.read_springs("Lateral springs")
        self.axial = self.read_springs("Axial springs")
        self.in_slide = self.number("Load/Lateral resistance in the slide", 0, 1)
        self.length = self.number("Length", 1e-3)
        self.element_size = self.choose_element_size()

    def optional(self, name, default):
        """One positive number, or the default of an empty entry."""
        return self.number(name, 1e-30) if self.get(name) else default

    def read_pipe(self):
        """The section Pipe; stiffnesses follow from diameter, wall and modulus unless given."""
        diameter = self.number("Pipe/Outer diameter", 1e-6)
        wall = self.number("Pipe/Wall thickness", 1e-9, diameter / 2)
        modulus = self.number("Pipe/Young's modulus", 1e-30)
        pipe = Pipe(diameter, wall, self.number("Pipe/Yield stress", 1e-30), 0, 0,
                    self.number("Pipe/Tension", 0))
        pipe.bending_stiffness = self.optional("Pipe/Bending stiffness",
                                               modulus * pipe.second_moment)
        pipe.axial_stiffness = self.optional("Pipe/Axial stiffness", modulus * pipe.area)
        return pipe

    def read_springs(self, section):
        """Springs without 'Ultimate resistance' are linear."""
        return Springs(self.number(section + "/Stiffness", 0),
                       self.optional(section + "/Ultimate resistance", math.inf))

    def choose_element_size(self):
        """A sixteenth of the length (4 EI/k)^(1/4) over which a beam on springs bends, unless
        given. Twenty thousand elements are the most."""
        stiffness = self.lateral.stiffness or 1e-30
        bend = (4 * self.pipe.bending_stiffness / stiffness) ** 0.25
        size = self.optional("Element size", min(bend / 16, self.length / 64))
        if self.length / size > 20000:
            raise UserError(f"'{self.path}': {self.length / size:.0f} elements of {size:.3g} m "
                            f"would be needed for 'Length = {self.get('Length')}', where 20000 "
                            "are the most. Choose a shorter 'Length' or a larger 'Element size'.")
        return size

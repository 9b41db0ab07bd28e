# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sections of the page, in their order."""

from talus_tools.report.sections.bands import bands
from talus_tools.report.sections.budgets import energy, mass, momentum
from talus_tools.report.sections.forces import faces, obstacles
from talus_tools.report.sections.fracture import fracture
from talus_tools.report.sections.lines import lines
from talus_tools.report.sections.maps import maps
from talus_tools.report.sections.motion import motion
from talus_tools.report.sections.pore import pore_water
from talus_tools.report.sections.record import parameters, remarks
from talus_tools.report.sections.runout import runout
from talus_tools.report.sections.safety import safety
from talus_tools.report.sections.soil import soil
from talus_tools.report.sections.stations import stations
from talus_tools.report.sections.thalweg import thalweg

# Results first, then how far they can be trusted, then what was run.
SECTIONS = [safety, maps, motion, runout, bands, obstacles, stations, lines, thalweg, soil,
            pore_water, faces, fracture, mass, momentum, energy, remarks, parameters]

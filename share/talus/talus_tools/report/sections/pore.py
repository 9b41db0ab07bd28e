# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pore water: drainage and excess pressure."""

import re

from talus_tools.report.page import Lines, Section
from talus_tools.report.sections.summary import summary

MEANINGS = {
    "largest excess pore pressure [Pa]": ("excess pore pressure", "Largest of all points, beyond "
                                          "the pressure of still water."),
    "largest pore pressure ratio [-]": ("pore pressure ratio r_u", "Largest of all points: the "
                                        "excess pressure over the weight of the soil above at "
                                        "rest. At 1 friction is lost."),
}
REMARK = re.compile(r"pore water has a stiffness K_f|s water moves")


def pore_water(run):
    """Where soil has an excess pore pressure."""
    if not set(MEANINGS) & set(run.statistics.names):
        return None
    materials = dict.fromkeys(run.entries.get(f"Bodies/{body}/Material", "")
                              for body in run.names("Bodies/Names"))
    said = [f"Pore water of '{name}': "
            f"{run.entries.get(f'Materials/{name}/Pore water/Drainage', 'drained')}."
            for name in materials]
    said += [line for line in run.log.remarks if REMARK.search(line)]
    return Section("pore-water", "Pore water",
                   "Its excess pressure takes effective stress, and friction with it, from the soil.",
                   [summary(run, MEANINGS), Lines(said)])

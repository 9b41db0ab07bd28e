# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few numbers that a reader looks for first."""

import dataclasses

import numpy

from talus_tools.report.places import structure_names
from talus_tools.report.sections.forces import names_of
from talus_tools.units import plain, show, unit_of


@dataclasses.dataclass
class Tile:
    """A number with its name and what it means."""
    name: str
    text: str
    value: str
    sentence: str
    unit: str = ""


def tile(name, value, unit, sentence):
    """The number as text and with all its digits."""
    return Tile(name, show(value, unit), repr(float(value)), sentence, unit)


def safety(run):
    """The factor of safety."""
    found = run.log.factor_of_safety()
    if not found:
        return []
    factor, bound = found
    return [Tile("factor of safety", f"{bound} {plain(factor)}".strip(), repr(factor),
                 "1 is the verge of failure.")]


def forces(run):
    """The largest force on each of the first structures."""
    table, result = run.tables["obstacles"], []
    names = [name for name in names_of(table) if name in structure_names(run).values()
             ] if table else []
    for name in names[:2]:
        force = numpy.sqrt(sum(table[f"{name} force {axis} [N]"]**2
                               for axis in "xyz"[:run.dimension]))
        result.append(tile(f"largest force on {name}", force.max(), unit_of("[N]", run.dimension),
                           f"Mean over a row, at t = {plain(table['time [s]'][force.argmax()])} "
                           "s."))
    return result


def runout(run):
    """Runout and speed along the way of the slide, whatever its direction."""
    table = run.tables["runout"]
    # Rows without soil that is thick enough have no front.
    distances = table["runout [m]"][numpy.isfinite(table["runout [m]"])]
    speed = numpy.nan_to_num(table["speed of the centre [m/s]"])
    result = [tile("runout", distances[-1], "m",
                   "Of the front from its start, along the way of the slide."
                   )] if len(distances) else []
    if speed.any():
        result.append(tile("largest velocity", speed.max(), "m/s", "Of the centre of mass, at t = "
                           f"{plain(table['time [s]'][speed.argmax()])} s."))
    return result


def along_x(run):
    """The same along x, of runs without runout.csv."""
    table, result = run.statistics, []
    if "front x [m]" in table:
        front = table["front x [m]"]
        result.append(tile("front at the end", front[-1], "m",
                           f"Largest x of a point; {show(front[-1] - front[0], 'm')} beyond the "
                           "start."))
    velocity = table["centre velocity x [m/s]"]
    at = int(numpy.argmax(numpy.abs(velocity)))
    if velocity.any():
        result.append(tile("largest velocity", velocity[at], "m/s",
                           f"Of the centre of mass, at t = {plain(table['time [s]'][at])} s."))
    return result


def headline(run):
    """At most eight tiles."""
    result = safety(run) + (runout(run) if run.tables["runout"] else along_x(run))
    if run.tables["profile"]:
        profile = run.tables["profile"]
        last = profile["time [s]"] == profile["time [s]"][-1]
        result.append(tile("thickness at the end", profile["thickness [m]"][last].max(), "m",
                           "Largest one of the deposit."))
    return result + forces(run)

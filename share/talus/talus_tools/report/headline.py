# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few numbers that a reader looks for first."""

import dataclasses

import numpy

from talus_tools.report.places import is_release, structure_names
from talus_tools.report.sections.forces import having_forces
from talus_tools.tables import read_lines
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
    names = having_forces(table, structure_names(run).values()) if table else []
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
    speed = numpy.nan_to_num(table["largest depth-mean speed [m/s]"])
    result = [tile("runout", distances[-1], "m",
                   "Of the front from its start, along the way of the slide."
                   )] if len(distances) else []
    if speed.any():
        result.append(tile("largest speed", speed.max(), "m/s", "Mean over the depth, at t = "
                           f"{plain(table['time [s]'][speed.argmax()])} s."))
    return result


def largest_on_maps(run):
    """Largest depth-mean speed of all places [m/s]; 0 without maps."""
    table = run.tables["maps"]
    if table:
        values = table["maximum speed"]
    elif "maximum-speed" in run.names_of_maps():
        values = run.map("maximum-speed").values
    else:
        return 0
    return numpy.nanmax(values, initial=0)


def along_x(run):
    """The same along x, of runs without runout.csv."""
    table, result = run.statistics, []
    if "front x [m]" in table:
        front = table["front x [m]"]
        result.append(tile("front at the end", front[-1], "m",
                           f"Largest x of a point; {show(front[-1] - front[0], 'm')} beyond the "
                           "start."))
    if largest_on_maps(run):
        return result + [tile("largest speed", largest_on_maps(run), "m/s",
                              "Mean over the depth, by the maps.")]
    speed = numpy.sqrt(sum(table[f"centre velocity {axis} [m/s]"]**2
                           for axis in "xyz"[:run.dimension]))
    if speed.any():
        result.append(tile("largest speed of the centre", speed.max(), "m/s",
                           "Of the centre of mass, at t = "
                           f"{plain(table['time [s]'][speed.argmax()])} s."))
    return result


def deposit(run):
    """Largest thickness at the end in the columns outside of the release area."""
    table = run.tables["profile"]
    if table is None:
        return []
    time = table["time [s]"]
    first, last = time == time[0], time == time[-1]
    # Rounded, since the centres of columns are written as computed.
    places = numpy.stack([numpy.round(table[f"{axis} [m]"], 6)
                          for axis in "xyz"[:run.dimension:2]], axis=-1)
    release = set(map(tuple, places[first][is_release(table["thickness [m]"][first])]))
    is_outside = [tuple(place) not in release for place in places[last]]
    thickness = table["thickness [m]"][last][is_outside]
    return [tile("thickness of the deposit", thickness.max(), "m",
                 f"Largest one outside of the release area, at t = {plain(time[-1])} s."
                 )] if len(thickness) else []


def arrivals(run):
    """When soil reaches each of the first lines on the ground, such as a pipeline."""
    groups = read_lines(run.path("lines.csv")) if run.has("lines.csv") else {}
    result = []
    for line, columns in list(groups.items())[:2]:
        name = next((name for name in columns if name.startswith("arrival time")), None)
        times = columns[name][numpy.isfinite(columns[name])] if name else numpy.empty(0)
        if len(times):
            thickness = name[len("arrival time "):-len(" [s]")]
            result.append(tile(f"arrival at {line or 'the line'}", times.min(), "s",
                               f"Soil of {thickness} reaches the first place of the line."))
    return result


def final(run):
    """Whether the results are final: the soil is at rest at the end."""
    table = run.statistics
    if "at rest" not in table or not len(table["at rest"]):
        return []
    since, end = run.log.at_rest_since(), table["time [s]"][-1]
    if since is not None and table["at rest"][-1]:
        return [tile("at rest from", since, "s", "The results are final.")]
    return [Tile("at rest", "no", "0", f"The soil still moved at t = {plain(end)} s: the runout is "
                 "not final.")]


def headline(run):
    """At most ten tiles: how far, how fast, how thick, when, with what force, and if finally."""
    result = safety(run) + (runout(run) if run.tables["runout"] else along_x(run))
    return result + deposit(run) + arrivals(run) + forces(run) + final(run)

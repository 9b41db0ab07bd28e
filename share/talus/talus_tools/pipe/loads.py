# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load of a slide on a pipe, from the tables of a run of talus."""

import os

import numpy

from talus_tools.errors import UserError
from talus_tools.parameters import read_parameters
from talus_tools.results import Results
from talus_tools.tables import read_lines, read_table

ENVELOPE_PARTS = 20  # steps in which a load without a history is applied
PRESSURE, LARGEST_PRESSURE = "impact pressure [Pa]", "maximum impact pressure [Pa]"


class Load:
    """Load per length [N/m] at places s [m] along the pipe (columns) and times [s] (rows).
    Between places the load is linear; before the first and after the last it is zero."""

    def __init__(self, times, places, values, label):
        self.times, self.places, self.values, self.label = times, places, values, label

    def at(self, row, s):
        """Load at places s in a row."""
        return numpy.interp(s, self.places, self.values[row], left=0, right=0)

    def covers(self, s):
        """Whether the load reaches the places s at any time."""
        peak = numpy.interp(s, self.places, numpy.abs(self.values).max(axis=0), left=0, right=0)
        return peak > 0


def read_load(settings, folder):
    """Load that the entry 'Load/Source' asks for."""
    if not os.path.isfile(os.path.join(folder, "parameters.prm")):
        raise UserError(f"'{folder}' has no parameters.prm, so it is no output folder of talus.")
    read = {"obstacle": of_obstacle, "stations": of_stations, "line": of_line,
            "plan": of_plan}[settings.source]
    load = read(settings, folder)
    if not numpy.isfinite(load.values).all():
        raise UserError(f"The load of {load.label} is not a number in all rows. Choose another "
                        "column or a run whose tables are complete.")
    if not load.values.any():
        raise UserError(f"The load of {load.label} is zero at all times: the slide did not reach "
                        "the pipe, or another column holds the load.")
    check_places(settings, load)
    return load


def check_places(settings, load):
    """The loaded part lies on the pipe."""
    first, last = load.places[0], load.places[-1]
    if first < -1e-9 or last > settings.length * (1 + 1e-9):
        raise UserError(f"The load of {load.label} reaches from {first:g} to {last:g} m, where "
                        f"places from 0 to 'Length' = {settings.length:g} m were expected.")


def table(folder, name):
    """A table of the run."""
    path = os.path.join(folder, name)
    if not os.path.isfile(path):
        raise UserError(f"'{folder}' has no {name}. Choose another 'Load/Source', or run talus "
                        "with the section that writes the table.")
    return read_table(path)


def of_obstacle(settings, folder):
    """The force on an obstacle of a 2-D run, N per metre, over the width of the slide."""
    entries = read_parameters(os.path.join(folder, "parameters.prm"))
    if entries.get("Dimension", "2") != "2":
        raise UserError(f"'{folder}' is a run in 3-D, whose obstacles have one force for their "
                        "whole length. Use 'Load/Source = stations' or 'line'.")
    width = settings.number("Load/Width", 1e-6)
    centre = (settings.number("Load/Centre", 0) if settings.get("Load/Centre") else
              settings.length / 2)
    data = table(folder, "obstacles.csv")
    column = f"{settings.needed('Load/Obstacle')} {settings.get('Load/Column')}"
    force = data[column]
    edges = numpy.array([centre - width / 2, centre + width / 2])
    return Load(data["time [s]"], edges, numpy.stack([force, force], axis=1),
                f"column '{column}' of obstacles.csv")


def of_stations(settings, folder):
    """Impact pressure at stations along the pipe, times the diameter."""
    stations = list_stations(settings)
    data = table(folder, "stations.csv")
    pressure = numpy.stack([data[f"{name} {PRESSURE}"] for name in stations], axis=1)
    return Load(data["time [s]"], numpy.array(list(stations.values())),
                settings.pipe.diameter * pressure, "the impact pressure of stations.csv")


def list_stations(settings):
    """{name: distance along the pipe [m]} by increasing distance."""
    expected = ("a list 'NAME: s, NAME: s' of at least two stations, by increasing distance s "
                "along the pipe in m,")
    try:
        pairs = [part.rsplit(":", 1) for part in settings.needed("Load/Stations").split(",")]
        stations = {name.strip(): float(place) for name, place in pairs}
    except ValueError:
        raise settings.error("Load/Stations", expected) from None
    if len(stations) < 2 or not (numpy.diff(list(stations.values())) > 0).all():
        raise settings.error("Load/Stations", expected)
    return stations


def of_line(settings, folder):
    """Maximum impact pressure along a line of lines.csv, times the diameter. The table has no
    history: the load grows from zero to the envelope."""
    path = os.path.join(folder, "lines.csv")
    if not os.path.isfile(path):
        raise UserError(f"'{folder}' has no lines.csv. Run talus with 'Stations/Lines'.")
    lines = read_lines(path)
    name = settings.needed("Load/Line")
    if name not in lines:
        raise settings.error("Load/Line", "one of the lines of lines.csv (" + ", ".join(lines)
                             + ")")
    if LARGEST_PRESSURE not in lines[name]:
        raise UserError(f"'{path}' has no column '{LARGEST_PRESSURE}'. Run talus with "
                        "'Stations/Drag coefficient' or 'Stations/Bearing factor'.")
    places = lines[name]["distance [m]"]
    envelope = settings.pipe.diameter * numpy.nan_to_num(lines[name][LARGEST_PRESSURE])
    share = numpy.arange(ENVELOPE_PARTS + 1) / ENVELOPE_PARTS
    return Load(share, places, share[:, None] * envelope, f"the line '{name}' of lines.csv")


def of_plan(settings, folder):
    """Force per length of the soil in the columns of the plan series across a route, in time:
    that of the impact pressure by the velocity across the route, over the pipe, or over the soil
    where it is thinner."""
    series = Results(folder).plan()
    if series.dim == 2:
        raise UserError(f"'{folder}' is a run in 2-D, where no route lies on the map. Use "
                        "'Load/Source = obstacle' or 'stations'.")
    drag, bearing = (settings.number(f"Load/{name}", 0) for name in ("Drag coefficient",
                                                                    "Bearing factor"))
    strength = settings.number("Load/Shear strength", 0) if bearing else 0
    s, places, across = places_along(settings, route_of(settings), series.cells.dx)
    columns = numpy.array([series.column(*place) for place in places])
    diameter, values = settings.pipe.diameter, []
    for soil in series.states:
        at = numpy.minimum(numpy.searchsorted(soil.columns, columns), len(soil.columns) - 1)
        found = (soil.columns[at] == columns if len(soil.columns) else
                 numpy.zeros(len(columns), dtype=bool))
        load = numpy.zeros(len(columns))
        # x points east and z south.
        east, south = soil.velocities[at[found], 0], soil.velocities[at[found], 2]
        speed = east * across[found, 0] - south * across[found, 1]
        total = numpy.maximum(numpy.hypot(east, south), 1e-30)
        density = soil.mass / soil.volume if soil.volume > 0 else 0
        load[found] = (numpy.minimum(diameter, soil.volumes[at[found]] / series.area)
                       * (drag * density * speed * abs(speed) / 2
                          + bearing * strength * speed / total))
        values.append(load)
    return Load(numpy.array([soil.time for soil in series.states]), s, numpy.array(values),
                "the soil of plan.csv on the route")


def route_of(settings):
    """Corners of the route on the map, shape (n, 2) [m]."""
    expected = "two or more places on the map, 'easting, northing; easting, northing; ...' in m,"
    try:
        corners = numpy.array([[float(x) for x in place.split(",")]
                               for place in settings.needed("Load/Route").split(";")])
    except ValueError:
        raise settings.error("Load/Route", expected) from None
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 2:
        raise settings.error("Load/Route", expected)
    return corners


def places_along(settings, corners, step):
    """Distances along the route, in the middle of parts of at most `step` [m], their places, and
    the unit vectors across, to the right of the route."""
    s, places, across = [], [], []
    start = 0.
    for one, other in zip(corners, corners[1:]):
        length = numpy.linalg.norm(other - one)
        if length == 0:
            raise settings.error("Load/Route", "places that differ from each other")
        n = int(numpy.ceil(length / step))
        t = (numpy.arange(n) + 0.5) / n
        s.append(start + t * length)
        places.append(one + t[:, None] * (other - one))
        right = numpy.array([other[1] - one[1], one[0] - other[0]]) / length
        across.append(numpy.tile(right, (n, 1)))
        start += length
    return numpy.concatenate(s), numpy.concatenate(places), numpy.concatenate(across)

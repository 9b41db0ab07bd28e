# SPDX-License-Identifier: LGPL-2.1-or-later
"""Places of the mesh on the map."""

import numpy

from talus_tools.parameters import numbers


def origin(run):
    """Easting and northing of x = z = 0 [m]."""
    values = numbers(run.entries.get("Grid/Origin", "0, 0")) or [0, 0]
    return numpy.array(values[:2] if len(values) > 1 else [0, 0], dtype=float)


def on_map(run, x, z):
    """Easting and northing of places [m]; z points to the south."""
    east, north = origin(run)
    return numpy.stack([east + numpy.asarray(x), north - numpy.asarray(z)], axis=-1)


def station_names(run):
    """Names of the stations."""
    return [name.strip() for name, colon, _ in
            (part.partition(":") for part in run.entries.get("Stations/Points", "").split("|"))
            if colon]


def stations_of(run):
    """{name: (easting, northing)} of 'Stations/Points'; what is no place is left out."""
    result, is_on_map = {}, run.entries.get("Stations/Coordinates", "mesh") == "map"
    for part in run.entries.get("Stations/Points", "").split("|"):
        name, _, place = part.partition(":")
        values = numbers(place) if place.strip() else None
        if values and len(values) == 2:
            result[name.strip()] = numpy.array(values) if is_on_map else on_map(run, *values)
    return result

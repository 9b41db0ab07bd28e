# SPDX-License-Identifier: LGPL-2.1-or-later
"""The way of a 3-D slide in plan, along which runout.csv measures, and sections along it."""

import dataclasses

import numpy

from talus_tools.parameters import numbers
from talus_tools.report.on_map import origin

CORNER_DISTANCE = 4  # cells, between corners of the way of the centre of mass
SHARE_OF_MASS = 0.99  # of the start, down to which that way goes on


@dataclasses.dataclass
class Way:
    """A polyline in plan. `corners`: x and z [m], shape (n, 2), two at least, neighbours differ;
    both ends go on straight. `label`: of the axis of distances along it. `name`: the way in
    words."""
    corners: numpy.ndarray
    label: str
    name: str

    def segments(self):
        """Start, unit vector, length [m] and chainage of the start [m] of each segment."""
        steps = numpy.diff(self.corners, axis=0)
        lengths = numpy.linalg.norm(steps, axis=1)
        starts = numpy.concatenate([[0.0], numpy.cumsum(lengths)[:-1]])
        return list(zip(self.corners[:-1], steps / lengths[:, None], lengths, starts))

    def limits(self, k):
        """Distances from the start of segment k between which it reaches [m]."""
        last = len(self.corners) - 2
        return (-numpy.inf if k == 0 else 0.0,
                numpy.inf if k == last else self.segments()[k][2])

    def project(self, places):
        """Distance along the way [m], distance from it [m] and unit vector of the way there, of
        places (x, z), shape (n, 2); a place belongs to the nearest segment."""
        along, away = numpy.zeros(len(places)), numpy.full(len(places), numpy.inf)
        direction = numpy.zeros((len(places), 2))
        for k, (start, vector, _, chainage) in enumerate(self.segments()):
            s = numpy.clip((places - start) @ vector, *self.limits(k))
            distance = numpy.linalg.norm(places - start - s[:, None] * vector, axis=1)
            near = distance < away
            along[near], away[near] = chainage + s[near], distance[near]
            direction[near] = vector
        return along, away, direction

    def width(self, size):
        """Smallest width [m] of strips across the way so that columns of this size in x and z
        leave no strip empty within the soil."""
        return size * max(numpy.abs(vector).sum() for _, vector, _, _ in self.segments())


def straight(place, vector, label, name):
    """A straight way through a place in plan along a unit vector."""
    place = numpy.asarray(place, dtype=float)
    return Way(numpy.array([place, place + vector]), label, name)


def label_of(way):
    """Label of the axis of a section; a section of a 2-D run has no way."""
    return way.label if way else "x [m]"


def along_x(z):
    """The line along x at this z; distances along it are x."""
    return straight((0, z), (1, 0), "x [m]", f"the line along x at z = {z:.4g} m")


def user_corners(run):
    """Corners of 'Runout/Path' in the mesh, shape (n, 2)."""
    corners = numpy.array([numbers(place) for place in
                           run.entries.get("Runout/Path", "").split(";") if place.strip()])
    if run.entries.get("Runout/Coordinates", "mesh") == "map" and len(corners):
        corners = (corners - origin(run)) * (1, -1)
    return corners


def corners_of_centre(run):
    """Way of the centre of mass by statistics.csv: corners every four cells, and no further
    once more than 1 % of the soil has left the mesh, as in runout.csv."""
    table = run.statistics
    centres = numpy.stack([table[f"centre {axis} [m]"] for axis in "xz"], axis=-1)
    is_whole = table["mass [kg]"] >= SHARE_OF_MASS * table["mass [kg]"][0]
    distance = CORNER_DISTANCE * float(run.entries.get("Grid/Cell size", "0"))
    corners = [centres[0]]
    for centre, may_go_on in zip(centres[:-1], is_whole):
        if len(corners) > 1 and not may_go_on:
            break
        if numpy.linalg.norm(centre - corners[-1]) >= distance:
            corners.append(centre)
    if len(corners) > 1 and not is_whole[-1]:
        return numpy.array(corners)
    while len(corners) > 1 and numpy.linalg.norm(centres[-1] - corners[-1]) < distance / 2:
        corners.pop()
    if numpy.linalg.norm(centres[-1] - corners[-1]) > 0:
        corners.append(centres[-1])
    return numpy.array(corners)


def corners_of(run):
    """Corners of the way that runout.csv measures along, shape (n, 2); one only where the soil
    has not moved. 3-D only."""
    corners = user_corners(run)
    return corners if len(corners) else corners_of_centre(run)


def way_of(run):
    """Way that runout.csv measures along; None in 2-D. Soil that has not moved has no way:
    along x through the centre of mass."""
    if run.dimension == 2:
        return None
    corners = corners_of(run)
    if len(corners) < 2:
        return along_x(float(corners[0, 1]))
    if len(user_corners(run)):
        return Way(corners, "distance along the path [m]", "the path of the section Runout")
    return Way(corners, "distance along the way [m]", "the way of the centre of mass")

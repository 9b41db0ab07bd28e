# SPDX-License-Identifier: LGPL-2.1-or-later
"""The steepest path from a release area downwards, and how far a slide may come on it."""

import numpy

from talus_tools.errors import UserError

GRAVITY = 9.81  # m/s^2


def follow(floor, start, sense, is_over):
    """Places, shape (n, 2), along the steepest way down (sense -1) or up (+1), a cell of the sea
    floor apart, to the place for which is_over(places) holds or to the end of the raster. Through
    a hollow and over a top the way goes straight on."""
    step, straight = floor.cell, None
    places = [numpy.asarray(start, dtype=float)]

    def direction(place):
        ends = floor.at(place + step * numpy.array([(1, 0), (-1, 0), (0, 1), (0, -1)]))
        slope = numpy.array([ends[0] - ends[1], ends[2] - ends[3]])
        length = numpy.linalg.norm(slope)
        return sense * slope / length if length > 0 else numpy.zeros(2)

    while not is_over(places):
        onwards = direction(places[-1] + 0.5 * step * direction(places[-1]))
        past = places[-1] - places[max(-len(places), -8)]
        if straight is None and len(places) > 8 and onwards @ past < 0.5 * numpy.linalg.norm(past):
            straight = past / numpy.linalg.norm(past)
        new = places[-1] + step * (onwards if straight is None else straight)
        if not numpy.isfinite(floor.at(new)).all() or (new == places[-1]).all():
            break
        places.append(new)
    return numpy.array(places)


def lengths(places):
    """Length of the way to each place [m]."""
    return numpy.concatenate([[0], numpy.linalg.norm(numpy.diff(places, axis=0), axis=1).cumsum()])


def steepest_path(floor, release, soil, most):
    """Places along the way, shape (n, 2), and whether it ends where a block of soil as thick as
    the release comes to rest (else the raster or `most` [m] ends it). The block, without water and
    with the bed shear stress of the soil, runs further than the middle of a slide."""
    start = release.largest.middle()
    up = follow(floor, start, 1, lambda places: not release.is_near(places[-1]))
    heights = [float(floor.at(start)[0])]
    if not numpy.isfinite(heights[0]):
        raise UserError("The raster has no height in the middle of the release area. Check both "
                        "files and their coordinate systems.")
    energy = [0.]
    loss = soil.bed_shear_stress / (soil.density * release.depth)

    def is_over(places):
        if len(places) > len(heights):
            heights.append(float(floor.at(places[-1])[0]))
            weight = GRAVITY * soil.submerged_density / soil.density
            energy.append(energy[-1] + weight * (heights[-2] - heights[-1]) - loss * floor.cell)
        outside = not release.is_near(places[-1])
        return ((energy[-1] <= 0 and outside) or len(places) * floor.cell > most)

    down = follow(floor, start, -1, is_over)
    if len(down) < 2 or len(up) < 2:
        raise UserError("The sea floor has no slope in the middle of the release area. Move the "
                        "area to a slope, or check the raster.")
    return numpy.concatenate([up[:0:-1], down]), bool(energy[-1] <= 0), max(energy)


def simplified(places, tolerance):
    """The fewest corners of a line that stays within a tolerance [m] (Douglas and Peucker)."""
    keep = {0, len(places) - 1}
    parts = [(0, len(places) - 1)]
    while parts:
        i, k = parts.pop()
        if k - i < 2:
            continue
        along = places[k] - places[i]
        away = places[i + 1:k] - places[i]
        size = numpy.linalg.norm(along)
        distance = (abs(along[0] * away[:, 1] - along[1] * away[:, 0]) / size if size > 0
                    else numpy.linalg.norm(away, axis=1))
        at = int(distance.argmax())
        if distance[at] > tolerance:
            keep.add(i + 1 + at)
            parts += [(i, i + 1 + at), (i + 1 + at, k)]
    return places[sorted(keep)]


def place_at(places, distance):
    """Place on a line after a length [m]."""
    way = lengths(places)
    return numpy.array([numpy.interp(distance, way, places[:, axis]) for axis in (0, 1)])

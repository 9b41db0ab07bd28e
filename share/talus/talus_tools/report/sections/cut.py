# SPDX-License-Identifier: LGPL-2.1-or-later
"""Upright sections through 3-D fields along a way in plan; of 2-D fields all is in it."""

import numpy

LENGTH = "box length [m]"
PLAN = [0, 2]


def half_lengths(corners, values):
    """Half of each point's box along the axes [m], shape (points, 3)."""
    if corners.shape[1] > 2:
        return numpy.ptp(corners, axis=1) / 2
    if LENGTH in values:
        return values[LENGTH] / 2
    return numpy.full((len(corners), 3), 0.05)


def around(centres, half):
    """Rectangles, shape (points, 4, 2), about centres with half lengths, each (points, 2)."""
    signs = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    return centres[:, None, :] + signs * half[:, None, :]


def cut_points(corners, values, way):
    """Outlines in the section, shape (points, 4, 2), and values of the points whose boxes the
    section along the way cuts; all of them where the way is None."""
    if way is None:
        return rectangles(corners, values), values
    half, centres = half_lengths(corners, values), corners.mean(axis=1)
    along, away, direction = way.project(centres[:, PLAN])
    hit = away <= numpy.abs(direction * half[:, PLAN][:, ::-1]).sum(axis=1)
    length = numpy.abs(direction * half[:, PLAN]).sum(axis=1)
    outlines = around(numpy.stack([along, centres[:, 1]], axis=-1)[hit],
                      numpy.stack([length, half[:, 1]], axis=-1)[hit])
    return outlines, {name: array[hit] for name, array in values.items()}


def rectangles(corners, values):
    """Outlines of 2-D points, shape (points, 4, 2): quadrilaterals as they are, of all others
    the box."""
    if corners.shape[1] == 4:
        return corners[:, :, :2]
    return around(corners.mean(axis=1)[:, :2], half_lengths(corners, values)[:, :2])


def cut_surface(corners, way):
    """Lines of a surface, shape (lines, 2, 2): its own in 2-D, those where the section along
    the way cuts its triangles in 3-D."""
    if way is None or corners.shape[1] != 3:
        return corners[:, :, :2]
    parts = []
    for k, (start, vector, _, chainage) in enumerate(way.segments()):
        from_start = corners[:, :, PLAN] - start
        across = from_start @ (-vector[1], vector[0])
        in_plane = numpy.stack([from_start @ vector, corners[:, :, 1]], axis=-1)
        lines = clipped(cut_triangles(in_plane, across), *way.limits(k))
        parts.append(lines + (chainage, 0.0))
    return numpy.concatenate(parts)


def cut_triangles(places, across):
    """Lines, shape (lines, 2, 2), in which triangles with these corners, shape (n, 3, 2), in a
    plane and distances from the plane, shape (n, 3), meet the plane."""
    above = across > 0
    hit = above.any(axis=1) & ~above.all(axis=1)
    places, across, above = places[hit], across[hit], above[hit]
    # The corner that is alone on its side of the plane, and the two others.
    alone = numpy.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = numpy.arange(len(places))
    first, height, ends = places[row, alone], across[row, alone], []
    for other in ((alone + 1) % 3, (alone + 2) % 3):
        share = height / (height - across[row, other])
        ends.append(first + share[:, None] * (places[row, other] - first))
    return numpy.stack(ends, axis=1)


def clipped(lines, low, high):
    """The parts of lines, shape (n, 2, 2), with a first coordinate from low to high."""
    lines = lines[(lines[:, :, 0].max(axis=1) > low) & (lines[:, :, 0].min(axis=1) < high)]
    first, step = lines[:, :1], lines[:, 1:] - lines[:, :1]
    length = numpy.where(step[..., :1] == 0, 1.0, step[..., :1])
    share = (numpy.clip(lines[..., :1], low, high) - first[..., :1]) / length
    return first + share * step


def middle(corners, weights):
    """The place in plan, x and z, in the middle of what weighs most."""
    centres = corners.mean(axis=1)[:, PLAN]
    total = weights.sum()
    return weights @ centres / total if total > 0 else centres.mean(axis=0)

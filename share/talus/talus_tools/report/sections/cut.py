# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections through 3-D fields on a plane of constant z; of 2-D fields all is in it."""

import numpy

LENGTH = "box length [m]"


def half_lengths(corners, values):
    """Half of each point's box along the axes [m], shape (points, 3)."""
    if corners.shape[1] > 2:
        return numpy.ptp(corners, axis=1) / 2
    if LENGTH in values:
        return values[LENGTH] / 2
    return numpy.full((len(corners), 3), 0.05)


def cut_points(corners, values, z):
    """Those points whose boxes the plane cuts; all of them where z is None."""
    if z is None:
        return corners, values
    centres = corners.mean(axis=1)[:, 2]
    hit = numpy.abs(centres - z) <= half_lengths(corners, values)[:, 2]
    return corners[hit], {name: array[hit] for name, array in values.items()}


def rectangles(corners, values):
    """Outlines of the points in the plane, shape (points, 4, 2): quadrilaterals as they are,
    of all others the box."""
    if corners.shape[1] == 4:
        return corners[:, :, :2]
    signs = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    half = half_lengths(corners, values)[:, :2]
    return corners.mean(axis=1)[:, None, :2] + signs * half[:, None, :]


def cut_surface(corners, z):
    """Lines of a surface, shape (lines, 2, 2): its own in 2-D, those where the plane cuts
    its triangles in 3-D."""
    if z is None or corners.shape[1] != 3:
        return corners[:, :2, :2]
    above = corners[:, :, 2] > z
    corners = corners[above.any(axis=1) & ~above.all(axis=1)]
    above = corners[:, :, 2] > z
    # The corner that is alone on its side of the plane, and the two others.
    alone = numpy.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = numpy.arange(len(corners))
    first = corners[row, alone]
    ends = []
    for other in (corners[row, (alone + 1) % 3], corners[row, (alone + 2) % 3]):
        share = (z - first[:, 2]) / (other[:, 2] - first[:, 2])
        ends.append((first + share[:, None] * (other - first))[:, :2])
    return numpy.stack(ends, axis=1)


def middle(corners, weights):
    """The z of the plane through the middle of what weighs most."""
    centres = corners.mean(axis=1)[:, 2]
    total = weights.sum()
    return float(centres @ weights / total) if total > 0 else float(centres.mean())

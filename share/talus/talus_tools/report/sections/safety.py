# SPDX-License-Identifier: LGPL-2.1-or-later
"""Equilibrium and factor of safety, with the mechanism of failure."""

import numpy

from talus_tools.report.page import Lines, Section, embed, subplots
from talus_tools.report.sections.cut import PLAN, cut_points, middle
from talus_tools.report.sections.soil import boxes, frame
from talus_tools.report.way import label_of, straight


def downhill(run, motion):
    """The mechanism in the direction in which gravity does work on it: its sign is free."""
    angle = numpy.radians(float(run.entries.get("Gravity/Slope angle", "0")))
    work = motion[:, 0].sum() * numpy.sin(angle) - motion[:, 1].sum() * numpy.cos(angle)
    return motion if work >= 0 else -motion


def line_of_motion(corners, motion):
    """Straight way in plan through the middle of what moves, along its mean motion; along x
    where parts move against each other."""
    size = numpy.linalg.norm(motion, axis=1)
    mean = motion[:, PLAN].sum(axis=0)
    length = numpy.linalg.norm(mean)
    vector = mean / length if length > 0.05 * size.sum() else numpy.array([1.0, 0.0])
    return straight(middle(corners, size), vector, "distance along the motion [m]",
                    "the mean motion, through the middle of what moves")


def mechanism(run, name, caption):
    """How the soil moves when it fails, the largest component being 1."""
    series = run.series(name)
    if series is None:
        return []
    corners, values = series.read(series.times[-1])
    motion, way = downhill(run, values["mechanism [-]"]), None
    if run.dimension == 3:
        way = line_of_motion(corners, motion)
        x, z = way.corners[0]
        caption += f" Section along {way.name}, x = {x:.4g} m, z = {z:.4g} m."
        motion = numpy.stack([motion[:, PLAN] @ (way.corners[1] - way.corners[0]), motion[:, 1]],
                             axis=-1)
    outlines, values = cut_points(corners, {**values, "motion": motion}, way)
    motion = values["motion"][:, :2]
    speed = numpy.linalg.norm(motion, axis=1)
    places = outlines.mean(axis=1)
    window, height = frame([outlines], 1)
    figure, axes = subplots(height=height + 0.5)
    drawn = axes.add_collection(boxes(outlines, speed / speed.max(), (0, 1)))
    moving = numpy.flatnonzero(speed > 0.15 * speed.max())
    shown = numpy.random.default_rng(1).choice(moving, min(70, len(moving)), replace=False)
    axes.quiver(places[shown, 0], places[shown, 1], motion[shown, 0], motion[shown, 1],
                color="black", scale=28, width=0.0014)
    axes.set(xlim=window[:2], ylim=window[2:], xlabel=label_of(way), ylabel="y [m]")
    axes.grid(False)
    figure.colorbar(drawn, ax=axes, label="motion [-]", pad=0.01)
    return [embed(figure, caption, "png")]


def verdict(run):
    """The factor in plain words."""
    found = run.log.factor_of_safety()
    if found is None:
        return []
    factor, bound = found
    if factor < 1 and bound != "more than":
        word = "Below 1: with the strength given the soil does not stand."
    elif factor < 1.3 and bound != "more than":
        word = ("The soil stands, by less than the margin of 1.3 to 1.5 that is usual for slopes; "
                "which one is required is for the standard of the project to say.")
    else:
        word = "The soil stands; compare with the margin that the standard of the project requires."
    return [f"{run.log.safety} {word}"]


def safety(run):
    """Where the run had static stages."""
    parts = [Lines(verdict(run) or ["There is no factor of safety: the stage 'strength "
                                    "reduction' did not run, or did not end."]),
             Lines([line for line in run.log.results if line != run.log.safety])]
    parts += mechanism(run, "mechanism", "How the soil fails when its strength is divided by "
                       "the factor of safety: what is bright moves, arrows say where "
                       "to, what is dark stays. The edge between them is the slip surface.")
    parts += mechanism(run, "no-equilibrium", "No equilibrium was found: how the soil moves.")
    if not run.log.results and len(parts) == 2 and run.stages.strip() == "dynamics":
        return None
    return Section("safety", "Factor of safety",
                   "By how much the strength of the soil (and of the seabed) can be divided until "
                   "the slope fails: 1 is the verge of failure.", parts)

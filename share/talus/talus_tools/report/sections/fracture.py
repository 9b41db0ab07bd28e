# SPDX-License-Identifier: LGPL-2.1-or-later
"""Signs of numerical fracture."""

from talus_tools.report.notices import fracture as found_fracture
from talus_tools.report.page import COLORS, Lines, Section, embed, subplots
from talus_tools.report.sections.summary import summary

MEANINGS = {
    "empty interior cells": ("empty interior cells", "Holes: cells without soil that have soil "
                             "above and below. Sound: 0."),
    "empty columns": ("empty columns", "Gaps over the whole depth. Sound: 0."),
    "connected bodies": ("connected bodies", "Pieces that do not touch. Sound: as many as "
                         "at the start."),
    "cells with one point": ("cells with one point", "Some lie along every surface; many mean "
                             "that the soil is about to tear."),
    "splits": ("splits", "How often a point was split so that the soil stays whole."),
    "largest generation": ("largest generation", "Largest number of splits behind one point."),
    "clipped boxes": ("clipped boxes", "Axes along which a box is shorter or longer than the "
                      "weights can take. Short ones are common in thin layers, and harmless."),
    "points at generation limit": ("at the largest generation", "Points that should be split, but "
                                   "'Splitting/Maximum generation' forbids it. Sound: 0."),
    "points at mesh limit": ("at the edge of the mesh", "Points that should be split, but their "
                             "children would lie outside the mesh. Sound: 0."),
    "points at length limit": ("at the minimum length", "Points stretched beyond the threshold "
                               "that are shorter than 'Splitting/Minimum length': common, and "
                               "harmless, since they fit into their cell."),
}


def picture(run):
    """The four counts over time."""
    time = run.statistics["time [s]"]
    figure, axes = subplots(1, 4, height=2.1)
    for one, name, color in zip(axes, MEANINGS, COLORS):
        one.step(time, run.statistics[name], where="post", color=color)
        one.set_title(name)
        one.set(xlabel="time [s]", xlim=(0, time[-1]))
        one.set_ylim(0, max(1.05 * run.statistics[name].max(), 1.5))
    return embed(figure, "Counts of fracture over time: a sound run has lines at 0, 0 and the "
                 "number of bodies at the start.")


def fracture(run):
    """A plain verdict, the counts, and the table."""
    sentences = found_fracture(run) or [
        "Sound: no holes, no gaps, and no more pieces than at the start, in every row."]
    figures = [picture(run)] if len(run.statistics) > 1 else []
    return Section("fracture", "Numerical fracture",
                   "A material point method may tear soil where nothing broke. These counts would "
                   "show it.", [Lines(sentences)] + figures + [summary(run, MEANINGS)])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far and how fast the soil went."""

import numpy

from talus_tools.report.page import (BLUE, GREEN, GREY, RED, Folded, Section, embed,
                                     subplots)
from talus_tools.report.sections.summary import summary

MEANINGS = {
    "front x [m]": ("front", "How far the foremost point is: what the slide reaches at most."),
    "front of 99.5 % mass x [m]": (
        "front of 99.5 % of the mass", "The front without single points far ahead; the better "
        "one of the two for damage."),
    "front of thick soil x [m]": (
        "front of thick soil", "The nose: where the soil is thicker than `Runout/Smallest "
        "thickness`."),
    "rear x [m]": ("rear", "Smallest x of a point: how far the scarp went back."),
    "height [m]": ("height", "Largest height of a point above the bottom or the ground."),
    "centre x [m]": ("centre of mass, x", "How far the soil went as a whole."),
    "centre velocity x [m/s]": (
        "velocity of the centre of mass", "How fast the soil moves as a whole."),
    "maximum speed [m/s]": ("largest speed", "On the grid; 99.9 % of the mass is not faster."),
    "maximum speed of points [m/s]": (
        "largest speed of a point", "An upper bound for impacts; single points are noisy, up to "
        "1 m/s in soil at rest."),
    "points": ("material points", "Points split where the flow stretches: more points, the same "
               "mass."),
}


ALONG_PATH = {
    "runout [m]": ("runout", "How far the front is beyond that of the start, along the way of the "
                   "slide."),
    "front along path [m]": ("front", "Outer edge of the foremost column that is thick enough, "
                             "from the centre of mass at the start on."),
    "rear along path [m]": ("rear", "Outer edge of the last column: how far the scarp went back."),
    "centre along path [m]": ("centre of mass", "How far the soil went as a whole."),
    "speed of the centre [m/s]": ("speed of the centre of mass", "How fast the soil moves as a "
                                  "whole, in plan."),
    "largest depth-mean speed [m/s]": ("largest mean speed over the depth", "Of the columns: for "
                                       "impacts better than the speed of single points."),
    "length in plan [m]": ("length in plan", "Covered by soil."),
    "area in plan [m^2]": ("area in plan", "Covered by soil."),
}
# (column, label, style) of places and of speeds: along the way of the slide, and along x.
PATH_CURVES = (
    (("front along path [m]", "front", {"color": BLUE}),
     ("centre along path [m]", "centre of mass", {"color": GREY}),
     ("rear along path [m]", "rear", {"color": RED})),
    (("speed of the centre [m/s]", "centre of mass", {"color": GREY}),
     ("largest depth-mean speed [m/s]", "fastest column", {"color": RED})))
X_CURVES = (
    (("front x [m]", "front", {"color": BLUE}),
     ("front of 99.5 % mass x [m]", "front of 99.5 % mass", {"color": BLUE, "ls": "--"}),
     ("centre x [m]", "centre of mass", {"color": GREY}),
     ("rear x [m]", "rear", {"color": RED})),
    (("centre velocity x [m/s]", "centre of mass, x", {"color": GREY}),
     ("maximum speed [m/s]", "fastest soil", {"color": RED})))


def history(run, table, curves, where):
    """Front and rear, speeds, and the number of points over time."""
    figure, (place, speed, points) = subplots(1, 3, height=2.7)
    for axes, some in zip((place, speed), curves):
        for column, label, style in some:
            if column in table:
                axes.plot(table["time [s]"], table[column], label=label, **style)
    place.set_title(where)
    speed.set_title("velocity [m/s]")
    points.plot(run.statistics["time [s]"], run.statistics["points"], color=GREEN)
    points.set_title("material points")
    points.set_ylim(bottom=0)
    for axes in (place, speed, points):
        axes.set(xlabel="time [s]", xlim=(0, max(run.time, 1e-12)))
    # Room for the legends above the lines.
    for axes in (place, speed):
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.35 * (high - low))
        axes.legend(loc="upper left", labelspacing=0.2)
    if speed.get_lines()[0].get_ydata().min() >= 0:
        speed.set_ylim(bottom=0)
    return embed(figure, "Where the soil is, how fast it is and by how many points it is carried, "
                 "over time. A front that runs level at the end has come to rest.")


def parts_of(run, table, curves, where, meanings):
    """Picture and table; without rows beyond the first the table only."""
    pictures = [history(run, table, curves, where)] if len(table) > 1 else []
    return pictures + [meanings_table(run, table, meanings)]


def meanings_table(run, table, meanings):
    """Rows of the table; speeds count from the start on, when there is no way yet."""
    result = summary(run, meanings, table)
    if table is not run.statistics:
        speeds = {column: said for column, said in meanings.items() if "speed" in column}
        whole = iter(summary(run, speeds, run.tables["runout"]).rows)
        result.rows = [next(whole) if "speed" in row[1].column else row for row in result.rows]
    return result


def runout(run):
    """Along the way of the slide where the run noted it; else along x."""
    along_x = parts_of(run, run.statistics, X_CURVES, "position x [m]", MEANINGS)
    table = run.tables["runout"]
    if table is None:
        return Section("runout", "Runout",
                       "Positions of the centres of the points along x, the direction down the "
                       "slope; the soil itself reaches half a point further.", along_x)
    # Before the slide moves it has no way, and all distances are 0.
    moved = numpy.flatnonzero(table["front along path [m]"] != table["rear along path [m]"])
    table = table.since(moved[0] if len(moved) else 0)
    return Section("runout", "Runout",
                   "Along the way of the slide in plan, from the centre of mass at the start on; "
                   f"soil counts where it is thicker than {run.smallest_thickness('Runout'):g} m.",
                   parts_of(run, table, PATH_CURVES, "distance along the way [m]", ALONG_PATH)
                   + [Folded("Positions and velocities of the points along x", along_x)])

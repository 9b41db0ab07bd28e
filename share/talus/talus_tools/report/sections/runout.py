# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far and how fast the soil went."""

from talus_tools.report.page import BLUE, GREEN, GREY, RED, Section, embed, subplots
from talus_tools.report.sections.summary import summary

MEANINGS = {
    "front x [m]": ("front", "How far the foremost point is: what the slide reaches at most."),
    "front of 99.5 % mass x [m]": (
        "front of 99.5 % of the mass", "The front without single points far ahead; the better "
        "one of the two for damage."),
    "rear x [m]": ("rear", "Smallest x of a point: how far the scarp went back."),
    "height [m]": ("height", "Largest height of a point above the bottom or the ground."),
    "centre x [m]": ("centre of mass, x", "How far the soil went as a whole."),
    "centre velocity x [m/s]": (
        "velocity of the centre of mass", "How fast the soil moves as a whole."),
    "maximum speed [m/s]": (
        "largest speed of a point", "An upper bound for impacts; single points are noisy, up to "
        "1 m/s in soil at rest."),
    "points": ("material points", "Points split where the flow stretches: more points, the same "
               "mass."),
}


def history(run):
    """Front and rear, speeds, and the number of points over time."""
    table, time = run.statistics, run.statistics["time [s]"]
    figure, (place, speed, points) = subplots(1, 3, height=2.7)
    for column, label, style in (
            ("front x [m]", "front", {"color": BLUE}),
            ("front of 99.5 % mass x [m]", "front of 99.5 % mass", {"color": BLUE, "ls": "--"}),
            ("centre x [m]", "centre of mass", {"color": GREY}),
            ("rear x [m]", "rear", {"color": RED})):
        if column in table:
            place.plot(time, table[column], label=label, **style)
    place.set_title("position x [m]")
    speed.plot(time, table["centre velocity x [m/s]"], color=GREY, label="centre of mass, x")
    speed.plot(time, table["maximum speed [m/s]"], color=RED, label="fastest point")
    speed.set_title("velocity [m/s]")
    points.plot(time, table["points"], color=GREEN)
    points.set_title("material points")
    points.set_ylim(bottom=0)
    for axes in (place, speed, points):
        axes.set(xlabel="time [s]", xlim=(0, max(time[-1], 1e-12)))
    # Room for the legends above the lines.
    for axes in (place, speed):
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.35 * (high - low))
        axes.legend(loc="upper left", labelspacing=0.2)
    if speed.get_lines()[0].get_ydata().min() >= 0:
        speed.set_ylim(bottom=0)
    return embed(figure, "Where the soil is, how fast it is and by how many points it is carried, "
                 "over time. A front that runs level at the end has come to rest.")


def runout(run):
    """Without rows beyond the first there is a table only."""
    parts = [history(run)] if len(run.statistics) > 1 else []
    parts.append(summary(run, MEANINGS))
    return Section("runout", "Runout",
                   "Positions of the centres of the points along x, the direction down the slope; "
                   "the soil itself reaches half a point further.", parts)

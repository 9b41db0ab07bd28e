# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces on obstacles and on the faces of the mesh."""

import numpy

from talus_tools.report.page import (BLUE, COLORS, RED, Cell, Folded, Lines, Rows, Section, embed,
                                     subplots)
from talus_tools.report.places import structure_names
from talus_tools.units import largest, scaled, show, unit_of

HEAD = ["quantity", "largest mean over a row", "at t =", "largest running mean",
        "largest in any step", "mean over the run", "what it means"]
FACES = ("Left", "Right", "Bottom", "Top", "Back", "Front")
AXES = {"x": "Along the slope: drag; positive where the soil pushes along x.",
        "y": "Across the slope: negative presses down, positive lifts.",
        "z": "Sideways."}


def having_forces(table, names):
    """Those obstacles or faces that have columns in the table."""
    return [name for name in names if f"{name} force x [N]" in table.names]


def has_running_means(table, name):
    """Whether the run averaged forces over time, which older ones did not."""
    return f"{name} largest mean force x [N]" in table


def peak(table, name, axis, kind=""):
    """Least and largest component in any step, or of the running mean (kind " mean")."""
    both = [table[f"{name} {which}{kind} force {axis} [N]"] for which in ("least", "largest")]
    return min(both[0].min(), 0), max(both[1].max(), 0)


def history(table, name, dimension):
    """Components over time, with the range of the running mean or of single steps."""
    kind = " mean" if has_running_means(table, name) else ""
    time = table["time [s]"]
    axes_of_space = "xyz"[:dimension]
    unit = unit_of("[N]", dimension)
    figure, axes = subplots(1, dimension, height=2.3)
    for one, axis, color in zip(axes, axes_of_space, (BLUE, RED, COLORS[2])):
        force = table[f"{name} force {axis} [N]"]
        scale, shown_unit = scaled(max(map(abs, peak(table, name, axis, kind))), unit)
        one.fill_between(time, table[f"{name} least{kind} force {axis} [N]"] / scale,
                         table[f"{name} largest{kind} force {axis} [N]"] / scale, step="pre",
                         color=color, alpha=0.2, lw=0)
        one.plot(time, force / scale, color=color)
        one.set_title(f"force {axis} [{shown_unit}]")
        one.set(xlabel="time [s]", xlim=(0, time[-1]))
    return embed(figure, f"{name}: the force over time. Line: mean over each row of the table; "
                 "band: least and largest value "
                 + ("of the running mean over 'Force averaging time'." if kind
                    else "of any step in it."))


def rows_of(table, name, dimension):
    """Extremes and means of each component, and the moment, area and works."""
    time, unit, rows = table["time [s]"], unit_of("[N]", dimension), []
    for axis in "xyz"[:dimension]:
        column = f"{name} force {axis} [N]"
        at = largest(table[column])
        step = max(peak(table, name, axis), key=abs)
        running = (show(max(peak(table, name, axis, " mean"), key=abs), unit)
                   if has_running_means(table, name) else "–")
        mean = table[f"{name} impulse {axis} [N s]"][-1] / time[-1] if time[-1] > 0 else 0
        rows.append([f"force {axis}", Cell(show(table[column][at], unit),
                                           repr(float(table[column][at])), column),
                     show(time[at], "s"), running, show(step, unit), show(mean, unit), AXES[axis]])
    for column, what, sentence in (
            (f"{name} moment z [N m]", "moment z", "About its reference point: what overturns."),
            (f"{name} contact area [m]" if dimension == 2 else f"{name} contact area [m^2]",
             "contact area", "As far as soil fills the cells at its surface.")):
        if column in table:
            at = largest(table[column])
            rows.append([what, Cell(show(table[column][at], unit_of(column, dimension)),
                                    repr(float(table[column][at])), column),
                         show(time[at], "s"), "–", "–", "–", sentence])
    return rows


def contact(table, name):
    """When the soil arrives."""
    column = f"{name} contact area"
    touched = numpy.flatnonzero(table[column] > 0) if column in table else []
    if not len(touched):
        return f"{name}: the soil never touches it."
    return f"{name}: the soil touches it from t = {table['time [s]'][touched[0]]:.4g} s on."


def parts_of(run, table, name):
    """Picture and table of one obstacle or face."""
    pictures = [history(table, name, run.dimension)] if len(table) > 1 else []
    return pictures + [Lines([contact(table, name)]),
                       Rows(HEAD, rows_of(table, name, run.dimension))]


def obstacles(run):
    """Forces on structures; those on terrains, which are the ground, are folded."""
    table = run.tables["obstacles"]
    if table is None:
        return None
    structures = structure_names(run).values()
    names = having_forces(table, run.obstacle_names())
    ground = [name for name in names if name not in structures]
    parts = [part for name in names if name in structures
             for part in parts_of(run, table, name)]
    parts += [Folded(f"Forces on {name}, which is the ground", parts_of(run, table, name))
              for name in ground]
    return Section("obstacles", "Forces on obstacles",
                   "What the soil does to each obstacle. A structure feels the means over a row "
                   "and the running mean; single steps have peaks that are partly numerical.",
                   parts)


def faces(run):
    """Forces on the faces of the mesh."""
    table = run.tables["boundaries"]
    if table is None:
        return None
    return Section("faces", "Forces on the faces of the mesh",
                   "What the soil does to the seabed and the walls at the edge of the mesh.",
                   [part for name in having_forces(table, FACES)
                    for part in parts_of(run, table, name)])

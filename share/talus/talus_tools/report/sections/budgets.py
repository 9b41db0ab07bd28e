# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mass, momentum and energy: what the method must conserve."""

import numpy

from talus_tools.report.notices import energy_scale
from talus_tools.report.page import (COLORS, GREY, Cell, Lines, Rows, Section, embed,
                                     subplots)
from talus_tools.report.sections.summary import summary
from talus_tools.units import plain, scaled, show, unit_of

ENERGIES = {
    "gravity work [J]": ("work of gravity", "All that drives the slide comes from here."),
    "kinetic energy [J]": ("kinetic energy", "What the slide could do to whatever stands in its "
                           "way."),
    "elastic energy [J]": ("elastic energy", "Stored in the soil; it comes back."),
    "plastic work [J]": ("plastic work", "Used up by shearing and remoulding the soil."),
    "friction work [J]": ("work of friction", "Used up along the seabed and obstacles."),
    "drag work [J]": ("work of drag", "Taken by the water around the slide."),
    "added mass kinetic energy [J]": ("energy of the added mass", "Of the water that moves with "
                                      "the soil."),
    "contact work [J]": ("work of contact", "Taken by walls, normal contact and prescribed "
                         "motion; negative where they drive the soil."),
    "damping work [J]": ("work of damping", "Used up by numerical damping; none unless asked "
                         "for."),
    "pore pressure work [J]": ("work of the pore pressure", "Given to soil that swells, by pore "
                               "water whose pressure is given."),
    "water energy [J]": ("energy of the pore water", "Stored by water that undrained soil "
                         "compresses."),
    "outflow energy [J]": ("energy of outflow", "Taken along by soil that left the mesh."),
    "inflow energy [J]": ("energy of inflow", "Brought by soil that entered the mesh."),
    "energy remainder [J]": ("remainder", "What the sum of all others misses: an error of the "
                             "method, positive where energy was lost."),
}


def mass(run):
    """The mass must stay what it was."""
    values = run.balanced_mass()
    change = numpy.abs(values - values[0]).max() / values[0]
    table = summary(run, {
        "mass [kg]": ("mass", "The points carry it; none may be lost."),
        "outflow mass [kg]": ("mass that left", "Through faces of outflow."),
        "inflow mass [kg]": ("mass that entered", "Through faces of inflow.")})
    passed = [words for words, history in (("with what left", run.outflow("mass", "kg")),
                                           ("less what entered", run.inflow("mass", "kg")))
              if history.any()]
    what = ", ".join(["The mass", *passed]) + ("," if passed else "")
    said = (f"{what} did not change by a single bit." if change == 0 else
            f"{what} changed by at most {plain(change)} of itself. " +
            ("That is nothing but round-off." if change < 1e-9 else
             "It must not: see the notice at the top."))
    return Section("mass", "Mass budget", "Soil can neither vanish nor appear.",
                   [table, Lines([said])])


def impulses(run):
    """(name, history, sentence) of what changed the momentum along x."""
    table = run.statistics
    time, result = table["time [s]"], []
    gravity = run.gravity()
    if gravity is not None:
        # Momentum is that of half a step before the time of its row.
        lag = 0.5 * table["time step [s]"]
        result.append(("gravity", table["mass [kg]"][0] * gravity * (time - lag),
                       "m' g sin(slope) t: the downslope part of the submerged weight, over time."))
    result.append(("seabed", table["seabed impulse x [N s]"],
                   "Friction on the seabed: negative where it brakes."))
    if "drag impulse x [N s]" in table:
        result.append(("drag", table["drag impulse x [N s]"],
                       "What the water took by drag: negative where it brakes."))
        added = table["added mass momentum x [kg m/s]"]
        result.append(("added mass", added[0] - added,
                       "What the soil gave to the water that moves with it."))
    if run.inflow("mass", "kg").any():
        result.append(("inflow", run.inflow("momentum x", "kg m/s"),
                       "What soil that entered brought along."))
    if run.outflow("mass", "kg").any():
        result.append(("outflow", -run.outflow("momentum x", "kg m/s"),
                       "What soil that left took along."))
    obstacles = run.tables["obstacles"]
    columns = [f"{name} impulse x [N s]" for name in run.obstacle_names()]
    columns = [column for column in columns if obstacles and column in obstacles]
    if columns:
        taken = sum(numpy.interp(time, obstacles["time [s]"], obstacles[n]) for n in columns)
        result.append(("obstacles", -taken, "What obstacles took: negative where they brake."))
    return result


def momentum(run):
    """Momentum along x against the impulses that made it."""
    table = run.statistics
    time, p = table["time [s]"], table["momentum x [kg m/s]"]
    unit = unit_of("[kg m/s]", run.dimension)
    parts = impulses(run)
    others = p - p[0] - sum(history for _, history, _ in parts)
    closed = run.gravity() is not None
    parts.append(("the rest", others, ("Walls, prescribed motion and damping; without them, the "
                                       "error of the balance." if closed else
                                       "Gravity, walls, prescribed motion and damping.")))
    rows = [["momentum along x at the end", Cell(show(p[-1], unit), repr(float(p[-1])),
                                                 "momentum x [kg m/s]"),
             "Mass times velocity of its centre: the impulse it takes to stop the slide."]]
    rows += [[f"impulse of {name}" if name != "the rest" else name, show(history[-1], unit),
              sentence] for name, history, sentence in parts]
    figures = []
    if len(time) > 1:
        figure, axes = subplots(height=2.6)
        factor, shown_unit = scaled(max(numpy.abs(h).max() for _, h, _ in parts), unit)
        axes.plot(time, (p - p[0]) / factor, color="black", lw=2, label="change of momentum")
        for (name, history, _), color in zip(parts, COLORS):
            axes.plot(time, history / factor, color=color, label=name, lw=1.2)
        axes.set(xlabel="time [s]", ylabel=f"[{shown_unit}]", xlim=(0, time[-1]))
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
        figures.append(embed(figure, "The change of momentum along x (black) is the sum of the "
                             "impulses (coloured)."))
    return Section("momentum", "Momentum budget",
                   "What gravity gives along the slope, friction and obstacles take.",
                   figures + [Rows(["quantity", "at the end", "what it means"], rows)])


def energy_picture(run):
    """Where the work of gravity went."""
    table, time = run.statistics, run.statistics["time [s]"]
    known = [name for name in ENERGIES if name in table]
    factor, unit = scaled(max(numpy.abs(table[name]).max() for name in known),
                          unit_of("[J]", run.dimension))
    figure, axes = subplots(height=3)
    axes.plot(time, table["gravity work [J]"] / factor, color="black", lw=2,
              label="work of gravity")
    names = [name for name in known if name not in ("gravity work [J]", "energy remainder [J]")
             and numpy.abs(table[name]).max() > 0]
    for name, color in zip(names, COLORS):
        start = 0 if name.startswith("kinetic") else table[name][0]
        axes.plot(time, (table[name] - start) / factor, label=ENERGIES[name][0], color=color,
                  lw=1.2)
    axes.plot(time, table["energy remainder [J]"] / factor, color=GREY, ls=":", label="remainder")
    axes.set(xlabel="time [s]", ylabel=f"[{unit}]", xlim=(0, time[-1]))
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return embed(figure, "Where the work of gravity (black) went. All but the kinetic energy "
                 "count from the start; the dotted remainder should lie on zero.")


def energy(run):
    """Energies, and how well they add up."""
    table = run.statistics
    scale, name = energy_scale(table)
    worst = numpy.abs(table["energy remainder [J]"]).max()
    share = f"The remainder is at most {plain(100 * worst / scale, 3)} % of {name}." if scale else (
        "Nothing has moved yet.")
    if scale:
        share += (" Below 1 %: the budget closes well." if worst <= 0.01 * scale else
                  " More than 1 %: take the results with care.")
    figures = [energy_picture(run)] if len(table) > 1 else []
    return Section("energy", "Energy budget",
                   "What gravity puts in must be found again as motion, stored energy, or work "
                   "used up.", figures + [summary(run, ENERGIES), Lines([share])])

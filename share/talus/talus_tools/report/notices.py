# SPDX-License-Identifier: LGPL-2.1-or-later
"""What whoever uses the results must see first."""

import os

import numpy

from talus_tools.report.run import has_rows
from talus_tools.units import plain, show, unit_of

# Shares above which a budget is not closed well enough to be left unsaid.
ENERGY, MASS, LEDGER = 0.01, 1e-9, 1e-9

# Depth below a surface, in cells, and departure of the contact area from the area under the
# soil, above which they are told.
BELOW_SURFACE, CONTACT_AREA = 0.1, 0.05


def energy_scale(statistics):
    """What the energy remainder is compared with: the work of gravity, or, where there is
    none, the energy that the soil began with or that the boundaries gave."""
    gravity = numpy.abs(statistics["gravity work [J]"]).max()
    start = statistics["kinetic energy [J]"][0] + abs(statistics["elastic energy [J]"][0])
    driven = max(numpy.abs(statistics[name]).max() for name in
                 ("contact work [J]", "inflow energy [J]") if name in statistics)
    return (gravity, "the work of gravity") if gravity > 0 else (
        max(start, driven), "the energy at the start or from the boundaries")


def unfinished(run):
    """Why the end of the table is not the end of the run."""
    if run.is_finished():
        return []
    why = run.log.stopped()
    if run.is_writing():
        why = "It is still running."
    elif os.path.isfile(run.path("last-state.vtu")):
        why = "An error ended it; last-state.vtu has the points at that time."
    elif not why:
        why = "It was killed, or failed."
    return [f"The run has not finished: it reached t = {plain(run.time)} s of "
            f"{plain(run.end_time)} s. {why} All that follows is the state of then, not the "
            "result."]


def moving(run):
    """Runout is no result while the soil still flows."""
    # Without gravity there is no slide: a bar may vibrate for ever.
    without = not run.statistics["gravity work [J]"].any()
    if run.is_at_rest() in (None, True) or without or not run.is_finished():
        return []
    energy = run.statistics["grid kinetic energy [J]"]
    return [f"The soil still moves at the end: its kinetic energy is "
            f"{plain(100 * energy[-1] / energy.max(), 3)} % of its largest value (at rest: below "
            "0.1 %). The front is not the final runout; a later End time would tell it."]


def energy(run):
    """A remainder above one per cent."""
    remainder = numpy.abs(run.statistics["energy remainder [J]"]).max()
    scale, name = energy_scale(run.statistics)
    if scale == 0 or remainder <= ENERGY * scale:
        return []
    unit = unit_of("[J]", run.dimension)
    return [f"The energy budget does not close: up to {show(remainder, unit)} are unaccounted "
            f"for, {plain(100 * remainder / scale, 3)} % of {name} (expected: below 1 %). "
            "Try smaller cells or a smaller CFL number and see whether the runout changes."]


def mass(run):
    """Points that were lost or made."""
    values = run.balanced_mass()
    change = numpy.abs(values - values[0]).max()
    if change <= MASS * values[0]:
        return []
    return [f"The mass changed by up to {show(change, unit_of('[kg]', run.dimension))}, "
            f"{plain(100 * change / values[0], 3)} % of that at the start: soil was lost or made."]


def left(run):
    """Soil that left through outflow faces is no part of fronts and deposits."""
    mass_left = run.outflow("mass", "kg")[-1]
    if mass_left <= 0:
        return []
    start = run.statistics["mass [kg]"][0]
    return [f"{plain(100 * mass_left / start, 3)} % of the soil left the mesh through faces of "
            f"outflow ({show(mass_left, unit_of('[kg]', run.dimension))}). Deposit and runout are "
            "those of the rest."]


def fracture(run):
    """Voids and pieces."""
    statistics, result = run.statistics, []
    time = statistics["time [s]"]
    for name, what in (("empty interior cells", "holes within the soil"),
                       ("empty columns", "gaps across the whole depth of the soil")):
        bad = numpy.flatnonzero(statistics[name] > 0)
        if len(bad):
            result.append(
                f"There are {what}: up to {statistics[name].max():.0f} {name}, first at t = "
                f"{plain(time[bad[0]])} s. Where nothing broke in nature this is numerical "
                "fracture.")
    bodies = statistics["connected bodies"]
    if bodies.max() > bodies[0]:
        first = numpy.flatnonzero(bodies > bodies[0])[0]
        result.append(f"The soil came apart: {bodies.max():.0f} connected bodies, "
                      f"{bodies[0]:.0f} at the start; first at t = {plain(time[first])} s.")
    return result


# Columns that count points which a limit keeps from being split: the limit, and what to do.
SPLIT_LIMITS = {
    "points at generation limit": (
        "'Splitting/Maximum generation' forbids it. Raise that number."),
    "points at mesh limit": (
        "their children would lie more than half a cell outside the mesh. Enlarge the mesh by "
        "'Grid/Lower corner' and 'Grid/Upper corner', or take smaller cells."),
}


def split_limits(run):
    """Points that are stretched too far and are not split: the soil may tear there."""
    time, result = run.statistics["time [s]"], []
    for column, why in SPLIT_LIMITS.items():
        count = run.statistics[column] if column in run.statistics else numpy.zeros(1)
        # A few points among thousands of neighbours leave no gap.
        if count.max() <= 1e-3 * run.statistics["points"].max():
            continue
        first = time[numpy.flatnonzero(count)[0]]
        result.append(f"Up to {count.max():.0f} points were stretched too far and could not be "
                      f"split, first at t = {plain(first)} s: {why} Until then the soil may tear "
                      "there although nothing broke in nature.")
    return result


def conservation(run):
    """Splits that did not conserve."""
    worst = numpy.abs(run.statistics["split conservation error [-]"]).max()
    return [] if worst <= LEDGER else [
        f"Splitting points changed mass, momentum or energy by {plain(worst)} of their sums "
        "(expected: round-off)."]


def below_surface(run):
    """Soil that went through an obstacle."""
    table, result = run.tables["obstacles"], []
    for obstacle in run.obstacle_names() if table else []:
        name = obstacle + " deepest point [cells]"
        if name in table and table[name].max() > BELOW_SURFACE:
            unit = "m^2" if run.dimension == 2 else "m^3"
            column = f"{obstacle} volume below surface [{unit}]"
            result.append(f"Up to {show(table[column].max(), unit)} of soil is below the surface "
                          f"of the obstacle '{obstacle}', at most "
                          f"{plain(table[obstacle + ' depth below surface [m]'].max(), 3)} m deep "
                          f"({plain(table[name].max(), 2)} cells).")
    return result


def contact_area(run):
    """Ground under the soil that the soil does not touch, or touches twice."""
    unit = "m" if run.dimension == 2 else "m^2"
    area = run.statistics[f"contact area [{unit}]"]
    footprint = run.statistics[f"footprint [{unit}]"]
    rows = numpy.flatnonzero((area > 0) & (numpy.abs(area - footprint) >
                                           CONTACT_AREA * footprint))
    if not len(rows):
        return []
    worst = rows[numpy.argmax(numpy.abs(area[rows] / footprint[rows] - 1))]
    return [f"At t = {plain(run.statistics['time [s]'][worst])} s the soil touched "
            f"{plain(100 * area[worst] / footprint[worst], 3)} % of the ground under it (expected: "
            "95 to 105 %). Either soil is in the air there, or friction acts on a wrong area."]


def cut_off(run):
    """Tables whose last line was not complete."""
    return [f"The last line of {name}.csv is not complete and was left out."
            for name, table in run.tables.items() if table and table.left_out]


def damaged(run):
    """Rows with NaN where a number must be."""
    return [f"{n} {'row' if n == 1 else 'rows'} of {name} with values that are not numbers "
            f"{'was' if n == 1 else 'were'} left out. The run failed, or the file was changed."
            for name, n in run.damaged.items()]


def empty_tables(run):
    """Tables that a run made and did not fill, as on a disk that is full."""
    names = list(run.empty)
    if run.has("lines.csv") and not has_rows(run.path("lines.csv")):
        names.append("lines.csv")
    # At the start of a run a table may have its header only.
    if len(run.statistics) == 1:
        names = [name for name in names if os.path.getsize(run.path(name)) == 0]
    return [f"{name} has no complete row ({os.path.getsize(run.path(name))} bytes), so that its "
            "section is missing here. A full disk or a copy that was cut off leaves such files."
            for name in names]


def remarks(run):
    """The log in one sentence; the lines themselves have a section."""
    n = run.log.n_remarks
    return [] if n == 0 else [
        f"The run has {n} {'remark' if n == 1 else 'remarks'}; see “Remarks of the log” below."]


def notices(run):
    """All of them, the gravest first."""
    checks = (unfinished, mass, left, energy, fracture, split_limits, conservation, below_surface,
              contact_area, moving, cut_off, damaged, empty_tables, remarks)
    return [sentence for check in checks for sentence in check(run)]

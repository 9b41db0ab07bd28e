# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the members say together: study.csv, exceedance.csv and exceedance maps."""

import csv
import os
import shutil

import numpy

from talus_tools.errors import UserError
from talus_tools.esri import Grid, read_grid, write_grid
from talus_tools.study.member import FINISHED
from talus_tools.study.settings import MEMBER, MOVING
from talus_tools.tables import header, read_table


def is_moving(member):
    """Whether the soil of a finished member still moved at its end: 1 or 0, or nothing where its
    run did not note it, as one without dynamics."""
    path = member.path("statistics.csv")
    if "at rest" not in header(path):
        return ""
    table = read_table(path)
    return "" if table["time [s]"][-1] == 0 else str(int(table["at rest"][-1] == 0))


class Results:
    """Status, reason and quantities of all members; quantities, shape (members, quantities),
    are NaN where a member has not finished. `moving`: see is_moving()."""

    def __init__(self, settings, members):
        self.settings, self.members = settings, members
        self.states = [member.state() for member in members]
        self.values = numpy.full((len(members), len(settings.quantities)), numpy.nan)
        for i, member in enumerate(members):
            if self.states[i][0] == FINISHED:
                self.values[i] = [q.value(member) for q in settings.quantities]
        self.moving = [is_moving(member) if status == FINISHED else ""
                       for member, (status, _) in zip(members, self.states)]

    def finished(self):
        """The members that count."""
        return [m for m, (status, _) in zip(self.members, self.states) if status == FINISHED]

    def having(self, status):
        """(member, reason) of those with this status."""
        return [(m, reason) for m, (own, reason) in zip(self.members, self.states)
                if own == status]

    def exceedance(self, index):
        """Sorted values of a quantity, and the share of finished members at or above each."""
        values = numpy.sort(self.values[:, index][numpy.isfinite(self.values[:, index])])
        n = len(values)
        return values, 1 - numpy.searchsorted(values, values) / n if n else values


    def ranked(self, index):
        """(number, moving) of the finished members in the order of exceedance()."""
        order = numpy.argsort(self.values[:, index], kind="stable")  # NaN last
        return [(self.members[i].number, self.moving[i]) for i in order
                if numpy.isfinite(self.values[i, index])]


def write_csv(path, rows):
    """At once or not at all."""
    with open(path + ".part", "w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows(rows)
    os.replace(path + ".part", path)


def cell(value):
    """All digits of a number; nothing for none."""
    return "" if numpy.isnan(value) else repr(float(value))


def write_tables(results):
    """study.csv with one row per member, exceedance.csv with one per value."""
    settings = results.settings
    rows = [settings.columns()]
    for i, (member, (status, reason)) in enumerate(zip(results.members, results.states)):
        rows.append([member.number, *map(repr, member.values), status,
                     *map(cell, results.values[i]), results.moving[i], member.hash[:12],
                     reason])
    write_csv(os.path.join(settings.folder, "study.csv"), rows)
    rows = [["quantity", "value", "share of members at or above [-]", MEMBER, MOVING]]
    for i, quantity in enumerate(settings.quantities):
        rows += [[quantity.label(), repr(float(value)), repr(float(share)), *who]
                 for value, share, who in zip(*results.exceedance(i), results.ranked(i))]
    write_csv(os.path.join(settings.folder, "exceedance.csv"), rows)


def plan_maps(results):
    """{threshold: Grid of the share of members above it}, and the ground or None; nothing
    without rasters."""
    name = results.settings.map
    paths = [member.path(f"maps/{name}.asc") for member in results.finished()]
    if not paths or not all(map(os.path.isfile, paths)):
        return {}, None
    first, counts = read_grid(paths[0]), {}
    for path in paths:
        grid = read_grid(path)
        if not grid.is_aligned_with(first):
            raise UserError(f"'{path}' has other cells than '{paths[0]}', so that there is no "
                            "exceedance map. Do not vary the mesh or the raster within a study.")
        for threshold in results.settings.thresholds:
            above = numpy.nan_to_num(grid.values, nan=-numpy.inf) > threshold
            counts[threshold] = counts.get(threshold, 0) + above
    folder = os.path.join(results.settings.folder, "maps")
    os.makedirs(folder, exist_ok=True)
    grids = {t: Grid(n / len(paths), first.west, first.south, first.dx, first.dy)
             for t, n in counts.items()}
    for threshold, grid in grids.items():
        write_grid(os.path.join(folder, f"exceedance-{name}-{threshold:g}.asc"), grid)
    ground = os.path.join(os.path.dirname(paths[0]), "ground.asc")
    if os.path.isfile(ground):
        shutil.copyfile(ground, os.path.join(folder, "ground.asc"))
        return grids, read_grid(ground)
    return grids, None


def section_maps(results):
    """In 2-D: places x [m] and {threshold: share of members above it}; nothing without
    maps.csv."""
    name = results.settings.map.replace("-", " ") + " ["
    paths = [member.path("maps.csv") for member in results.finished()]
    if not paths or not all(map(os.path.isfile, paths)):
        return numpy.empty(0), {}
    tables = [read_table(path) for path in paths]
    places = numpy.unique(numpy.concatenate([table["x [m]"] for table in tables]))
    shares = {t: numpy.zeros(len(places)) for t in results.settings.thresholds}
    for table in tables:
        columns = [column for column in table.names if column.startswith(name)]
        if not columns:
            raise UserError(f"'{table.path}' has no column '{name}…]', of which the study was to "
                            "make exceedance maps. Set 'Exceedance/Map' to one that it has.")
        at = numpy.searchsorted(places, table["x [m]"])
        for threshold, share in shares.items():
            share[at] += numpy.nan_to_num(table[columns[0]]) > threshold
    shares = {threshold: share / len(tables) for threshold, share in shares.items()}
    rows = [["x [m]", *(f"share of members with {results.settings.map.replace('-', ' ')} above "
                        f"{t:g} [-]" for t in shares)]]
    rows += [[repr(float(x)), *(repr(float(share[i])) for share in shares.values())]
             for i, x in enumerate(places)]
    write_csv(os.path.join(results.settings.folder, "exceedance-maps.csv"), rows)
    return places, shares

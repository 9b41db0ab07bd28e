# SPDX-License-Identifier: LGPL-2.1-or-later
"""Response of a pipe to the load of a slide, row by row of the load."""

import csv
import os

import numpy

from talus_tools.pipe.beam import Beam, State
from talus_tools.units import largest

# Quantities at the nodes: column, unit.
QUANTITIES = (("deflection", "m"), ("bending moment", "N m"), ("shear force", "N"),
              ("axial force", "N"), ("utilisation", "-"))
NEAR_END = 0.02  # of the length


def respond(settings, load):
    """Quasi-static response: every row of the load is in balance, and springs that have
    yielded remember their slip. Inertia of the pipe is neglected."""
    beam = Beam(settings, resistance=lambda s: numpy.where(
        load.covers(s), settings.in_slide, 1.0))
    state, previous = State(len(beam.s)), numpy.zeros_like(beam.s_gauss)
    rows = []
    for row in range(len(load.times)):
        current = load.at(row, beam.s_gauss)
        state = beam.advance(state, previous, current)
        previous = current
        rows.append(at_nodes(beam, state, current))
    return Response(settings, load, beam, numpy.array(rows))


def at_nodes(beam, state, load):
    """Array (quantities, nodes) in the order of QUANTITIES."""
    moment, shear, axial = beam.forces(state, load)
    return numpy.stack([state.displacement[:, 1], moment, shear, axial,
                        beam.pipe.utilisation(axial, moment)])


class Response:
    """`values`: array (rows of the load, quantities, nodes)."""

    def __init__(self, settings, load, beam, values):
        self.settings, self.load, self.values, self.s = settings, load, values, beam.s
        self.has_history = settings.source != "line"

    def largest(self):
        """Name, unit, value, time and place of each quantity's largest magnitude."""
        result = []
        for q, (name, unit) in enumerate(QUANTITIES):
            row, node = divmod(largest(self.values[:, q].ravel()), len(self.s))
            result.append((name, unit, self.values[row, q, node], self.load.times[row],
                           self.s[node]))
        return result

    def utilisation(self):
        """Largest stress over the yield stress [-]."""
        return self.values[:, -1].max()

    def peak_row(self):
        """Row of the load with the largest utilisation."""
        return int(self.values[:, -1].max(axis=1).argmax())

    def reaches_the_ends(self):
        """Whether the pipe deflects near its ends, so that the ends matter."""
        deflection = numpy.abs(self.values[:, 0])
        near = (self.s < NEAR_END * self.s[-1]) | (self.s > (1 - NEAR_END) * self.s[-1])
        return deflection[:, near].max() > 0.01 * deflection.max()

    def held_by_the_ends(self):
        """Share of the largest change of the axial force that the ends hold [-]."""
        change = numpy.abs(self.values[:, 3] - self.settings.pipe.tension)
        return change[:, [0, -1]].max() / max(change.max(), 1e-30)

    def write(self, folder):
        """The tables along.csv, history.csv and loads.csv."""
        self.write_along(os.path.join(folder, "along.csv"))
        self.write_history(os.path.join(folder, "history.csv"))
        self.write_loads(os.path.join(folder, "loads.csv"))

    def write_along(self, path):
        """Along the pipe: values at the largest utilisation, and extremes over all times."""
        row = self.peak_row()
        names, columns = ["s [m]", "load [N/m]"], [self.s, self.load.at(row, self.s)]
        for q, (name, unit) in enumerate(QUANTITIES):
            values = self.values[:, q]
            names += [f"{name} [{unit}]", f"smallest {name} [{unit}]", f"largest {name} [{unit}]"]
            columns += [values[row], values.min(axis=0), values.max(axis=0)]
        write_table(path, names, numpy.stack(columns, axis=1))

    def write_history(self, path):
        """In time: the whole load, and the value of largest magnitude along the pipe."""
        total = numpy.trapezoid if hasattr(numpy, "trapezoid") else numpy.trapz
        columns = [self.load.times, total(self.load.values, self.load.places, axis=1)]
        names = ["time [s]" if self.has_history else "share of the load [-]", "load [N]"]
        for q, (name, unit) in enumerate(QUANTITIES):
            names.append(f"largest {name} [{unit}]")
            columns.append([values[largest(values)] for values in self.values[:, q]])
        write_table(path, names, numpy.stack(columns, axis=1))

    def write_loads(self, path):
        """Load per length at each time (rows) and place (columns), for other programs."""
        names = ["time [s]" if self.has_history else "share of the load [-]"]
        names += [f"s = {place:.9g} m [N/m]" for place in self.load.places]
        write_table(path, names, numpy.column_stack([self.load.times, self.load.values]))


def write_table(path, names, rows):
    """One header line, commas, numbers."""
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([f"{value:.12g}" for value in row] for row in rows)

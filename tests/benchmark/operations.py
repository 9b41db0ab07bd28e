# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bytes and floating-point operations of a step, per point: the one place where
they are written down.

Operations are additions, multiplications, divisions, roots, comparisons and
exponentials, one each, a multiply-add two. They are those that the formulas need;
entries of a register that carry nothing are not counted. Counts of formulas that are
templates come from talus-benchmark, which evaluates them with a number that
counts; those of the loops over nodes are formulas below.

Bytes are those of the columns that a sweep over all points reads and writes, once
each, a column that is changed twice. Nodes, and the sums that a cell hands on to
them, are left out of both: the points of a cell share them.
"""

import statistics

# Doubles of the columns, in d dimensions.
COLUMNS = {
    "position": lambda d: d,
    "velocity": lambda d: d,
    "edges": lambda d: d * d,
    "stress": lambda d: 2 * d,
    "mass": lambda d: 1,
    "reference volume": lambda d: 1,
    "box length": lambda d: d,
    "length at creation": lambda d: d,
    "elastic energy": lambda d: 1,
    "plastic work": lambda d: 1,
    "plastic strain": lambda d: 1,
    "generation": lambda d: 1,
}

# Columns that come from memory, and columns that go there, by phase of the log. A
# step is two sweeps over the points; a column belongs to the phase of a sweep that
# needs it first, as the others find it in the cache. All is on: B-bar,
# von Mises, boxes that follow the stretch.
SWEEPS = {
    "time step": (
        ["edges", "mass", "velocity", "box length"], []),
    "points to grid": (["position", "stress", "reference volume"], []),
    "grid to points": (
        ["position", "box length", "velocity", "mass", "edges"],
        ["position", "velocity"]),
    "stress update": (
        ["stress", "elastic energy", "plastic work", "plastic strain"],
        ["edges", "stress", "elastic energy", "plastic work",
         "plastic strain", "box length"]),
    "splitting": (["length at creation", "generation"], []),
}


def bytes_of(phase, d):
    """Per point and step, or None for a phase that has no sweep over points."""
    if phase not in SWEEPS:
        return None
    return 8 * sum(COLUMNS[name](d) for names in SWEEPS[phase] for name in names)


class Operations:
    """Operations per point in @p d dimensions. @p counted are the counts by
    talus-benchmark."""

    def __init__(self, counted, d):
        self.d = d
        self.determinant = counted[f"determinant, {d}-D"]
        self.weights = d * counted["weights along an axis"]
        self.linear_elastic = counted[f"linear elastic, {d}-D"]
        self.von_mises = counted[f"von Mises, {d}-D"]

    def scatter(self):
        """Axis by axis, z, y, x. Of the r entries of the record the forces along
        each axis but x take a gradient, too, and the forces by the gradient
        along x are entries of their own."""
        d, r = self.d, 2 + 3 * self.d
        contributions = self.determinant + 2 + 3 * d + d * (d + 1) // 2
        planes = 3 * (r + 3 * d) if d == 3 else 0
        rows = 3 ** (d - 1) * (r + 2 * d)
        nodes = 3**d * 2 * r
        return self.weights + contributions + planes + rows + nodes

    def gather(self):
        """Axis by axis, x, y, z: 2d values take the weights, and the d velocities
        a gradient for each axis so far."""
        d = self.d
        sums = sum(
            3**k * (2 * 2 * d + 2 * d * (d - k + 1)) for k in range(1, d + 1)
        )
        return (
            self.weights + sums + 10 * d + d * d + 3 + self.search_outside_cell()
        )

    def search_outside_cell(self):
        return 3 * self.d

    def mean_stress(self):
        return self.determinant + self.d + 5

    def mean_dilatation(self):
        return self.determinant + 3 * self.d + 4

    def time_step(self):
        """Square of the wave speed; per axis speed and box; the two bounds."""
        return self.determinant + 6 + 10 * self.d + 14

    def edges(self):
        """Lengths of the box, and the test for long edges."""
        d, n_combinations = self.d, 2 if self.d == 2 else 12
        return (2 * d * d + d * (2 * d - 1) + 4 * d
                + n_combinations * (5 * d + 3))

    def elastic_block(self):
        """The step of block.prm and block-3d.prm."""
        return (
            self.time_step() + self.scatter() + self.gather()
            + self.linear_elastic + self.edges()
        )

    def by_phase(self):
        """The step of a landslide, by phase of the log."""
        return {
            "time step": self.time_step(),
            "points to grid": self.mean_stress() + self.scatter(),
            "grid to points": self.gather() + self.mean_dilatation(),
            "stress update": self.von_mises + self.edges(),
            "splitting": 5 * self.d + 1,
        }


def phase_table(runs, fresh, late, operations, roof):
    """Heading and rows: where the time of runs of a landslide goes, beside what
    the roofline @p roof allows each phase; the time for points that are new and
    for as many after a long way."""
    rows = [("phase", "ns per point and step", "share", "bytes", "operations",
             "least ns by bytes", "least ns by operations", "over the roofline",
             "ns, new points", "ns, late")]
    work = operations.by_phase()
    total = statistics.median(r.ns for r in runs)
    for name in runs[0].phases:
        ns, *others = [
            statistics.median(r.ns_of(name) for r in some)
            for some in (runs, fresh, late)
        ]
        n_bytes = bytes_of(name, operations.d)
        limits = [""] * 5
        if n_bytes is not None:
            by_bytes = 1e9 * n_bytes / roof.bandwidth
            by_operations = 1e9 * work[name] / roof.operations
            limits = [
                f"{n_bytes}", f"{work[name]:.0f}", f"{by_bytes:.2f}",
                f"{by_operations:.2f}",
                f"{ns / max(by_bytes, by_operations):.1f}",
            ]
        rows.append((name, f"{ns:.2f}", f"{100 * ns / total:.1f} %", *limits,
                     *[f"{other:.2f}" for other in others]))
    n_bytes = sum(bytes_of(name, operations.d) or 0 for name in runs[0].phases)
    n_operations = sum(work.get(name, 0) for name in runs[0].phases)
    rows.append(
        ("all", f"{total:.2f}", "100 %", f"{n_bytes}", f"{n_operations:.0f}",
         "", "", "",
         *[f"{statistics.median(r.ns for r in some):.2f}" for some in (fresh, late)])
    )
    return rows

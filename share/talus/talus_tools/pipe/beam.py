# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beam with tension on bilinear soil springs.

Unknowns at each node: axial displacement u [m], deflection w [m], rotation w' [-]. Bending is
linear in w'' (Bernoulli), the axial strain is u' + w'^2/2 (von Karman). Deflections are cubic and
axial displacements linear in an element. The axial force is constant in an element: from the mean
of w'^2/2, since the sum of a linear u' and a quartic w'^2 would lock.

A straight pipe without tension has no stiffness but EI, and the first correction of Newton's
method for a slide of kilometres is a thousand times the deflection. A line search therefore
shortens each correction: the state in balance minimizes the energy of pipe, springs and load, and
the residual times the correction is the slope of the energy along the correction.
"""

import numpy
from scipy.linalg import solve_banded

from talus_tools.errors import UserError

N_GAUSS = 4  # integrate products of two cubic shape functions exactly
BAND = 5  # half the bandwidth of two nodes with three unknowns each
TOLERANCE = 1e-9  # of the residual, over the norm of loads and internal forces
LARGEST_ERROR = 1e-2  # of the residual, over the norm of the largest load
MAX_ITERATIONS = 100
SEARCHES = 40  # tries of a line search
SMALLER_SLOPE = 0.5  # slope of the energy after a line search, over the slope before
SMALLEST_PART = 2.0**-6  # of an increment of the load
EPSILON = numpy.finfo(float).eps


class State:
    """Displacements, and the plastic displacement of the springs at the Gauss points, m."""

    def __init__(self, n_nodes):
        self.displacement = numpy.zeros((n_nodes, 3))
        self.lateral_slip = numpy.zeros((n_nodes - 1, N_GAUSS))
        self.axial_slip = numpy.zeros((n_nodes - 1, N_GAUSS))


class NoBalance(Exception):
    """No equilibrium was found for a load."""


def spring(springs, factor, displacement, slip):
    """Force on the pipe per length, N/m, tangent, N/m^2, and slip, m, of bilinear springs
    whose stiffness and resistance are multiplied by `factor`."""
    stiffness, limit = factor * springs.stiffness, factor * springs.resistance
    trial = stiffness * (displacement - slip)
    force = numpy.clip(trial, -limit, limit) if numpy.isfinite(springs.resistance) else trial
    slides = force != trial
    moved = displacement - force / numpy.where(slides, stiffness, 1)
    return force, numpy.where(slides, 0, stiffness), numpy.where(slides, moved, slip)


class Beam:
    """Nodes at equal distances along a straight pipe. `resistance(s)`: factor of the lateral
    springs at the places s [m]."""

    def __init__(self, settings, resistance):
        self.settings, self.pipe = settings, settings.pipe
        n = max(8, round(settings.length / settings.element_size))
        self.s = numpy.linspace(0, settings.length, n + 1)
        self.h = self.s[1] - self.s[0]
        points, weights = numpy.polynomial.legendre.leggauss(N_GAUSS)
        self.xi, self.weights = (points + 1) / 2, weights / 2 * self.h
        self.s_gauss = self.s[:-1, None] + self.h * self.xi
        self.resistance = resistance(self.s_gauss)
        self.shape = self.hermite(self.xi)
        self.linear = numpy.stack([1 - self.xi, self.xi])
        self.bending, self.geometric = self.matrices()
        self.free = self.free_unknowns()
        self.largest_load = 0.0  # norm over the elements of all loads so far, N
        # Unknowns of an element in the order of the nodes: rows of w and rotation, of u.
        self.w_rows, self.u_rows = numpy.array([1, 2, 4, 5]), numpy.array([0, 3])

    def hermite(self, xi):
        """Cubic shape functions of w and w' at both nodes: an array (4, len(xi))."""
        h = self.h
        return numpy.stack([1 - 3 * xi**2 + 2 * xi**3, h * (xi - 2 * xi**2 + xi**3),
                            3 * xi**2 - 2 * xi**3, h * (xi**3 - xi**2)])

    def matrices(self):
        """Integrals of N'' N''^T, 1/m^3, and of N' N'^T, 1/m, over an element."""
        h = self.h
        bending = numpy.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                               [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]])
        geometric = numpy.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2],
                                 [-36, -3 * h, 36, -3 * h], [3 * h, -h**2, -3 * h, 4 * h**2]])
        return bending / h**3, geometric / (30 * h)

    def free_unknowns(self):
        """Mask (nodes, 3) of the unknowns that no end holds."""
        free = numpy.ones((len(self.s), 3), dtype=bool)
        held = {"fixed": [0, 1, 2], "pinned": [0, 1], "free": []}[self.settings.ends]
        for end in (0, -1):
            free[end, held] = False
        if not held and self.settings.axial.stiffness == 0:
            free[0, 0] = False  # nothing else would keep the pipe from moving along its axis
        return free

    @staticmethod
    def bent(displacement):
        """Deflections and rotations of both nodes (elements, 4), without the deflection of the
        first node, which neither bends nor stretches the element. Short elements far from the
        straight pipe would lose digits with the whole deflection."""
        w = numpy.hstack([displacement[:-1, 1:], displacement[1:, 1:]])
        w[:, [0, 2]] -= displacement[:-1, 1:2]
        return w

    def axial_force(self, displacement):
        """Axial force of each element, N, with tension positive."""
        w = self.bent(displacement)
        stretch = (numpy.diff(displacement[:, 0])
                   + 0.5 * numpy.einsum("ei,ij,ej->e", w, self.geometric, w)) / self.h
        return self.pipe.tension + self.pipe.axial_stiffness * stretch

    def elements(self, displacement, state, load, stiff=False):
        """End forces (elements, 6), their tangents (elements, 6, 6), and the slips of the
        springs. The end forces are those that an element needs to be in balance with its
        springs and with `load`, N/m, at its Gauss points. `stiff`: tangents without the yielding
        of springs and without the softening by compression, for which all corrections decrease
        the energy."""
        w = numpy.hstack([displacement[:-1, 1:], displacement[1:, 1:]])
        u = numpy.stack([displacement[:-1, 0], displacement[1:, 0]], axis=1)
        axial = self.axial_force(displacement)
        p, p_slope, lateral_slip = spring(self.settings.lateral, self.resistance, w @ self.shape,
                                          state.lateral_slip)
        t, t_slope, axial_slip = spring(self.settings.axial, 1, u @ self.linear, state.axial_slip)
        bent = self.bent(displacement)
        turned = bent @ self.geometric  # derivative of the integral of w'^2/2
        pull = self.pipe.axial_stiffness / self.h
        force = numpy.zeros((len(w), 6))
        force[:, self.w_rows] = (self.pipe.bending_stiffness * (bent @ self.bending)
                                 + axial[:, None] * turned
                                 + numpy.einsum("eg,ig,g->ei", p - load, self.shape,
                                                self.weights))
        force[:, self.u_rows] = (numpy.outer(axial, [-1, 1])
                                 + numpy.einsum("eg,ig,g->ei", t, self.linear, self.weights))
        tangent = numpy.zeros((len(w), 6, 6))
        hardens = axial
        if stiff:
            hardens = numpy.maximum(axial, 0)
            p_slope = self.resistance * self.settings.lateral.stiffness
            t_slope = numpy.full_like(t, self.settings.axial.stiffness)
        tangent[:, self.w_rows[:, None], self.w_rows] = (
            self.pipe.bending_stiffness * self.bending + hardens[:, None, None] * self.geometric
            + pull * turned[:, :, None] * turned[:, None, :]
            + numpy.einsum("eg,ig,jg,g->eij", p_slope, self.shape, self.shape, self.weights))
        tangent[:, self.u_rows[:, None], self.u_rows] = (
            pull * numpy.array([[1, -1], [-1, 1]])
            + numpy.einsum("eg,ig,jg,g->eij", t_slope, self.linear, self.linear, self.weights))
        coupling = pull * turned[:, :, None] * numpy.array([-1, 1])
        tangent[:, self.w_rows[:, None], self.u_rows] = coupling
        tangent[:, self.u_rows[:, None], self.w_rows] = coupling.transpose(0, 2, 1)
        return force, tangent, lateral_slip, axial_slip

    def residual(self, force, displacement):
        """Sums of the end forces at the free unknowns, flat, and the norm that counts as zero:
        a small part of the end forces, or the rounding of the deflection times the stiffness,
        but never more than LARGEST_ERROR of the largest load."""
        total = numpy.zeros((len(self.s), 3))
        total[:-1] += force[:, :3]
        total[1:] += force[:, 3:]
        rounding = (EPSILON * 12 * self.pipe.bending_stiffness / self.h**3
                    * numpy.linalg.norm(displacement[:, 1]))
        zero = max(TOLERANCE * numpy.linalg.norm(force, axis=0).max(), rounding)
        return (numpy.where(self.free, total, 0).ravel(),
                min(zero, LARGEST_ERROR * self.largest_load))

    def correction(self, tangent, residual):
        """Solve the linear system; held unknowns stay."""
        n = residual.size
        matrix = numpy.zeros((2 * BAND + 1, n))
        first = 3 * numpy.arange(len(tangent))
        for i in range(6):
            for j in range(6):
                matrix[BAND + i - j, first + j] += tangent[:, i, j]
        held = numpy.flatnonzero(~self.free.ravel())
        for unknown in held:
            for other in range(max(0, unknown - BAND), min(n, unknown + BAND + 1)):
                matrix[BAND + unknown - other, other] = other == unknown
                matrix[BAND + other - unknown, unknown] = other == unknown
        try:
            return solve_banded((BAND, BAND), matrix, -residual).reshape(-1, 3)
        except numpy.linalg.LinAlgError:
            return numpy.full((len(self.s), 3), numpy.nan)

    def downhill(self, displacement, state, load):
        """Correction by Newton's method along which the energy decreases, and the slope of the
        energy along the correction. A tangent that has no such correction is replaced by the
        stiff one."""
        for stiff in (False, True):
            force, tangent, _, _ = self.elements(displacement, state, load, stiff)
            residual, _ = self.residual(force, displacement)
            step = self.correction(tangent, residual)
            slope = residual @ step.ravel()
            if slope < 0:
                return step, slope
        raise NoBalance

    def search(self, displacement, step, slope, state, load):
        """Share of `step` after which the energy has decreased and its slope is small. Without
        a rise of the energy the whole step is taken."""
        share, low, high = 1.0, 0.0, None
        for _ in range(SEARCHES):
            moved = displacement + share * step
            residual, _ = self.residual(self.elements(moved, state, load)[0], moved)
            there = residual @ step.ravel()
            if (high is None and there < 0) or abs(there) <= SMALLER_SLOPE * abs(slope):
                return share
            low, high = (share, high) if there < 0 else (low, share)
            # Near zero the slope is linear; far away a cubic polynomial of the share.
            share = ((low + high) / 2 if low > 0 or not numpy.isfinite(there)
                     else high * max(0.1, slope / (slope - there)))
        raise NoBalance

    def balance(self, state, load):
        """State in balance with a load per length, N/m, at the Gauss points, by Newton's method
        with line search from `state`."""
        self.largest_load = max(self.largest_load,
                                numpy.linalg.norm((load * self.weights).sum(axis=1)))
        result = State(len(self.s))
        displacement = state.displacement
        for _ in range(MAX_ITERATIONS):
            force, _, result.lateral_slip, result.axial_slip = self.elements(
                displacement, state, load)
            residual, zero = self.residual(force, displacement)
            if numpy.linalg.norm(residual) <= zero:
                result.displacement = displacement
                return result
            step, slope = self.downhill(displacement, state, load)
            displacement = displacement + self.search(displacement, step, slope, state,
                                                      load) * step
        raise NoBalance

    def check_hold(self, load):
        """Refuse a load, N/m, for which no balance exists: at free ends nothing but the lateral
        springs can hold the pipe, whatever the tension. Held ends can hold any load, since the
        stretched elastic pipe has no largest tension."""
        springs = self.settings.lateral
        if self.settings.ends != "free" or (springs.stiffness > 0
                                            and numpy.isinf(springs.resistance)):
            return
        limit = springs.resistance * self.resistance if springs.stiffness > 0 else 0 * load
        total, held = abs((load @ self.weights).sum()), (limit @ self.weights).sum()
        if total > held:
            raise UserError(
                f"No balance exists: the load of {total:.4g} N in sum is larger than the ultimate "
                f"resistance of all lateral springs, {held:.4g} N, and 'Ends = free' hold "
                "nothing. Change 'Ends', 'Length', 'Lateral springs/Ultimate resistance' or "
                "'Load/Lateral resistance in the slide'.")

    def advance(self, state, load, next_load):
        """State after the load has changed to `next_load`, in as many parts as Newton's method
        needs."""
        self.check_hold(next_load)
        done, part = 0.0, 1.0
        while done < 1:
            part = min(part, 1 - done)
            try:
                state = self.balance(state, load + (done + part) * (next_load - load))
            except NoBalance as error:
                part /= 2
                if part < SMALLEST_PART:
                    raise UserError(
                        f"Newton's method found no balance beyond {100 * done:.3g} % of the "
                        f"change to a load of {numpy.abs(next_load).max():.4g} N/m. Whether a "
                        "balance exists is not known. A pipe that soil and tension hardly hold "
                        "turns by more than the moderate rotations of the model: see 'Ends', "
                        "'Axial springs' and 'Lateral springs/Ultimate resistance'.") from error
                continue
            done += part
            part *= 2
        return state

    def forces(self, state, load):
        """Bending moment -EI w'', N m, shear force, N, and axial force, N, at the nodes. Moments
        and shear forces are the end forces of the elements, which are more accurate than
        derivatives of w."""
        force = self.elements(state.displacement, state, load)[0]
        moment = numpy.append(force[:, 2], -force[-1, 5])
        shear = numpy.append(-force[:, 1], force[-1, 4])
        axial = self.axial_force(state.displacement)
        at_nodes = numpy.concatenate([axial[:1], (axial[:-1] + axial[1:]) / 2, axial[-1:]])
        return moment, shear, at_nodes

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a new case consists of: mesh, slip surface, soil, places."""

import dataclasses
import math

import numpy

from talus_tools.new_case.path import GRAVITY, lengths, place_at, simplified, steepest_path
from talus_tools.new_case.release import GENTLEST_SIDE, STEEPEST_SIDE
from talus_tools.new_case.terrain import read_sea_floor

CELLS_ACROSS = {2: 4, 3: 1.2}  # the thickness of the release: a first, coarse run
ROUND = (1, 1.2, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)
N_STATIONS = 4
MOST_LIP = 0.05  # rise of the bed downslope, over the depth


@dataclasses.dataclass
class Soil:
    """Soft clay: undrained shear strength a + b depth [Pa], sensitivity [-], saturated density and
    the density minus that of the water [kg/m^3]."""
    at_mudline: float
    per_metre: float
    sensitivity: float
    density: float
    water: float
    depth: float
    bed: float = 0  # Pa, in place of the remoulded strength

    @property
    def submerged_density(self):
        """kg/m^3."""
        return self.density - self.water

    @property
    def strength(self):
        """Strength as an expression of talus."""
        return f"{self.at_mudline:g} + {self.per_metre:g}*depth"

    @property
    def bed_shear_stress(self):
        """Remoulded strength at the deepest place of the slip surface [Pa]."""
        return (self.bed or float(
            f"{(self.at_mudline + self.per_metre * self.depth) / self.sensitivity:.2g}"))


def rounded(size, down=True):
    """The nearest round number below or above."""
    power = 10.**math.floor(math.log10(size))
    fits = [n * power for n in ROUND if (n * power <= size * 1.0001) == down
            or math.isclose(n * power, size)]
    return (max if down else min)(fits)


class Case:
    """Where soil comes from and may go to. All lengths in m, places on the map."""

    def __init__(self, raster, code, release, soil, options):
        self.raster, self.code, self.release, self.soil = raster, code, release, soil
        self.water = options.water_density
        self.reach = options.reach
        corners = release.corners()
        lower, upper = corners.min(axis=0) - self.reach, corners.max(axis=0) + self.reach
        self.floor = read_sea_floor(raster, code, (*lower, *upper))
        self.mean_floor = self.floor.smooth(max(0.25 * release.size(), self.floor.cell))
        self.path, self.comes_to_rest, self.energy = steepest_path(
            self.mean_floor, release, soil, self.reach)
        self.line = simplified(self.path, 0.05 * release.size())
        self.sides, self.toe = self.slip_surface(options.sides)
        self.cells = {dim: (options.cell_size if dim == 3 and options.cell_size else
                            rounded(release.depth / (options.cells or CELLS_ACROSS[dim])))
                      for dim in (2, 3)}

    def slip_depths(self, places, toe):
        """Depths of the slip surface [m] whose sides rise by `self.sides`, towards the end of the
        area by `toe`, height over length."""
        found = [self.release.inside(place) for place in places]
        depths = numpy.array([min(depth, self.sides * max(0, inside)) for inside, depth in found])
        if toe is not None:
            depths = numpy.minimum(depths, toe * numpy.maximum(0, self.before_toe(places)))
        return depths

    def down(self):
        """Unit vector down the slope in the middle of the release area."""
        at = numpy.linalg.norm(self.path - self.release.largest.middle(), axis=1).argmin()
        vector = self.path[min(at + 4, len(self.path) - 1)] - self.path[max(at - 4, 0)]
        return vector / numpy.linalg.norm(vector)

    def before_toe(self, places):
        """Distance [m] up the slope of the lowest corner of the area."""
        down = self.down()
        return (self.release.largest.corners @ down).max() - numpy.asarray(places) @ down

    def lip(self, toe):
        """How high the slip surface rises along the path, downslope of its deepest place [m]."""
        places = self.path
        slip = self.floor.at(places) - self.slip_depths(places, toe)
        soil = self.slip_depths(places, None) > 0
        if not soil.any():
            return 0.
        slip = slip[soil.nonzero()[0][0]:]
        end = min(len(slip), int(soil.sum()) + 2)
        return float(numpy.nanmax(slip[:end] - numpy.fmin.accumulate(slip[:end])))

    def slip_surface(self, sides):
        """Rise of the sides, and towards the toe, such that the bed does not rise downslope; the
        latter None for several polygons, which have no common toe."""
        self.sides = sides or STEEPEST_SIDE
        if len(self.release.polygons) > 1 or sides:
            return self.sides, None
        for toe in numpy.geomspace(STEEPEST_SIDE, GENTLEST_SIDE, 8):
            if self.lip(toe) <= MOST_LIP * self.release.depth:
                break
        return self.sides, float(f"{toe:.2g}")

    def stations(self):
        """Names and places along the path below the release area."""
        way = lengths(self.path)
        outside = [d for d, place in zip(way, self.path)
                   if self.before_toe([place])[0] < 0 and self.release.inside(place)[0] < 0]
        if not outside:
            return {}
        start, end = outside[0], way[-1]
        step = rounded((end - start) / N_STATIONS) if end > start else 0
        return {f"{k * step:.0f} m": place_at(self.path, start + k * step)
                for k in range(1, N_STATIONS + 1) if start + k * step <= end} if step else {}

    def box(self):
        """West, south, east, north edge of the mesh, within the raster."""
        corners = self.release.corners()
        all_places = numpy.concatenate([corners, self.path])
        across = numpy.array([-self.down()[1], self.down()[0]])
        width = numpy.ptp(self.release.largest.corners @ across)
        margin = max(0.75 * width, 10 * self.cells[3])
        box = [*(all_places.min(axis=0) - margin), *(all_places.max(axis=0) + margin)]
        return self.within_raster(box)

    def within_raster(self, box):
        """The box without the sides where the raster has gaps."""
        step = max(self.floor.cell, self.cells[3])
        edge = 1.5 * self.floor.cell
        box = [max(box[0], self.floor.west + edge), max(box[1], self.floor.south + edge),
               min(box[2], self.floor.east - edge), min(box[3], self.floor.north - edge)]
        while True:
            gaps = ~numpy.isfinite(self.floor.part(*box))
            if not gaps.any():
                return box
            shares = [gaps[:, 0].mean(), gaps[-1].mean(), gaps[:, -1].mean(), gaps[0].mean()]
            if max(shares) == 0:
                # A hole inside: the side nearest to it.
                rows, columns = gaps.nonzero()
                shares = [-columns.min(), rows.max() - len(gaps), columns.max() - gaps.shape[1],
                          -rows.min()]
            side = int(numpy.argmax(shares))
            box[side] += step if side < 2 else -step

    def volume(self):
        """Volume of the release [m^3]."""
        corners = self.release.corners()
        h = 0.5 * max(self.cells[3], numpy.ptp(corners, axis=0).max() / 200)
        x, y = (numpy.arange(corners[:, axis].min() + h / 2, corners[:, axis].max(), h)
                for axis in (0, 1))
        places = numpy.stack(numpy.meshgrid(x, y), axis=-1).reshape(-1, 2)
        return float(self.slip_depths(places, self.toe).sum() * h * h)

    def driving_stress(self):
        """Shear stress of the weight on the slip surface in the middle of the area [Pa]."""
        place = self.release.largest.middle()
        step = self.mean_floor.cell * self.down()
        ends = self.mean_floor.at([place - step, place + step])
        angle = math.atan2(ends[0] - ends[1], 2 * self.mean_floor.cell)
        return (self.soil.submerged_density * GRAVITY * self.release.depth
                * math.sin(angle) * math.cos(angle))

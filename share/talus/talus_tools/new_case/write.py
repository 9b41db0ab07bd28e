# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter files of a new case."""

import math
import os

import numpy

from talus_tools.gis import words_of
from talus_tools.new_case.case import rounded
from talus_tools.new_case.path import GRAVITY, lengths

MOST_COARSE_CELLS = 60_000


def plain(value):
    """A number without an exponent or needless digits."""
    return f"{value:.10g}" if abs(value) < 1e10 else f"{value:.6g}"


def places(points, separator="; "):
    """Places on the map, to a tenth of a metre."""
    return separator.join(f"{x:.1f}, {y:.1f}" for x, y in points)


class Mesh:
    """Box of cells, a multiple of the coarsest ones: lower and upper corner [m]; in 3-D the origin
    on the map [m], the north-western corner."""

    def __init__(self, case, dim):
        self.dim, self.cell, self.level = dim, case.cells[dim], 2
        if dim == 3:
            west, south, east, north = case.box()
            plan = [(west, east), (south, north)]
            heights = case.floor.part(west, south, east, north)
        else:
            plan = [(0, lengths(case.line)[-1])]
            heights = case.floor.at(case.path)
        heights = heights[numpy.isfinite(heights)]
        low = heights.min() - case.release.depth - 2 * self.cell
        high = heights.max() + max(case.release.depth, 4 * self.cell)
        while (math.prod((b - a) / self.coarse for a, b in (*plan, (low, high)))
               > MOST_COARSE_CELLS and self.level < 5):
            self.level += 1
        self.plan = [self.fit(*side) for side in plan]
        self.low = self.coarse * math.floor(low / self.coarse)
        self.high = self.coarse * math.ceil(high / self.coarse)

    @property
    def coarse(self):
        """Size of the coarsest cell [m]."""
        return self.cell * 2**self.level

    def fit(self, lower, upper):
        """The largest whole number of coarse cells in an interval, in its middle."""
        n = max(1, math.floor((upper - lower) / self.coarse))
        lower = 0 if self.dim == 2 else round(0.5 * (lower + upper - n * self.coarse))
        return lower, lower + n * self.coarse

    def corners(self):
        """Lower and upper corner in the axes of the mesh, as texts."""
        lengths_of_plan = [upper - lower for lower, upper in self.plan]
        lower, upper = [0, self.low], [lengths_of_plan[0], self.high]
        if self.dim == 3:
            lower.append(0)
            upper.append(lengths_of_plan[1])
        return tuple(", ".join(map(plain, corner)) for corner in (lower, upper))

    def origin(self):
        """Easting and northing of x = z = 0."""
        return self.plan[0][0], self.plan[1][1]


def pocket_of(case, mesh):
    """Expression of the depth of the slip surface."""
    release = case.release
    depth = "depth_of_release" if release.field else plain(release.depth)
    parts = [depth, f"{case.sides:g}*max(0, release)"]
    if case.toe is not None:
        if mesh.dim == 2:
            way = lengths(case.path)
            x = numpy.interp(0, -case.before_toe(case.path), way)
            parts.append(f"{case.toe:g}*max(0, {x:.1f} - x)")
        else:
            down, (east, north) = case.down(), mesh.origin()
            start = case.before_toe([(east, north)])[0]
            parts.append(f"{case.toe:g}*max(0, {start:.1f} {-down[0]:+.4f}*x {down[1]:+.4f}*z)")
    return f"min({', '.join(parts)})"


def surfaces(case, mesh, folder):
    """Section of the sea floor, release area and slip surface."""
    release = case.release
    section = f"\n    set Section    = {places(case.line)}" if mesh.dim == 2 else ""
    own = case.raster.system is None or case.raster.system.IsProjected()
    raster_map = "" if own else f"\n    set Projection = {words_of(case.code)}"
    release_map = ("" if release.is_on_map and own
                   else f"\n    set Projection = {words_of(case.code)}")
    raster, area = (os.path.relpath(path, folder) for path in (case.raster.path, release.path))
    names = ("mudline, release, " + ("depth_of_release, " if release.field else "")
             + "pocket, slip")
    rise = "; rise towards the toe" if case.toe else ""
    depth = f"""
  subsection depth_of_release   # the number of each polygon
    set File       = {area}{release_map}{section}
    set Attribute  = {release.field}
  end""" if release.field else ""
    return f"""subsection Surfaces
  set Names = {names}
  subsection mudline
    set File       = {raster}{raster_map}{section}
  end
  subsection release            # distance from the outline, positive inside [m]
    set File       = {area}{release_map}{section}
  end{depth}
  subsection pocket             # depth; rise of the sides{rise}
    set Expression = {pocket_of(case, mesh)}
  end
  subsection slip
    set Expression = mudline - pocket
  end
end"""


def corners_of_body(case, mesh):
    """Where the layer ends in plan: around the release area."""
    margin = 4 * mesh.cell + case.floor.cell  # places of the path are a cell of it apart
    if mesh.dim == 2:
        way = lengths(case.path)
        x = [d for d, place in zip(way, case.path) if case.release.inside(place)[0] > 0]
        low, high = max(0, min(x) - margin), max(x) + margin
        return f"{low:.0f}, 0", f"{high:.0f}, 0"
    corners = case.release.corners()
    east, north = mesh.origin()
    x, z = corners[:, 0] - east, north - corners[:, 1]
    return (f"{x.min() - margin:.0f}, 0, {z.min() - margin:.0f}",
            f"{x.max() + margin:.0f}, 0, {z.max() + margin:.0f}")


def end_time(case):
    """Several times the time of the block of steepest_path() [s]."""
    speed = max((2 * case.energy)**0.5, 1)
    return max(60, rounded(3 * lengths(case.line)[-1] / speed, down=False))


def along(case, mesh):
    """Sections of the stations, and in 3-D of maps and runout."""
    stations = case.stations()
    way = lengths(case.path)
    on_path = {name: way[numpy.linalg.norm(case.path - place, axis=1).argmin()]
               for name, place in stations.items()}
    if mesh.dim == 2:
        points = " | ".join(f"{name}: {x:.0f}" for name, x in on_path.items())
        return f"""subsection Stations
  set Points = {points}   # downslope of the release
end""" if points else ""
    points = " | ".join(f"{name}: {places([place])}" for name, place in stations.items())
    part = (f"""subsection Stations
  set Coordinates = map
  set Points      = {points}   # downslope of the release
end

""" if points else "")
    return f"""{part}subsection Runout
  set Coordinates = map
  set Path        = {places(case.line)}   # steepest path
end

subsection Maps
  set Write              = true
  set Cell size          = {plain(2 * mesh.cell)}
  set Arrival thresholds = 0.5
end"""


def text(case, dim, folder, name):
    """The parameter file of a case in `dim` dimensions, which will stand in `folder`."""
    mesh, soil = Mesh(case, dim), case.soil
    lower, upper = mesh.corners()
    low, high = corners_of_body(case, mesh)
    origin = ""
    if dim == 3:
        east, north = mesh.origin()
        origin = f"\n  set Origin         = {plain(east)}, {plain(north)}, 0   # easting, northing, height of x = y = z = 0"
    kind = "Slide" if dim == 3 else "Section of the slide"
    faces = ("Left", "Right", "Back", "Front")[:2 * (dim - 1)]
    outflow = "\n".join(f"  set {face:5} = outflow" for face in faces)
    return f"""# {kind} of '{os.path.basename(case.release.path)}', written by talus-new. Lines marked by !! are
# assumptions: replace them by numbers of the site (doc/soft-clay.md).
set Title     = {kind} of {os.path.splitext(os.path.basename(case.release.path))[0]}
set Dimension = {dim}
set End time  = {plain(end_time(case))}   # or earlier, when the slide is at rest

subsection Grid
  set Lower corner   = {lower}
  set Upper corner   = {upper}
  set Cell size      = {plain(mesh.cell)}   # halve it to see whether the result depends on it
  set Coarsest level = {mesh.level}{origin}
end

{surfaces(case, mesh, folder)}

subsection Boundaries           # soil may leave the mesh
{outflow}
end

subsection Gravity
  set Magnitude = {GRAVITY}
end

subsection Water
  set Density                   = {plain(soil.water)}
  set Added mass coefficient    = 0.1
  set Skin friction coefficient = 0.005
  set Pressure drag coefficient = 0.5
end

subsection Obstacles
  set Names = bed
  subsection bed                # all below the slip surface stays
    set Shape                = terrain
    set Surface              = slip
    set Friction coefficient = 10
    set Maximum shear stress = {plain(soil.bed_shear_stress)}   # !! Pa, remoulded strength at the base
  end
end

subsection Bodies
  set Names = failed
  subsection failed
    set Shape         = layer
    set Upper surface = mudline
    set Lower surface = slip
    set Lower corner  = {low}
    set Upper corner  = {high}
    set Filling       = clipped
    set Material      = clay
    set K0            = 0.9
  end
end

subsection Materials
  set Names = clay
  subsection clay
    set Law                      = Bingham
    set Density                  = {plain(soil.density)}   # !! kg/m^3, saturated
    set Submerged density        = {plain(soil.submerged_density)}
    set Undrained shear strength = {soil.strength}   # !! Pa, undisturbed
    set Remoulded strength ratio = {1 / soil.sensitivity:.4g}   # !! one over the sensitivity
    set Stiffness ratio          = 300   # !! E/s_u
    set Poisson's ratio          = 0.49
    set Viscosity                = 100   # !! Pa s
  end
end

subsection Mesh tracking
  set Enabled = true
  set Margin  = 6
end

subsection Transfer
  set Scheme = filtered FLIP
end

subsection Splitting
  set Threshold = 2
end

{along(case, mesh)}

subsection Output
  set Folder              = output/{name}
  set Field interval      = {plain(rounded(end_time(case) / 20))}
  set Statistics interval = 1
end
"""

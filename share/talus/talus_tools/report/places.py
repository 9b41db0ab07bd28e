# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a reader knows the place by: release area, routes, stations and structures, in the
coordinates of the map."""

import dataclasses

import numpy
from matplotlib import patheffects
from matplotlib.collections import PolyCollection

from talus_tools.report.on_map import on_map, stations_of
from talus_tools.report.way import corners_of
from talus_tools.tables import read_lines

RELEASE, ROUTE, STRUCTURE, WAY = "#c8442b", "#7a1fa2", "#111111", "#3c464e"
# White around letters and lines, so that they can be read on any colour.
HALO = [patheffects.withStroke(linewidth=2.2, foreground="white")]


def routes_of(run):
    """{name: places, shape (n, 2)} of the lines on the ground."""
    groups = read_lines(run.path("lines.csv")) if run.has("lines.csv") else {}
    return {name: on_map(run, columns["x [m]"], columns["z [m]"])
            for name, columns in groups.items() if "z [m]" in columns}


def structure_names(run):
    """Names of the obstacles but for terrains, which are the ground itself, by number."""
    return {i: name for i, name in enumerate(run.obstacle_names())
            if run.entries.get(f"Obstacles/{name}/Shape", "") != "terrain"}


def structures_of(run):
    """{name: triangles in plan, shape (n, 3, 2)} at the last time."""
    series, names = run.series("obstacles"), structure_names(run)
    if series is None or not names:
        return {}
    corners, values = series.read(series.times[-1])
    if corners.shape[1] != 3:
        return {}
    plan = on_map(run, corners[:, :, 0], corners[:, :, 2])
    found = {name: plan[values["obstacle"] == i] for i, name in names.items()}
    return {name: triangles for name, triangles in found.items() if len(triangles)}


@dataclasses.dataclass
class Places:
    """Stations, routes and structures by name; `release`: the Grid of the thickness at the
    start, or None; `way`: corners of the way of the slide, shape (n, 2), along which sections
    are drawn; one only where the soil has not moved."""
    stations: dict
    routes: dict
    structures: dict
    release: object
    way: numpy.ndarray

    def points(self):
        """Places of stations, routes and structures, shape (n, 2)."""
        return numpy.array([*self.stations.values(),
                            *(place for route in self.routes.values() for place in route),
                            *(t.mean(axis=(0, 1)) for t in self.structures.values())]
                           ).reshape(-1, 2)

    def within(self, extent):
        """What a map of this extent (west, east, south, north) shows."""
        def is_seen(places):
            return len(inside(places.reshape(-1, 2), extent)) > 0
        return Places(*({name: places for name, places in some.items() if is_seen(places)}
                        for some in (self.stations, self.routes, self.structures)), self.release,
                      self.way)

    def legend(self):
        """What the lines and dots are, in words."""
        parts = [text for there, text in (
            (self.release is not None, "red outline: release area"),
            (self.routes, "violet: " + ", ".join(name or "line" for name in self.routes)),
            (self.stations, "triangles: stations"),
            (self.structures, "black: structures"),
            (len(self.way) > 1, "dashed: the way of the slide, along which sections are drawn")
        ) if there]
        return f" {'; '.join(parts).capitalize()}." if parts else ""


def places_of(run, grids):
    """All that is known of a 3-D run; grids: its rasters by name."""
    return Places(stations_of(run), routes_of(run), structures_of(run),
                  grids.get("thickness-at-start"), on_map(run, *corners_of(run).T))


def label(axes, text, place, color):
    """A name beside a place; names outside of the picture are left out."""
    axes.annotate(text, place, xytext=(4, 4), textcoords="offset points", fontsize=7.5,
                  color=color, path_effects=HALO, annotation_clip=True, zorder=6)


def is_release(thickness):
    """Where a thickness at the start is release area: more than a hundredth of the largest one, so
    that slivers at an edge are no release areas of their own."""
    return thickness > 0.01 * thickness.max()


def draw_release(axes, grid):
    """The outline of the release area."""
    there = is_release(numpy.nan_to_num(grid.values))
    if there.any() and not there.all():
        east, north = grid.place(*numpy.indices(there.shape))
        axes.contour(east, north, there.astype(float), levels=[0.5], colors=RELEASE,
                     linewidths=1.3, zorder=4)


def inside(places, extent):
    """Those places, shape (n, 2), that are within an extent (west, east, south, north)."""
    west, east, south, north = extent
    return places[(places[:, 0] >= west) & (places[:, 0] <= east)
                  & (places[:, 1] >= south) & (places[:, 1] <= north)]


def draw_places(axes, places):
    """Over a map that is drawn already; its window stays."""
    window = axes.get_xlim(), axes.get_ylim()
    if places.release is not None:
        draw_release(axes, places.release)
    axes.plot(*places.way.T, color=WAY, lw=1.1, ls="--", path_effects=HALO, zorder=4)
    for name, line in places.routes.items():
        axes.plot(*line.T, color=ROUTE, lw=1.6, path_effects=HALO, zorder=5)
        shown = inside(line, (*window[0], *window[1]))
        if len(shown) and name:
            label(axes, name, shown[numpy.argmax(shown[:, 1] - 1e-6 * shown[:, 0])]
                  - (0, 0.06 * (window[1][1] - window[1][0])), ROUTE)
    for name, triangles in places.structures.items():
        axes.add_collection(PolyCollection(triangles, facecolors=STRUCTURE, edgecolors=STRUCTURE,
                                           linewidths=0.8, zorder=5))
        label(axes, name, triangles.reshape(-1, 2).max(axis=0), STRUCTURE)
    for name, place in places.stations.items():
        axes.plot(*place, marker="^", color="white", mec=STRUCTURE, ms=6, mew=1, zorder=6)
        label(axes, name, place, STRUCTURE)
    axes.set(xlim=window[0], ylim=window[1])

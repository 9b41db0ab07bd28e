# SPDX-License-Identifier: LGPL-2.1-or-later
"""The slide in time, as a slider of the report and as a film: a picture that stays, with axes
and bathymetry, and small frames of soil over it, one per time."""

import dataclasses
import io

import numpy
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from PIL import Image, ImageDraw

from talus_tools.esri import Grid
from talus_tools.report.page import STYLE, WIDTH, plt, saved
from talus_tools.report.on_map import on_map
from talus_tools.report.places import draw_places, inside, places_of
from talus_tools.report.sections.cut import cut_surface, rectangles
from talus_tools.report.sections.maps import GROUND, draw_ground, read_maps
from talus_tools.report.sections.soil import SPEED, exaggeration, frame
from talus_tools.report.sections.thalweg import (THICKNESS, VELOCITY, VELOCITY_Z, columns_of,
                                                 magnification, places_of as cells_of)

# Axes of a picture [inch]: distances from its edges, and the largest extents.
LEFT, BOTTOM, TOP, RIGHT, LOWEST, HIGHEST = 0.95, 0.5, 0.15, 1.1, 1.7, 4.6
PIXELS = 820  # of a frame of a section, along x
LINE = 255  # palette entry of structures


@dataclasses.dataclass
class View:
    """PNG of the picture that stays and of the lines above all; shares (left, top, width,
    height) of it that the frames take; the frames, palette images; what is seen."""
    base: bytes
    top: bytes
    window: tuple
    frames: list
    caption: str


@dataclasses.dataclass
class Film:
    """Times [s] and one or more views of them."""
    times: numpy.ndarray
    views: list


def chosen(times, most):
    """At most so many of the times, evenly, the first and the last among them."""
    index = numpy.rint(numpy.linspace(0, len(times) - 1, min(most, len(times)))).astype(int)
    return times[numpy.unique(index)]


class Stage:
    """Axes of a fixed size over a window (left, right, lower, upper) in the unit of the
    axes, and the frames that fit them."""

    def __init__(self, window, ratio):
        """ratio: height of the axes over their width."""
        width = WIDTH - LEFT - RIGHT
        height = min(max(width * ratio, LOWEST), HIGHEST)
        if ratio * width > HIGHEST:
            width = HIGHEST / ratio
        self.window, self.size = window, (width, height)
        self.total = (LEFT + width + RIGHT, BOTTOM + height + TOP)

    def shares(self):
        """Left, top, width and height of the axes as shares of the picture."""
        (width, height), (all_width, all_height) = self.size, self.total
        return (LEFT / all_width, TOP / all_height, width / all_width, height / all_height)

    def axes(self, is_visible=True):
        """A figure and its axes."""
        plt.rcParams.update(STYLE)
        figure = plt.figure(figsize=self.total)
        left, top, width, height = self.shares()
        axes = figure.add_axes([left, 1 - top - height, width, height])
        axes.grid(False)
        axes.set(xlim=self.window[:2], ylim=self.window[2:])
        axes.ticklabel_format(useOffset=False, style="plain")
        if not is_visible:
            axes.set_axis_off()
        return figure, axes

    def scale(self, figure, colors, largest, label):
        """The scale of colours beside the axes."""
        left, top, width, height = self.shares()
        bar = figure.add_axes([left + width + 0.1 / self.total[0], 1 - top - height,
                               0.14 / self.total[0], height])
        bar.grid(False)
        figure.colorbar(ScalarMappable(Normalize(0, largest), colors), cax=bar, label=label,
                        extend="max")


def palette_image(index, colors):
    """An image of palette entries: 0 is transparent, LINE black, between them the colours."""
    image = Image.fromarray(index.astype(numpy.uint8))
    table = numpy.zeros((256, 3), dtype=numpy.uint8)
    table[1:LINE] = (255 * colormaps[colors](numpy.linspace(0, 1, LINE - 1))[:, :3]).astype(int)
    table[LINE] = 17
    image.putpalette(table.tobytes())
    return image


def entries(values, largest):
    """Palette entries of values from zero to the largest one; of NaN and zero, none."""
    share = numpy.nan_to_num(values) / (largest or 1)
    return numpy.where(share > 0, 1 + (LINE - 2) * numpy.clip(share, 0, 1), 0).astype(numpy.uint8)


def png(image):
    """The bytes of an image."""
    stream = io.BytesIO()
    options = {"transparency": 0} if image.mode == "P" else {}
    image.save(stream, "PNG", optimize=True, **options)
    return stream.getvalue()


def high(values):
    """The end of a scale: 99.5 % of the values are below."""
    values = values[numpy.isfinite(values) & (values > 0)]
    return float(numpy.percentile(values, 99.5)) if len(values) else 1.0


# --- In plan, from profile.csv.

def rasters(run, times):
    """Thickness and speed, shape (times, z, x), NaN where there is no soil, and the Grid of
    their cells."""
    table = run.tables["profile"]
    x, i, dx = cells_of(table["x [m]"])
    z, k, dz = cells_of(table["z [m]"])
    speed = numpy.hypot(table[VELOCITY], table[VELOCITY_Z])
    result = numpy.full((2, len(times), len(z), len(x)), numpy.nan)
    for t, time in enumerate(times):
        now = table["time [s]"] == time
        result[0, t, k[now], i[now]] = table[THICKNESS][now]
        result[1, t, k[now], i[now]] = speed[now]
    west, south = on_map(run, x[0] - dx / 2, z[-1] + dz / 2)
    return result, Grid(result[0, 0], float(west), float(south), dx, dz)


def plan_window(cells, places):
    """Window of the map with all soil and what is drawn near it."""
    west, east, south, north = cells.extent()
    near = inside(places.points(), (2 * west - east, 2 * east - west, 2 * south - north,
                                    2 * north - south))
    for e, n in near:
        west, east, south, north = min(west, e), max(east, e), min(south, n), max(north, n)
    margin = 0.06 * max(east - west, north - south)
    return west - margin, east + margin, south - margin, north + margin


def plan_view(stage, what, cells, ground, places):
    """One quantity in plan; what: (values by time, colours, label, caption)."""
    values, colors, label, caption = what
    figure, axes = stage.axes()
    if ground:
        draw_ground(axes, ground, stage.window)
    axes.set(xlabel="easting [m]", ylabel="northing [m]", xlim=stage.window[:2],
             ylim=stage.window[2:])
    largest = high(values)
    stage.scale(figure, colors, largest, label)
    over, empty = stage.axes(is_visible=False)
    draw_places(empty, places)
    west, east, south, north = stage.window
    left, top, width, height = stage.shares()
    extent = cells.extent()
    window = (left + width * (extent[0] - west) / (east - west),
              top + height * (north - extent[3]) / (north - south),
              width * (extent[1] - extent[0]) / (east - west),
              height * (extent[3] - extent[2]) / (north - south))
    return View(saved(figure), saved(over, transparent=True), window,
                [palette_image(entries(one, largest), colors) for one in values],
                caption + places.legend())


def plan_film(run, most):
    """Thickness and speed from above."""
    table = run.tables["profile"]
    if table is None:
        return None
    times = chosen(numpy.unique(table["time [s]"]), most)
    (thickness, speed), cells = rasters(run, times)
    grids = read_maps(run.path("maps")) if run.has("maps/ground.asc") else {}
    places = places_of(run, grids)
    window = plan_window(cells, places)
    places = places.within(window)
    stage = Stage(window, (window[3] - window[2]) / (window[1] - window[0]))
    return Film(times, [plan_view(stage, what, cells, grids.get(GROUND), places) for what in (
        (thickness, "viridis", "thickness [m]", "Thickness of the soil, from above."),
        (speed, "magma", "speed [m/s]", "Mean speed over the depth, from above."))])


# --- In section, from the points.

def painted(index, quads, colors, window):
    """Paint quadrilaterals, shape (n, 4, 2), into an image of palette entries: small ones by
    samples as fine as pixels, which is fast for many, large ones as polygons."""
    x0, x1, y0, y1 = window
    rows, columns = index.shape
    places = (quads - (x0, y0)) / (x1 - x0, y0 - y1) * (columns, rows) + (0, rows)
    is_large = numpy.ptp(places, axis=1).max(axis=1, initial=0) > 3
    a, b = numpy.meshgrid(*2 * [(numpy.arange(4) + 0.5) / 4])
    weights = numpy.stack([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b]).reshape(4, -1)
    p = numpy.einsum("qcd,cs->qsd", places[~is_large], weights).astype(int).reshape(-1, 2)
    keep = ((p >= 0) & (p < (columns, rows))).all(axis=1)
    index[p[keep, 1], p[keep, 0]] = numpy.repeat(colors[~is_large], weights.shape[1])[keep]
    image = Image.fromarray(index)
    draw = ImageDraw.Draw(image)
    for place, color in zip(places[is_large].reshape(-1, 8).tolist(), colors[is_large].tolist()):
        draw.polygon(place, fill=color)
    return numpy.array(image)


def painted_lines(index, lines, window):
    """Paint lines, shape (n, 2, 2), two pixels thick."""
    x0, x1, y0, y1 = window
    rows, columns = index.shape
    places = (lines - (x0, y0)) / (x1 - x0, y0 - y1) * (columns, rows) + (0, rows)
    image = Image.fromarray(index)
    draw = ImageDraw.Draw(image)
    for place in places.reshape(-1, 4).tolist():
        draw.line(place, fill=LINE, width=2)
    return numpy.array(image)


def canvas(stage):
    """Palette entries of a frame without soil."""
    return numpy.zeros((int(PIXELS * stage.size[1] / stage.size[0]), PIXELS), dtype=numpy.uint8)


def section_view(stage, frames, largest, label, caption, bed=None):
    """A section with its scale; bed: x and height of it, or None."""
    figure, axes = stage.axes()
    axes.set(xlabel="x [m]", ylabel="y [m]")
    stage.scale(figure, "viridis", largest, label)
    over, lines = stage.axes(is_visible=False)
    if bed:
        lines.plot(*bed, color="black", lw=1.2)
    return View(saved(figure), saved(over, transparent=True), stage.shares(), frames, caption)


def points_film(run, most):
    """The soil coloured by its speed, and the structures."""
    series = run.series("points")
    if series is None:
        return None
    times = chosen(series.times, most)
    states = [series.read(time) for time in times]
    if not all(len(corners) for corners, _ in states):
        return None
    window, height = frame([corners for corners, _ in states], 1)
    stage = Stage(window, height / (0.82 * WIDTH))
    largest = high(numpy.concatenate([values[SPEED] for _, values in states]))
    surfaces, frames = run.series("obstacles"), []
    for time, (corners, values) in zip(times, states):
        # Soil at rest is seen, too.
        index = painted(canvas(stage), rectangles(corners, values),
                        numpy.maximum(entries(values[SPEED], largest), 1), window)
        if surfaces:
            lines, _ = surfaces.read(surfaces.nearest(time))
            index = painted_lines(index, cut_surface(lines, None), window)
        frames.append(palette_image(index, "viridis"))
    caption = ("The soil, coloured by speed. " + exaggeration(window, stage.size[1])
               + (" Black: surfaces of obstacles." if surfaces else ""))
    return Film(times, [section_view(stage, frames, largest, "speed [m/s]", caption)])


def columns_film(run, most):
    """Thickness over the bed, magnified, coloured by the mean velocity over the depth; None
    where the bed is so flat that the points themselves show the slide."""
    table = run.tables["profile"]
    if table is None or "ground [m]" not in table:
        return None
    x, ground = columns_of(run, None).bed()
    factor = magnification(ground, table[THICKNESS].max())
    if factor == 1:
        return None
    times = chosen(numpy.unique(table["time [s]"]), most)
    top = ground.max() + 1.1 * factor * table[THICKNESS].max()
    stage = Stage((x[0], x[-1], ground.min() - 0.05 * numpy.ptp(ground), top), 0.36)
    largest, half = high(numpy.abs(table[VELOCITY])), cells_of(x)[2] / 2
    frames = []
    for time in times:
        now = table["time [s]"] == time
        low, at = table["ground [m]"][now], table["x [m]"][now]
        upper = low + factor * table[THICKNESS][now]
        quads = numpy.stack([numpy.stack([at + side * half, height], axis=-1)
                             for side, height in ((-1, low), (1, low), (1, upper), (-1, upper))],
                            axis=1)
        colors = numpy.maximum(entries(numpy.abs(table[VELOCITY][now]), largest), 1)
        frames.append(palette_image(painted(canvas(stage), quads, colors, stage.window),
                                    "viridis"))
    return Film(times, [section_view(
        stage, frames, largest, "mean velocity [m/s]",
        f"Thickness of the soil over the bed, drawn {factor:g} times as large as heights of the "
        "bed, coloured by the mean velocity over the depth.", (x, ground))])


def film(run, most):
    """The film of a run with at most so many times; None where the run wrote neither points
    nor a profile, or one time only."""
    found = (plan_film(run, most) if run.dimension == 3 else
             columns_film(run, most) or points_film(run, most))
    return found if found and len(found.times) > 1 else None

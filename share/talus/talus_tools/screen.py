# SPDX-License-Identifier: LGPL-2.1-or-later
"""Factor of safety of the infinite slope over a raster: where to look for slides."""

import math
import os

import numpy
from osgeo import gdal
from scipy.ndimage import uniform_filter

from talus_tools.errors import Parser, UserError, number_of, positive
from talus_tools.gis import extent, open_raster
from talus_tools.report.page import plt
from talus_tools.tables import read_table

DESCRIPTION = """Write the factor of safety of an infinite slope of undrained clay at each place of a
raster of heights, NAME-safety.tif, and a picture, NAME-safety.png. The slope fails along a surface
parallel to the sea floor, at the most unfavourable of the depths. See doc/bathymetry.md."""
GRAVITY = 9.81  # m/s^2
LARGEST = 100.  # factors above are written as this
BAND_CELLS = 4_000_000
CLASSES = (1, 1.2, 1.5, 2, 3)


def options_of_user():
    """Options of the command line."""
    parser = Parser(prog="talus-screen", description=DESCRIPTION)
    parser.add_argument("raster", metavar="RASTER", help="heights, in any format of GDAL")
    parser.add_argument("--depths", metavar="D,D,...", default="5,10,20,40",
                        help="depths of the slip surface [m]; default 5,10,20,40")
    parser.add_argument("--strength", metavar="A,B", default="2000,1500",
                        help="undrained shear strength A + B depth [Pa]; or a CSV file with the "
                        "columns 'depth [m]' and 'undrained shear strength [Pa]'; default "
                        "2000,1500")
    parser.add_argument("--horizontal", metavar="K", type=number_of, default=0,
                        help="pseudo-static horizontal acceleration down the slope, over gravity")
    parser.add_argument("--density", metavar="X", type=positive, default=1650,
                        help="of the saturated soil [kg/m^3]; default 1650")
    parser.add_argument("--water-density", metavar="X", type=positive, default=1025,
                        help="[kg/m^3]; default 1025")
    parser.add_argument("--length", metavar="M", type=positive,
                        help="average the heights over squares of this side [m]: gullies smaller "
                        "than a slide do not count")
    parser.add_argument("--output", metavar="FOLDER", default=".", help="folder of the files")
    return parser.parse_args()


def list_of(words, option):
    """Numbers of an option."""
    try:
        return [float(word) for word in words.split(",")]
    except ValueError as error:
        raise UserError(f"{option} is '{words}', where numbers, separated by commas, are "
                        "expected.") from error


def strengths_at(depths, words):
    """Undrained shear strength [Pa] at depths [m]."""
    if os.path.exists(words):
        table = read_table(words)
        try:
            return numpy.interp(depths, table["depth"], table["undrained shear strength"])
        except KeyError as error:
            raise UserError(f"'{words}' has no column {error}, where 'depth [m]' and 'undrained "
                            "shear strength [Pa]' are expected.") from error
    numbers = list_of(words, "--strength")
    if len(numbers) != 2:
        raise UserError(f"--strength is '{words}', where two numbers A,B of A + B depth, or an "
                        "existing CSV file are expected.")
    return numbers[0] + numbers[1] * numpy.asarray(depths)


def factor_of_safety(tangent, depths, strengths, soil):
    """Least factor of safety over the depths, at slopes with a tangent [-]: undrained strength
    over the shear stress of submerged weight and horizontal acceleration on a plane parallel to
    the slope @cite morgenstern1967. `soil`: density, that of water [kg/m^3], k_h [-]."""
    density, water, horizontal = soil
    cosine = 1 / (1 + tangent**2)  # squared
    stress = cosine * ((density - water) * tangent + density * horizontal)
    ratio = min(strength / depth for strength, depth in zip(strengths, depths))
    with numpy.errstate(divide="ignore"):
        return numpy.minimum(ratio / (GRAVITY * stress), LARGEST)


def cell_sizes(raster, rows):
    """Width and height of the cells [m] in rows, counted from the north."""
    west, dx, _, north, _, dy = raster.dataset.GetGeoTransform()
    if not raster.is_in_degrees:
        unit = raster.system.GetLinearUnits() if raster.system else 1
        return numpy.full(len(rows), dx * unit), -dy * unit
    a, e2 = 6378137., 6.69437999014e-3  # WGS 84: m and -
    latitude = numpy.radians(north + (numpy.asarray(rows) + 0.5) * dy)
    across = a / numpy.sqrt(1 - e2 * numpy.sin(latitude)**2)
    along = across * (1 - e2) / (1 - e2 * numpy.sin(latitude)**2)
    return (math.radians(dx) * across * numpy.cos(latitude),
            (math.radians(-dy) * along)[:, None])


def heights_of(raster, first, n_rows):
    """Heights of rows [m], NaN where there are none."""
    band = raster.dataset.GetRasterBand(1)
    values = band.ReadAsArray(0, first, raster.dataset.RasterXSize, n_rows).astype(float)
    known = band.GetMaskBand().ReadAsArray(0, first, raster.dataset.RasterXSize, n_rows) != 0
    values = (values * (band.GetScale() or 1) + (band.GetOffset() or 0)) * raster.unit
    return numpy.where(known, values, numpy.nan)


def averaged(values, n_rows, n_columns):
    """Means over rectangles of cells, of those with a value."""
    size = (n_rows, n_columns)
    known = numpy.isfinite(values)
    if known.all():
        return uniform_filter(values, size, mode="nearest")
    sums = uniform_filter(numpy.where(known, values, 0), size, mode="nearest")
    shares = uniform_filter(known.astype(float), size, mode="nearest")
    return numpy.where(known, sums / numpy.maximum(shares, 1e-9), numpy.nan)


def tangents(values, dx, dy):
    """Tangent of the slope, by central differences; one-sided at the edges."""
    down, right = numpy.gradient(values)
    return numpy.hypot(down / dy, right / dx[:, None])


def bands(raster, length):
    """First row and tangents of the slope of bands of rows of the whole raster."""
    rows, columns = raster.dataset.RasterYSize, raster.dataset.RasterXSize
    dx, dy = cell_sizes(raster, numpy.arange(rows))
    half = [1 + 2 * int(0.5 * length / numpy.median(size)) if length else 1 for size in (dy, dx)]
    margin = half[0] // 2 + 1
    step = max(1, BAND_CELLS // columns)
    for first in range(0, rows, step):
        start, end = max(0, first - margin), min(rows, first + step + margin)
        values = heights_of(raster, start, end - start)
        if max(half) > 1:
            values = averaged(values, *half)
        part = dy if numpy.isscalar(dy) else dy[start:end]
        yield first, tangents(values, dx[start:end], part)[first - start:first - start + step]


def draw(factors, raster, path):
    """Classes of the factor on the map."""
    west, south, east, north = extent(raster)
    figure, axes = plt.subplots(figsize=(8, 7), layout="constrained")
    colors = plt.get_cmap("RdYlGn")(numpy.linspace(0.05, 0.95, len(CLASSES) + 1))
    levels = [0, *CLASSES, LARGEST * 1.01]
    image = axes.imshow(
        factors, extent=(west, east, south, north), interpolation="nearest",
        aspect=1 / math.cos(math.radians(0.5 * (south + north))) if raster.is_in_degrees else 1,
        cmap=plt.matplotlib.colors.ListedColormap(colors),
        norm=plt.matplotlib.colors.BoundaryNorm(levels, len(colors)))
    bar = figure.colorbar(image, ax=axes, shrink=0.8, label="factor of safety [-]")
    bar.set_ticks(levels[1:-1])
    names = ("longitude", "latitude") if raster.is_in_degrees else ("easting [m]", "northing [m]")
    axes.set(xlabel=names[0], ylabel=names[1])
    axes.ticklabel_format(useOffset=False, style="plain")
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)


def create(path, raster):
    """A GeoTIFF with the cells of the raster."""
    target = gdal.GetDriverByName("GTiff").Create(
        path, raster.dataset.RasterXSize, raster.dataset.RasterYSize, 1, gdal.GDT_Float64,
        ["COMPRESS=DEFLATE", "PREDICTOR=3", "ZLEVEL=1", "TILED=YES"])
    target.SetGeoTransform(raster.dataset.GetGeoTransform())
    if raster.system is not None:
        target.SetProjection(raster.system.ExportToWkt())
    target.GetRasterBand(1).SetNoDataValue(math.nan)
    return target


def screen(raster, depths, strengths, soil, length, path):
    """Write the factors to a GeoTIFF; return a thinned copy for the picture and the number of
    cells below each of CLASSES, with the number of all as last."""
    target = create(path, raster)
    every = max(1, max(raster.dataset.RasterXSize, raster.dataset.RasterYSize) // 1500)
    counts, picture = numpy.zeros(len(CLASSES) + 1, dtype=int), []
    for first, tangent in bands(raster, length):
        factors = factor_of_safety(tangent, depths, strengths, soil)
        target.GetRasterBand(1).WriteArray(factors, 0, first)
        counts += [int((factors < limit).sum()) for limit in (*CLASSES, math.inf)]
        picture.append(factors[-first % every::every, ::every])
    del target  # writes the file
    return numpy.concatenate(picture), counts


def main():
    """Raster, picture and shares of the area."""
    options = options_of_user()
    depths = list_of(options.depths, "--depths")
    if not all(0 < depth < math.inf for depth in depths):
        raise UserError(f"--depths are '{options.depths}', where numbers above 0 are expected.")
    strengths = strengths_at(depths, options.strength)
    if not all(strength > 0 for strength in strengths):
        raise UserError("The undrained shear strength is not above 0 at each of the depths. "
                        "Correct --strength.")
    raster = open_raster(options.raster)
    name = os.path.join(options.output,
                        os.path.splitext(os.path.basename(options.raster))[0] + "-safety")
    try:
        os.makedirs(options.output, exist_ok=True)
        picture, counts = screen(raster, depths, strengths,
                                 (options.density, options.water_density, options.horizontal),
                                 options.length, name + ".tif")
        draw(picture, raster, name + ".png")
    except (OSError, RuntimeError) as error:
        raise UserError(f"'{name}.tif' cannot be written: {error}.") from error
    if not counts[-1]:
        raise UserError(f"'{options.raster}' has no heights.")
    print("Share of the area below a factor of safety: " + ", ".join(
        f"{limit:g}: {100 * count / counts[-1]:.1f} %" for limit, count in zip(CLASSES, counts)))
    print(f"See {name}.png and {name}.tif.")
    return 0

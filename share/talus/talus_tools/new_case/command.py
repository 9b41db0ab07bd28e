# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-new."""

import os

import numpy

from talus_tools.errors import Parser, UserError, positive
from talus_tools.gis import map_of, open_raster, transformed, words_of
from talus_tools.new_case.case import MOST_LIP, Case, Soil
from talus_tools.new_case.path import lengths
from talus_tools.new_case.picture import draw
from talus_tools.new_case.release import on_map, read_release
from talus_tools.new_case.write import text

DESCRIPTION = """Write two cases of talus from a raster of heights and the outline of a release
area: NAME-3d.prm, the slide in three dimensions, NAME-section.prm, its section along the steepest
path, and NAME.png, a picture of both. See doc/bathymetry.md."""


def options_of_user():
    """Options of the command line."""
    parser = Parser(prog="talus-new", description=DESCRIPTION)
    parser.add_argument("raster", metavar="RASTER", help="heights, in any format of GDAL")
    parser.add_argument("polygon", metavar="POLYGON",
                        help="release area: polygons in any format of GDAL")
    parser.add_argument("depth", metavar="DEPTH",
                        help="depth of the slip surface [m], or the field of the polygons with it")
    parser.add_argument("--name", help="of the case, instead of that of the polygon")
    parser.add_argument("--output", metavar="FOLDER", default=".", help="folder of the files")
    for name, default, words in (
            ("--cells", None, "cells across the depth, instead of 1.2 (section: 4)"),
            ("--cell-size", None, "size of the cells in 3-D [m]"),
            ("--sides", None, "rise of the sides of the release, height over length; by default "
             "0.2, and less towards the toe, so that the bed does not rise downslope"),
            ("--reach", 20_000, "farthest that the slide may come [m]"),
            ("--strength-ratio", 0.25, "undrained shear strength over the vertical effective "
             "stress [-]"),
            ("--strength-at-mudline", 2000, "[Pa]"),
            ("--sensitivity", 5, "undisturbed over remoulded strength [-]"),
            ("--bed-shear-stress", 0, "[Pa], instead of the remoulded strength at the base"),
            ("--density", 1650, "of the saturated soil [kg/m^3]"),
            ("--water-density", 1025, "[kg/m^3]")):
        parser.add_argument(name, type=positive, default=default, metavar="X",
                            help=words + (f"; default {default:g}" if default else ""))
    options = parser.parse_args()
    if options.density <= options.water_density:
        raise UserError(f"The soil has {options.density:g} kg/m^3, where more than the water, "
                        f"{options.water_density:g} kg/m^3, is expected.")
    return options


def case_of(options):
    """The case of the user's files."""
    raster = open_raster(options.raster)
    polygons, system, field = read_release(options.polygon, options.depth)
    corners = numpy.concatenate([polygon.corners for polygon in polygons])
    code = map_of(raster, transformed(corners, system, raster.system))
    release = on_map(options.polygon, polygons, system, field, raster, code)
    weight = 9.81 * (options.density - options.water_density)
    soil = Soil(options.strength_at_mudline, float(f"{options.strength_ratio * weight:.2g}"),
                options.sensitivity, options.density, options.water_density, release.depth,
                options.bed_shear_stress)
    return Case(raster, code, release, soil, options)


def remarks(case):
    """What the user should know, as sentences."""
    result = []
    lip = case.lip(case.toe)
    if lip > MOST_LIP * case.release.depth:
        result.append(f"The slip surface rises by {lip:.1f} m downslope of the release, which "
                      "holds soil back. Give a smaller depth, gentler --sides, or a longer area.")
    if not case.comes_to_rest:
        result.append("A block of the soil would not come to rest on the path: the raster, or "
                      "--reach, ends before. Soil that leaves the mesh is lost, and counted.")
    if case.driving_stress() < case.soil.bed_shear_stress:
        result.append(f"The weight of the soil gives a shear stress of {case.driving_stress():.0f} "
                      f"Pa in the middle of the area, less than the bed shear stress of "
                      f"{case.soil.bed_shear_stress:g} Pa: the soil will hardly move.")
    if len(case.release.polygons) > 1:
        result.append("The section runs through the polygon with the most soil.")
    return result


def main():
    """Two cases and a picture."""
    options = options_of_user()
    name = options.name or os.path.splitext(os.path.basename(options.polygon))[0]
    paths = {what: os.path.join(options.output, name + what)
             for what in ("-3d.prm", "-section.prm", ".png")}
    for path in paths.values():
        if os.path.exists(path):
            raise UserError(f"'{path}' is there already. Remove it, or choose another --name or "
                            "--output.")
    case = case_of(options)
    try:
        os.makedirs(options.output, exist_ok=True)
        for dim, what in ((3, "-3d"), (2, "-section")):
            with open(paths[what + ".prm"], "w", encoding="utf-8") as stream:
                stream.write(text(case, dim, options.output, name + what))
        draw(case, paths[".png"])
    except OSError as error:
        raise UserError(f"'{options.output}' cannot be written: {error.strerror}.") from error
    on = f" on the map {words_of(case.code)}" if case.code else ""
    print(f"Release: {case.volume():.3g} m^3{on}. Path: {lengths(case.path)[-1]:.0f} m, from "
          f"{case.floor.at(case.path[0])[0]:.0f} m to {case.floor.at(case.path[-1])[0]:.0f} m.")
    for remark in remarks(case):
        print("Remark: " + remark)
    print(f"See {paths['.png']}. Replace the numbers marked by !!, and run 'talus "
          f"{paths['-section.prm']}', then 'talus {paths['-3d.prm']}'.")
    return 0

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-tsunami."""

import os
from types import SimpleNamespace

from talus_tools.errors import Parser, UserError, positive
from talus_tools.report.on_map import stations_of
from talus_tools.results import Results
from talus_tools.tsunami.geoclaw import sea_floor, write_geoclaw
from talus_tools.tsunami.motion import blocks_of, motion_of
from talus_tools.tsunami.write import rows_of_table, write_dtopo, write_netcdf, write_table

DESCRIPTION = """Write the change of the height of the sea floor in time as the source of a tsunami
model: tsunami-source.tt3 (GeoClaw's dtopo, type 3) and tsunami-source.csv. The run needs
'Output/Plan interval'; see doc/tsunami.md."""


def options_of_user():
    """Options of the command line."""
    parser = Parser(prog="talus-tsunami", description=DESCRIPTION)
    parser.add_argument("run", metavar="DIR", help="output folder of a run")
    parser.add_argument("--interval", type=positive, metavar="S",
                        help="time between two blocks [s], instead of 'Output/Plan interval'")
    parser.add_argument("--start-time", type=positive, default=0, metavar="S",
                        help="time of the tsunami run at which the slide starts [s], instead of one"
                        " interval: a motion that begins with the run counts as topography")
    parser.add_argument("--width", type=positive, default=0, metavar="M",
                        help="2-D only: width of the slide across the section [m]")
    parser.add_argument("--water-depth", type=positive, default=0, metavar="M",
                        help="depth of the water d above the slide [m], for a column of the speed "
                        "over sqrt(g d)")
    parser.add_argument("--degrees", action="store_true",
                        help="longitude and latitude in WGS 84 in place of the map in metres")
    parser.add_argument("--netcdf", action="store_true", help="write tsunami-source.nc, too")
    parser.add_argument("--geoclaw", action="store_true", help="3-D only: write topography.tt3, the "
                        "sea floor before the slide, and setrun.py, a case of GeoClaw, too")
    parser.add_argument("--sea-level", type=float, default=0, metavar="M",
                        help="with --geoclaw: sea level on the vertical axis of the map [m]")
    parser.add_argument("--output", metavar="FOLDER", help="folder of the files, instead of DIR")
    return parser.parse_args()


def main():
    """Source of a tsunami model."""
    options = options_of_user()
    results = Results(options.run)
    series = results.plan()
    options.interval = options.interval or float(results.parameters["Output/Plan interval"])
    options.gravity = float(results.parameters["Gravity/Magnitude"])
    blocks = blocks_of(series, options.interval)
    motion = motion_of(series, blocks, options)
    if series.dim == 2 and (options.degrees or options.geoclaw):
        raise UserError("A 2-D section has no place on a map, so it has no degrees and no sea floor "
                        "around the slide. Leave out --degrees and --geoclaw.")
    heights = sea_floor(results, series.cells) if options.geoclaw else None
    gauges = stations_of(SimpleNamespace(entries=results.parameters)) if options.geoclaw else {}
    if options.degrees:
        from talus_tools.tsunami.degrees import heights_on_degrees, on_degrees, transformation
        motion = on_degrees(motion, series.map)
        if options.geoclaw:
            heights = heights_on_degrees(series.cells, heights, motion.cells, series.map)
            gauges = {name: transformation(series.map)([place])[0]
                      for name, place in gauges.items()}
    folder = options.output or results.folder
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise UserError(f"'{folder}' cannot be made: {error.strerror}.") from error
    source = os.path.join(folder, "tsunami-source")
    write_dtopo(source + ".tt3", motion)
    if options.netcdf:
        write_netcdf(source + ".nc", motion)
    if options.geoclaw:
        write_geoclaw(folder, motion, heights, gauges, options)
    write_table(source + ".csv", rows_of_table(series, blocks, options, options.width or 1))
    if 0 < options.start_time < options.interval:
        print(f"Remark: --start-time is {options.start_time:g} s, where at least one interval of "
              f"{options.interval:g} s is expected: an earlier motion counts as topography of the "
              "start.")
    print(f"See {source}.tt3" + (", .nc" if options.netcdf else "")
          + (", setrun.py" if options.geoclaw else "") + f" and .csv: {motion.n_blocks} blocks from t = {motion.start_time:g} s, each "
          f"{motion.interval:g} s.")
    return 0

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A whole case of GeoClaw around the source: the sea floor before the slide, and setrun.py."""

import math
import os

import numpy

from talus_tools.errors import UserError
from talus_tools.tsunami.write import new_file

SETRUN = '''"""Tsunami of the slide in '{run}': a case of GeoClaw (Clawpack 5.7 or newer).

One grid with the cells of the source covers the topography. To follow the wave to a coast append
files of a larger area to topofiles, widen lower and upper, and refine (amr_levels_max).
"""
from clawpack.clawutil import data


def setrun(claw_pkg="geoclaw"):
    """Parameters of the run."""
    rundata = data.ClawRunData(claw_pkg, 2)

    claw = rundata.clawdata
    claw.lower[:] = {lower}
    claw.upper[:] = {upper}
    claw.num_cells[:] = {cells}
    claw.num_eqn, claw.num_aux, claw.capa_index = 3, {n_aux}, {capacity}
    claw.t0 = 0.0
    claw.output_style = 1
    claw.tfinal = {end!r}  # the slide, then twice the time in which the wave crosses the grid
    claw.num_output_times = 20
    claw.dt_variable, claw.dt_initial = True, {step!r}
    claw.cfl_desired, claw.cfl_max = 0.75, 1.0
    claw.steps_max = 100000
    claw.order, claw.dimensional_split, claw.transverse_waves = 2, "unsplit", 2
    claw.num_waves, claw.limiter, claw.use_fwaves = 3, ["mc", "mc", "mc"], True
    claw.source_split = "godunov"
    claw.num_ghost = 2
    claw.bc_lower[:] = ["extrap", "extrap"]  # waves leave the grid
    claw.bc_upper[:] = ["extrap", "extrap"]

    amr = rundata.amrdata
    amr.amr_levels_max = 1
    amr.refinement_ratios_x, amr.refinement_ratios_y, amr.refinement_ratios_t = [2], [2], [2]
    amr.aux_type = {aux}
    amr.flag_richardson, amr.flag2refine = False, True

    geo = rundata.geo_data
    geo.gravity = {gravity!r}
    geo.coordinate_system = {system}  # 1: metres, 2: longitude and latitude
    geo.sea_level = {sea_level!r}
    geo.dry_tolerance = 0.001
    geo.friction_forcing, geo.manning_coefficient, geo.friction_depth = True, 0.025, 1e6
    rundata.refinement_data.variable_dt_refinement_ratios = True
    rundata.refinement_data.wave_tolerance = 0.01

    rundata.topo_data.topofiles.append([3, "topography.tt3"])
    rundata.dtopo_data.dtopofiles.append([3, "tsunami-source.tt3"])
    rundata.dtopo_data.dt_max_dtopo = {interval!r}
    rundata.qinit_data.qinit_type = 0
    rundata.qinit_data.qinitfiles = []
{gauges}    return rundata


if __name__ == "__main__":
    setrun().write()
'''


def sea_floor(results, cells):
    """Height of the sea floor before the slide [m] on the cells of the plan series: the ground and
    the soil on it."""
    for name in ("ground", "thickness-at-start"):
        if not results.has(f"maps/{name}.asc"):
            raise UserError(f"'{results.folder}' has no map 'maps/{name}.asc', from which the sea "
                            "floor before the slide follows. Set 'Maps/Write', and give the bed as "
                            "an obstacle; or leave out --geoclaw.")
    ground, soil = results.map("ground"), results.map("thickness-at-start")
    if not (ground.is_aligned_with(soil) and ground.values.shape == (cells.rows, cells.columns)):
        raise UserError(f"The maps of '{results.folder}' do not have the cells of 'plan.csv'. Run "
                        "talus again.")
    known = numpy.isfinite(ground.values)
    if not known.all():
        raise UserError(f"'{results.path('maps/ground.asc')}' has {(~known).sum()} cells without a "
                        "height, so the sea floor is not known there. Let the bed cover the mesh, "
                        "or leave out --geoclaw.")
    return ground.values + numpy.nan_to_num(soil.values)


def write_topography(path, cells, heights):
    """GeoClaw's topography of type 3; numbers belong to the centres of the cells."""
    step = f"{cells.dx!r} cellsize" if cells.dx == cells.dy else f"{cells.dx!r} {cells.dy!r} cellsize"
    with new_file(path) as part, open(part, "w", encoding="ascii") as stream:
        stream.write(f"{cells.columns} mx\n{cells.rows} my\n{cells.x()[0]!r} xlower\n"
                     f"{cells.y()[-1]!r} ylower\n{step}\n-9999 nodata_value\n")
        numpy.savetxt(stream, heights, fmt="%.12g")


def write_setrun(path, motion, heights, gauges, options):
    """setrun.py on the cells of the topography. `gauges`: {name: (x, y)}."""
    cells = motion.cells
    depth = max(options.sea_level - heights.min(), 1.)
    metre = 1 / 111e3 if motion.in_degrees else 1
    wave = math.sqrt(options.gravity * depth)  # m/s
    length = math.hypot(cells.columns * cells.dx, cells.rows * cells.dy) / metre
    aux = ["center", "capacity", "yleft"] if motion.in_degrees else ["center"]
    lines = "".join(
        f"    rundata.gaugedata.gauges.append([{i + 1}, {x!r}, {y!r}, 0., 1e10])  # {name}\n"
        for i, (name, (x, y)) in enumerate(gauges.items()))
    text = SETRUN.format(
        run=options.run, lower=[float(cells.x()[0]), float(cells.y()[-1])],
        upper=[float(cells.x()[-1]), float(cells.y()[0])],
        cells=[cells.columns - 1, cells.rows - 1], n_aux=len(aux),
        capacity=2 if motion.in_degrees else 0, aux=aux,
        end=float(round(motion.times()[-1] + 2 * length / wave)),
        step=0.5 * min(cells.dx, cells.dy) / metre / wave, gravity=options.gravity,
        system=2 if motion.in_degrees else 1, sea_level=options.sea_level,
        interval=motion.interval, gauges=lines)
    with new_file(path) as part, open(part, "w", encoding="utf-8") as stream:
        stream.write(text)


def write_geoclaw(folder, motion, heights, gauges, options):
    """topography.tt3 and setrun.py. Sea floor that lies dry where the slide moves is an error: no
    wave would arise."""
    moves = numpy.logical_or.reduce([motion.change(k) != 0 for k in range(motion.n_blocks)])
    if moves.any() and heights[moves].min() >= options.sea_level:
        raise UserError(f"The slide moves on a sea floor at {heights[moves].min():g} m and higher, "
                        f"and the sea level is {options.sea_level:g} m. Give the sea level on the "
                        "vertical axis of the map with --sea-level, m.")
    write_topography(os.path.join(folder, "topography.tt3"), motion.cells, heights)
    write_setrun(os.path.join(folder, "setrun.py"), motion, heights, gauges, options)

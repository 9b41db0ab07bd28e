# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of the source of a tsunami model."""

import contextlib
import os

import numpy

from talus_tools.errors import UserError


@contextlib.contextmanager
def new_file(path):
    """Name under which a file is written; the file gets its own name when it is complete."""
    part = path + ".part"
    try:
        yield part
        os.replace(part, path)
    except OSError as error:
        raise UserError(f"'{path}' could not be written: {error.strerror}. Make room, or give "
                        "another folder with --output.") from error
    finally:
        with contextlib.suppress(OSError):
            os.remove(part)


def write_dtopo(path, motion):
    """GeoClaw's dtopo file of type 3: nine lines of header, the value first, then a row of
    numbers for each row of each block, the northernmost first. Numbers belong to the centres of
    the cells, and are written with the digits that give them back bit by bit."""
    cells = motion.cells
    header = {"mx": cells.columns, "my": cells.rows, "mt": motion.n_blocks,
              "xlower": cells.x()[0], "ylower": cells.y()[-1], "t0": motion.start_time,
              "dx": cells.dx, "dy": cells.dy, "dt": motion.interval}
    with new_file(path) as part, open(part, "w", encoding="ascii") as stream:
        for label, value in header.items():
            stream.write(f"{value:.17g} {label}\n")
        for k in range(motion.n_blocks):
            numpy.savetxt(stream, motion.change(k), fmt="%.17g")


def write_netcdf(path, motion):
    """netCDF-4 with the variables x, y [m], time [s] and dz(time, y, x) [m]; y increases. In
    degrees, lon and lat stand in place of x and y."""
    from osgeo import gdal, gdal_array
    gdal.UseExceptions()
    driver = gdal.GetDriverByName("netCDF")
    if driver is None:
        raise UserError("GDAL was built without netCDF. Leave out --netcdf; tsunami-source.tt3 "
                        "has the same numbers.")
    cells = motion.cells
    east, north = (("lon", "degrees_east"), ("lat", "degrees_north")) if motion.in_degrees else (
        ("x", "m"), ("y", "m"))
    number = gdal.ExtendedDataType.Create(
        gdal_array.NumericTypeCodeToGDALTypeCode(numpy.float64))

    def write(part):
        # The file is complete when its last object is gone, on return.
        group = driver.CreateMultiDimensional(part).GetRootGroup()
        axes = []
        for (name, unit), values in ((("time", "s"), motion.times()), (north, cells.y()[::-1]),
                                     (east, cells.x())):
            axes.append(group.CreateDimension(name, "", "", len(values)))
            axis = group.CreateMDArray(name, axes[-1:], number)
            axis.SetUnit(unit)
            axis.Write(numpy.array(values, dtype=float))
        dz = group.CreateMDArray("dz", axes, number)
        dz.SetUnit("m")
        for k in range(motion.n_blocks):
            values = numpy.ascontiguousarray(motion.change(k)[::-1])
            dz.Write(values[None], [k, 0, 0], [1, *values.shape])

    with new_file(path) as part:
        try:
            write(part)
        except RuntimeError as error:
            raise OSError(0, str(error)) from error


def rows_of_table(series, blocks, options, width):
    """{column: value} of each block. Volumes are those of the slide; `width` is that of a 2-D
    section [m], 1 in 3-D."""
    first = series.thickness(blocks[0])
    axes = [axis for axis in range(series.dim) if axis != 1]
    before = blocks[0]
    for k, soil in enumerate(blocks):
        change = (series.thickness(soil) - first) * series.area * width
        raised, lowered = change[change > 0].sum(), -change[change < 0].sum()
        volume = (soil.volume - blocks[0].volume) * width
        row = {"time [s]": k * options.interval, "volume raised [m^3]": raised,
               "volume lowered [m^3]": lowered, "change of soil volume [m^3]": volume,
               "closure [m^3]": raised - lowered - volume}
        row |= {f"centre velocity {'xyz'[a]} [m/s]": soil.velocity[a] for a in axes}
        row |= {f"centre acceleration {'xyz'[a]} [m/s^2]":
                (soil.velocity[a] - before.velocity[a]) / options.interval for a in axes}
        if options.water_depth > 0:
            row["speed over sqrt(g d) [-]"] = (numpy.linalg.norm(soil.velocity)
                                               / numpy.sqrt(options.gravity * options.water_depth))
        before = soil
        yield row


def write_table(path, rows):
    """Table with a row per block."""
    with new_file(path) as part, open(part, "w", encoding="ascii") as stream:
        for k, row in enumerate(rows):
            if k == 0:
                stream.write(",".join(row) + "\n")
            stream.write(",".join(repr(float(value) + 0) for value in row.values()) + "\n")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Read what talus wrote: statistics.csv, parameters.prm, fields by ParaView.

Needs only what Debian ships: numpy, matplotlib, and for render() and
extract() ParaView (they must run inside pvbatch).
"""

import csv
import os
import re
import tempfile

import numpy

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

plt.rcParams.update({
    "font.size": 8.5,
    "axes.titlesize": 8.5,
    "axes.titlelocation": "left",
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "figure.dpi": 120,
    "savefig.dpi": 120,
})

# The same in all pictures: with splitting, without, the closed form.
SPLIT, UNSPLIT, EXACT = "#1f5fa8", "#c8442b", "#555555"


def statistics(folder):
    """Columns of statistics.csv by name."""
    with open(os.path.join(folder, "statistics.csv"), newline="") as stream:
        rows = list(csv.reader(stream))
    values = numpy.array([[float(x) for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def parameter(folder, name):
    """Text of the first entry of this name in parameters.prm."""
    with open(os.path.join(folder, "parameters.prm")) as stream:
        found = re.search(r"^\s*set\s+%s\s*=\s*(.*?)\s*$" % re.escape(name),
                          stream.read(), re.MULTILINE)
    if not found:
        raise SystemExit("%s/parameters.prm has no entry '%s'"
                         % (folder, name))
    return found.group(1)


def open_points(folder):
    """The series points.pvd as a ParaView source, and its times."""
    from paraview import simple
    reader = simple.PVDReader(FileName=os.path.join(folder, "points.pvd"))
    reader.UpdatePipelineInformation()
    times = reader.TimestepValues
    times = numpy.atleast_1d(numpy.array(times, dtype=float))
    return reader, times


def centers(source):
    """The points themselves, whether they were written as boxes or not."""
    from paraview import simple
    cells = simple.PointDatatoCellData(Input=source)
    return simple.CellCenters(Input=cells, VertexCells=1)


def nearest(times, time):
    return times[numpy.argmin(numpy.abs(times - time))]


def render(source, time, field, limits, window, size, dots=None):
    """Picture of the window (x0, x1, y0, y1), as an array of size (w, h).

    The points' boxes are filled with the colour of `field`, or, with dots =
    their size in pixels, the centres are drawn. The window is stretched to the
    picture, whatever its aspect.
    """
    from paraview import simple
    simple._DisableFirstRenderCameraReset()
    if dots:
        source = centers(source)
    view = simple.CreateView("RenderView")
    view.ViewSize = size
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.CameraParallelProjection = 1
    view.InteractionMode = "2D"
    view.ViewTime = time

    x0, x1, y0, y1 = window
    exaggeration = size[1] * (x1 - x0) / (size[0] * (y1 - y0))
    display = simple.Show(source, view)
    display.Representation = "Points" if dots else "Surface"
    display.Scale = [1, exaggeration, 1]
    display.PointSize = dots or 1
    # A flat picture needs no light: colours as in the colour bar.
    display.Ambient, display.Diffuse, display.Specular = 1, 0, 0
    # Boxes hold their values as cell data.
    simple.UpdatePipeline(time, source)
    at_cells = field in source.CellData.keys()
    simple.ColorBy(display, ("CELLS" if at_cells else "POINTS", field))
    display.SetScalarBarVisibility(view, False)
    colors = simple.GetColorTransferFunction(field)
    colors.ApplyPreset("Viridis (matplotlib)", True)
    colors.RescaleTransferFunction(*limits)

    middle = [(x0 + x1) / 2, exaggeration * (y0 + y1) / 2]
    view.CameraFocalPoint = middle + [0]
    view.CameraPosition = middle + [1000]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = exaggeration * (y1 - y0) / 2

    handle, name = tempfile.mkstemp(suffix=".png")
    os.close(handle)
    simple.SaveScreenshot(name, view, ImageResolution=size,
                          OverrideColorPalette="")
    picture = plt.imread(name)
    os.remove(name)
    simple.Delete(view)
    return picture


def extract(reader, time, names):
    """Values of these fields at all points at this time, one per point."""
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy
    source = centers(reader)
    simple.UpdatePipeline(time, source)
    data = servermanager.Fetch(source)
    simple.Delete(source)
    if data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return [vtk_to_numpy(data.GetPointData().GetArray(n)) for n in names]


def show(axes, picture, window):
    """Put a picture made by render() behind axes in its own coordinates."""
    axes.imshow(picture, extent=window, aspect="auto", origin="upper")
    axes.set_xlim(window[0], window[1])
    axes.set_ylim(window[2], window[3])


def save(figure, name):
    """Write as PNG."""
    figure.savefig(name)
    plt.close(figure)
    print(name)

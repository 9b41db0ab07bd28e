# SPDX-License-Identifier: LGPL-2.1-or-later
"""A first view of a run of talus in ParaView: soil coloured by speed with one range for all
times, points as the cells of their edges, the bed in relief, structures, and the time.

    cd output/slope-3d && paraview --script=.../share/talus/paraview.py
    pvpython paraview.py DIR [PICTURE.png [TIME [boxes]]]

With `boxes` points are drawn as boxes parallel to the axes.

It may also be imported as a macro (Macros > Import new macro); it then shows the run whose
points.pvd is selected. Without a folder it takes the present one.
"""

import os
import re
import sys

# This file has the name of ParaView's own module, which must be found instead of it.
HERE = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else ""
sys.path[:] = [path for path in sys.path if os.path.abspath(path) != HERE]

# pylint: disable=wrong-import-position
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

SPEED, LENGTH, EDGES, OBSTACLE = "speed [m/s]", "box length [m]", "edges [m]", "obstacle"
# Share of the values that the scale of colours shows: single fast points do not take it.
SHARE = 0.995
STRUCTURE, BLACK, WHITE = [0.15] * 3, [0.0] * 3, [1.0] * 3
SIZE = [1400, 800]  # of a picture, pixels
# Light from the north-west on a bed whose slopes are steepened, so that a slope of a degree is
# seen, too; y points upwards.
STEEPER = 6
SHADE = (f"(Normals_Y - 0.7*{STEEPER}*(Normals_X + Normals_Z))"
         f"/sqrt(Normals_Y^2 + {STEEPER**2}*(Normals_X^2 + Normals_Z^2))")


def folder_of_run():
    """The folder given, that of the selected reader, or the present one."""
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        return sys.argv[1]
    source = simple.GetActiveSource()
    name = getattr(source, "FileName", None)
    return os.path.dirname(name) if name else os.getcwd()


def reader_of(folder, name):
    """A reader of all times of points, obstacles ...; None where the run wrote none."""
    path = os.path.join(folder, name + ".pvd")
    return (simple.PVDReader(registrationName=name, FileName=path) if os.path.isfile(path)
            else None)


def times_of(reader):
    """All times of a reader."""
    values = reader.TimestepValues
    return list(values) if hasattr(values, "__len__") else [values]


def blocks_of(data):
    """The data sets of what a reader gives."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    return [data.GetBlock(i) for i in range(data.GetNumberOfBlocks()) if data.GetBlock(i)]


def association(reader, name):
    """POINTS or CELLS, by where a field is; None if it is nowhere."""
    for kind, info in (("POINTS", reader.PointData), ("CELLS", reader.CellData)):
        if name in info.keys():
            return kind
    return None


def range_over_time(reader, name):
    """From zero to where SHARE of the values of all times are below, and the box of all places.
    Each time counts by its fastest points, so that a long rest does not take the scale."""
    largest, box = 0.0, [1e300, -1e300] * 3
    for time in times_of(reader):
        reader.UpdatePipeline(time)
        now = reader.GetDataInformation().GetBounds()
        box = [(min, max)[i % 2](box[i], now[i]) for i in range(6)]
        for block in blocks_of(simple.servermanager.Fetch(reader)):
            array = (block.GetPointData().GetArray(name) or block.GetCellData().GetArray(name))
            if array and array.GetNumberOfTuples():
                values = vtk_to_numpy(array)
                values.sort()
                largest = max(largest, float(values[int(SHARE * (len(values) - 1))]))
    return [0.0, largest or 1.0], box


def terrain_numbers(folder):
    """Numbers of the obstacles that are terrains, by parameters.prm."""
    try:
        with open(os.path.join(folder, "parameters.prm"), encoding="utf-8-sig",
                  errors="replace") as stream:
            text = stream.read()
    except OSError:
        return []
    section = re.search(r"^subsection Obstacles\n(.*?)^end", text, re.MULTILINE | re.DOTALL)
    names = re.search(r"^\s*set Names\s*=\s*(.*)$", section[1] if section else "", re.MULTILINE)
    result = []
    for number, name in enumerate(n.strip() for n in (names[1] if names else "").split(",")):
        shape = re.search(rf"^  subsection {re.escape(name)}\n(.*?)^  end", section[1],
                          re.MULTILINE | re.DOTALL) if name else None
        if shape and re.search(r"^\s*set Shape\s*=\s*terrain\s*$", shape[1], re.MULTILINE):
            result.append(number)
    return result


def show_soil(points, span, is_plane, view):
    """The points: where they were written as dots, the cells of their edges or boxes."""
    shown, where = points, association(points, SPEED)
    if where == "POINTS" and sys.argv[4:] != ["boxes"]:
        shown = simple.TensorGlyph(registrationName="soil", Input=points, GlyphType="Box")
        shown.Tensors, shown.Scalars = ["POINTS", EDGES], ["POINTS", SPEED]
        shown.ExtractEigenvalues = 0
        shown.ScaleFactor = 1.0
    elif where == "POINTS":
        shown = simple.Glyph(registrationName="soil", Input=points, GlyphType="Box")
        shown.ScaleArray = ["POINTS", LENGTH]
        shown.VectorScaleMode = "Scale by Components"
        shown.OrientationArray = ["POINTS", "No orientation array"]
        shown.ScaleFactor = 1.0
        shown.GlyphMode = "All Points"
    drawn = simple.Show(shown, view)
    drawn.Representation = "Surface"
    if is_plane:
        drawn.Ambient, drawn.Diffuse = 1.0, 0.0  # a flat cell has no normal
    simple.ColorBy(drawn, (where, SPEED))
    colors = simple.GetColorTransferFunction(SPEED)
    colors.ApplyPreset("Viridis (matplotlib)", True)
    colors.AutomaticRescaleRangeMode = "Never"
    colors.RescaleTransferFunction(*span)
    drawn.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colors, view)
    bar.Title, bar.ComponentTitle, bar.TitleColor, bar.LabelColor = SPEED, "", BLACK, BLACK
    bar.LabelFormat = bar.RangeLabelFormat = "%.3g"
    bar.TitleFontSize = bar.LabelFontSize = 14
    bar.AutomaticLabelFormat = 0


def show_bed(surface, number, view):
    """A terrain in shaded relief, with contours of its height."""
    shade = simple.Calculator(registrationName=f"relief {number}", Input=surface)
    shade.ResultArrayName, shade.Function = "shade", SHADE
    height = simple.Calculator(registrationName=f"bed {number}", Input=shade)
    height.ResultArrayName, height.Function = "height [m]", "coordsY"
    height.UpdatePipeline()
    drawn = simple.Show(height, view)
    simple.ColorBy(drawn, ("POINTS", "shade"))
    grey = simple.GetColorTransferFunction("shade")
    grey.ApplyPreset("Grayscale", True)
    low, high = height.PointData["shade"].GetRange()
    grey.RescaleTransferFunction(low - 0.8 * (high - low), high + 0.1 * (high - low))
    drawn.SetScalarBarVisibility(view, False)
    # The shade is the light.
    drawn.Ambient, drawn.Diffuse, drawn.Specular = 1.0, 0.0, 0.0
    drawn.LineWidth = 3.0
    low, high = height.PointData["height [m]"].GetRange()
    contours = simple.Contour(registrationName=f"contours {number}", Input=height)
    contours.ContourBy = ["POINTS", "height [m]"]
    contours.Isosurfaces = [low + (high - low) * k / 12 for k in range(1, 12)]
    lines = simple.Show(contours, view)
    lines.ColorArrayName = ["POINTS", ""]
    lines.AmbientColor = lines.DiffuseColor = [0.35] * 3


def show_obstacles(obstacles, terrains, is_plane, view):
    """The bed in relief by its shading, structures dark."""
    obstacles.UpdatePipeline(times_of(obstacles)[0])
    kind = association(obstacles, OBSTACLE)
    low, high = (obstacles.PointData if kind == "POINTS" else obstacles.CellData)[
        OBSTACLE].GetRange()
    for number in range(int(low), int(high) + 1):
        one = simple.Threshold(registrationName=f"obstacle {number}", Input=obstacles)
        one.Scalars = [kind, OBSTACLE]
        one.ThresholdMethod = "Between"
        one.LowerThreshold, one.UpperThreshold = number - 0.5, number + 0.5
        surface = simple.ExtractSurface(Input=one)
        smooth = simple.GenerateSurfaceNormals(registrationName=f"surface {number}",
                                               Input=surface)
        if number in terrains and not is_plane:
            show_bed(smooth, number, view)
            continue
        drawn = simple.Show(smooth, view)
        drawn.ColorArrayName = ["POINTS", ""]
        drawn.DiffuseColor = drawn.AmbientColor = STRUCTURE
        drawn.LineWidth = 3.0


def place_camera(view, box, is_plane):
    """On the box of the soil at all times: from the side in 2-D, in 3-D from above, with y
    upwards."""
    focus = [(box[2 * d] + box[2 * d + 1]) / 2 for d in range(3)]
    lengths = [box[2 * d + 1] - box[2 * d] for d in range(3)]
    view.CameraFocalPoint, view.CameraViewUp = focus, [0.0, 1.0, 0.0]
    direction = (0.0, 0.0, 1.0) if is_plane else (0.1, 0.8, 0.6)
    distance = 1.5 * max(lengths[0] * SIZE[1] / SIZE[0], lengths[1], lengths[2]) / 0.54
    view.CameraPosition = [f + distance * d for f, d in zip(focus, direction)]
    if is_plane:
        view.CameraParallelProjection = 1
        view.CameraParallelScale = 0.55 * max(lengths[0] * SIZE[1] / SIZE[0], lengths[1])


def main():
    """Build the view; with the name of a picture, save it at the last time or that given."""
    folder = folder_of_run()
    points = reader_of(folder, "points")
    if points is None:
        raise SystemExit(f"paraview.py: '{folder}' has no points.pvd. Start it in the output "
                         "folder of a run that writes points, or name that folder.")
    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground, view.BackgroundColorMode = 0, "Single Color"
    view.Background, view.OrientationAxesLabelColor = WHITE, BLACK
    times = times_of(points)
    span, box = range_over_time(points, SPEED)
    is_plane = box[5] - box[4] < 1e-6 * (box[1] - box[0])
    show_soil(points, span, is_plane, view)
    obstacles = reader_of(folder, "obstacles")
    if obstacles is not None:
        show_obstacles(obstacles, terrain_numbers(folder), is_plane, view)
    clock = simple.AnnotateTimeFilter(registrationName="time", Input=points)
    clock.Format = "t = {time:.4g} s"
    shown = simple.Show(clock, view)
    shown.Color, shown.FontSize = BLACK, 20
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    view.ViewTime = simple.GetTimeKeeper().Time = (
        float(sys.argv[3]) if len(sys.argv) > 3 else times[-1])
    place_camera(view, box, is_plane)
    if len(sys.argv) > 2:
        view.ViewSize = SIZE
        simple.SaveScreenshot(sys.argv[2], view, ImageResolution=SIZE)
    simple.Render(view)


main()

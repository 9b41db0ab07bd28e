# SPDX-License-Identifier: LGPL-2.1-or-later
"""Read what talus wrote: statistics.csv, parameters.prm, fields in VTU files.

Needs numpy and matplotlib. Whoever wants to look around takes ParaView.
"""

import base64
import csv
import os
import xml.etree.ElementTree
import zlib

import numpy

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

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
    values = numpy.array([[float(x or "nan") for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def parameter(folder, name):
    """Text of the first entry in parameters.prm whose path ends with this name,
    for instance Centre or Obstacles/pipe/Centre."""
    sections = []
    with open(os.path.join(folder, "parameters.prm")) as stream:
        for line in map(str.strip, stream):
            if line.startswith("subsection "):
                sections.append(line[len("subsection "):])
            elif line == "end":
                sections.pop()
            elif line.startswith("set "):
                entry, text = map(str.strip, line[4:].split("=", 1))
                if ("/" + "/".join(sections + [entry])).endswith("/" + name):
                    return text
    raise SystemExit("%s/parameters.prm has no entry '%s'" % (folder, name))


def decode(array):
    """The numbers of a DataArray of a VTU file, compressed or as text."""
    kind = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8",
            "UInt8": "u1"}[array.get("type")]
    if array.get("format") == "ascii":
        numbers = numpy.array((array.text or "").split(), dtype=kind)
    else:
        # A header of 32-bit numbers (blocks, their size, that of the last one,
        # compressed sizes), then the blocks; each is base64 of its own.
        text = "".join((array.text or "").split())
        n_blocks = int.from_bytes(base64.b64decode(text[:8])[:4], "little")
        length = 4 * (3 + n_blocks)
        end = 4 * ((length + 2) // 3)
        sizes = numpy.frombuffer(base64.b64decode(text[:end])[:length],
                                 "<u4")[3:]
        data = base64.b64decode(text[end:])
        ends = numpy.cumsum(sizes)
        numbers = numpy.frombuffer(
            b"".join(zlib.decompress(data[last - size:last])
                     for last, size in zip(ends, sizes)), kind)
    n = int(array.get("NumberOfComponents", "1"))
    return numbers.reshape(-1, n) if n > 1 else numbers


def read_vtu(path):
    """Vertices of the cells, shape (cells, vertices, 3), and their values by
    name. Points that were written as dots are cells with one vertex."""
    corners, values = [], {}
    for piece in xml.etree.ElementTree.parse(path).getroot().iter("Piece"):
        places = decode(piece.find("Points/DataArray"))
        cells = {a.get("Name"): decode(a)
                 for a in piece.findall("Cells/DataArray")}
        n = len(cells["offsets"])
        if n == 0:
            continue
        corners.append(places[cells["connectivity"]].reshape(n, -1, 3))
        for array in piece.findall("CellData/DataArray") + \
                piece.findall("PointData/DataArray"):
            values.setdefault(array.get("Name"), []).append(decode(array))
    return (numpy.concatenate(corners),
            {name: numpy.concatenate(parts) for name, parts in values.items()})


class Series:
    """The files of a .pvd by time; those of several ranks belong together."""

    def __init__(self, path):
        self.files = {}
        for entry in xml.etree.ElementTree.parse(path).getroot().iter(
                "DataSet"):
            file = os.path.join(os.path.dirname(path), entry.get("file"))
            self.files.setdefault(float(entry.get("timestep")), []).extend(
                self.parts(file))

    @staticmethod
    def parts(file):
        if not file.endswith(".pvtu"):
            return [file]
        return [os.path.join(os.path.dirname(file), piece.get("Source"))
                for piece in xml.etree.ElementTree.parse(file).getroot().iter(
                    "Piece")]

    def read(self, time):
        """See read_vtu()."""
        parts = [read_vtu(file) for file in self.files[time]]
        return (numpy.concatenate([part[0] for part in parts]),
                {name: numpy.concatenate([part[1][name] for part in parts])
                 for name in parts[0][1]})


def open_points(folder, name="points"):
    """The series points.pvd, and its times."""
    series = Series(os.path.join(folder, name + ".pvd"))
    return series, numpy.array(sorted(series.files))


def nearest(times, time):
    return times[numpy.argmin(numpy.abs(times - time))]


def render(series, time, field, limits, window, size, dots=None):
    """Picture of the window (x0, x1, y0, y1), as an array of size (w, h).

    The points' boxes are filled with the colour of `field`, or, with dots =
    their size in pixels, the centres are drawn. The window is stretched to the
    picture, whatever its aspect.
    """
    corners, values = series.read(time)
    figure = plt.figure(figsize=(size[0] / 100, size[1] / 100), dpi=100)
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set_axis_off()
    axes.set_xlim(window[:2])
    axes.set_ylim(window[2:])
    style = {"cmap": "viridis", "norm": plt.Normalize(*limits)}
    if dots or corners.shape[1] == 1:
        places = corners.mean(axis=1)
        axes.scatter(places[:, 0], places[:, 1], c=values[field], linewidths=0,
                     marker="s", s=(0.72 * (dots or 1))**2, **style)
    else:
        boxes = PolyCollection(corners[:, :, :2], linewidths=0,
                               antialiaseds=False, **style)
        boxes.set_array(values[field])
        axes.add_collection(boxes)
    figure.canvas.draw()
    picture = numpy.asarray(figure.canvas.buffer_rgba()).copy()
    plt.close(figure)
    return picture


def extract(series, time, names):
    """Values of these fields at all points at this time, one per point."""
    values = series.read(time)[1]
    return [values[name] for name in names]


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

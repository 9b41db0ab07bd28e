# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields in VTU files, as talus writes them, and the series of a .pvd file."""

import base64
import os
import xml.etree.ElementTree
import zlib

import numpy

from talus_tools.errors import UserError

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}


def decode(array):
    """The numbers of a DataArray, compressed or as text."""
    kind = TYPES[array.get("type")]
    if array.get("format") == "ascii":
        values = numpy.array((array.text or "").split(), dtype=kind)
    else:
        # A header of 32-bit numbers (blocks, their size, that of the last one, compressed
        # sizes), then the blocks; each is base64 of its own.
        text = "".join((array.text or "").split())
        n_blocks = int.from_bytes(base64.b64decode(text[:8])[:4], "little")
        length = 4 * (3 + n_blocks)
        end = 4 * ((length + 2) // 3)
        sizes = numpy.frombuffer(base64.b64decode(text[:end])[:length], "<u4")[3:]
        data = base64.b64decode(text[end:])
        ends = numpy.cumsum(sizes)
        values = numpy.frombuffer(b"".join(zlib.decompress(data[last - size:last])
                                           for last, size in zip(ends, sizes)), kind)
    n = int(array.get("NumberOfComponents", "1"))
    return values.reshape(-1, n) if n > 1 else values


def parse(path):
    """Root of an XML file."""
    try:
        return xml.etree.ElementTree.parse(path).getroot()
    except OSError as error:
        raise UserError(f"'{path}' cannot be read: {error.strerror}.") from error
    except xml.etree.ElementTree.ParseError as error:
        raise UserError(f"'{path}' is damaged: {error}.") from error


def read_vtu(path):
    """Vertices of the cells, shape (cells, vertices, 3), and their values by name. Points
    that were written as dots are cells with one vertex. All cells are of the same kind."""
    corners, values = [], {}
    for piece in parse(path).iter("Piece"):
        places = decode(piece.find("Points/DataArray"))
        cells = {a.get("Name"): decode(a) for a in piece.findall("Cells/DataArray")}
        n = len(cells["offsets"])
        if n == 0:
            continue
        corners.append(places[cells["connectivity"]].reshape(n, -1, 3))
        for array in piece.findall("CellData/DataArray") + piece.findall("PointData/DataArray"):
            values.setdefault(array.get("Name"), []).append(decode(array))
    if not corners:
        return numpy.empty((0, 1, 3)), {}
    return (numpy.concatenate(corners),
            {name: numpy.concatenate(parts) for name, parts in values.items()})


class VtuSeries:
    """The files of a .pvd by time."""

    def __init__(self, path):
        self.files = {}
        for entry in parse(path).iter("DataSet"):
            file = os.path.join(os.path.dirname(path), entry.get("file"))
            self.files.setdefault(float(entry.get("timestep")), []).extend(self.parts(file))
        self.times = numpy.array(sorted(self.files))

    def nearest(self, time):
        """The time of the series that is nearest to this one."""
        return self.times[numpy.argmin(numpy.abs(self.times - time))]

    def read(self, time):
        """Vertices of the cells, shape (cells, vertices, 3), and their values by name."""
        parts = [part for part in map(read_vtu, self.files[time]) if len(part[0])]
        if not parts:
            return numpy.empty((0, 1, 3)), {}
        return (numpy.concatenate([part[0] for part in parts]),
                {name: numpy.concatenate([part[1][name] for part in parts])
                 for name in parts[0][1]})

    @staticmethod
    def parts(file):
        """The pieces of a file that stands for several, as earlier versions of talus wrote on
        several ranks."""
        if not file.endswith(".pvtu"):
            return [file]
        return [os.path.join(os.path.dirname(file), piece.get("Source"))
                for piece in parse(file).iter("Piece")]

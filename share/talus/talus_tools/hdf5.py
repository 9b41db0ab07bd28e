# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields in HDF5 files, as talus writes them, and the series of an .xdmf file."""

import os

import numpy

try:
    import h5py
except ImportError:
    h5py = None

from talus_tools.errors import UserError
from talus_tools.vtu import FileSeries, parse


def read_hdf5(path):
    """As read_vtu(): vertices of the cells, shape (cells, vertices, 3), and their values by
    name with unit."""
    try:
        with h5py.File(path) as file:
            cells = file["mesh/cells"][:]
            corners = file["mesh/vertices"][:][cells].reshape(len(cells), -1, 3)
            return corners, {text(field.attrs["name"]): field[:]
                             for field in file["fields"].values()}
    except (OSError, KeyError) as error:
        raise UserError(f"'{path}' cannot be read: {error}.") from error


def text(attribute):
    """A text of fixed length as a string."""
    return attribute.decode("utf-8", "replace") if isinstance(attribute, bytes) else str(attribute)


class Hdf5Series(FileSeries):
    """The files of an .xdmf by time; one file per time, whatever the number of ranks."""

    def __init__(self, path):
        super().__init__()
        for grid in parse(path).iter("Grid"):
            time, item = grid.find("Time"), grid.find("Geometry/DataItem")
            if time is not None and item is not None:
                name = item.text.strip().split(":")[0]
                self.files[float(time.get("Value"))] = [os.path.join(os.path.dirname(path), name)]
        self.times = numpy.array(sorted(self.files))

    read_file = staticmethod(read_hdf5)

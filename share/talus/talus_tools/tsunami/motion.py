# SPDX-License-Identifier: LGPL-2.1-or-later
"""Change of the height of the sea floor in time, from the plan series of a run."""

import dataclasses
import math
import typing

import numpy

from talus_tools.errors import UserError
from talus_tools.plan import Cells

MOST_CELLS = 1e7  # a dtopo file has a number for every cell and block


@dataclasses.dataclass
class Motion:
    """Change of the height of the sea floor on `cells`. Block k, at start_time + k * interval [s],
    is change(k), shape (rows, columns) [m]."""
    cells: Cells
    start_time: float
    interval: float
    n_blocks: int
    change: typing.Callable
    in_degrees: bool = False

    def times(self):
        """Times of the blocks [s]."""
        return [self.start_time + k * self.interval for k in range(self.n_blocks)]


def blocks_of(series, interval):
    """States for the blocks: block k is the first state at or after k * interval; the last one is
    the last state of the run."""
    times = [soil.time for soil in series.states]
    blocks, at = [], 0
    while len(blocks) * interval <= times[-1]:
        before, at = at, int(numpy.searchsorted(times, len(blocks) * interval))
        if blocks and at == before:
            raise UserError(f"'{series.path}' has no state from t = {times[at - 1]:g} s to "
                            f"{times[at]:g} s, longer than the interval of {interval:g} s. Give a "
                            "longer --interval, at least 'Output/Plan interval' and the time step "
                            "of the run.")
        blocks.append(series.states[at])
    if blocks[-1] is not series.states[-1]:
        blocks.append(series.states[-1])
    return blocks


def cells_of(series, width):
    """Cells of the source. A 2-D section has rows of equal height over the width [m], symmetric
    about the section."""
    cells = series.cells
    if (series.dim == 2) != (width > 0):
        raise UserError("The run is a 2-D section. Give the width of the slide across the section "
                        "with --width, m." if series.dim == 2 else
                        f"--width is {width:g} m, but a 3-D slide has a width of its own. Leave "
                        "out --width.")
    n_cells = cells.columns * (width / cells.dx if series.dim == 2 else cells.rows)
    if n_cells > MOST_CELLS:
        raise UserError(f"The source would have {n_cells:g} cells, where {MOST_CELLS:.0f} are the "
                        "most. Run talus with a larger 'Maps/Cell size'.")
    if series.dim == 3:
        return cells
    rows = max(2, math.floor(width / cells.dx + 0.5))
    dy = width / rows
    return Cells(cells.west, cells.south + 0.5 * width - rows * dy, cells.dx, dy, cells.columns,
                 rows)


def motion_of(series, blocks, options):
    """Motion of the blocks; the change of the thickness of the soil since the first one."""
    cells = cells_of(series, options.width)
    before = series.thickness(blocks[0])

    def change(k):
        # A section has the same change in all rows.
        return numpy.broadcast_to(series.thickness(blocks[k]) - before, (cells.rows, cells.columns))

    return Motion(cells, options.start_time or options.interval, options.interval, len(blocks),
                  change)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""CSV files of talus: one header line, commas, numbers."""

import copy
import csv
import io

import numpy

from talus_tools.errors import UserError
from talus_tools.texts import LENIENT, read_text

LINE = "line"  # column of lines.csv with the names


def find_column(names, name):
    """The column `name` among the names, which end with a unit in brackets: with its unit or
    without it. None if there is none, or if several columns differ in the unit alone."""
    if name in names:
        return name
    found = [other for other in names if split_unit(other)[0] == name]
    return found[0] if len(found) == 1 else None


def split_unit(name):
    """Name and unit of a column "name [unit]"; the unit is empty for a number without one."""
    start = name.rfind(" [")
    return (name[:start], name[start + 2:-1]) if start > 0 and name.endswith("]") else (name, "")


class Table:
    """Columns by name, with the unit or without it, as numbers, but the column LINE as texts; the
    text of the last row as it was written."""

    def __init__(self, path, names, rows, left_out):
        self.path = path
        self.names = names
        self.values = numpy.array([[number(cell) for cell in without_texts(names, row)]
                                   for row in rows])
        self.lines = numpy.array([row[names.index(LINE)].strip() for row in rows]
                                 if LINE in names else [])
        self.last_row = dict(zip(names, rows[-1]))
        self.left_out = left_out

    def __contains__(self, name):
        return find_column(self.names, name) is not None

    def __getitem__(self, name):
        found = find_column(self.names, name)
        if found is None:
            raise UserError(f"'{self.path}' has no column '{name}'.")
        if found == LINE:
            return self.lines
        return self.values[:, without_texts(self.names, self.names).index(found)]

    @property
    def units(self):
        """Unit of each column by its name without the unit."""
        return dict(map(split_unit, self.names))

    def __len__(self):
        return len(self.values)

    def since(self, row):
        """The rows from this one on."""
        result = copy.copy(self)
        result.values, result.lines = self.values[row:], self.lines[row:]
        return result

    def where(self, rows):
        """The rows of a mask."""
        result = copy.copy(self)
        result.values = self.values[rows]
        result.lines = self.lines[rows] if len(self.lines) else self.lines
        return result


def number(cell):
    """A cell as a number; an empty one is none."""
    return float(cell) if cell.strip() else numpy.nan


def without_texts(names, row):
    """Cells of a row whose columns hold numbers."""
    return [cell for name, cell in zip(names, row) if name != LINE] if LINE in names else row


def is_complete(names, row):
    """Whether all cells are there and are numbers, but for those of LINE."""
    try:
        return len(row) == len(names) and len([*map(number, without_texts(names, row))]) > 0
    except ValueError:
        return False


def header(path):
    """Names of the columns; nothing where the first line is not complete yet."""
    try:
        with open(path, newline="", **LENIENT) as stream:
            line = stream.readline()
    except OSError:
        return []
    return next(csv.reader([line])) if line.endswith("\n") else []


def cells_of(path):
    """Names of the columns, texts of the cells by row, and the whole text of a table."""
    text = read_text(path)
    try:
        names, *rows = list(csv.reader(io.StringIO(text, newline=""))) or [[]]
    except csv.Error as error:
        raise UserError(f"'{path}' is no table of talus: {error}.") from error
    return names, rows, text


def read_table(path):
    """Read a table. A last line that is cut off, as one that is being written, is
    left out, which the table tells in `left_out`; any other is an error."""
    names, rows, text = cells_of(path)
    bad = [i for i, row in enumerate(rows) if not is_complete(names, row)]
    # A line is whole when it has its end; before, its last number may lack digits.
    left_out = bool(rows) and (not text.endswith("\n") or bad == [len(rows) - 1])
    if left_out:
        rows.pop()
    if [i for i in bad if i < len(rows)]:
        raise UserError(f"'{path}', line {bad[0] + 2}, is not {len(names)} numbers separated by "
                        "commas, as the header says. The file was changed or damaged: run talus "
                        "again, or remove that line.")
    if not rows:
        raise UserError(f"'{path}' has no complete row yet. A run writes the first one when it "
                        "starts to move; wait for it, or look for its error in log.txt.")
    return Table(path, names, rows, left_out)


def read_lines(path):
    """{line: {column: values}} of a table whose column `line` says which line a row belongs
    to; without one all rows are of one line. Incomplete rows are left out."""
    names, rows, _ = cells_of(path)
    groups = {}
    for row in rows:
        if len(row) == len(names):
            entry = dict(zip(names, row))
            groups.setdefault(entry.pop(LINE, "").strip(), []).append(entry)
    try:
        return {line: {name: numpy.array([number(entry[name]) for entry in entries])
                       for name in entries[0]} for line, entries in groups.items()}
    except ValueError as error:
        raise UserError(f"'{path}' is no table of talus: in every column but '{LINE}' numbers "
                        f"are expected ({error}).") from error

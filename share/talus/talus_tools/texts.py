# SPDX-License-Identifier: LGPL-2.1-or-later
"""Text files: UTF-8, with or without a byte order mark."""

import os

from talus_tools.errors import UserError

# For open(): a byte order mark is no part of the text; other bytes than UTF-8, as in results of
# older runs, become U+FFFD.
LENIENT = {"encoding": "utf-8-sig", "errors": "replace"}


def read_text(path):
    """Text of a file of a run, whatever its bytes are."""
    try:
        with open(path, newline="", **LENIENT) as stream:
            return stream.read()
    except OSError as error:
        raise UserError(f"'{path}' cannot be read: {error.strerror}.") from error


def read_input(path):
    """Text of a file that a user writes: other bytes than UTF-8 are an error that names the
    line, since a replaced letter would change a path or a name."""
    try:
        with open(path, "rb") as stream:
            data = stream.read()
    except OSError as error:
        raise UserError(f"'{path}' cannot be read: {error.strerror}.") from error
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        # The position does not count the mark, which is in the first line.
        line = data[:error.start].count(b"\n") + 1
        raise UserError(f"'{path}', line {line}, is not UTF-8. Save the file as UTF-8 in the "
                        "editor.") from error


def shown(path):
    """A path as text for pages and pictures: bytes that are not UTF-8 are replaced."""
    return os.fsencode(path).decode("utf-8", errors="replace")

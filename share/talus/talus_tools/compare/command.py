# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-compare."""

import os

from talus_tools.compare.pair import Pair
from talus_tools.compare.sections import SECTIONS
from talus_tools.errors import Parser, UserError
from talus_tools.report.write import filled, write_page
from talus_tools.texts import shown

DESCRIPTION = """Write a page that compares two runs of talus: headline numbers with their
differences, the parameters that differ, maps of both and of their difference, and histories. It is
one file and needs no network."""


def main():
    """The page; it gets its name when it is complete."""
    parser = Parser(prog="talus-compare", description=DESCRIPTION)
    parser.add_argument("first", metavar="A", help="output folder of a run")
    parser.add_argument("second", metavar="B", help="output folder of the run compared with it")
    parser.add_argument("--output", metavar="FILE", default="compare.html",
                        help="the page (compare.html)")
    options = parser.parse_args()
    pair = Pair(options.first, options.second)
    sections = [section for section in (make(pair) for make in SECTIONS) if section]
    page = filled("compare.html", title=f"{pair.a.title or 'Two runs'}: comparison",
                  labels=pair.labels, folders=[shown(os.path.abspath(run.folder)) for run in pair.runs],
                  sections=sections)
    try:
        write_page(options.output, page)
    except OSError as error:
        raise UserError(f"'{options.output}' cannot be written: {error.strerror}.") from error
    print(f"Open {options.output} in a browser.")
    return 0

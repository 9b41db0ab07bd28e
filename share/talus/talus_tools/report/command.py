# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-report."""

from talus_tools.errors import Parser
from talus_tools.report.write import write_report

DESCRIPTION = """Write report.html into the output folder of a run of talus: what was run, budgets,
fracture, runout, diagrams, forces, factor of safety, and what to look at. It is one file and
needs no network."""


def main():
    """Reports of the folders named; the last lines tell where they are."""
    parser = Parser(prog="talus-report", description=DESCRIPTION)
    parser.add_argument("folders", metavar="DIR", nargs="+", help="output folder of a run")
    for folder in parser.parse_args().folders:
        path, notices = write_report(folder)
        for notice in notices:
            print(f"Notice: {notice}")
        print(f"Open {path} in a browser.")
    return 0

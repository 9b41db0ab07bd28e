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
    for option, meaning in (("--slab", "body that lies on a weak layer"),
                            ("--weak-layer", "body whose critical length is drawn")):
        parser.add_argument(option, metavar="BODY", help=meaning)
    given = parser.parse_args()
    layer = (given.slab, given.weak_layer)
    if None in layer and layer != (None, None):
        parser.error("--slab and --weak-layer go together: give both, or none.")
    for folder in given.folders:
        path, notices = write_report(folder, layer if given.slab else None)
        for notice in notices:
            print(f"Notice: {notice}")
        print(f"Open {path} in a browser.")
    return 0

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-pipe."""

import os

from talus_tools.errors import Parser, UserError
from talus_tools.pipe.loads import read_load
from talus_tools.pipe.response import respond
from talus_tools.pipe.settings import Settings
from talus_tools.units import plain, show

DESCRIPTION = """Compute deflection, bending moment, axial force and utilisation of a pipeline
that a slide loads: a beam with tension on bilinear soil springs, in time. The load comes from a
run of talus."""


def main():
    """Tables and a picture of the response."""
    parser = Parser(prog="talus-pipe", description=DESCRIPTION)
    parser.add_argument("run", metavar="DIR", help="output folder of a run")
    parser.add_argument("pipe", metavar="PIPE.prm", help="pipe, springs and load; see doc/pipe.md")
    parser.add_argument("--output", metavar="FOLDER",
                        help="folder of the results, instead of DIR/pipe")
    options = parser.parse_args()
    settings = Settings(options.pipe)
    response = respond(settings, read_load(settings, options.run))
    folder = options.output or os.path.join(options.run, "pipe")
    try:
        os.makedirs(folder, exist_ok=True)
        response.write(folder)
        # Loaded here, since loading Matplotlib takes longer than all else.
        from talus_tools.pipe.picture import draw
        draw(response, os.path.join(folder, "pipe.png"))
    except OSError as error:
        raise UserError(f"'{folder}' cannot be written: {error.strerror}.") from error
    report(response, folder)
    return 0


def report(response, folder):
    """Largest values with time and place, on the terminal."""
    for name, unit, peak, time, place in response.largest():
        when = f" at t = {plain(time)} s" if response.has_history else ""
        print(f"largest {name}: {show(peak, unit.strip('-'))}{when}, s = {plain(place)} m")
    diameter = response.settings.pipe.diameter
    if not 0.05 <= diameter <= 4:
        print(f"Remark: 'Pipe/Outer diameter' is {diameter:g} m, where 0.05 to 4 m are usual. Look "
              "at the number and its unit.")
    if response.utilisation() > 1:
        print("Remark: the stress exceeds the yield stress. The pipe is computed as elastic; "
              "beyond a utilisation of 1 deflections are too small and moments too large.")
    if response.reaches_the_ends():
        print("Remark: the pipe still deflects near an end, by more than a hundredth of the "
              "largest deflection. Choose a longer 'Length'.")
    if response.settings.ends != "free" and response.held_by_the_ends() > 0.1:
        print(f"Remark: the ends hold {100 * response.held_by_the_ends():.0f} % of the axial "
              "force. If nothing holds the pipe there, choose a longer 'Length', or 'Axial "
              "springs'.")
    print(f"See {os.path.join(folder, 'along.csv')}, history.csv, loads.csv and pipe.png.")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-calibrate."""

import os

from talus_tools.calibrate.posterior import QUANTILES, Posterior
from talus_tools.errors import Parser, UserError
from talus_tools.study.emulation import Emulation
from talus_tools.study.ensemble import make_members, program_version
from talus_tools.study.results import Results, write_csv
from talus_tools.study.settings import Settings

DESCRIPTION = """Find the parameters with which the runs of a study fit an observed deposit:
quantiles and a picture of their posterior distribution. Run talus-study before; see
doc/study.md."""


def main():
    """Tables and a picture in the folder of the study."""
    parser = Parser(prog="talus-calibrate", description=DESCRIPTION)
    parser.add_argument("study", metavar="STUDY.prm", help="a study with the section 'Observed'")
    parser.add_argument("--output", metavar="DIR", help="folder of the study, instead of 'Output "
                        "folder'")
    parser.add_argument("--program", metavar="PATH", help="talus, instead of 'Program'")
    options = parser.parse_args()
    settings = Settings(options.study)
    settings.folder = options.output or settings.folder
    settings.program = options.program or settings.program
    if not settings.observed:
        raise UserError(f"'{settings.path}' observes nothing: list names in 'Observed/Names', each "
                        "with a section of that name.")
    results = Results(settings, make_members(settings, program_version(settings)))
    posterior = Posterior(Emulation(results))
    names = [f"{kind} {100 * q:g} %" for kind in ("prior", "posterior") for q in QUANTILES]
    rows = posterior.rows()
    write_csv(os.path.join(settings.folder, "calibration.csv"),
              [["name", *names]] + [[row[0], *(repr(float(v)) for v in row[1:])] for row in rows])
    # Loaded here, since loading Matplotlib takes longer than all else.
    from talus_tools.calibrate.picture import draw
    draw(posterior, os.path.join(settings.folder, "calibration.png"))
    for row in rows:
        print(f"{row[0]}: {row[5]:.4g}, with 90 % probability from {row[4]:.4g} to {row[6]:.4g} "
              f"(before: {row[2]:.4g}, {row[1]:.4g} to {row[3]:.4g})")
    print(f"{posterior.effective_samples():.0f} effective samples; see "
          f"{os.path.join(settings.folder, 'calibration.csv')} and calibration.png.")
    return 0

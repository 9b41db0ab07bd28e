# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-study."""

import os
import platform

import numpy
import scipy

from talus_tools.errors import Parser, UserError
from talus_tools.study.ensemble import lock, make_members, program_version, run_members
from talus_tools.study.member import FAILED, FINISHED
from talus_tools.study.quantities import ExceedanceMap
from talus_tools.study.results import Results, plan_maps, section_maps, write_tables
from talus_tools.study.settings import ENTRIES, MEMBER, MOVING, STATUS, Settings
from talus_tools.texts import read_input

DESCRIPTION = """Run talus many times with varied parameters, and tell how the results are
distributed. Run it again after an interruption: finished members are kept, others go on."""
UNFINISHED = 75  # exit status, as of talus: run the same command again


def parse():
    """Options."""
    parser = Parser(prog="talus-study", description=DESCRIPTION)
    parser.add_argument("study", metavar="STUDY.prm", help="what to run; see doc/study.md")
    parser.add_argument("--output", metavar="DIR", help="folder, instead of 'Output folder'")
    parser.add_argument("--program", metavar="PATH", help="talus, instead of 'Program'")
    parser.add_argument("--at-once", metavar="M", type=int,
                        help="runs at the same time, instead of 'Number at once'")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--list", action="store_true", help="list the members; run nothing")
    what.add_argument("--member", metavar="K", type=int,
                      help="run this member only, from 1, as one task of a job array does")
    what.add_argument("--collect", action="store_true",
                      help="write the tables of what has finished; run nothing")
    return parser.parse_args()


def list_members(settings, members):
    """One line per member."""
    print(",".join([MEMBER, *(one.name for one in settings.varied), STATUS]))
    for member in members:
        print(f"{member.number}," + ",".join(f"{value:.6g}" for value in member.values)
              + f",{member.state()[0]}")


def write_record(settings, version):
    """study.prm: all entries with their defaults, and the versions that drew and ran."""
    known = {name: settings.get(name) for name in ENTRIES if "NAME" not in name}
    lines = [f"# {line}" for line in (
        "The study as it was understood by talus-study with", f"  {version}",
        f"  Python {platform.python_version()}, NumPy {numpy.__version__}, "
        f"SciPy {scipy.__version__}")]
    lines += [f"# {name} = {value}" for name, value in known.items()]
    content = read_input(settings.path)
    path = os.path.join(settings.folder, "study.prm")
    if os.path.realpath(path) == os.path.realpath(settings.path):
        raise UserError(f"'{settings.path}' would be written over by the record of the study. "
                        "Give the file another name, or choose another 'Output folder'.")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write("\n".join(lines) + "\n\n" + content)


def write_results(settings, members):
    """Tables, maps and pictures, the failed members, and the exit status."""
    # Loaded here, since loading Matplotlib takes longer than all else.
    from talus_tools.study import pictures
    results = Results(settings, members)
    write_tables(results)
    pictures.overview(results)
    grids, ground = plan_maps(results)
    if grids:
        pictures.exceedance_maps(settings, grids, ground)
    places, shares = section_maps(results)
    if shares:
        pictures.exceedance_lines(settings, places, shares)
    if settings.emulates:
        from talus_tools.study.emulation import write_emulation
        write_emulation(results)
    failed = results.having(FAILED)
    for member, reason in failed:
        print(f"{member.name} failed: {reason}")
    n_done = len(results.finished())
    moving = [m.number for m, flag in zip(members, results.moving) if flag == "1"]
    if moving:
        print(f"{len(moving)} of the finished members still moved at the end (members "
              f"{', '.join(map(str, moving))}), so that their runout is not final and "
              f"probabilities are lower bounds for quantities that grow; see the column '{MOVING}'.")
    print(f"{n_done} of {len(members)} members have finished; see "
          f"{os.path.join(settings.folder, 'study.csv')}.")
    return 1 if failed else 0 if n_done == len(members) else UNFINISHED


def named(settings):
    """All that asks for a column or a map."""
    return [*settings.quantities, ExceedanceMap(settings.map)]


def run_one(settings, members, number):
    """A task of a job array writes no common file."""
    if not 1 <= number <= len(members):
        raise UserError(f"--member {number} was given, where a number from 1 to {len(members)} "
                        "was expected.")
    member = members[number - 1]
    run_members([member], 1, named(settings))
    status, _ = member.state()
    return {FINISHED: 0, FAILED: 1}.get(status, UNFINISHED)


def main():
    """Run, list, or collect."""
    options = parse()
    settings = Settings(options.study)
    settings.folder = options.output or settings.folder
    settings.program = options.program or settings.program
    if options.at_once is not None and options.at_once < 1:
        raise UserError(f"--at-once {options.at_once} was given, where a number of at least 1 was "
                        "expected.")
    version = program_version(settings)
    members = make_members(settings, version)
    if options.list:
        list_members(settings, members)
        return 0
    if options.member is not None:
        return run_one(settings, members, options.member)
    with lock(settings.folder):
        write_record(settings, version)
        if not options.collect:
            run_members(members, options.at_once or settings.at_once, named(settings))
        return write_results(settings, members)

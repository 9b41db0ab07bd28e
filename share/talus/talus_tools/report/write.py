# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a run to report.html."""

import os

from talus_tools.errors import UserError
from talus_tools.qgis import write_styles
from talus_tools.report.contents import SECTIONS
from talus_tools.report.headline import headline
from talus_tools.report.notices import notices
from talus_tools.report.run import HERE, Run
from talus_tools.texts import read_text, shown
from talus_tools.units import plain

try:
    import jinja2
except ImportError as error:
    raise UserError("Python's jinja2 was not found, which fills in the page. Debian's package "
                    "python3-jinja2 has it.") from error


def subtitle(run):
    """One line on what and how long."""
    space = "plane strain, all forces and energies per metre width" if run.dimension == 2 else "3-D"
    steps = run.statistics["step"][-1]
    return (f"{space}; {plain(run.time)} s in {steps:.0f} steps, "
            f"{run.statistics['points'][-1]:.0f} material points at the end")


def filled(template, **values):
    """A page as text. It is XML as well as HTML, so that tests can read it."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    return environment.get_template(template).render(
        style=read_text(os.path.join(HERE, "report.css")), **values)


def render(run):
    """The report as text."""
    sections = [section for section in (make(run) for make in SECTIONS) if section]
    name = shown(os.path.basename(os.path.abspath(run.folder)))
    return filled(
        "report.html", script=read_text(os.path.join(HERE, "slider.js")), name=name,
        title=run.title or name, subtitle=subtitle(run),
        finished=run.is_finished(), notices=notices(run), tiles=headline(run), sections=sections,
        version=run.versions[0] if run.versions else "", hash=run.hash[:12])


def write_page(path, page):
    """Write a page; it gets its name when it is complete."""
    with open(path + ".part", "w", encoding="utf-8") as stream:
        stream.write(page)
    os.replace(path + ".part", path)


def write_report(folder, layer=None):
    """Write report.html into the folder of a run and styles of QGIS beside its maps; return the
    path of the report and the notices. `layer`: see Run."""
    run = Run(folder, layer)
    path = run.path("report.html")
    try:
        write_page(path, render(run))
        write_styles(run)
    except OSError as error:
        raise UserError(f"'{error.filename or path}' cannot be written: "
                        f"{error.strerror}.") from error
    return path, notices(run)

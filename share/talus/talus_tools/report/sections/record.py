# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was run, and what its log says."""

from talus_tools.report.page import Folded, Lines, Rows, Section, Text


def parameters(run):
    """Versions and hash; folded the entries that are not at their defaults, and all of them."""
    parts = [Rows(["what", "is"], [
        ["program", run.versions[0] if run.versions else "not told"],
        ["libraries", ", ".join(run.versions[1:]) or "not told"],
        ["SHA-256 of parameters.prm", run.hash],
        ["stages", run.stages]])]
    if run.changed is None:
        parts.append(Lines(["The reference of all parameters, parameters.prm, was not found beside "
                            "talus-report, so that entries are not compared with their defaults."]))
    else:
        parts.append(Folded(f"The {len(run.changed)} entries that are not at their defaults", [
            Rows(["entry", "value", "default"],
                 [[name.replace("/", " / "), value,
                   "not known" if default is None else default or "none"]
                  for name, value, default in run.changed])]))
    parts.append(Folded("All parameters, as talus understood them", [Text(run.parameter_text)]))
    return Section(
        "what-was-run", "What was run",
        "The same parameters.prm run by the same version on the same machine gives the same "
        "results, bit by bit. Quote the first digits of its hash with any number of this page.",
        parts)


def remarks(run):
    """What the log says beyond the routine, and the whole of it, folded."""
    if not run.log.text:
        return None
    parts = [Lines(run.log.remarks or ["None: the log has nothing but the routine."])]
    parts.append(Folded("The whole log", [Text(run.log.text)]))
    return Section("log", "Remarks of the log",
                   "Everything in log.txt that is neither routine (mesh, time steps, wall times) "
                   "nor a result shown above. Read each line: it tells what to know of the "
                   "materials, the geometry, or of stops and resumptions.", parts)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""What log.txt says, sorted: routine, results, and what whoever uses the results must know."""

import re

# The line of a run that has come to its end.
ENDED = "A report of this run: "
# Lines that every run has, and those of the searches in static stages. What is not among
# them is worth reading, its numbered remarks before all.
ROUTINE = [re.compile(pattern) for pattern in (
    r"The mesh fills .* points?\.$", r"t = .*the time step is ", r"t = .*largest share of points",
    r"t = .*(mesh changed|shared out)", r"Wall time by phase", r"Peak memory of a rank",
    r"Work: ", r"Messages of nodes: ", r"\s",
    r"Stage '.*':$", r"\d+ steps to t = ", ENDED, r"$")]
SAFETY = re.compile(r"The factor of safety is ")
RESULTS = [SAFETY, re.compile(r"Equilibrium was found ")]


class Log:
    """Lines of log.txt; nothing where there is no such file."""

    def __init__(self, text, title=""):
        self.text = text
        lines = text.splitlines()
        self.results = [line for line in lines if any(p.match(line) for p in RESULTS)]
        self.remarks = [line for line in lines
                        if line.strip() not in ("", title.strip()) and line not in self.results
                        and not any(pattern.match(line) for pattern in ROUTINE)]
        self.n_remarks = sum(line.startswith("Remark ") for line in self.remarks)
        safety = [line for line in lines if SAFETY.match(line)]
        self.safety = safety[-1] if safety else ""

    def factor_of_safety(self):
        """(number, "", "more than" or "less than"), or None."""
        found = re.match(r"The factor of safety is (more than |less than |)([-+.\de]*\d)",
                         self.safety)
        return (float(found[2]), found[1].strip()) if found else None

    def last_event(self):
        """The last line that says that the run stopped, was resumed, or came to its end."""
        lines = [line for line in self.text.splitlines()
                 if line.startswith(("Stopped at t = ", "Resumed at t = ", ENDED))]
        return lines[-1] if lines else ""

    def has_ended(self):
        """Whether the run came to its end."""
        return self.last_event().startswith(ENDED)

    def stopped(self):
        """The line that says that the run was stopped, unless it was resumed later."""
        line = self.last_event()
        return line if line.startswith("Stopped") else ""

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables on the terminal, and the goals in doc/performance.md."""

import os
import re
import subprocess
import textwrap


def processor():
    with open("/proc/cpuinfo") as file:
        text = file.read()
    name = re.search(r"^model name\s*: (.*)$", text, re.M)
    return (name.group(1) if name else "unknown processor"), text.count("processor\t")


def machine(bench):
    """One sentence about what the figures were measured on."""
    name, n_cores = processor()
    version = subprocess.run(
        [bench.compiler, "--version"], stdout=subprocess.PIPE, text=True
    ).stdout.splitlines()[0]
    roof = bench.roofline()
    march = f"`-march={bench.march}`" if bench.march else "for distribution"
    registers = bench.registers()
    return (
        f"{name}, {n_cores} cores; {version}, {march}"
        + (f", {registers}" if registers else "")
        + "; on one core "
        f"{1e-9 * roof.bandwidth:.1f} GB/s (triad) and "
        f"{1e-9 * roof.operations:.1f} GFLOP/s (multiply-add, "
        "counted as two); medians of "
        f"{bench.repeat}."
    )


def at_most(bound):
    return lambda value: value <= bound, f"<= {bound:g}"


def at_least(bound):
    return lambda value: value >= bound, f">= {bound:g}"


def within(lower, upper):
    return lambda value: lower <= value <= upper, f"{lower:g} ... {upper:g}"


def row(what, value, text, goal=None):
    """A line of the table; without a goal, it only tells."""
    if goal is None:
        return (what, text, "", "")
    is_met, bound = goal
    return (what, text, bound, "met" if is_met(value) else "**falls short**")


def without_yardstick(what, goal):
    return (what, "", goal[1], "no yardstick")


def print_table(rows):
    for row in rows:
        print(" | ".join(str(cell) for cell in row), flush=True)


def as_markdown(heading, rows):
    lines = ["| " + " | ".join(row) + " |" for row in (heading, *rows)]
    lines.insert(1, "|" + "---|" * len(heading))
    return "\n".join(lines)


def replace_between(text, name, content):
    """@p text with what stands between the comments of that name replaced."""
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
    before, rest = text.split(begin)
    return before + begin + content + "\n" + end + rest.split(end)[1]


def write_goals(path, sentence, goals):
    with open(path) as file:
        text = file.read()
    text = replace_between(
        text,
        "goals",
        textwrap.fill(sentence, 118) + "\n\n" + as_markdown(("what", "measured", "goal", ""), goals),
    )
    with open(path, "w") as file:
        file.write(text)
    print(os.path.relpath(path) + " is written.")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Instructions and cycles per point and step by group of functions, beside the
yardstick's, as the processor counts them: which part of a step takes more than a
hand-written kernel, and whether by more instructions or by waiting."""

import collections
import os
import re
import shutil
import subprocess

# The first group whose expression is found in the name of a function.
GROUPS = {
    "walk and weights": r"talus::BlockWalk<",
    "scatter": r"talus::Transfer<\d>::scatter\b",
    "gather": r"talus::Transfer<\d>::gather\b",
    "means": r"talus::Transfer<\d>::(average_|set_cell_means|shift_to_cell_means)",
    "stress": r"talus::.*(update_stress|update_by_state|update_box_lengths)",
    "time step": r"talus::(TimeStep<|.*wave_modulus)",
    "splitting": r"talus::Splitter<",
    "relocation": r"talus::(Relocation|Reordering|Rows|BlockMove|ElementMove)",
    "nodes": r"talus::.*(NodalFields|Boundaries|Seabed|Damping|NodalExchange|"
    r"contact_area|Grid<)",
}
REST = "rest"
EVENTS = ("instructions", "cycles")


def reason_to_skip():
    """Why the processor's counters cannot be read, or nothing."""
    if not shutil.which("perf"):
        return "perf was not found; Debian's package linux-perf brings it."
    done = subprocess.run(
        ["perf", "stat", "-x,", "-e", ",".join(e + ":u" for e in EVENTS), "true"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )
    counts = re.findall(r"^(\d+),", done.stdout, re.M)
    if done.returncode != 0 or len(counts) < len(EVENTS):
        return "perf does not count instructions and cycles on this machine."
    return ""


def group_of(function):
    for name, pattern in GROUPS.items():
        if re.search(pattern, function):
            return name
    return REST


def counts_of(command, folder):
    """What the processor counts while @p command runs: by event, in all and by
    group of functions. Returns the command's output, too."""
    data = os.path.join(folder, "perf.data")
    events = ",".join(event + ":u" for event in EVENTS)
    # Totals are counted; the groups' shares are those of the samples.
    done = subprocess.run(
        ["perf", "stat", "-x,", "-o", data + ".stat", "-e", events, *command],
        check=True, stdout=subprocess.PIPE, text=True,
    )
    subprocess.run(
        ["perf", "record", "-q", "-F", "4000", "-e", events, "-o", data, *command],
        check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )
    samples = subprocess.run(
        ["perf", "script", "-i", data, "-F", "event,period,ip,sym"],
        check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    ).stdout
    shares = {event: collections.Counter() for event in EVENTS}
    for line in samples.splitlines():
        found = re.match(r"\s*(\d+)\s+(\w+):\w*:?\s+[0-9a-f]+ (.*)$", line)
        if found and found[2] in shares:
            shares[found[2]][group_of(found[3])] += int(found[1])
    with open(data + ".stat") as file:
        text = file.read()
    result = {}
    for event in EVENTS:
        total = int(re.search(rf"^(\d+),,{event}", text, re.M).group(1))
        of_samples = sum(shares[event].values()) or 1
        result[event] = {
            group: total * n / of_samples for group, n in shares[event].items()
        }
        result[event]["all"] = total
    return result, done.stdout


def columns_of_talus(bench, file, settings):
    """Per point and step; less what a run takes that ends after one step, which
    is loading the program and reading the input."""
    output = os.path.join(bench.folder, "counted")
    run = [*bench.command(file, settings, output), "--overwrite"]
    counts, text = counts_of(run, bench.folder)
    steps = float(re.search(r"(\S+) point-steps in", text).group(1))
    start, _ = counts_of([*run, "--set", "End time=1e-9"], bench.folder)
    return {
        event: {
            group: max(n - start[event].get(group, 0), 0) / steps
            for group, n in counts[event].items()
        }
        for event in EVENTS
    }


def yardstick_in_all(bench, n_points, steps, dim=2):
    """Per point and step: the difference of runs of two lengths, so that the
    setup does not count."""
    short, long = (
        counts_of(bench.yardstick_command(n_points, n, dim), bench.folder)[0]
        for n in (steps, 3 * steps)
    )
    return {
        event: {"all": (long[event]["all"] - short[event]["all"])
                / (2 * steps * n_points)}
        for event in EVENTS
    }


def counter_table(bench, cases):
    """Heading and rows, or a sentence. @p cases are names with their file,
    settings, points and steps for the yardstick."""
    reason = reason_to_skip()
    if reason:
        return "Not measured: " + reason
    heading, columns = ["functions"], []
    for name, file, settings, yardstick in cases:
        found = columns_of_talus(bench, file, settings)
        for event in EVENTS:
            heading.append(f"{name}: {event}")
            columns.append(found[event])
        if yardstick and bench.yardstick_program:
            found = yardstick_in_all(bench, *yardstick)
            for event in EVENTS:
                heading.append(f"yardstick, {yardstick[0] // 1000}k points: {event}")
                columns.append(found[event])
    rows = [
        (group, *[f"{c[group]:.1f}" if group in c else "" for c in columns])
        for group in (*GROUPS, REST, "all")
    ]
    return [tuple(heading), *rows]

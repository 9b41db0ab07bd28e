# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sets of ctest's entries, and how long they take: tests/sets.csv.

Usage: sets.py --check BUILD
       sets.py --renew BUILD

--check fails if an entry of the build folder has no row or a row names no entry,
and if an entry is not in exactly one of the sets quick, full and slow. --renew
takes the seconds from ctest's record of the entries that ran in BUILD (mean of all
runs) and adds a row of the set `full` for each new entry.
"""

import csv
import json
import pathlib
import subprocess
import sys

ROWS = pathlib.Path(__file__).with_name("sets.csv")
SETS = {"quick", "full", "slow"}
# Entries of parts that a build may lack.
OPTIONAL = ("report/from_python.",)


def labels_of_entries(build):
    """Labels of the entries of ctest by name, without those of single suites."""
    text = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"],
                          check=True, stdout=subprocess.PIPE).stdout
    labels = {}
    for test in json.loads(text)["tests"]:
        properties = {p["name"]: p["value"] for p in test["properties"]}
        labels[test["name"]] = set(properties.get("LABELS", []))
    return {name: of for name, of in labels.items() if "single" not in of}


def read_rows():
    with open(ROWS, newline="") as stream:
        return {row["entry"]: row for row in csv.DictReader(stream)}


def problems(entries, rows):
    """Sentences on what does not fit."""
    for name, labels in entries.items():
        if name not in rows:
            yield ("The entry %s has no row in tests/sets.csv; add one with "
                   "`python3 tests/sets.py --renew BUILD` and choose its set." % name)
        elif len(labels & SETS) != 1 or rows[name]["set"] not in labels:
            yield ("The entry %s is in the sets %s, but tests/sets.csv says '%s'; "
                   "expected is one of quick, full and slow." % (
                       name, sorted(labels & SETS), rows[name]["set"]))
    for name in rows:
        if name not in entries and not name.startswith(OPTIONAL):
            yield ("tests/sets.csv has a row of %s, which ctest does not know. "
                   "Correct the name, or say in the commit which entry holds its "
                   "gates now." % name)


def renew(build, rows, entries):
    record = pathlib.Path(build, "Testing", "Temporary", "CTestCostData.txt")
    for line in record.read_text().split("---")[0].splitlines():
        name, _, seconds = line.rsplit(" ", 2)
        if name in entries and float(seconds) > 0:
            row = rows.setdefault(name, {"entry": name, "set": "full"})
            row["seconds"] = max(1, round(float(seconds)))
    with open(ROWS, "w", newline="") as stream:
        out = csv.DictWriter(stream, ["entry", "set", "seconds"], lineterminator="\n")
        out.writeheader()
        out.writerows(rows[name] for name in sorted(rows))


def main():
    option, build = sys.argv[1:]
    entries, rows = labels_of_entries(build), read_rows()
    if option == "--renew":
        renew(build, rows, entries)
        return 0
    found = list(problems(entries, rows))
    print("\n".join(found) or "%d entries, each in one set." % len(entries))
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main())

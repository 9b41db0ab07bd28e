#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Print the release notes of a version from the files in doc/changes.

Usage: changelog.py VERSION

Entries are grouped by kind, incompatible changes first, and sorted by date. At a
release each entry is shortened to a line, the list is put above the previous
release in CHANGELOG.md, and the files in doc/changes are removed.
"""

import pathlib
import re
import sys

# Kinds in the files, and the headings.
KINDS = {"Incompatible": "Changed, incompatible", "New": "Added",
         "Changed": "Changed", "Fixed": "Fixed", "Removed": "Removed"}


def entries(folder):
    """(kind, text) of each file in the folder, in the order of date."""
    for path in sorted(folder.glob("2*")):
        text = path.read_text().split("<br>")[0].strip()
        found = re.match(r"([^:]+):\s*(.*)", text, re.DOTALL)
        kind = next((kind for kind in KINDS if kind in found.group(1)),
                    "Incompatible" if "incompatible" in found.group(1)
                    else "Changed")
        yield kind, " ".join(found.group(2).split())


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    all_entries = list(entries(pathlib.Path(__file__).parent / "changes"))
    print(f"## talus {sys.argv[1]}")
    for kind, heading in KINDS.items():
        texts = [text for k, text in all_entries if k == kind]
        if texts:
            print(f"\n### {heading} in {sys.argv[1]}\n")
        for text in texts:
            print(f"* {text}")


if __name__ == "__main__":
    main()

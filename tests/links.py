# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hold the links of the pages: files and headings must exist.

Usage: links.py ROOT

Looks at README.md, CONTRIBUTING.md and all pages below doc/. Fails with one line per
broken link; links to other hosts are not followed.
"""

import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def headings(page):
    """Names of the headings of a page, as GitHub makes them."""
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
    names = set()
    for words in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        words = LINK.sub(lambda match: match.group(0).split("]")[0][1:], words)
        name = re.sub(r"[^\w\- ]", "", words.lower()).strip()
        names.add(name.replace(" ", "-"))
    return names


def broken_links(root):
    pages = [root / "README.md", root / "CONTRIBUTING.md",
             *sorted((root / "doc").rglob("*.md"))]
    for page in pages:
        # Parts of the pages of the verification: held by those.
        if page.parent.name == "text":
            continue
        text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(),
                      flags=re.DOTALL)
        for target in LINK.findall(text):
            if "://" in target or target.startswith("mailto:"):
                continue
            path, _, heading = target.partition("#")
            file = (page.parent / path).resolve() if path else page
            if not file.exists():
                yield "%s: no file %s" % (page.relative_to(root), target)
            elif heading and heading not in headings(file):
                yield "%s: no heading %s" % (page.relative_to(root), target)


def main():
    found = list(broken_links(pathlib.Path(sys.argv[1]).resolve()))
    for line in found:
        print(line)
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of Markdown as Doxygen wants them, from pages as GitHub shows them.

Usage: doxygen_filter.py FILE.md, which writes to standard output.

Formulas between $$ become \\f[ ... \\f], those between $ \\f$ ... \\f$, keys of
references.bib in brackets become citations, and links and headings get names
that are unique among all pages, since those of Doxygen are: Doxygen 1.9.4 knows
no links to headings.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
KEYS = set(re.findall(r"^@\w+\{(\w+),", (ROOT / "doc/references.bib").read_text(),
                      re.MULTILINE))
CITATION = re.compile(r"\[(\w+(?:,\s\w+)*)\]")
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")


def page_name(file):
    """doc/changes/README.md is page_doc_changes_README."""
    return "page_" + "_".join(file.relative_to(ROOT).with_suffix("").parts)


def heading_name(file, heading):
    """The same with what GitHub calls the heading."""
    words = re.sub(r"[^\w\- ]", "", heading.lower()).strip()
    return page_name(file) + "_" + words.replace(" ", "-")


def link(file, match):
    image, text, target = match.groups()
    if "://" in target:
        return match.group(0)
    path, _, heading = target.partition("#")
    path = (file.parent / path).resolve() if path else file
    if image or path.suffix != ".md":
        return "%s[%s](%s)" % (image, text, path.name)
    name = page_name(path)
    if heading:
        name += "_" + heading
    return "[%s](@ref %s)" % (text, name)


def citation(match):
    keys = match.group(1).split()
    if not KEYS.issuperset(key.rstrip(",") for key in keys):
        return match.group(0)
    return " ".join("\\cite " + key for key in keys)


def code_or_formula(match):
    words = match.group(0)
    if words.startswith("$"):
        return "\\f$%s\\f$" % words[1:-1]
    # Doxygen ends code in simple backticks at an apostrophe.
    return "`%s`" % words if "'" in words else words


def heading(file, match):
    marks, words = match.groups()
    name = page_name(file) if marks == "#" else heading_name(file, words)
    # Doxygen shows citations and marks of code in headings as they are written.
    keys = CITATION.search(words)
    words = CITATION.sub("", words).strip().replace("`", "")
    return "%s %s {#%s}" % (marks, words, name) + (
        "\n\nSee %s." % citation(keys) if keys else "")


def convert(file, text):
    # Every other part is code or a formula.
    parts = re.split(r"(```.*?```|\$\$.*?\$\$)", text, flags=re.DOTALL)
    for part in parts:
        if part.startswith("$$"):
            part = "\\f[" + part[2:-2] + "\\f]"
        elif not part.startswith("```"):
            part = re.sub(r"^(#+) (.*)$", lambda match: heading(file, match),
                          part, flags=re.MULTILINE)
            part = LINK.sub(lambda match: link(file, match), part)
            part = CITATION.sub(citation, part)
            part = re.sub(r"`[^`]*`|\$[^$`]+\$", code_or_formula, part)
            # Doxygen takes a colon that follows for a part of the key.
            part = re.sub(r"(\\cite \w+):", r"\1&zwj;:", part)
        yield part


if __name__ == "__main__":
    page = pathlib.Path(sys.argv[1]).resolve()
    print("".join(convert(page, page.read_text())), end="")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hold the tokens of the sources and the words of the pages below a ceiling.

Usage: weight.py ROOT

Counts the C++ tokens of ROOT/include and ROOT/source, room by room. Comments,
blanks and lines of the preprocessor count nothing. Also counts the words, as
`wc -w` does, of ROOT/README.md, ROOT/CONTRIBUTING.md and all pages below ROOT/doc.
Pages that doc/verification/report.py writes have no ceiling.

The last row of ROOT/tests/weight.csv is the ceiling. A new row with a higher
number needs a reason that names the feature. Ends with 1 above the ceiling, or
with a row that does not fit.
"""

import collections
import csv
import pathlib
import re
import sys

TOKEN = re.compile(
    r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''  # literals
    r'|\.?\d(?:[eEpP][+-]|[\w.\'])*|[A-Za-z_]\w*'  # numbers and names
    r'|<<=|>>=|\.\.\.|->\*|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]='
    r'|\S', re.DOTALL)
# Literals are found, too, since they may hold the signs of a comment.
COMMENT = re.compile(
    r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*.*?\*/', re.DOTALL)
PREPROCESSOR = re.compile(r"^\s*#(?:[^\n\\]|\\.|\\\n)*", re.MULTILINE)

GENERATED = re.compile(r"doc/verification(/(?!experiments)[^/]*)?\.md")


def tokens_of(text):
    """Number of C++ tokens."""
    text = COMMENT.sub(
        lambda match: match.group() if match.group()[0] in "\"'" else " ",
        PREPROCESSOR.sub(" ", text))
    return sum(1 for _ in TOKEN.finditer(text))


def tokens_by_room(root):
    count = collections.Counter()
    for folder in (root / "include" / "talus", root / "source"):
        for path in folder.rglob("*"):
            if path.suffix in (".h", ".cc"):
                room = path.relative_to(folder).parts[0]
                count[room] += tokens_of(path.read_text())
    return count


def words_of_pages(root):
    """Words written by hand, and words of generated pages."""
    written = generated = 0
    for page in [root / "README.md", root / "CONTRIBUTING.md",
                 *(root / "doc").rglob("*.md")]:
        words = len(page.read_text().split())
        if GENERATED.fullmatch(page.relative_to(root).as_posix()):
            generated += words
        else:
            written += words
    return written, generated


def read_ceilings(root):
    """Rows of weight.csv, with numbers."""
    rows = []
    try:
        lines = (root / "tests" / "weight.csv").read_text().splitlines()
        rows = list(csv.DictReader(lines))
        for row in rows:
            row.update(tokens=int(row["tokens"]), words=int(row["words"]))
    except (OSError, KeyError, TypeError, ValueError):
        rows = []
    if not rows:
        sys.exit("tests/weight.csv: expected is the line 'date,tokens,words,reason' "
                 "and at least one row of this kind, with whole numbers. Correct "
                 "the file.")
    return rows


def problems_of_rows(rows):
    """A sentence for each row that raises a ceiling without a reason."""
    for before, row in zip(rows, rows[1:]):
        reason = (row["reason"] or "").strip().lower()
        for what in ("tokens", "words"):
            if row[what] > before[what] and reason in ("", "release"):
                yield ("tests/weight.csv: the row of %s raises the ceiling of the "
                       "%s from %d to %d without a reason. Name the new feature "
                       "in the last column, or keep the ceiling." % (
                           row["date"], what, before[what], row[what]))


def problem_of_count(what, where, found, ceiling):
    """A sentence if the number is above the ceiling."""
    if found > ceiling:
        yield ("There are %d %s in %s; tests/weight.csv permits %d. Remove %d %s, "
               "or add a row to tests/weight.csv with a higher number and the "
               "feature that needs it." % (
                   found, what, where, ceiling, found - ceiling, what))


def main():
    root = pathlib.Path(sys.argv[1])
    rows = read_ceilings(root)
    ceiling = rows[-1]
    rooms = tokens_by_room(root)
    tokens = sum(rooms.values())
    written, generated = words_of_pages(root)
    print("%-24s %8s %8s" % ("", "count", "ceiling"))
    for room, count in rooms.most_common():
        print("tokens of %-14s %8d" % (room, count))
    for line in (("tokens of all rooms", tokens, ceiling["tokens"]),
                 ("words of pages", written, ceiling["words"]),
                 ("words of generated pages", generated, "")):
        print("%-24s %8d %8s" % line)
    problems = [
        *problems_of_rows(rows),
        *problem_of_count("tokens", "include and source", tokens,
                          ceiling["tokens"]),
        *problem_of_count("words", "README.md, CONTRIBUTING.md and the pages below "
                          "doc", written, ceiling["words"])]
    for line in problems:
        print(line)
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())

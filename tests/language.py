# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hold comments and pages to the rules of language of CONTRIBUTING.md.

Usage: language.py ROOT [--list | --ceilings]

Reads the comments below ROOT/include and ROOT/source, room by room, and the
pages ROOT/doc/*.md, ROOT/doc/*/*.md, ROOT/README.md and ROOT/CONTRIBUTING.md.
Fails on

  * a docstring (///) that begins with a pronoun or a relative word,
  * a word or a kind of name that the project has replaced,
  * more than 6 pointing words per 100 words in a room or on a page,
  * a paragraph of more than 120 words on a page of SHORT_PARAGRAPHS,
  * more functions with over six parameters than MAX_FUNCTIONS.

Where text is older than these rules, a ceiling below says how much of it is
left. A ceiling may fall; a line that is no longer needed is to be deleted, and
the script says which. With --list each place that counts is printed, with
--ceilings the ceilings of today.
"""

import collections
import math
import pathlib
import re
import sys

MAX_POINTING = 6.0  # per 100 words
MAX_PARAGRAPH = 120  # words
MAX_PARAMETERS = 6

# Ceilings: pointing words per 100 words, by room or page.
POINTING = {
    "doc/output.md": 7.9,
    "doc/usage.md": 7.9,
    "geometry": 8.9,
    "io": 9.8,
    "problem": 9.2,
    "terrain": 8.5,
}
# Ceilings: docstrings that begin with a pronoun or a relative word, by room.
OPENINGS = {
    "base": 1,
    "boundaries": 4,
    "checkpoint": 2,
    "contact": 4,
    "equilibrium": 10,
    "geometry": 23,
    "grid": 1,
    "io": 37,
    "maps": 3,
    "materials": 6,
    "observers": 3,
    "problem": 29,
    "simulation": 5,
    "terrain": 4,
    "transfer": 2,
    "water": 4,
}
# Ceilings: replaced words and names, by room or page.
REPLACED = {
    "adaptivity": 8,
    "doc/output.md": 2,
    "geometry": 4,
    "io": 4,
}
# Pages on which no paragraph may be longer than MAX_PARAGRAPH.
SHORT_PARAGRAPHS = ["doc/method.md", "doc/performance.md"]
# Ceiling: functions of include/ and source/ with more than MAX_PARAMETERS.
MAX_FUNCTIONS = 3

POINTING_WORD = re.compile(
    r"\b(those|these|that|it|its|they|them|their|this|such|so|else|ones?|both|"
    r"others?|what|whatever|whoever|who|which)\b", re.IGNORECASE)
WORD = re.compile(r"[A-Za-z][A-Za-z'-]*")
OPENING = re.compile(
    r"(that|those|these|this|it|its|they|them|their|such|so|else|ones|both|"
    r"one (?:of|that|which|who)|others?|what|whatever|whoever|who|whom|whose|"
    r"which|where|of|"
    r"in which|from which|to which|by which|the same|the other|the others)\b",
    re.IGNORECASE)
# What is used instead is in CONTRIBUTING.md.
REPLACED_WORD = re.compile(
    r"\b((least|most)_\w+|\w+_(least|most)|whoever|whomever|whatsoever|"
    r"books?|booked|booking|book_\w+|bring_back|gifts?|outsiders?|"
    r"violate[sd]?|violations?|share_in_mean)\b", re.IGNORECASE)


class Count:
    """Words, pointing words and offences of a room or a page."""

    def __init__(self):
        self.words = 0
        self.pointing = 0
        self.openings = []
        self.replaced = []
        self.long_paragraphs = []

    def add(self, text):
        self.words += len(WORD.findall(text))
        self.pointing += len(POINTING_WORD.findall(text))

    def rate(self):
        return 100 * self.pointing / max(1, self.words)


def blocks_of_comments(lines):
    """(number of the first line, mark, text) of each block of comments."""
    mark_at = re.compile(r"\s*(///<?|//|/\*+!?|\*(?!\w)\s?)(.*)")
    begin, mark, text, inside = 0, "", [], False
    for number, line in enumerate(lines + [""], 1):
        match = mark_at.match(line)
        if match and match.group(1).startswith("*") and not inside:
            match = None
        if match:
            if not text:
                begin, mark = number, match.group(1)
            inside = ("/*" in line or inside) and "*/" not in line
            text.append(match.group(2).replace("*/", "").strip())
        elif text:
            yield begin, mark, " ".join(text)
            text = []
        if not match and "//" in line and '"' not in line:
            yield (number, "///" if "///<" in line else "//",
                   line.split("//", 1)[1].lstrip("/<! "))


def without_markup(text):
    """Words of a page: no code, formulas, targets of links, or HTML."""
    text = re.sub(r"<!--.*?-->|```.*?```|\$\$.*?\$\$", " ", text,
                  flags=re.DOTALL)
    text = re.sub(r"`[^`]*`|\$[^$\n]*\$", " ", text)
    return re.sub(r"\]\([^)]*\)|<[^>]*>", " ", text)


def count_source(root, counts):
    for path in sorted([*(root / "include").rglob("*.h"),
                        *(root / "source").rglob("*.cc")]):
        name = path.relative_to(root)
        room = path.parent.name
        lines = path.read_text().split("\n")
        count = counts[room]
        for number, mark, text in blocks_of_comments(lines):
            if "SPDX" in text:
                continue
            count.add(text)
            place = "%s:%d: %s" % (name, number, text[:70])
            # A line of "///<" alone goes on with the line above.
            if mark == "///" and OPENING.match(text):
                count.openings.append(place)
        for number, line in enumerate(lines, 1):
            count.replaced += [
                "%s:%d: %s" % (name, number, match.group(0))
                for match in REPLACED_WORD.finditer(line)]


def paragraphs(text):
    """(first words, number of words) of paragraphs and items of lists."""
    text = re.sub(r"```.*?```|\$\$.*?\$\$|^[|#!][^\n]*$", "\n\n", text,
                  flags=re.DOTALL | re.MULTILINE)
    for part in re.split(r"\n\s*\n|\n(?=\s*(?:[*-]|\d+\.) )", text):
        words = part.split()
        if words:
            yield " ".join(words[:8]), len(words)


def count_pages(root, counts):
    pages = [root / "README.md", root / "CONTRIBUTING.md",
             *sorted((root / "doc").glob("*.md")),
             *sorted((root / "doc").glob("*/*.md"))]
    for path in pages:
        name = str(path.relative_to(root))
        text = path.read_text()
        count = counts[name]
        words = without_markup(text)
        count.add(words)
        count.replaced += ["%s: %s" % (name, match.group(0))
                           for match in REPLACED_WORD.finditer(words)]
        if name in SHORT_PARAGRAPHS:
            count.long_paragraphs += [
                "%s: %d words: %s ..." % (name, n, start)
                for start, n in paragraphs(text) if n > MAX_PARAGRAPH]


def code_alone(text):
    """Source without comments, strings and preprocessor."""
    text = re.sub(
        r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'',
        " ", text, flags=re.DOTALL)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", text,
                  flags=re.MULTILINE)


def number_of_parameters(text, begin):
    """Parameters of the list that opens at @p begin, and the list's end."""
    depth, commas, at = 0, 0, begin
    while at < len(text):
        if text[at] in "([{<":
            depth += 1
        elif text[at] in ")]}" or (text[at] == ">" and text[at - 1] != "-"):
            depth -= 1
            if depth == 0:
                break
        elif text[at] == "," and depth == 1:
            commas += 1
        at += 1
    is_empty = not text[begin + 1:at].strip()
    return (0 if is_empty else commas + 1), at


def functions_with_many_parameters(root):
    """file: name (number) of each definition with too many parameters."""
    keywords = {"if", "for", "while", "switch", "catch", "return", "sizeof",
                "decltype", "alignas", "requires", "static_assert"}
    for path in sorted([*(root / "include").rglob("*.h"),
                        *(root / "source").rglob("*.cc")]):
        text = code_alone(path.read_text())
        for match in re.finditer(r"([\w~]+)\s*(\()", text):
            if match.group(1) in keywords:
                continue
            n, end = number_of_parameters(text, match.start(2))
            if n <= MAX_PARAMETERS:
                continue
            # A definition: its body, or a constructor's initialisers, follow.
            after = re.match(r"\)\s*(const|noexcept|override|final|\s|&)*"
                             r"(->[^{;]*)?(\{|:[^:])", text[end:])
            if after and (after.group(3) == "{" or match.group(1)[0].isupper()):
                yield "%s: %s (%d)" % (path.relative_to(root),
                                       match.group(1), n)


def compare(what, name, found, ceilings, usual, problems, spare):
    """Note a count over its ceiling, and a ceiling that is not needed."""
    ceiling = ceilings.get(name, usual)
    if found > ceiling + 0.05:
        problems.append("%s: %.4g %s, at most %.4g" % (name, found, what,
                                                       ceiling))
        return True
    if name in ceilings and found <= usual:
        spare.append("delete the ceiling of '%s': %s" % (name, what))
    return False


def print_ceilings(counts):
    """The ceilings that all counts of today would need, as above."""
    for name, number, limit in (
            ("POINTING", lambda c: math.ceil(10 * c.rate()) / 10, MAX_POINTING),
            ("OPENINGS", lambda c: len(c.openings), 0),
            ("REPLACED", lambda c: len(c.replaced), 0)):
        print("%s = {" % name)
        for room, count in sorted(counts.items()):
            if number(count) > limit:
                print('    "%s": %s,' % (room, number(count)))
        print("}")


def main():
    root = pathlib.Path(sys.argv[1])
    list_all = "--list" in sys.argv
    counts = collections.defaultdict(Count)
    count_source(root, counts)
    count_pages(root, counts)
    if "--ceilings" in sys.argv:
        print_ceilings(counts)
        return 0
    problems, spare = [], []
    for name, count in sorted(counts.items()):
        print("%-36s %6d words %5.1f pointing %3d openings %3d replaced"
              % (name, count.words, count.rate(), len(count.openings),
                 len(count.replaced)))
        compare("pointing words per 100", name, count.rate(), POINTING,
                MAX_POINTING, problems, spare)
        for what, found, ceilings in (
                ("docstrings that begin with a pronoun", count.openings,
                 OPENINGS),
                ("replaced words", count.replaced, REPLACED)):
            if compare(what, name, len(found), ceilings, 0, problems,
                       spare) or list_all:
                problems += ["  " + place for place in found]
        problems += count.long_paragraphs
    many = list(functions_with_many_parameters(root))
    print("%d functions with more than %d parameters" % (len(many),
                                                         MAX_PARAMETERS))
    if len(many) > MAX_FUNCTIONS or list_all:
        problems += ["  " + place for place in many]
    total = [c for name, c in counts.items() if "." not in name]
    print("all comments: %.1f pointing words per 100" % (
        100 * sum(c.pointing for c in total) / sum(c.words for c in total)))
    for line in spare + problems:
        print(line)
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())

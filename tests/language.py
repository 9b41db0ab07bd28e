# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hold comments and pages to the rules of language of CONTRIBUTING.md.

Usage: language.py ROOT [--list]

Reads the comments below ROOT/include and ROOT/source, room by room, and the
pages ROOT/doc/*.md, ROOT/doc/*/*.md, ROOT/README.md and ROOT/CONTRIBUTING.md.
Fails on

  * a docstring (///) that begins with a pronoun or a relative word,
  * a word or a kind of name that the project has replaced,
  * more than 6 pointing words per 100 words in a room or on a page,
  * a paragraph of more than 120 words on a page of SHORT_PARAGRAPHS,
  * more functions with over six parameters than MAX_FUNCTIONS.

With --list the functions with over six parameters are printed, too.
"""

import collections
import pathlib
import re
import sys

MAX_POINTING = 6.0  # per 100 words
MAX_PARAGRAPH = 120  # words
MAX_PARAMETERS = 6

# Pages on which no paragraph may be longer than MAX_PARAGRAPH.
SHORT_PARAGRAPHS = ["doc/method.md", "doc/output.md", "doc/performance.md",
                    "doc/usage.md"]
# Ceiling: functions of include/ and source/ with more than MAX_PARAMETERS.
MAX_FUNCTIONS = 2

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


def main():
    root = pathlib.Path(sys.argv[1])
    list_all = "--list" in sys.argv
    counts = collections.defaultdict(Count)
    count_source(root, counts)
    count_pages(root, counts)
    problems = []
    for name, count in sorted(counts.items()):
        print("%-36s %6d words %5.1f pointing %3d openings %3d replaced"
              % (name, count.words, count.rate(), len(count.openings),
                 len(count.replaced)))
        if count.rate() > MAX_POINTING:
            problems.append("%s: %.1f pointing words per 100, at most %.0f"
                            % (name, count.rate(), MAX_POINTING))
        for what, places in (
                ("begins with a pronoun", count.openings),
                ("replaced word", count.replaced)):
            problems += ["%s: %s" % (what, place) for place in places]
        problems += count.long_paragraphs
    many = list(functions_with_many_parameters(root))
    print("%d functions with more than %d parameters" % (len(many),
                                                         MAX_PARAMETERS))
    if len(many) > MAX_FUNCTIONS or list_all:
        problems += ["  " + place for place in many]
    total = [c for name, c in counts.items() if "." not in name]
    print("all comments: %.1f pointing words per 100" % (
        100 * sum(c.pointing for c in total) / sum(c.words for c in total)))
    for line in problems:
        print(line)
    return len(problems) > 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter files of deal.II: sections, entries, comments, and defaults."""

import re

from talus_tools.errors import UserError
from talus_tools.texts import read_input, read_text

LINE_END = re.compile(r"\r?\n")
ENTRY = re.compile(r"set\s+(.*?)\s*=\s*(.*)$")
INCLUDE = re.compile(r"\s*(?:include|INCLUDE)\s+([^#]*[^#\s])")


def split_lines(text):
    """Lines of a text. str.splitlines() also splits at characters that talus takes as parts of a
    line."""
    lines = LINE_END.split(text)
    return lines[:-1] if lines[-1] == "" else lines


def lines_of(text):
    """Lines with their numbers, without comments; a trailing backslash joins two."""
    number, start, pending = 0, 1, ""
    for number, line in enumerate(split_lines(text), 1):
        line = pending + line.split("#", 1)[0].strip()
        if not pending:
            start = number
        if line.endswith("\\"):
            pending = line[:-1].rstrip() + " "
            continue
        pending = ""
        if line:
            yield start, line


def expand(path, depth=0):
    """Text of a file of talus with the lines of the files that it includes, which it names
    from the present folder."""
    if depth > 20:
        raise UserError(f"'{path}' is included through more than 20 files; one of them may "
                        "include itself.")
    lines = []
    for line in split_lines(read_input(path)):
        found = INCLUDE.match(line)
        lines.append(expand(found[1], depth + 1) if found else line)
    return "\n".join(lines)


def as_text(entries):
    """{"Section/Entry": value} in the language of parameter files."""
    lines = []
    for name, value in entries.items():
        *sections, entry = name.split("/")
        lines += [f"{'  ' * i}subsection {section}" for i, section in enumerate(sections)]
        lines.append(f"{'  ' * len(sections)}set {entry} = {value}")
        lines += [f"{'  ' * i}end" for i in reversed(range(len(sections)))]
    return "\n".join(lines) + "\n"


def read_parameters(path, read=read_text):
    """All entries in order, {"Section/Sub-section/Entry": value}. `read`: read_text() for a file
    of a run, read_input() for a file of the user."""
    entries, sections = {}, []
    for number, line in lines_of(read(path)):
        found = ENTRY.match(line)
        if found:
            entries["/".join(sections + [found[1]])] = found[2]
        elif line.startswith("subsection "):
            sections.append(line[len("subsection "):].strip())
        elif line == "end" and sections:
            sections.pop()
        else:
            raise UserError(f"'{path}', line {number}: '{line}' is none of 'set NAME = VALUE', "
                            "'subsection NAME' and 'end' of a section.")
    if sections:
        raise UserError(f"'{path}' ends within the section '{'/'.join(sections)}': an 'end' is "
                        "missing.")
    return entries


class Defaults:
    """Defaults by the reference of all parameters. Sections with names of the user's stand
    there once, as an example: a body, and a material for each law."""

    def __init__(self, path):
        self.entries = read_parameters(path)

    def of(self, name, entries):
        """Default of an entry among `entries`; None where the reference has none."""
        parts = name.split("/")
        if len(parts) >= 3 and parts[0] == "Materials":
            parts[1] = entries.get(f"Materials/{parts[1]}/Law", "")
        elif len(parts) == 3 and parts[0] in ("Bodies", "Obstacles", "Surfaces"):
            # Obstacles have the shapes of bodies, which a reference may have alone.
            sections = [parts[0]] + ["Bodies"] * (parts[0] == "Obstacles")
            return next((self.entries[key] for section in sections for key in self.entries
                         if key.count("/") == 2 and key.startswith(section + "/")
                         and key.endswith("/" + parts[2])), None)
        elif parts[0] == "Boundaries":
            # The faces across z are as those across x, which the reference of 2-D has.
            parts[1] = re.sub(r"^(Back|Front)\b", "Left", parts[1])
        return self.entries.get("/".join(parts))


def numbers(text):
    """The numbers of a list; None if it is none."""
    try:
        return [float(part) for part in re.split(r"[,;\s]+", text.strip())]
    except ValueError:
        return None


def is_same_value(one, other):
    """Whether two texts mean the same: 1e3 and 1000, or the same words."""
    if one.split() == other.split():
        return True
    left, right = numbers(one), numbers(other)
    if left is None or right is None:
        return False
    # The reference is that of 2-D: (0, 1) there is (0, 1, 0) in 3-D.
    return left == right or (len(left), len(right)) == (3, 2) and left == right + [0]


def changed_entries(entries, defaults):
    """(name, value, default or None) of those that are not at their default. Of an entry
    whose default is not known an empty value counts as the default."""
    result = []
    for name, value in entries.items():
        default = defaults.of(name, entries)
        if not is_same_value(value, default or ""):
            result.append((name, value, default))
    return result

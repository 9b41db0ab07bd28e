# SPDX-License-Identifier: LGPL-2.1-or-later
"""Name the tests that a change affects, as command lines that build and run them.

Usage: affected.py [--since COMMIT] [--build BUILD] [--run]
       affected.py --check

Reads the files changed since COMMIT (default: where the branch left origin/main or
main), committed or not. --run executes the command lines.

The includes of the sources give the unit tests. tests/affected.csv gives the whole
runs of each room and the entries of other files; the first row that fits counts, and
a name such as Block is a case. tests/sets.csv gives the seconds; slow entries are left
out. The word `quick` is for the whole quick set. --check only compares affected.csv
with the tests, and the includes with include_arrows.cmake, and ends with 1 and a
sentence for each name that is wrong.
"""

import argparse
import collections
import csv
import fnmatch
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MAX_SECONDS = 60  # of the whole runs of a room, on two cores
MANY = 40  # more suites run as the parts of all unit tests, in few processes
# Checks of the sources, and the checks that need no program.
CHECKS = {"case/IncludeArrows", "case/Language", "case/Weight"}
NO_PROGRAM = CHECKS | {"case/Affected", "case/Links", "case/Sets",
                       "case/VerificationPages"}

INCLUDE = re.compile(r'^ *# *include *[<"]([^>"]+)[>"]', re.MULTILINE)
IMPORT = re.compile(r"^ *(?:from|import) (\w+)", re.MULTILINE)
SUITE = re.compile(r"^ *TEST(?:_F|_P)?\((\w+),", re.MULTILINE)
RANKS = re.compile(r"TALUS_ALSO_ON_RANKS\(\s*(\w+),([\d,\s]+)\)")
CLASS = re.compile(r"^class (\w+)", re.MULTILINE)
ARROW = re.compile(r"^set\((\w+)((?: [\w${}]+)*)\)", re.MULTILINE)


def room_of(path):
    match = re.match(r"(?:include/talus|source)/(\w+)/", path)
    return match and match.group(1)


def read_rows(name):
    return csv.DictReader((ROOT / "tests" / name).read_text().splitlines())


def read_arrows():
    """By room, the rooms that it may include."""
    arrows = {None: set()}
    for room, names in ARROW.findall((ROOT / "tests/include_arrows.cmake").read_text()):
        arrows[room] = {room}
        for name in names.split():
            arrows[room] |= arrows[name[2:-1]] if name[0] == "$" else {name}
    return arrows


class Tree:
    """Includes of the sources and tests, and entries of ctest by test file."""

    def __init__(self):
        self.sets = {row["entry"]: row["set"] for row in read_rows("sets.csv")}
        self.time = {row["entry"]: int(row["seconds"]) for row in read_rows("sets.csv")}
        self.rows = {row["files"]: row["entries"] for row in read_rows("affected.csv")}
        self.text = {path.relative_to(ROOT).as_posix(): path.read_text()
                     for folder in ("include", "source", "tests")
                     for path in (ROOT / folder).rglob("*")
                     if path.suffix in (".h", ".cc", ".py")}
        self.users = collections.defaultdict(set)
        for path in self.text:
            for used in self.used_by(path):
                self.users[used].add(path)
        self.entries = {path: self.entries_in(path) for path in self.text
                        if path.startswith("tests/")}
        cmake = "".join((ROOT / folder / "CMakeLists.txt").read_text()
                        for folder in ("tests", "tests/cases"))
        self.known = {entry for entry in self.sets if not entry.startswith("case/")
                      or re.search(rf"\b{entry[5:]}\b", cmake)}
        self.known |= self.of_files(self.entries)

    def used_by(self, path):
        """Files of the project that a file includes or imports."""
        pattern, suffix = (IMPORT, ".py") if path.endswith(".py") else (INCLUDE, "")
        for name in pattern.findall(self.text[path]):
            for folder in (os.path.dirname(path), "include", "tests/unit"):
                used = os.path.normpath(f"{folder}/{name}{suffix}")
                if used in self.text:
                    yield used
                    break

    def entries_in(self, path):
        """Names of the entries whose tests are in the file."""
        text, file = self.text[path], pathlib.Path(path)
        if path == "tests/width/kernels.cc":
            return {"unit/Width"}
        if file.suffix == ".py":  # a class or the file has the name of the entry
            names = "|".join([*CLASS.findall(text), file.stem.title().replace("_", "")])
            name = re.compile(rf"(case/|report/{file.stem}\.)({names})(\.\dranks)?")
            folder = "report/" if path.startswith("tests/report/") else "case/"
            return {entry for entry in self.sets
                    if entry.startswith(folder) and name.fullmatch(entry)}
        room = "unit" if path.startswith("tests/unit/") else "case"
        ranks = [f"{suite}.{n}ranks" for suite, numbers in RANKS.findall(text)
                 for n in re.findall(r"\d+", numbers)]
        return {f"{room}/{suite}" for suite in SUITE.findall(text) + ranks}

    def reaching(self, paths):
        """The files, and all that include or import one of them."""
        found, queue = set(), list(paths)
        while queue:
            path = queue.pop()
            if path not in found:
                found.add(path)
                queue += self.users.get(path, ())
        return found

    def of_files(self, paths):
        return set().union(*(self.entries.get(path, ()) for path in paths))

    def of_row(self, files):
        """Entries of a row of affected.csv; a name that fits none stays."""
        names = ["case/" + word if re.match("[A-Z][^/]*$", word) else word
                 for word in self.rows.get(files, "").split()]
        return {entry for name in names
                for entry in fnmatch.filter(self.known, name) or [name]}

    def of_source(self, path):
        room = room_of(path)
        if path.endswith(".h"):
            users = self.reaching([path])
        else:
            header = f"include/talus/{room}/{pathlib.Path(path).stem}.h"
            users = self.reaching(user for user in self.users.get(header, ())
                                  if user.startswith("tests/"))
        folders = {f"tests/unit/{of}" for of in {room, *map(room_of, users)}}
        tests = {test for test in self.entries if os.path.dirname(test) in folders}
        tests |= {user for user in users if not user.startswith("tests/cases/")}
        return (self.of_files(tests) | self.of_row(f"room {room}") | CHECKS |
                {"case/InstalledSet", "case/ParameterReference"})

    def of_test(self, path):
        """Own entries; of a file without tests, those of its users."""
        header = re.sub(r"\.cc$", ".h", path)
        return self.entries.get(path) or self.of_files(self.reaching([path, header]))

    def of_parameters(self, path):
        """Entries of the tests that name a parameter file, or data of one."""
        name = re.compile(r"(?<![\w-])" + re.escape(os.path.basename(path)))
        tests = [test for test in self.entries if name.search(self.text[test])]
        return {"case/ParameterFiles"}.union(*map(self.of_test, tests))

    def affected_by(self, path):
        """Entries that a changed file affects."""
        for files in self.rows:
            if fnmatch.fnmatch(path, files):
                return self.of_row(files)
        if room_of(path):
            return self.of_source(path)
        if path.endswith(".prm") or path.startswith("prm/"):
            return self.of_parameters(path)
        if path.startswith("tests/"):
            return self.of_test(path) | {"case/Affected", "case/Sets"}
        return set()

    def seconds(self, entries):
        """Estimate for two cores; an entry on ranks takes both."""
        return sum(self.time.get(entry, 1 if entry.startswith("unit/") else 30)
                   * (1 if "anks" in entry else 0.5) for entry in entries)

    def problems_of_rows(self):
        for files in self.rows:
            found = self.of_row(files) & self.known
            for name in sorted(self.of_row(files) - self.known - {"quick"}):
                yield (f"affected.csv, row '{files}': no test is named {name}. "
                       "Correct the name.")
            quick = {name for name in found if self.sets.get(name) == "quick"}
            if files.startswith("room ") and (
                    quick != found or self.seconds(found) > MAX_SECONDS):
                yield (f"affected.csv, row '{files}': expected are entries of the set "
                       f"quick that take at most {MAX_SECONDS} s together. Remove "
                       f"{', '.join(sorted(found - quick)) or 'the longest'}.")

    def problems_of_rooms(self):
        arrows, sources = read_arrows(), {*map(room_of, self.text)}
        rows = {files[5:] for files in self.rows if files.startswith("room ")}
        for room in sorted((sources ^ set(arrows)) | (rows - sources)):
            yield (f"The room {room} is not everywhere: expected are sources, and a "
                   "line in include_arrows.cmake. Add what is missing.")
        for room in sorted(sources - rows - {None}):
            yield (f"The room {room} has no row in affected.csv. Add the row "
                   f"'room {room}' with the whole runs that exercise the room.")
        for path, users in self.users.items():
            for user in users:
                permitted = arrows.get(room_of(user))
                if permitted and room_of(path) not in permitted:
                    yield (f"{user} includes {path}, which include_arrows.cmake does "
                           "not permit. Remove the include.")


def git(*arguments):
    result = subprocess.run(["git", "-C", ROOT, *arguments], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return result.stdout.splitlines() if result.returncode == 0 else []


def changed_files(since):
    """Paths that differ from the commit."""
    for ref in ("origin/main", "main", "HEAD"):
        since = since or "".join(git("merge-base", ref, "HEAD"))
    if not git("rev-parse", "--verify", f"{since}^{{commit}}"):
        sys.exit(f"affected.py: git knows no commit '{since}'. Correct --since.")
    return sorted({*git("diff", "--name-only", "--no-renames", since),
                   *git("ls-files", "--others", "--exclude-standard")})


def runnable(tree, entries):
    """Entries that are not slow, with parts of the unit tests for many suites."""
    found = {entry for entry in entries if tree.sets.get(entry) != "slow"}
    suites = {entry for entry in found
              if entry.startswith("unit/") and entry not in tree.sets}
    if "quick" in found:
        found |= {entry for entry in tree.sets if tree.sets[entry] == "quick"}
    elif len(suites) > MANY:
        found |= {*fnmatch.filter(tree.sets, "unit/Part*"),
                  *fnmatch.filter(tree.sets, "unit/Ranks?")}
    else:
        return found
    return found - suites


def command_lines(tree, entries, build):
    ctest = f"ctest --test-dir {build} -j2 --output-on-failure --no-tests=error"
    if entries and not (ROOT / build / "CMakeCache.txt").exists():
        yield "cmake --preset test"
    if not entries <= NO_PROGRAM:
        yield f"cmake --build {build} --target tests"
    if "quick" in entries:
        yield f"{ctest} -L '^quick$'"
        entries = {entry for entry in entries if tree.sets.get(entry) == "full"}
    if entries:
        yield f"{ctest} -R '^({'|'.join(map(re.escape, sorted(entries)))})$'"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--since")
    parser.add_argument("--build", default="build/test")
    parser.add_argument("--run", action="store_true")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    tree = Tree()
    problems = [*tree.problems_of_rows(), *tree.problems_of_rooms()]
    if problems or options.check:
        print("\n".join(problems) or f"{len(tree.rows)} rows of affected.csv fit.")
        return len(problems) > 0
    affected = set()
    for path in changed_files(options.since):
        found = tree.affected_by(path)
        print(f"# {path}: {len(found)} entries")
        affected |= found
    entries = runnable(tree, affected)
    named = entries - {"quick"}
    print(f"# {len(named)} entries, about {tree.seconds(named):.0f} s on two cores")
    if slow := sorted(name for name in affected if tree.sets.get(name) == "slow"):
        print("# slow, left out:", *slow)
    for line in command_lines(tree, entries, options.build):
        print(line, flush=True)
        if options.run and (status := subprocess.call(line, shell=True, cwd=ROOT)):
            return status
    return 0


if __name__ == "__main__":
    sys.exit(main())

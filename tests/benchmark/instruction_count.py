#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Count the instructions of short runs: a slide, a slope in 3-D and a strength
reduction.

    tests/benchmark/instruction_count.py BUILD [--write] [--case NAME]
                                         [--program TALUS]

BUILD is a build folder, whose compiler and deal.II are used. Time is noisy and
instructions are not: the count is the same on a busy machine. Two guards:

The number of all instructions of a run, without set-up. Fails if a case takes
over 5 % more than instruction_count.txt says; if a case takes over 5 % fewer, the
script asks for a new reference, which --write writes. Left out with a compiler
whose major version is not the one of the reference, as each compiler has its own
count.

The work of the instructions in the kernels of the slide, whatever the compiler.
Code that takes registers apart, entry by entry or through memory, is right and
slow. A small change is enough: a comparison of vectors wider than a register, or a
selection hidden from the compiler. Each instruction of the compiled functions
counts as often as it was executed, so remainders of loops and rare branches do not
count. Fails if too few of the instructions of a kernel work on whole registers, or
if over 4 % of those on registers move single entries or halves. (Instructions per
operation of operations.py would say less: half of the instructions are no
operations, but addresses and loops.)

Valgrind counts. Valgrind knows AVX2 and FMA but not AVX-512, so the program is
built anew for x86-64-v3 in BUILD/instruction-count, with registers of four
doubles, and the C library is told to do without AVX-512: the count is the same on
every machine. --program counts with a program built before, --case counts a single
case. Skipped (status 77) without valgrind and on other processors.
"""

import argparse
import collections
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
REFERENCE = os.path.join(HERE, "instruction_count.txt")
TOLERANCE = 0.05
SKIPPED = 77
ARCH = "x86-64-v3"

# Functions of the kernels, and the least share of their instructions that work on
# whole registers: three quarters of what it was when this was written.
KERNELS = {
    "weights": (r"talus::BlockWalk<2>::compute_weights\(", 0.40),
    "points to grid": (r"talus::Transfer<2>::scatter\(", 0.43),
    "grid to points": (r"(talus::Transfer<2>::gather\(|"
                       r".*interpolate_to_block<2>)", 0.47),
    "stress": (r".*talus::RateLaw<2, talus::VonMisesFlow>::"
               r"update_stress_by<talus::VonMisesFlow>\(", 0.58),
    "time step": (r"talus::TimeStep<2>::add_batch\(", 0.35),
}
# Single entries or halves of registers. (Transpositions move halves.)
MOVES = re.compile(
    r"v?(p?extr[bwdq]|p?insr[bwdq]|extract[fi]\w+|insert[fi]\w+|"
    r"mov[hl]p[ds]|mov(lh|hl)ps)$"
)
MOST_MOVES = 0.04

class Case:
    """A short run of which all instructions in the function `counted` count: a
    function that main() calls in another file, so that it is not inlined."""

    def __init__(self, file, settings, dim, has_kernels=False):
        self.arguments = [os.path.join(ROOT, "prm", file)]
        for setting in [*settings, "Output/Write points=false",
                        "Output/Write grid=false", "Checkpoint/At the end=false"]:
            self.arguments += ["--set", setting]
        self.counted = f"talus::Simulation<{dim}>::run()"
        self.has_kernels = has_kernels


CASES = {
    # The quick landslide on large cells, with points that split soon: all phases
    # of a step take part.
    "slide": Case(
        "landslide-quick.prm",
        ["Grid/Cell size=0.8", "End time=0.6", "Splitting/Threshold=1.05",
         "Splitting/Minimum length=0"],
        dim=2, has_kernels=True),
    # A slope in 3-D on large cells, with bed, water, tracked mesh and maps.
    "slope-3d": Case(
        "slope-3d.prm",
        ["Grid/Cell size=20", "End time=3", "Output/Statistics interval=3"],
        dim=3),
    # Factor of safety of a slope on large cells.
    "strength-reduction": Case(
        "slope-stability.prm",
        ["Grid/Cell size=20"],
        dim=2),
}


def skip(reason):
    print("SKIPPED: " + reason)
    sys.exit(SKIPPED)


def cached(build, name):
    """Value of a variable of CMake's cache."""
    with open(os.path.join(build, "CMakeCache.txt")) as cache:
        found = re.search(rf"^{re.escape(name)}:\w+=(.*)$", cache.read(), re.M)
    if not found:
        sys.exit(
            f"{build}/CMakeCache.txt has no {name}. Give a folder in which talus "
            "was configured."
        )
    return found.group(1)


def compiler_version(compiler):
    """For example 'GCC 12.2.0'."""
    text = subprocess.run(
        [compiler, "--version"], check=True, stdout=subprocess.PIPE, text=True
    ).stdout
    name = "Clang" if "clang" in text else "GCC"
    return name + " " + re.search(r"\d+\.\d+\.\d+", text).group(0)


def read_reference():
    """Compiler, and instructions by case."""
    with open(REFERENCE) as file:
        text = "".join(line for line in file if not line.startswith("#"))
    values = dict(line.split(" = ") for line in text.strip().splitlines())
    compiler = values.pop("compiler")
    return compiler, {name: int(count) for name, count in values.items()}


def write_reference(compiler, counts):
    with open(REFERENCE, "w") as file:
        file.write(
            "# Instructions of the cases in instruction_count.py, by valgrind.\n"
            "# tests/benchmark/instruction_count.py BUILD --write renews them.\n"
            f"compiler = {compiler}\n"
        )
        for name, count in counts.items():
            file.write(f"{name} = {count}\n")


def build_program(build):
    """talus for ARCH. Returns its path."""
    folder = os.path.join(build, "instruction-count")
    subprocess.run(
        [
            "cmake", "-S", ROOT, "-B", folder, "-G", "Ninja",
            "-DCMAKE_BUILD_TYPE=Release",
            "-DTALUS_NATIVE=OFF",
            "-DTALUS_ARCH=" + ARCH,
            "-DTALUS_TESTS=OFF",
            "-DCMAKE_CXX_COMPILER=" + cached(build, "CMAKE_CXX_COMPILER"),
            "-Ddeal.II_DIR=" + cached(build, "deal.II_DIR"),
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    subprocess.run(
        ["cmake", "--build", folder, "--target", "talus", "--parallel", "2"],
        check=True,
    )
    return os.path.join(folder, "talus")


def without_avx512():
    """The environment in which the C library's mathematical functions are those
    of ARCH, too."""
    return dict(os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX512F")


def run_under_valgrind(program, case):
    """Returns point-steps, zero without time steps, and callgrind's result,
    instruction by instruction."""
    with tempfile.TemporaryDirectory(prefix="talus-count-") as folder:
        result = os.path.join(folder, "callgrind.out")
        done = subprocess.run(
            [
                "valgrind", "--tool=callgrind",
                "--callgrind-out-file=" + result,
                "--toggle-collect=" + case.counted,
                "--dump-instr=yes", "--compress-pos=no", "--compress-strings=no",
                program, *case.arguments, "--output", os.path.join(folder, "run"),
            ],
            env=without_avx512(), stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True,
        )
        if done.returncode != 0:
            sys.exit("The run under valgrind failed:\n" + done.stdout)
        with open(result) as file:
            text = file.read()
    steps = re.search(r"(\S+) point-steps in", done.stdout)
    return float(steps.group(1)) if steps else 0., text


def total(result, case):
    """Instructions of all calls of the counted function in a run."""
    count = int(re.search(r"^(?:totals|summary): (\d+)", result, re.M).group(1))
    if count == 0:
        sys.exit(
            f"No instruction of {case.counted} was counted: the function is no "
            "longer called by that name, or was inlined. Correct Case in "
            + __file__
        )
    return count


def disassemble(program):
    """Name and operands of each instruction of the program, by address."""
    text = subprocess.run(
        ["objdump", "-d", "--no-show-raw-insn", program],
        check=True, stdout=subprocess.PIPE, text=True,
    ).stdout
    found = re.finditer(r"^\s+([0-9a-f]+):\s+(\S+) *(.*)$", text, re.M)
    return {int(one[1], 16): (one[2], one[3]) for one in found}


def executed(program, result):
    """By function of the program, how often each address was executed; what it
    calls is not part of it."""
    counts = collections.defaultdict(collections.Counter)
    library = function = None
    is_call = False
    for line in result.splitlines():
        if line.startswith("ob="):
            library = line[3:]
        elif line.startswith("fn="):
            function = line[3:]
        elif line.startswith("calls="):
            is_call = True
        elif line.startswith("0x"):
            # The line after `calls=` is what the call took.
            if not is_call and os.path.basename(library) == os.path.basename(program):
                address, _, times = line.split()
                counts[function][int(address, 16)] += int(times)
            is_call = False
    return counts


def readable(pattern):
    return re.sub(r"\.\*|\\\(", "", pattern)


def judge_kernels(program, result, steps):
    """Prints what the kernels do; sentences on what they should not."""
    instructions = disassemble(program)
    counts = executed(program, result)
    print("instructions per point and step: all, on whole registers, moves of parts")
    for name, (pattern, least) in KERNELS.items():
        everything = on_registers = on_whole = moves = 0
        for function in filter(re.compile(pattern).match, counts):
            for address, times in counts[function].items():
                what, operands = instructions[address]
                everything += times
                if re.search("%[xyz]mm", operands):
                    on_registers += times
                    on_whole += times * ("%ymm" in operands)
                    moves += times * bool(MOVES.match(what))
        if everything == 0:
            yield (
                f"{name}: there is no {readable(pattern)}. It has another name now, "
                "or was inlined: correct KERNELS in " + __file__
            )
            continue
        print(
            f"  {name:15} {everything / steps:7.1f} {on_whole / steps:7.1f} "
            f"({on_whole / everything:.2f}, at least {least:.2f}) "
            f"{moves / steps:7.2f} ({moves / max(on_registers, 1):.3f}, at most "
            f"{MOST_MOVES:.2f})"
        )
        if on_whole < least * everything:
            yield (
                f"{name}: {on_whole / everything:.2f} of the instructions work on "
                f"whole registers, where {least:.2f} should. The compiler takes "
                f"registers apart: look at the disassembly of {readable(pattern)}."
            )
        if moves > MOST_MOVES * on_registers:
            yield (
                f"{name}: {moves / on_registers:.3f} of the instructions on "
                "registers move parts of them. Look at the disassembly of "
                f"{readable(pattern)}."
            )


def judge(name, count, reference):
    """The sentence and the exit status."""
    if reference is None:
        return 1, (
            f"FAILED: {name} has no reference. Renew the references with --write."
        )
    ratio = count / reference
    sentence = (
        f"{name}: {count} instructions, {100 * (ratio - 1):+.2f} % of the "
        f"reference {reference}."
    )
    if ratio > 1 + TOLERANCE:
        return 1, (
            f"FAILED: {sentence} The case became slower; if that is wanted, "
            "renew the reference with --write and say why in the commit."
        )
    if ratio < 1 - TOLERANCE:
        return 0, (
            f"{sentence} The case became faster: lower the reference with "
            "--write, so that the gain is guarded, too."
        )
    return 0, sentence


def count_case(program, name):
    """Returns the instructions of the case, and the exit status of its kernels."""
    case = CASES[name]
    steps, result = run_under_valgrind(program, case)
    count = total(result, case)
    # A factor of safety takes no steps.
    each = (f", {count / steps:.1f} in each of {steps:.5g} point-steps"
            if steps > 0 else "")
    print(f"{name}: {count} instructions{each}.", flush=True)
    status = 0
    if case.has_kernels:
        for error in list(judge_kernels(program, result, steps)):
            print("FAILED: " + error)
            status = 1
    return count, status


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", help="build folder")
    parser.add_argument("--write", action="store_true",
                        help="renew the references")
    parser.add_argument("--case", choices=list(CASES), action="append",
                        help="count this case; repeatable; default: all")
    parser.add_argument("--program", help="talus for x86-64-v3, already built")
    return parser.parse_args()


def skip_unless_countable():
    if platform.machine() not in ("x86_64", "AMD64"):
        skip(f"the count is for {ARCH}, this is {platform.machine()}.")
    if not shutil.which("valgrind"):
        skip("valgrind was not found; Debian's package valgrind brings it.")
    if not shutil.which("objdump"):
        skip("objdump was not found; Debian's package binutils brings it.")


def main():
    options = parse_arguments()
    skip_unless_countable()
    build = os.path.abspath(options.build)
    program = options.program or build_program(build)
    compiler = compiler_version(cached(build, "CMAKE_CXX_COMPILER"))
    expected, references = read_reference()
    status, counts = 0, {}
    for name in options.case or CASES:
        counts[name], status_of_kernels = count_case(program, name)
        status = max(status, status_of_kernels)
        if options.write:
            print(f"{name}: {counts[name]} instructions with {compiler}.")
        elif compiler.split(".")[0] == expected.split(".")[0]:
            status_of_count, sentence = judge(
                name, counts[name], references.get(name)
            )
            status = max(status, status_of_count)
            print(sentence, flush=True)
    if options.write:
        others = references if compiler == expected else {}
        write_reference(compiler, {**others, **counts})
    elif compiler.split(".")[0] != expected.split(".")[0]:
        print(
            f"The compiler is {compiler}, but the reference was taken with "
            f"{expected}; the counts of two compilers do not compare."
        )
    sys.exit(status)


if __name__ == "__main__":
    main()

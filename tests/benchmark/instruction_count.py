#!/usr/bin/env python3
"""Count the instructions of the time steps of a short slide.

    tests/benchmark/instruction_count.py BUILD [--write]

BUILD is a build folder, whose compiler and deal.II are used. Fails if the steps
take over 5 % more instructions than instruction_count.txt says; if they take over
5 % fewer, it asks for a new reference, which --write writes. Time is noisy and
instructions are not: the count is the same on a busy machine.

Valgrind counts, and does not know all instructions of new processors. So the
program is built anew in BUILD/instruction-count for x86-64-v3 (AVX2). Skipped
(status 77) without valgrind, and with a compiler whose major version is not that
of the reference, as each compiler has its own count.
"""

import argparse
import os
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

# The quick landslide on large cells, with points that split soon: all phases of
# a step take part, and nothing else is counted.
CASE = [
    os.path.join(ROOT, "prm", "landslide-quick.prm"),
    "--set", "Grid/Cell size=0.8",
    "--set", "End time=0.6",
    "--set", "Splitting/Threshold=1.05",
    "--set", "Splitting/Minimum length=0",
    "--set", "Output/Write points=false",
    "--set", "Output/Write grid=false",
    "--set", "Checkpoint/At the end=false",
]
# The time loop: a function that main() calls in another file, so that it is
# not inlined.
COUNTED = "talus::Simulation<2>::run()"


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
    """Compiler and count."""
    with open(REFERENCE) as file:
        text = "".join(line for line in file if not line.startswith("#"))
    values = dict(line.split(" = ") for line in text.strip().splitlines())
    return values["compiler"], int(values["instructions"])


def write_reference(compiler, count):
    with open(REFERENCE, "w") as file:
        file.write(
            "# Instructions of the time steps of the slide in "
            "instruction_count.py, by valgrind.\n"
            "# tests/benchmark/instruction_count.py BUILD --write renews it.\n"
            f"compiler = {compiler}\n"
            f"instructions = {count}\n"
        )


def build_program(build):
    """talus for processors that valgrind knows. Returns its path."""
    folder = os.path.join(build, "instruction-count")
    subprocess.run(
        [
            "cmake", "-S", ROOT, "-B", folder, "-G", "Ninja",
            "-DCMAKE_BUILD_TYPE=Release",
            "-DTALUS_ARCH=x86-64-v3",
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


def count_instructions(program):
    """Of all calls of COUNTED in one run."""
    # The mathematical functions of the C library, too, are those for any
    # processor.
    environment = dict(
        os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX,-AVX512F"
    )
    with tempfile.TemporaryDirectory(prefix="talus-count-") as folder:
        result = os.path.join(folder, "callgrind.out")
        done = subprocess.run(
            [
                "valgrind", "--tool=callgrind",
                "--callgrind-out-file=" + result,
                "--toggle-collect=" + COUNTED,
                program, *CASE, "--output", os.path.join(folder, "run"),
            ],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True,
        )
        if done.returncode != 0:
            sys.exit("The run under valgrind failed:\n" + done.stdout)
        with open(result) as file:
            totals = re.search(r"^(?:totals|summary): (\d+)", file.read(), re.M)
    print([line for line in done.stdout.splitlines() if "point-steps" in line][0])
    count = int(totals.group(1))
    if count == 0:
        sys.exit(
            f"No instruction of {COUNTED} was counted: the function is no longer "
            "called by that name, or was inlined. Correct COUNTED in " + __file__
        )
    return count


def judge(count, reference):
    """The sentence and the exit status."""
    ratio = count / reference
    sentence = (
        f"{count} instructions, {100 * (ratio - 1):+.2f} % of the reference "
        f"{reference}."
    )
    if ratio > 1 + TOLERANCE:
        return 1, (
            f"FAILED: {sentence} The steps became slower; if that is wanted, "
            "renew the reference with --write and say why in the commit."
        )
    if ratio < 1 - TOLERANCE:
        return 0, (
            f"{sentence} The steps became faster: lower the reference with "
            "--write, so that the gain is guarded, too."
        )
    return 0, sentence


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", help="build folder")
    parser.add_argument("--write", action="store_true", help="renew the reference")
    options = parser.parse_args()
    build = os.path.abspath(options.build)

    if not shutil.which("valgrind"):
        skip("valgrind was not found; Debian's package valgrind brings it.")
    compiler = compiler_version(cached(build, "CMAKE_CXX_COMPILER"))
    if not options.write:
        expected, reference = read_reference()
        if compiler.split(".")[0] != expected.split(".")[0]:
            skip(
                f"the compiler is {compiler}, but the reference was taken with "
                f"{expected}; the counts of two compilers do not compare."
            )
    count = count_instructions(build_program(build))
    if options.write:
        write_reference(compiler, count)
        print(f"{REFERENCE}: {count} instructions with {compiler}.")
        return
    status, sentence = judge(count, reference)
    print(sentence)
    sys.exit(status)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A short slide with splitting, compiled in several ways: the same statistics.

    tests/width/whole_runs.py widths|levels BUILD [--program DIST/talus]

BUILD is a build folder, whose compiler and deal.II are used.

widths: for x86-64-v3, every operation rounded by itself, with registers of 2, 4
and 8 doubles: all bits are the same. (On such a processor the compiler makes two
registers of one of 8 doubles, slowly; what a point gives is the same.) Built in
BUILD/width-2 ... width-8.

levels: the build for distribution with its libraries for x86-64-v2, -v3 and, if
the machine has it, -v4, where products and sums are contracted or not as the
processor has it: the same up to round-off. Built in BUILD/levels, unless
--program names one.

Skipped (status 77) on other processors.
"""

import argparse
import csv
import os
import platform
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.join(ROOT, "tests", "benchmark"))

from instruction_count import CASE, cached, skip

SETTINGS = [*CASE, "--set", "Output/Statistics interval=0.02"]

# What the loader is told the processor had not, so that it takes the library of a
# level; and the mathematical functions of the C library are then those of
# that level, too.
LEVELS = {
    "x86-64-v2": "-AVX2,-FMA,-AVX,-AVX512F",
    "x86-64-v3": "-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ,-AVX512CD",
    "x86-64-v4": "",
}

# Round-off over some hundred steps, of the largest number of a column.
TOLERANCE = 1e-11
# A remainder of large numbers, and a number that is round-off itself.
REMAINDER, OF_REMAINDER = "energy remainder [J]", "gravity work [J]"
LEDGER, MOST_OF_LEDGER = "split conservation error [-]", 1e-12


def build(folder, base, definitions):
    """talus in @p folder. Returns its path."""
    subprocess.run(
        [
            "cmake", "-S", ROOT, "-B", folder, "-G", "Ninja",
            "-DCMAKE_BUILD_TYPE=Release",
            "-DTALUS_NATIVE=OFF",
            "-DTALUS_TESTS=OFF",
            "-DCMAKE_CXX_COMPILER=" + cached(base, "CMAKE_CXX_COMPILER"),
            "-Ddeal.II_DIR=" + cached(base, "deal.II_DIR"),
            *definitions,
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    subprocess.run(
        ["cmake", "--build", folder, "--target", "talus", "--parallel", "2"],
        check=True,
    )
    return os.path.join(folder, "talus")


def statistics_of(program, mask=""):
    """Heading and rows of statistics.csv, as text."""
    environment = dict(os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=" + mask)
    with tempfile.TemporaryDirectory(prefix="talus-whole-run-") as folder:
        output = os.path.join(folder, "run")
        done = subprocess.run(
            [program, *SETTINGS, "--output", output],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True,
        )
        if done.returncode != 0:
            sys.exit("The run failed:\n" + done.stdout)
        with open(os.path.join(output, "statistics.csv")) as file:
            heading, *rows = csv.reader(file)
    if int(rows[-1][heading.index("splits")]) == 0:
        sys.exit("No point split: the slide of instruction_count.py has changed.")
    return heading, rows


def compare_bits(build_folder):
    """Sentences on what differs."""
    found = {}
    for width in (2, 4, 8):
        program = build(
            os.path.join(build_folder, f"width-{width}"),
            build_folder,
            [
                "-DTALUS_ARCH=x86-64-v3",
                f"-DWIDTH={width}",
                "-DCMAKE_PROJECT_talus_INCLUDE="
                + os.path.join(HERE, "one_rounding_each.cmake"),
            ],
        )
        # The mathematical functions of the C library are the same for all.
        found[width] = statistics_of(program, LEVELS["x86-64-v3"])
    heading, rows = found[4]
    print(f"{len(rows)} rows of statistics.csv with {list(found)} lanes.")
    for width, (_, others) in found.items():
        for column, name in enumerate(heading):
            differ = [
                row for row, other in zip(rows, others)
                if row[column] != other[column]
            ]
            if differ:
                yield (
                    f"{name}: {width} lanes and 4 differ in {len(differ)} rows, "
                    f"first at {differ[0][0]} s."
                )
        if len(rows) != len(others):
            yield f"{width} lanes have {len(others)} rows."


def kernels_of(program, mask):
    """The level of the library that the loader takes."""
    text = subprocess.run(
        [program, "--version"],
        env=dict(os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=" + mask),
        stdout=subprocess.PIPE, text=True,
    ).stdout
    level = re.search(r"kernels for ([\w-]+)", text)
    return level.group(1) if level else "unknown"


def compare_round_off(build_folder, program):
    """Sentences on what differs by more than round-off."""
    if program is None:
        program = build(os.path.join(build_folder, "levels"), build_folder, [])
    found = {}
    for level, mask in LEVELS.items():
        if kernels_of(program, mask) == level:
            found[level] = statistics_of(program, mask)
        else:
            print(f"{level} is left out: this processor does not have it.")
    if len(found) < 2:
        skip("of the levels of x86-64 this processor has less than two.")
    heading, rows = next(iter(found.values()))
    values = {
        level: list(zip(*[[float(x) for x in row] for row in others]))
        for level, (_, others) in found.items()
    }
    reference = next(iter(values.values()))
    largest = lambda name: max(abs(x) for x in reference[heading.index(name)])
    worst = (0, "none")
    for level, columns in values.items():
        if len(columns[0]) != len(reference[0]):
            yield f"{level} has {len(columns[0])} rows in place of {len(rows)}."
            continue
        for name, column, expected in zip(heading, columns, reference):
            if name == LEDGER:
                if max(map(abs, column)) > MOST_OF_LEDGER:
                    yield f"{level}, {name}: {max(map(abs, column))}."
                continue
            scale = largest(OF_REMAINDER if name == REMAINDER else name)
            error = max(abs(a - b) for a, b in zip(column, expected))
            if scale > 0:
                worst = max(worst, (error / scale, f"{level}, {name}"))
            if error > TOLERANCE * scale:
                yield f"{level}, {name}: {error:.3g} of {scale:.3g} differ."
    print(
        f"{len(rows)} rows of statistics.csv for {', '.join(found)}; largest "
        f"difference {worst[0]:.1e} of the column's maximum ({worst[1]})."
    )


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", choices=["widths", "levels"])
    parser.add_argument("build", help="build folder")
    parser.add_argument("--program", help="talus of a build for distribution")
    options = parser.parse_args()
    if platform.machine() not in ("x86_64", "AMD64"):
        skip("the levels are those of x86-64, this is " + platform.machine() + ".")
    folder = os.path.abspath(options.build)
    if options.what == "widths":
        if not has_avx2():
            skip("this processor has no AVX2.")
        errors = list(compare_bits(folder))
    else:
        errors = list(compare_round_off(folder, options.program))
    for error in errors:
        print("FAILED: " + error)
    sys.exit(1 if errors else 0)


def has_avx2():
    with open("/proc/cpuinfo") as file:
        return " avx2 " in file.read()


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A program with a law of its own, as a user builds it: talus is installed, found
by find_package(), and the example runs with each library that was installed.

Usage: own_law.py BUILD FOLDER LAUNCHER, where BUILD is the folder of a whole build
and LAUNCHER that of the compiler, if any. Exits with 77 if there is no such build.
"""

import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys

BUILD = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()
# What the loader is to leave out for each level.
LEVELS = {"x86-64-v4": "", "x86-64-v3": "-AVX512F", "x86-64-v2": "-AVX512F,-AVX2"}


def run(*command, **options):
    print(" ".join(map(str, command)), flush=True)
    return subprocess.run(command, check=True, text=True, **options)


def centre():
    """Height of the centre of the column at rest [m]: at the height Y of the
    undeformed column the stretch J bears what is above,
    (lambda + mu) J^2 - (lambda - w) J - mu = 0, w = rho g (H - Y)."""
    height, rho_g = 10., 1000. * 9.81
    mu = 1e6 / 2.6
    lame = 0.3 * 1e6 / 1.3 / 0.4
    n, y, result = 10000, 0., 0.
    for i in range(n):
        b = lame - rho_g * height * (1. - (i + 0.5) / n)
        J = (b + math.sqrt(b * b + 4. * (lame + mu) * mu)) / (2. * (lame + mu))
        result += (y + 0.5 * J * height / n) / n
        y += J * height / n
    return result


def check(level, version, environment):
    settings = FOLDER / "install/share/talus/examples/own-law/own_law.prm"
    output = FOLDER / ("results-" + level.replace(" ", "-"))
    run(FOLDER / "build/own-law", settings, "--overwrite", "--output", output,
        env=environment)
    with open(output / "statistics.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows[-2:]:
        found, expected = float(row["centre y [m]"]), centre()
        if abs(found - expected) > 5e-5 * expected:
            sys.exit(f"{version}: centre at {found} m, not at {expected} m")
    print(f"{version}: centre at {found:.5f} m, closed form {expected:.5f} m")


if not (BUILD / "lib/libtalus.so").exists():
    print(f"There is no library in {BUILD}.")
    sys.exit(77)
shutil.rmtree(FOLDER, ignore_errors=True)
run("cmake", "--install", BUILD, "--prefix", FOLDER / "install",
    stdout=subprocess.DEVNULL)
launcher = sys.argv[3:] and [f"-DCMAKE_CXX_COMPILER_LAUNCHER={sys.argv[3]}"]
run("cmake", "-S", FOLDER / "install/share/talus/examples/own-law",
    "-B", FOLDER / "build", "-DCMAKE_BUILD_TYPE=Release",
    f"-DCMAKE_PREFIX_PATH={FOLDER / 'install'}", *launcher)
run("cmake", "--build", FOLDER / "build")
levels = LEVELS if (BUILD / "lib/glibc-hwcaps").exists() else {"one level": ""}
flags = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
for level, hidden in levels.items():
    if level == "x86-64-v4" and "avx512f" not in flags:
        continue
    environment = os.environ | {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + hidden}
    version = run(FOLDER / "build/own-law", "--version", env=environment,
                  capture_output=True).stdout.strip()
    if level in LEVELS and level not in version:
        sys.exit(f"{level} was expected: {version}")
    check(level, version, environment)

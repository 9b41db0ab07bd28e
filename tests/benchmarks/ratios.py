#!/usr/bin/env python3
"""What many ranks and a tracking mesh gain, as ratios within one run.

    tests/benchmarks/ratios.py [--talus build/release/talus] [--repeat 3]
                               [--case NAME]

Cases, each two runs that take turns:

  ranks         landslide of 0.2 m, one rank against two: strong scaling
  large-domain  a domain 100 times as long, with tracking, against the tight
                one with small cells everywhere: time per step and memory

Timings are noisy; the medians of the ratios are printed. Nothing else should
run meanwhile.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LANDSLIDE = os.path.join(ROOT, "prm", "landslide.prm")
QUIET = ["Output/Write points=false", "Output/Write grid=false"]
LARGE = [
    "Grid/Upper corner=31960,8",
    "Grid/Coarsest level=6",
    "Mesh tracking/Enabled=true",
]
CASES = {
    "ranks": [(1, ["End time=2.5"]), (2, ["End time=2.5"])],
    "large-domain": [(1, ["End time=2.5"]), (1, ["End time=2.5"] + LARGE)],
}


def run(talus, ranks, settings):
    """Wall time of the steps [s], peak memory [MB] and cells of one run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [talus, LANDSLIDE, "--output", folder]
        for setting in QUIET + settings:
            command += ["--set", setting]
        environment = dict(os.environ)
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks)] + command
            if os.geteuid() == 0:
                environment["OMPI_ALLOW_RUN_AS_ROOT"] = "1"
                environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
        process = subprocess.Popen(
            command, env=environment, stdout=subprocess.PIPE, text=True
        )
        output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit("This run failed: " + " ".join(command))
        with open(os.path.join(folder, "log.txt")) as file:
            log = file.read()
    seconds = float(re.search(r"point-steps in (\S+) s:", output).group(1))
    cells = int(re.search(r"with (\d+) cells", log).group(1))
    for more in re.findall(r"and has (\d+) cells", log):
        cells = max(cells, int(more))
    return seconds, usage.ru_maxrss / 1024.0, cells


def compare(name, talus, repeat):
    first, second = CASES[name]
    pairs = []
    for _ in range(repeat):
        pairs.append((run(talus, *first), run(talus, *second)))
    for i, settings in enumerate((first, second)):
        seconds = statistics.median(pair[i][0] for pair in pairs)
        memory = statistics.median(pair[i][1] for pair in pairs)
        print(
            f"{name}: {settings[0]} rank(s), {pairs[0][i][2]} cells: "
            f"{seconds:.2f} s" + (f", {memory:.0f} MB" if settings[0] == 1 else "")
        )
    time = statistics.median(b[0] / a[0] for a, b in pairs)
    if name == "ranks":
        print(f"{name}: 2 ranks are {1 / time:.2f} times as fast")
    else:
        memory = statistics.median(b[1] / a[1] for a, b in pairs)
        print(f"{name}: time per step x {time:.2f}, memory x {memory:.2f}")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--talus", default=os.path.join(ROOT, "build/release/talus"))
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--case", choices=sorted(CASES), action="append")
    options = parser.parse_args()
    for name in options.case or sorted(CASES):
        compare(name, options.talus, options.repeat)


if __name__ == "__main__":
    main()

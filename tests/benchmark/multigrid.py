# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time and iterations of CG with multigrid on ever smaller cells, as a table.

    python3 multigrid.py BUILD [--repeat N] [--finest]

BUILD is the build folder. Each case of tests/cases/multigrid*.prm runs N times (3);
the fastest one counts. --finest adds a halving in 3-D, which needs some 10 GB.
"""

import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import time

CASES = pathlib.Path(__file__).resolve().parents[1] / "cases"
SIZES = {2: [0.625, 0.3125, 0.15625, 0.078125, 0.0390625],
         3: [0.25, 0.125, 0.0625]}


def measure(talus, dim, h, nu, folder):
    """Cells, unknowns, iterations, seconds of the linear system, of the run."""
    file = CASES / ("multigrid.prm" if dim == 2 else "multigrid-3d.prm")
    begin = time.monotonic()
    subprocess.run([talus, file, "--overwrite", "--output", folder,
                    "--set", f"Grid/Cell size={h}",
                    "--set", f"Materials/elastic/Poisson's ratio={nu}"],
                   check=True, capture_output=True)
    whole = time.monotonic() - begin
    log = (folder / "log.txt").read_text()
    with open(folder / "newton.csv", newline="") as stream:
        iterations = max(int(float(row["linear iterations"]))
                         for row in csv.DictReader(stream))
    return (int(re.search(r"with (\d+) cells", log).group(1)),
            int(re.search(r"with (\d+) unknowns", log).group(1)), iterations,
            float(re.search(r"linear iterations, (\S+) s", log).group(1)),
            whole)


def main():
    talus = pathlib.Path(sys.argv[1]).resolve() / "talus"
    options = sys.argv[2:]
    repeat = (int(options[options.index("--repeat") + 1])
              if "--repeat" in options else 3)
    if "--finest" in options:
        SIZES[3].append(0.03125)
    print("| | nu | cells of the mesh | unknowns | iterations | linear system "
          "[s] | per unknown [us] | whole run per unknown [us] |\n"
          "|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for dim, sizes in SIZES.items():
            for nu in (0.3, 0.49):
                for h in sizes:
                    runs = [measure(talus, dim, h, nu, pathlib.Path(folder))
                            for _ in range(repeat)]
                    cells, unknowns, iterations, *_ = runs[0]
                    system = min(run[3] for run in runs)
                    whole = min(run[4] for run in runs)
                    print(f"| {dim}-D | {nu} | {cells} | {unknowns} | "
                          f"{iterations} | {system:.3g} | "
                          f"{1e6 * system / unknowns:.3g} | "
                          f"{1e6 * whole / unknowns:.3g} |", flush=True)


if __name__ == "__main__":
    main()

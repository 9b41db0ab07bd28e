# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of talus and of the yardstick, and what their output says of the time."""

import collections
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))

# Nothing but the statistics, as often as asked for.
QUIET = [
    "Output/Write points=false",
    "Output/Write grid=false",
    "Checkpoint/At the end=false",
]

# States of the quick landslide [s]: while it runs fastest, and when it has gone
# most of its way.
STATES = {"mid": 8, "late": 20}


class Run:
    """What a run of talus tells at its end: steps, point-steps, points at the
    end, cells, seconds by phase of the log and of all steps, peak memory of a
    rank in bytes, and seconds of the whole process. Checkpoints are in none of
    the times but the last: a run that is resumed begins with one."""

    def __init__(self, output, log, elapsed):
        last = re.search(
            r"(\d+) steps to t = (\S+) s, (\d+) points at the end, "
            r"(\S+) point-steps in (\S+) s:",
            output,
        )
        self.steps = int(last.group(1))
        self.n_points = int(last.group(3))
        self.point_steps = float(last.group(4))
        cells = re.findall(r"(?:with|and has) (\d+) cells", log)
        self.cells = max(int(n) for n in cells)
        self.phases = {}
        for line in log[log.rindex("Wall time by phase") :].splitlines()[1:]:
            phase = re.match(r"  (\S.*?)\s+\S+\s+(\S+)\s+\S+\s+\S+ %$", line)
            if phase is None:
                break
            self.phases[phase.group(1)] = float(phase.group(2))
        checkpoints = self.phases.pop("checkpoint", 0.0)
        self.seconds = float(last.group(5)) - checkpoints
        memory = re.findall(r"Peak memory of a rank, MB:.* largest (\d+)", log)
        self.peak_memory = float(memory[-1]) * 2**20
        self.elapsed = elapsed

    @property
    def rate(self):
        """Million point-steps per second."""
        return 1e-6 * self.point_steps / self.seconds

    @property
    def ns(self):
        """Nanoseconds per point and step."""
        return 1e9 * self.seconds / self.point_steps

    def ns_of(self, phase):
        """The same of one phase."""
        return 1e9 * self.phases[phase] / self.point_steps


def parameter_file(name):
    """A file of this folder or of prm/."""
    own = os.path.join(HERE, name)
    return own if os.path.exists(own) else os.path.join(ROOT, "prm", name)


Roofline = collections.namedtuple("Roofline", "bandwidth operations")


def cached(build, name, default=None):
    """Value of a variable of CMake's cache."""
    with open(os.path.join(build, "CMakeCache.txt")) as cache:
        found = re.search(rf"^{re.escape(name)}:\w+=(.*)$", cache.read(), re.M)
    if found:
        return found.group(1)
    if default is None:
        sys.exit(f"{build}/CMakeCache.txt has no {name}.")
    return default


def architecture(build):
    """What the sources of a build are compiled for, as -march has it; empty for
    a build for all processors."""
    arch = cached(build, "TALUS_ARCH", "")
    is_native = cached(build, "TALUS_NATIVE", "ON").upper() in ("ON", "1", "TRUE")
    return arch or ("native" if is_native else "")


class Bench:
    """The programs to measure, and a folder to work in."""

    def __init__(self, build, folder, repeat):
        self.talus_program = os.path.join(build, "talus")
        self.benchmark_program = os.path.join(
            build, "tests", "benchmark", "talus-benchmark"
        )
        self.folder = folder
        self.repeat = repeat
        self.build = build
        self.compiler = cached(build, "CMAKE_CXX_COMPILER")
        self.march = architecture(build)
        self.yardstick_program = self.compile_yardstick()
        self.kept = {}

    def talus(
        self, file, settings, ranks=1, folder="run", state=None, build=None
    ):
        """Run a parameter file with what --set would set, with results in
        @p folder. With a @p state, the folder of an earlier run, go on from a
        copy of its last checkpoint. The program is that of another @p build if
        one is given. Returns a Run."""
        output = os.path.join(self.folder, folder)
        shutil.rmtree(output, ignore_errors=True)
        if state:
            shutil.copytree(
                os.path.join(self.folder, state),
                output,
                ignore=shutil.ignore_patterns("*.vtu"),
            )
        command = self.command(file, settings, output, build)
        if state:
            command.append("--resume")
        stdout, elapsed = self.execute(command, ranks)
        with open(os.path.join(output, "log.txt")) as file:
            return Run(stdout, file.read(), elapsed)

    def elapsed(self, file):
        """Run a parameter file; return the seconds of the whole process."""
        return self.execute(
            self.command(file, [], os.path.join(self.folder, "run")), 1
        )[1]

    @staticmethod
    def execute(command, ranks):
        """Run a command on @p ranks; return what it prints, and the seconds."""
        environment = dict(os.environ)
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks)] + command
            # Open MPI wants to be told that root may start it.
            environment["OMPI_ALLOW_RUN_AS_ROOT"] = "1"
            environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
        begin = time.monotonic()
        done = subprocess.run(
            command, env=environment, stdout=subprocess.PIPE, text=True
        )
        elapsed = time.monotonic() - begin
        if done.returncode != 0:
            sys.exit("This run failed: " + " ".join(command))
        return done.stdout, elapsed

    def command(self, file, settings, output, build=None):
        program = os.path.join(build, "talus") if build else self.talus_program
        command = [program, parameter_file(file), "--output", output]
        for setting in settings:
            command += ["--set", setting]
        return command

    def registers(self):
        """What `talus --version` says of its kernels, or nothing."""
        text = subprocess.run(
            [self.talus_program, "--version"], stdout=subprocess.PIPE, text=True
        ).stdout
        found = re.search(r"kernels for .* doubles? per register", text)
        return found.group(0) if found else ""

    def compile_yardstick(self):
        """The program, or None if TALUS_YARDSTICK names no source."""
        source = os.environ.get("TALUS_YARDSTICK", "")
        if not source:
            return None
        if not os.path.exists(source):
            sys.exit(
                f"TALUS_YARDSTICK names '{source}', which does not exist; give "
                "the source of the yardstick, or nothing to go without it."
            )
        program = os.path.join(self.folder, "yardstick")
        # As the program it is compared with; a build for all processors takes
        # what this one has.
        subprocess.run(
            [
                self.compiler, "-O3", "-march=" + (self.march or "native"),
                "-std=c++17", source, "-o", program,
            ],
            check=True,
        )
        return program

    def yardstick_command(self, n_points, steps, dim=2):
        """Variant B with about as many points, four per cell; in 3-D variant 3,
        eight per cell."""
        n_cells = round((n_points / 2**dim) ** (1 / dim))
        variant = "B" if dim == 2 else "3"
        return [self.yardstick_program, variant, str(n_cells), str(steps)]

    def yardstick(self, n_points, steps, dim=2):
        """Its million point-steps per second."""
        output = subprocess.run(
            self.yardstick_command(n_points, steps, dim),
            check=True,
            stdout=subprocess.PIPE,
            text=True,
        ).stdout
        return float(re.search(r"Mps/s\(wall\) (\S+)", output).group(1))

    def talus_benchmark(self, pattern):
        """Counters of the benchmarks whose names match, by name."""
        output = subprocess.run(
            [
                self.benchmark_program,
                "--benchmark_filter=" + pattern,
                "--benchmark_format=json",
            ],
            check=True,
            stdout=subprocess.PIPE,
            text=True,
        ).stdout
        return {run["name"]: run for run in json.loads(output)["benchmarks"]}

    def roofline(self):
        """Bytes and operations per second of the machine, the best of all."""
        if "roofline" not in self.kept:
            runs = [self.talus_benchmark("^roofline") for _ in range(self.repeat)]
            self.kept["roofline"] = Roofline(
                max(r["roofline/triad"]["bytes_per_second"] for r in runs),
                max(
                    r["roofline/multiply-add"]["operations_per_second"]
                    for r in runs
                ),
            )
        return self.kept["roofline"]

    def counted_operations(self):
        """Operations of the formulas that talus-benchmark counts, by name."""
        if "operations" not in self.kept:
            self.kept["operations"] = {
                name.split("/")[1]: run["operations"]
                for name, run in self.talus_benchmark("^operations").items()
            }
        return self.kept["operations"]

    def state(self, name):
        """Run the quick landslide with its default output to a state of
        STATES, once; go_on() continues from there. Returns that Run."""
        if name not in self.kept:
            before = list(STATES)[: list(STATES).index(name)]
            for earlier in before:
                self.state(earlier)
            self.kept[name] = self.talus(
                "landslide-quick.prm",
                [f"End time={STATES[name]}"],
                folder=name,
                state=before[-1] if before else None,
            )
        return self.kept[name]

    def go_on(self, name, seconds):
        """The quick landslide from a state on, statistics every 0.5 s."""
        self.state(name)
        return self.talus(
            "landslide-quick.prm",
            QUIET
            + [
                "Output/Statistics interval=0.5",
                f"End time={STATES[name] + seconds}",
            ],
            state=name,
        )

    def in_turn(self, *runs):
        """Call all @p runs one after the other, as often as is to be repeated:
        what disturbs the machine then disturbs all of them. Returns one list
        for each."""
        results = [[] for _ in runs]
        for _ in range(self.repeat):
            for result, run in zip(results, runs):
                result.append(run())
        return results


def median_ratio(first, second):
    """Median of the ratios of numbers that were measured in turn."""
    return statistics.median(a / b for a, b in zip(first, second))

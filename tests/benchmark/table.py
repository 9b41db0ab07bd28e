#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus reaches of its goals of speed, as ratios within one run.

    tests/benchmark/table.py BUILD [--repeat 5] [--case NAME]... [--write]
                             [--dist BUILD] [--clang BUILD]

BUILD is the build folder of a Release build. Runs that are compared take turns,
so that whatever disturbs the machine disturbs both; the median of the ratios is
printed. Nothing else should run meanwhile. With all cases it takes half an
hour or more. --write puts the rows into doc/performance.md; phases and instructions
are only printed. --dist and --clang name a build for distribution and one by clang, to
compare BUILD with.

The environment variable TALUS_YARDSTICK may name the source of the yardstick, a
program that is called with `B`, or `3` in space, the number of cells along a side
and that of steps, and prints million point-steps per second as `Mps/s(wall) 35.2`.
It is compiled as BUILD is: by its compiler, for the same processor.
"""

import argparse
import os
import statistics
import sys
import tempfile

from counters import counter_table
from features import CASES as FEATURES
from measure import QUIET, ROOT, STATES, Bench, median_ratio
from operations import Operations, phase_table
from report import (
    at_least, at_most, machine, print_table, row, within, without_yardstick,
    write_goals,
)

# Wave speed of the elastic block and of the clay, m/s, and their CFL number.
BLOCK_SPEED, CLAY_SPEED, CFL = 36.69, 84.44, 0.2


def block(bench, file, n_cells, steps, dim=2, more=(), upper=None, build=None):
    """The block of @p n_cells along an axis for about @p steps steps."""
    settings = block_settings(file, n_cells, steps, dim, upper)
    return bench.talus(file, [*settings, *more], build=build)


def block_settings(file, n_cells, steps, dim=2, upper=None):
    h = 1 / n_cells
    speed = CLAY_SPEED if "clay" in file else BLOCK_SPEED
    lower, end = [-3 * h, 0], upper or [1 + 3 * h, 1 + 3 * h]
    if dim == 3:
        lower, end = lower + [-3 * h], end + [1 + 3 * h]
    numbers = lambda values: ",".join(f"{x:.12g}" for x in values)
    return [
        f"Grid/Cell size={h:.12g}",
        "Grid/Lower corner=" + numbers(lower),
        "Grid/Upper corner=" + numbers(end),
        f"End time={steps * CFL * h / speed:.12g}",
    ]


def compare_with_yardstick(bench, what, run, n_points, steps, goal, dim=2):
    if not bench.yardstick_program:
        return without_yardstick(what, goal)
    runs, limits = bench.in_turn(run, lambda: bench.yardstick(n_points, steps, dim))
    ratio = median_ratio([r.rate for r in runs], limits)
    return row(
        what,
        ratio,
        f"{ratio:.3f} ({statistics.median(r.rate for r in runs):.1f} of "
        f"{statistics.median(limits):.1f} million point-steps/s)",
        goal,
    )


def elastic_block(bench):
    for n_cells, steps in ((100, 1280), (200, 320), (400, 120)):
        yield compare_with_yardstick(
            bench,
            f"elastic block, {4 * n_cells**2 // 1000}k points: share of the "
            "yardstick",
            lambda: block(bench, "block.prm", n_cells, steps),
            4 * n_cells**2,
            steps,
            at_least(0.75),
        )


def landslide(bench):
    n_points = bench.state("mid").n_points
    yield compare_with_yardstick(
        bench,
        f"landslide from {STATES['mid']} s on, {n_points} points: share of the "
        "yardstick",
        lambda: bench.go_on("mid", 0.5),
        n_points,
        500,
        at_least(0.5),
    )


def three_dimensions(bench):
    for n_cells, steps in ((16, 200), (22, 80)):
        n_points = 8 * n_cells**3
        yield compare_with_yardstick(
            bench,
            f"3-D block, {n_points // 1000}k points: share of the 3-D yardstick",
            lambda: block(bench, "block-3d.prm", n_cells, steps, 3),
            n_points,
            steps,
            at_least(0.65),
            3,
        )


def herschel_bulkley(bench):
    """The slide of Herschel-Bulkley material over the von Mises one."""
    common = QUIET + ["End time=3", "Splitting/Directions=stretched",
                       "Splitting/Shear=ignored"]
    law = [
        "Materials/clay/Law=Herschel-Bulkley",
        "Materials/clay/Consistency=500",
    ]
    runs = bench.in_turn(
        lambda: bench.talus("landslide-quick.prm", common),
        *[
            lambda n=n: bench.talus(
                "landslide-quick.prm",
                [*common, *law, f"Materials/clay/Flow exponent={n}"],
            )
            for n in (0.5, 0.7)
        ],
    )
    mises, *others = [[r.ns for r in some] for some in runs]
    for n, ns, goal in zip((0.5, 0.7), others, (at_most(1.3), None)):
        ratio = median_ratio(ns, mises)
        yield row(
            f"landslide of Herschel-Bulkley material, n = {n}, over von Mises: "
            "time per point",
            ratio,
            f"{ratio:.3f} ({statistics.median(ns):.0f} and "
            f"{statistics.median(mises):.0f} ns)",
            goal,
        )


def graded_mesh(bench):
    """Half cells at the seabed over uniform ones."""
    common = QUIET + ["End time=2"]
    boxes = "Grid/Refinement boxes=-40,0; 280,0.8; 1"
    graded, uniform = bench.in_turn(
        lambda: bench.talus("landslide-quick.prm", [*common, boxes]),
        lambda: bench.talus("landslide-quick.prm", common),
    )
    rates = [[r.rate for r in runs] for runs in (graded, uniform)]
    ratio = median_ratio(*rates)
    yield row(
        "landslide on half cells at the seabed over uniform ones: point-steps per "
        "second",
        ratio,
        f"{ratio:.3f} ({statistics.median(rates[0]):.1f} and "
        f"{statistics.median(rates[1]):.1f} million point-steps/s)",
        at_least(0.75),
    )


def other_builds(bench):
    """Other ways to compile, of the builds that the options name: the speed of
    one over that of the other, on the elastic block and on the block of clay."""
    for what, other, goal, is_over_given in (
        ("build for distribution over this one", bench.dist, at_least(0.95), True),
        ("this build over one by clang", bench.clang, within(0.9, 1.1), False),
    ):
        if not other:
            continue
        for file, name in (("block.prm", "elastic block"),
                           ("block-of-clay.prm", "block of clay")):
            text = f"{name}, 40k points, {what}: speed"
            theirs, ours = bench.in_turn(
                lambda: block(bench, file, 100, 600, build=other),
                lambda: block(bench, file, 100, 600),
            )
            rates = [[r.rate for r in runs] for runs in (theirs, ours)]
            if not is_over_given:
                rates.reverse()
            ratio = median_ratio(*rates)
            yield row(
                text,
                ratio,
                f"{ratio:.3f} ({statistics.median(rates[0]):.1f} and "
                f"{statistics.median(rates[1]):.1f} million point-steps/s)",
                goal,
            )


def constant_time(bench):
    """From 10 000 to a million points, in so many steps that the output at both
    ends does not count."""
    sizes = ((50, 6000), (158, 600), (500, 60))
    for file, name in (("block.prm", "elastic block"),
                       ("block-of-clay.prm", "block of clay, everything on")):
        runs = bench.in_turn(
            *[lambda n=n, steps=steps: block(bench, file, n, steps)
              for n, steps in sizes]
        )
        spread = statistics.median(
            max(turn) / min(turn)
            for turn in zip(*[[r.ns for r in of_size] for of_size in runs])
        )
        times = ", ".join(
            f"{statistics.median(r.ns for r in of_size):.0f}" for of_size in runs
        )
        yield row(
            f"{name}, 10k, 100k, 1M points: longest time per point over shortest",
            spread,
            f"{spread:.3f} ({times} ns)",
            at_most(1.1),
        )


def fresh_and_late(bench):
    """Runs of the landslide with new points, and with as many that have come a
    long way."""
    if "fresh and late" not in bench.kept:
        n_points = bench.state("late").n_points
        # The slide of 200 m^2 with four points per cell.
        h = (4 * 200 / n_points) ** 0.5
        bench.kept["fresh and late"] = bench.in_turn(
            lambda: bench.talus(
                "landslide-quick.prm",
                QUIET + [f"Grid/Cell size={h:.12g}",
                         f"End time={150 * CFL * h / CLAY_SPEED:.12g}"],
            ),
            lambda: bench.go_on("late", 0.15),
        )
    return bench.kept["fresh and late"]


def wandered(bench):
    fresh, late = fresh_and_late(bench)
    ratio = median_ratio([r.ns for r in late], [r.ns for r in fresh])
    yield row(
        f"landslide after {STATES['late']} s, {late[0].n_points} points, over one "
        f"that begins with {fresh[0].n_points}: time per point",
        ratio,
        f"{ratio:.3f} ({statistics.median(r.ns for r in late):.0f} and "
        f"{statistics.median(r.ns for r in fresh):.0f} ns)",
        at_most(1.15),
    )


def empty_cells(bench):
    """The elastic block of 10 000 cells beside 10 000 and 100 000 empty ones."""
    small, large = bench.in_turn(
        *[lambda x=x: block(bench, "block.prm", 100, 300, upper=[x, 1.03])
          for x in (1.91, 10.65)]
    )
    ratio = median_ratio(
        [r.seconds / r.steps for r in large], [r.seconds / r.steps for r in small]
    )
    occupied = 10000
    yield row(
        f"{large[0].cells - occupied} empty cells over "
        f"{small[0].cells - occupied}: time per step",
        ratio,
        f"{ratio:.3f}",
        at_most(1.05),
    )


def memory(bench):
    """What more points on the same mesh add to the peak."""
    few, many = [
        bench.talus(
            "landslide.prm",
            QUIET + ["End time=0.01", "Splitting/Enabled=false",
                     f"Bodies/slide/Points per cell and axis={n}"],
        )
        for n in (2, 8)
    ]
    each = (many.peak_memory - few.peak_memory) / (many.n_points - few.n_points)
    yield row(
        "memory per point beyond the mesh, 2-D von Mises [bytes]",
        each,
        f"{each:.0f}",
        at_most(400),
    )


def ranks_and_domain(bench):
    """What two ranks gain, and what a domain 100 times as long costs where the
    mesh tracks the soil."""
    settings = QUIET + ["End time=1.5"]
    larger = QUIET + ["Grid/Cell size=0.1", "End time=0.3"]
    one, two, large, larger_one, larger_two = bench.in_turn(
        lambda: bench.talus("landslide.prm", settings),
        lambda: bench.talus("landslide.prm", settings, ranks=2),
        lambda: bench.talus(
            "landslide.prm",
            settings + ["Grid/Upper corner=31960,8", "Grid/Coarsest level=6",
                        "Mesh tracking/Enabled=true"],
        ),
        lambda: bench.talus("landslide.prm", larger),
        lambda: bench.talus("landslide.prm", larger, ranks=2),
    )
    seconds = [[r.seconds for r in runs] for runs in (one, two, large)]
    for single, double in ((one, two), (larger_one, larger_two)):
        times = [[r.seconds for r in runs] for runs in (single, double)]
        gain = median_ratio(*times)
        yield row(
            f"landslide, {single[0].n_points} points, two ranks over one: speed",
            gain,
            f"{gain:.3f} ({statistics.median(times[0]):.1f} and "
            f"{statistics.median(times[1]):.1f} s)",
            at_least(1.9),
        )
    cost = median_ratio(seconds[2], seconds[0])
    memory_ratio = large[0].peak_memory / one[0].peak_memory
    yield row(
        f"landslide in 32 km with mesh tracking, {large[0].cells} cells, over "
        f"320 m, {one[0].cells} cells: time",
        cost,
        f"{cost:.3f}, peak memory {memory_ratio:.2f}",
    )


def start_up(bench):
    (runs,) = bench.in_turn(
        lambda: bench.talus("landslide-quick.prm", ["End time=1e-6"])
    )
    seconds = statistics.median(r.elapsed for r in runs)
    yield row(
        "start of the quick landslide, a step and its output [s]",
        seconds,
        f"{seconds:.2f}",
        at_most(2),
    )


def output(bench):
    mid, late = STATES["mid"], STATES["late"]
    for what, run in (
        (f"quick landslide to {mid} s", bench.state("mid")),
        (f"quick landslide from {mid} to {late} s", bench.state("late")),
        ("3-D landslide", bench.talus("landslide-3d.prm", [])),
    ):
        share = run.phases["output"] / sum(run.phases.values())
        yield row(
            f"{what}: share of output at the default interval [%]",
            100 * share,
            f"{100 * share:.2f}",
            at_most(5),
        )


def phases_of_landslide(bench):
    """Where the time goes, with everything on, in 2-D."""
    (runs,) = bench.in_turn(lambda: bench.go_on("mid", 0.5))
    return phase_table(
        runs,
        *fresh_and_late(bench),
        Operations(bench.counted_operations(), 2),
        bench.roofline(),
    )


def instructions_and_cycles(bench):
    """Of the elastic block and of the landslide, by group of functions."""
    block = block_settings("block.prm", 100, 600)
    slide = QUIET + ["End time=6", "Output/Statistics interval=0.5"]
    return counter_table(
        bench,
        [
            ("elastic block, 40k points", "block.prm", block, (40000, 300)),
            ("quick landslide to 6 s", "landslide-quick.prm", slide, None),
        ],
    )


CASES = {
    "block": elastic_block,
    "landslide": landslide,
    "3d": three_dimensions,
    "herschel-bulkley": herschel_bulkley,
    "graded": graded_mesh,
    "builds": other_builds,
    "constant": constant_time,
    "wandered": wandered,
    "empty": empty_cells,
    "memory": memory,
    "ranks": ranks_and_domain,
    "start": start_up,
    "output": output,
    **FEATURES,
}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", help="folder of a Release build")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument(
        "--case",
        choices=[*CASES, "phases", "instructions"],
        action="append",
        help="only this one; may be repeated",
    )
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--dist", help="folder of a build for distribution")
    parser.add_argument("--clang", help="folder of a build by clang")
    options = parser.parse_args()
    if options.write and options.case:
        sys.exit("--write writes whole tables: leave out --case.")

    with tempfile.TemporaryDirectory(prefix="talus-performance-") as folder:
        bench = Bench(os.path.abspath(options.build), folder, options.repeat)
        bench.dist, bench.clang = [
            build and os.path.abspath(build)
            for build in (options.dist, options.clang)
        ]
        print(machine(bench))
        rows = []
        for name, case in CASES.items():
            if options.case is None or name in options.case:
                for line in case(bench):
                    print_table([line])
                    rows.append(line)
        if options.case is None or "phases" in options.case:
            print_table(phases_of_landslide(bench))
        if options.case is None or "instructions" in options.case:
            counts = instructions_and_cycles(bench)
            print_table([[counts]] if isinstance(counts, str) else counts)
        if options.write:
            write_goals(
                os.path.join(ROOT, "doc", "performance.md"), machine(bench), rows
            )


if __name__ == "__main__":
    main()

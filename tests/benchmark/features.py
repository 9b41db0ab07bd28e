# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of what real slopes need beyond a slide on the bottom of the mesh: maps,
water, a bed of facets, convected domains; the slope in 3-D; strength reduction."""

import statistics

from measure import QUIET, median_ratio
from report import at_least, at_most, row

WATER = [
    "Water/Density=1000",
    "Water/Added mass coefficient=0.1",
    "Water/Skin friction coefficient=0.005",
    "Water/Pressure drag coefficient=0.5",
]


def ratio_of_times(what, runs, others, goal):
    """Row of the time per point of @p runs over that of @p others."""
    times, references = [[r.ns for r in some] for some in (runs, others)]
    ratio = median_ratio(times, references)
    return row(
        f"{what}: time per point",
        ratio,
        f"{ratio:.3f} ({statistics.median(times):.0f} and "
        f"{statistics.median(references):.0f} ns)",
        goal,
    )


def features_of_slide(bench):
    """The quick landslide to 8 s with one more feature at a time."""
    common = QUIET + ["End time=8", "Splitting/Directions=stretched",
                       "Splitting/Shear=ignored"]
    plain, maps, water, bed = bench.in_turn(
        lambda: bench.talus("landslide-quick.prm", common),
        lambda: bench.talus("landslide-quick.prm", [*common, "Maps/Write=true"]),
        lambda: bench.talus("landslide-quick.prm", [*common, *WATER]),
        lambda: bench.talus("landslide-inclined.prm", common),
    )
    for what, runs, goal in (
        ("with maps", maps, at_most(1.08)),
        ("in water", water, at_most(1.08)),
        ("on a bed of facets", bed, at_most(1.1)),
    ):
        yield ratio_of_times(f"landslide {what} over plain", runs, plain, goal)


def convected_domains(bench):
    common = QUIET + ["End time=3"]
    boxes, domains = bench.in_turn(
        *[
            lambda rule=rule: bench.talus(
                "landslide-quick.prm", [*common, f"Transfer/Box rule={rule}"]
            )
            for rule in ("axis-parallel", "convected domain")
        ]
    )
    yield ratio_of_times(
        "landslide, convected domains over boxes", domains, boxes, at_most(2)
    )


def slope_in_3d(bench):
    """The first 20 s of prm/slope-3d.prm."""
    settings = QUIET + ["End time=20"]
    start, one, two = bench.in_turn(
        lambda: bench.talus("slope-3d.prm", QUIET + ["End time=1e-6"]),
        lambda: bench.talus("slope-3d.prm", settings),
        lambda: bench.talus("slope-3d.prm", settings, ranks=2),
    )
    ns = statistics.median(r.ns for r in one)
    yield row(
        f"`slope-3d.prm` to 20 s, {one[0].n_points} points: time per point and "
        "step [ns]",
        ns,
        f"{ns:.0f}",
        at_most(260),
    )
    gain = median_ratio([r.ns for r in one], [r.ns for r in two])
    yield row(
        "the same, two ranks over one: speed",
        gain,
        f"{gain:.3f}",
        at_least(1.85),
    )
    seconds = statistics.median(r.elapsed for r in start)
    yield row(
        "the same, start, a step and its output [s]",
        seconds,
        f"{seconds:.1f}",
        at_most(4),
    )


def strength_reduction(bench):
    """prm/slope-stability.prm, factor of safety of a slope."""
    (seconds,) = bench.in_turn(lambda: bench.elapsed("slope-stability.prm"))
    median = statistics.median(seconds)
    yield row(
        "`slope-stability.prm`, factor of safety [s]",
        median,
        f"{median:.1f}",
        at_most(15),
    )


CASES = {
    "features": features_of_slide,
    "convected": convected_domains,
    "slope-3d": slope_in_3d,
    "strength-reduction": strength_reduction,
}

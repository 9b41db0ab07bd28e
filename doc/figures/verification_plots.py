# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the verification, from the series that the tests write."""

import csv
import os

from talus_output import EXACT, SPLIT, UNSPLIT, numpy, plt

# Files convergence-NAME.csv: legend and style.
CONVERGENCE = [
    ("linear-bar", "bar of the paper, v_cm / v0", SPLIT, "-"),
    ("bar", "1-D", "#3a8f5c", "-"),
    ("bar-split", "1-D, points split", "#3a8f5c", "--"),
    ("2-D", "2-D", "#8a5aa8", "-"),
    ("3-D", "3-D", "#b8860b", "-"),
    ("vortex", "vortex", UNSPLIT, "-"),
    ("vortex-split", "vortex, points split", UNSPLIT, "--"),
    ("bar-fixed-boxes", "1-D, fixed boxes", EXACT, ":"),
    ("2-D-fixed-boxes", "2-D, fixed boxes", EXACT, "-."),
]


def read(path):
    """Columns of a CSV file by name; None if no test wrote it."""
    if not os.path.exists(path):
        return None
    with open(path, newline="") as stream:
        rows = list(csv.reader(stream))
    values = numpy.array([[float(x or "nan") for x in row] for row in rows[1:]])
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def series(folder, name):
    return read(os.path.join(folder, name + ".csv"))


def save(figure, folder, name):
    # No date or version in the file: the same data give the same bytes.
    figure.savefig(os.path.join(folder, name), metadata={"Software": None})
    plt.close(figure)
    return name


def convergence(source, target):
    figure, axes = plt.subplots(figsize=(5.2, 3.6), constrained_layout=True)
    for name, label, color, dash in CONVERGENCE:
        table = series(source, "convergence-" + name)
        if table:
            axes.loglog(table["cells"], table["error"], dash, color=color,
                        marker="o", markersize=3, label=label)
    n = numpy.array([20., 60.])
    for order, level in ((1, 2e-4), (2, 1.2e-4)):
        axes.loglog(n, level * (n[0] / n)**order, color="black", linewidth=0.7)
        axes.text(n[1] * 1.03, level * (n[0] / n[1])**order,
                  "order %d" % order, va="center")
    axes.set_xlabel("cells along the body (vortex: along the mesh)")
    axes.set_title("error of the displacement [m], of v_cm / v0 [-]")
    axes.grid(linewidth=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return save(figure, target, "verification-convergence.png")


def bar(source, target):
    table = series(source, "bar")
    figure, axes = plt.subplots(figsize=(5.2, 2.2), constrained_layout=True)
    axes.plot(table["time [s]"], table["closed form"], color=EXACT,
              linewidth=2.5, alpha=0.4, label="closed form")
    axes.plot(table["time [s]"], table["talus"], color=SPLIT, label="talus, "
              "with splits")
    axes.set_title("bar of the paper: velocity of the centre of mass [m/s]")
    axes.set_xlabel("time [s]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return save(figure, target, "verification-bar.png")


def profiles(source, target, panels, name):
    """Lines against closed forms; each panel is (title, x label, [series])
    of series with the columns height, talus, closed form."""
    panels = [(title, label, [(n, s) for n, s in
                              ((n, series(source, f)) for n, f in lines) if s])
              for title, label, lines in panels]
    panels = [panel for panel in panels if panel[2]]
    if not panels:
        return None
    figure, axes = plt.subplots(1, len(panels), squeeze=False,
                                figsize=(2.9 * len(panels), 2.8),
                                constrained_layout=True)
    for a, (title, label, lines) in zip(axes[0], panels):
        for (legend, table), color in zip(lines, (SPLIT, UNSPLIT, "#3a8f5c")):
            a.plot(table["closed form"], table["height"], color=EXACT,
                   linewidth=2.5, alpha=0.4)
            a.plot(table["talus"], table["height"], ".", color=color,
                   markersize=3.5, label=legend)
        a.set_title(title)
        a.set_xlabel(label)
        a.set_ylim(bottom=0)
        a.grid(linewidth=0.3)
        a.legend(loc="upper left" if len(lines) > 1 else "best")
    axes[0][0].set_ylabel("height [m]")
    return save(figure, target, name)


def vertical_cut(source, target):
    """Settlement of the crest over the load; grey: bounds of the critical one."""
    tables = [(n, series(source, "vertical-cut-%d" % n)) for n in (8, 16, 32)]
    tables = [(n, table) for n, table in tables if table]
    if not tables:
        return None
    figure, axes = plt.subplots(figsize=(5.2, 2.6), constrained_layout=True)
    axes.axvspan(3.776, 3.83, color=EXACT, alpha=0.4, linewidth=0)
    for (n, table), color in zip(tables, (SPLIT, UNSPLIT, "#3a8f5c")):
        axes.semilogy(table["gamma H / s_u"],
                      table["final crest settlement / H"], "o-", color=color,
                      markersize=3.5, label="cells of H / %d" % n)
    axes.set_title("vertical cut: final settlement of the crest / H")
    axes.set_xlabel("gamma H / s_u")
    axes.grid(linewidth=0.3)
    axes.legend(loc="upper left")
    return save(figure, target, "verification-cut.png")


def deposits(results, target):
    """Height of the soil in the last rows of profile.csv."""
    is_empty = True
    figure, axes = plt.subplots(figsize=(7.8, 1.9), constrained_layout=True)
    for label, name, color, dash in (
            ("h = 0.2 m", "landslide-full", SPLIT, "-"),
            ("h = 0.4 m", "landslide-stretched", "#3a8f5c", "--"),
            ("h = 0.4 m, unsplit", "landslide-unsplit", UNSPLIT, "-")):
        table = read(os.path.join(results, name, "profile.csv"))
        if table:
            is_empty = False
            last = table["time [s]"] == table["time [s]"][-1]
            axes.plot(table["x [m]"][last], table["highest [m]"][last], dash,
                      color=color, label=label)
    if is_empty:
        plt.close(figure)
        return None
    axes.set_title("landslide of the paper at rest: height of the soil [m]")
    axes.set_xlabel("x [m]")
    axes.set_ylim(0, 2.6)
    axes.legend(loc="upper right", ncol=3)
    axes.grid(linewidth=0.3)
    return save(figure, target, "verification-deposits.png")


def draw_all(source, target):
    """Draw the pictures of the verification from the series in the folder
    @p source, into the folder @p target."""
    bar(source, target)
    convergence(source, target)
    profiles(source, target,
             [("vertical stress [kPa]", "kPa",
               [("16 cells", "column-16"), ("64 cells", "column-64")])],
             "verification-column.png")
    profiles(source, target,
             [("velocity down the slope", "m/s",
               [("Bingham", "layer-bingham"),
                ("Herschel-Bulkley, n = 0.5", "layer-herschel-bulkley")]),
              ("shear stress", "Pa",
               [("layer on a capped seabed", "shear-layer")])],
             "verification-layers.png")
    vertical_cut(source, target)
    deposits(os.path.join(source, "..", ".."), target)

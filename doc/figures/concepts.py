# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the sketches of doc/method.md: points and blocks, boxes and convected
domains, sheared cells, facets, splits and merges, the free surface.

    /usr/bin/python3 concepts.py [FOLDER]

Needs no run of talus. The sketches are computed by the formulas of the page; FOLDER is
doc/figures by default.
"""

import os
import sys

import numpy

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Polygon, Rectangle

plt.rcParams.update({
    "font.size": 8.5,
    "axes.titlesize": 8.5,
    "axes.titlelocation": "left",
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    # The same input gives the same bytes.
    "svg.hashsalt": "talus",
})

SOIL, BED, MARK, ARROW = "#c9a66b", "#8c8c8c", "#1f5fa8", "#c8442b"
GRID = dict(color="#9a9a9a", linewidth=0.6)


def draw_grid(axes, lower, upper, step=1.0):
    """Faces of square cells."""
    for x in numpy.arange(lower[0], upper[0] + step / 2, step):
        axes.plot([x, x], [lower[1], upper[1]], zorder=0, **GRID)
    for y in numpy.arange(lower[1], upper[1] + step / 2, step):
        axes.plot([lower[0], upper[0]], [y, y], zorder=0, **GRID)


def bare(axes, title):
    axes.set_title(title)
    axes.set_aspect("equal")
    axes.axis("off")


def box(axes, centre, lengths, **style):
    style = {"facecolor": SOIL, "edgecolor": "black", "linewidth": 0.7,
             "alpha": 0.75, **style}
    axes.add_patch(Rectangle(numpy.subtract(centre, numpy.divide(lengths, 2)),
                             *lengths, **style))


def arrow(axes, tail, tip, color=ARROW, style="-|>", width=1.1):
    axes.annotate("", xy=tip, xytext=tail, zorder=5,
                  arrowprops=dict(arrowstyle=style, color=color,
                                  linewidth=width, shrinkA=0, shrinkB=0))


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name), bbox_inches="tight",
                   metadata={"Date": None})
    plt.close(figure)


def bracket(axes, begin, end, y, text, color):
    """A bracket under the entries [begin, end) of an array, with a text."""
    a, b = begin + 0.08, end - 0.08
    axes.plot([a, a, b, b], [y + 0.22, y, y, y + 0.22], color=color)
    axes.text((a + b) / 2, y - 0.12, text, ha="center", va="top", color=color)


def points_and_blocks(folder):
    """How points lie in memory."""
    figure, (mesh, memory) = plt.subplots(
        2, 1, figsize=(7.6, 4.4), height_ratios=[2.1, 1.6])
    bare(mesh, "Points in cells, numbered along p4est's curve")
    draw_grid(mesh, (0, 0), (4, 2))
    curve = [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (3, 0), (2, 1), (3, 1)]
    numbers = [4, 4, 2, 3, 4, 2, 2, 1]  # of points, by cell
    places = numpy.array([(0.3, 0.26), (0.7, 0.24), (0.28, 0.62), (0.72, 0.64)])
    n = 0
    cell_of_point = []
    for c, (cell, count) in enumerate(zip(curve, numbers)):
        mesh.text(cell[0] + 0.04, cell[1] + 0.96, "cell %d" % c, color=BED,
                  ha="left", va="top", fontsize=7)
        for k in range(count):
            x = numpy.add(cell, places[k])
            mesh.plot(*x, "o", color=SOIL, markeredgecolor="black",
                      markersize=11)
            mesh.text(*x, n, ha="center", va="center", fontsize=6.5)
            cell_of_point.append(c)
            n += 1
    centres = numpy.array(curve) + 0.5
    mesh.plot(*centres.T, "-", color=MARK, linewidth=0.8, alpha=0.45, zorder=0)

    memory.set_xlim(-3.6, n + 0.2)
    memory.set_ylim(-3.6, 1.5)
    memory.axis("off")
    memory.set_title("The same points in the columns of memory, of which two "
                     "are drawn")
    for row, name in enumerate(("mass", "position x")):
        memory.text(-0.2, row * 0.7 + 0.3, name, ha="right", va="center")
        for p in range(n):
            memory.add_patch(Rectangle(
                (p, row * 0.7), 1, 0.6, edgecolor="black", linewidth=0.5,
                facecolor=(SOIL if cell_of_point[p] % 2 == 0 else "#ead9bb")))
            memory.text(p + 0.5, row * 0.7 + 0.3, p, ha="center", va="center",
                        fontsize=6.5)
    begin = 0
    memory.text(-0.2, -0.5, "segments", ha="right", va="center")
    for c, count in enumerate(numbers):
        bracket(memory, begin, begin + count, -0.45, "%d" % c, "black")
        begin += count
    memory.text(-0.2, -1.6, "blocks", ha="right", va="center", color=MARK)
    bracket(memory, 0, 8, -1.55, "8 points", MARK)
    bracket(memory, 8, 16, -1.55, "8 points", MARK)
    bracket(memory, 16, 17, -1.55, "1", MARK)
    bracket(memory, 17, n, -1.55, "5 points", MARK)
    memory.text(-0.2, -2.7, "batches", ha="right", va="center", color=ARROW)
    bracket(memory, 0, 17, -2.65, "batch: whole cells", ARROW)
    bracket(memory, 17, n, -2.65, "the next batch", ARROW)
    save(figure, folder, "method-points.svg")


def lengths_of_rows(F):
    """Lengths of the box with the second moments of the cell of edges F."""
    return numpy.sqrt(numpy.diag(F @ F.T))


def cell(axes, centre, A, **style):
    """A parallelogram with the columns of A as edges."""
    axes.add_patch(Polygon(
        [centre + A @ corner / 2
         for corner in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
        **{"edgecolor": "black", "linewidth": 0.7, **style}))


def boxes_and_domains(folder):
    """A patch of four cells after shear and after a rotation."""
    angle = numpy.radians(30)
    deformations = [
        ("undeformed", numpy.eye(2)),
        ("simple shear, $\\gamma$ = 0.8", numpy.array([[1, 0.8], [0, 1]])),
        ("stretch by 1.5, then turned by 30°",
         numpy.array([[numpy.cos(angle), -numpy.sin(angle)],
                      [numpy.sin(angle), numpy.cos(angle)]])
         @ numpy.diag([1.5, 1 / 1.5]))]
    grid = (numpy.arange(4) + 0.5) / 2
    X = numpy.array([(x, y) for y in grid for x in grid])
    L = 0.5
    figure, rows = plt.subplots(2, 3, figsize=(7.6, 4.6),
                                constrained_layout=True)
    for column, (title, F) in enumerate(deformations):
        x = (X - 1) @ F.T
        limits = [(-1.9, 1.9), (-1.45, 1.45)]
        for row in (0, 1):
            axes = rows[row, column]
            bare(axes, title if row == 0 else "")
            draw_grid(axes, (-2, -1), (2, 1))
            axes.set_xlim(*limits[0])
            axes.set_ylim(*limits[1])
            for k, place in enumerate(x):
                style = dict(facecolor=ARROW if k == 5 else SOIL, alpha=0.5,
                             edgecolor="black", linewidth=0.7)
                if row == 0:
                    box(axes, place, lengths_of_rows(F) * L, **style)
                else:
                    cell(axes, place, F * L, **style)
            axes.plot(*x.T, "k.", markersize=2.5)
    rows[0, 0].text(-1.9, 1.3, "boxes (second moments)", color=MARK)
    rows[1, 0].text(-1.9, 1.3, "convected domains", color=MARK)
    save(figure, folder, "method-boxes.svg")


def reduced_cells(folder):
    """A sheared cell, the reduced cell of the same lattice, and its box."""
    A = numpy.array([[1.0, 1.7], [0.0, 0.8]])
    B = A.copy()
    B[:, 1] -= round(A[:, 0] @ A[:, 1] / (A[:, 0] @ A[:, 0])) * A[:, 0]
    figure, axes = plt.subplots(1, 2, figsize=(7.6, 2.5),
                                constrained_layout=True)
    for panel, title in zip(axes, ("(a) sheared cell and reduced cell",
                                   "(b) box with the same second moments")):
        bare(panel, title)
        panel.set_xlim(-2.3, 2.3)
        panel.set_ylim(-1.25, 1.25)
        places = numpy.array([A @ (i, j) for i in range(-6, 7)
                              for j in (-1, 0, 1)])
        panel.plot(*places.T, "k.", markersize=3)
    cell(axes[0], numpy.zeros(2), A, facecolor="none", edgecolor=ARROW,
         linestyle="--", linewidth=1.3, zorder=4)
    for place in (numpy.zeros(2), B[:, 0], -B[:, 0], B[:, 1], -B[:, 1]):
        cell(axes[0], place, B, alpha=0.6,
             facecolor=SOIL if not place.any() else "#ead9bb")
    corner = -A.sum(axis=1) / 2
    arrow(axes[0], corner, corner + A[:, 1])
    axes[0].text(*(corner + 0.3 * A[:, 1] + (0.12, -0.06)), "$a_2$",
                 color=ARROW)
    corner = -B.sum(axis=1) / 2
    arrow(axes[0], corner, corner + B[:, 1], color=MARK)
    axes[0].text(*(corner + B[:, 1] + (0.1, 0.12)), "$a_2 - 2 a_1$",
                 color=MARK)
    cell(axes[1], numpy.zeros(2), B, facecolor=SOIL, alpha=0.6)
    box(axes[1], (0, 0), lengths_of_rows(B), facecolor="none",
        edgecolor=MARK, linewidth=1.3, alpha=1)
    save(figure, folder, "method-lattice.svg")


def facets(folder):
    """Facets of a bed, gap, and the share of a facet that soil covers."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.3),
                                         constrained_layout=True)
    slope = 0.3

    def bed(x):
        return 0.45 + slope * x

    bare(left, "(a) One facet per cell that the surface cuts")
    draw_grid(left, (0, 0), (3, 2))
    left.fill_between([0, 3], 0, [bed(0), bed(3)], color=BED, alpha=0.45,
                      linewidth=0)
    left.plot([0, 3], [bed(0), bed(3)], color="black")
    normal = numpy.array([-slope, 1]) / numpy.hypot(slope, 1)
    # Where the surface crosses faces of cells.
    crossings = sorted({0., 1., 2., 3., (1 - 0.45) / slope})
    for a, b in zip(crossings, crossings[1:]):
        centre = numpy.array([(a + b) / 2, bed((a + b) / 2)])
        left.plot([a, b], [bed(a), bed(b)], color=MARK, linewidth=3,
                  solid_capstyle="butt")
        left.plot(a, bed(a), "|", color="black", markersize=8)
        left.plot(*centre, "o", color=MARK, markersize=4, zorder=6)
        arrow(left, centre, centre + 0.34 * normal, color=MARK)
    left.text(0.46, bed(0.5) + 0.30, "$n_c$", color=MARK, ha="left")
    left.text(0.52, bed(0.5) - 0.19, "$x_c$", color=MARK)
    left.text(2.2, 0.35, "obstacle")
    lengths = numpy.array([0.44, 0.40])
    centre = numpy.array([2.66, 1.78])
    box(left, centre, lengths)
    left.plot(*centre, "k.")
    # The corner that is nearest to the surface, and its distance.
    reach = 0.5 * lengths @ numpy.abs(normal)
    foot = centre - normal * ((centre[1] - bed(centre[0])) * normal[1])
    side = foot + normal * ((centre - foot) @ normal - reach)
    arrow(left, foot, side, style="<|-|>")
    tangent = numpy.array([normal[1], -normal[0]])
    left.plot(*numpy.array([side - 0.45 * tangent, side + 0.5 * tangent]).T,
              "--", color=ARROW, linewidth=0.8)
    left.text(*(0.5 * (foot + side) + [0.06, 0.02]), "gap", color=ARROW,
              ha="left", va="center")

    bare(right, "(b) Area in contact, in the enlarged first cell")
    draw_grid(right, (0, 0), (1, 1))
    right.set_xlim(-0.06, 1.62)
    right.set_ylim(-0.12, 1.06)
    right.fill_between([0, 1], 0, [bed(0), bed(1)], color=BED, alpha=0.45,
                       linewidth=0)
    right.plot([0, 1], [bed(0), bed(1)], color=MARK, linewidth=3,
               solid_capstyle="butt")
    boxes = [(numpy.array([0.125, 0.615]), numpy.array([0.24, 0.16])),
             (numpy.array([0.635, 0.76]), numpy.array([0.25, 0.16]))]
    for place, size in boxes:
        box(right, place, size)
    for i in range(4):
        x = (i + 0.5) / 4
        y = bed(x)
        # A sample under a box, or between the ends of two boxes near by.
        under = any(abs(x - place[0]) <= size[0] / 2 and
                    place[1] - size[1] / 2 - y <= 0.25 for place, size in boxes)
        ends = [[abs(x - (place[0] + s * size[0] / 2)) <= 0.25
                 and s * (x - place[0]) > 0 for place, size in boxes]
                for s in (1, -1)]
        covered = under or all(any(side) for side in ends)
        right.plot([x, x], [0, 1], ":", color="black", linewidth=0.5)
        right.plot(x, y, "o", markersize=7, zorder=6, markeredgecolor="black",
                   color=ARROW if covered else "white")
    for i, (color, text) in enumerate((
            (ARROW, "covered sample:\nunder a box, or\nbetween two boxes"),
            ("white", "sample without\nsoil above"))):
        right.plot(1.10, 0.82 - 0.42 * i, "o", color=color, markersize=7,
                   markeredgecolor="black")
        right.text(1.16, 0.82 - 0.42 * i, text, va="center")
    save(figure, folder, "method-facets.svg")


def split_and_merge(folder):
    """Children that tile their parent, and two points that become one."""
    figure, axes = plt.subplots(1, 4, figsize=(7.6, 2.3),
                                constrained_layout=True)
    for a, title in zip(axes, ("stretched point", "split: longest edge",
                               "split: all edges", "merged pair")):
        bare(a, title)
        a.set_xlim(-0.75, 0.75)
        a.set_ylim(-0.62, 0.55)
    lx, ly = 1.2, 0.5
    box(axes[0], (0, 0), (lx, ly))
    axes[0].plot(0, 0, "k.")
    arrow(axes[0], (-lx / 2, -0.36), (lx / 2, -0.36), color="black",
          style="<|-|>", width=0.7)
    axes[0].text(0, -0.41, "$|a_1|$, $|F e_1| > \\beta\\,|F e_1|_0$",
                 ha="center", va="top")
    for s in (-1, 1):
        box(axes[1], (s * lx / 4, 0), (lx / 2, ly))
        axes[1].plot(s * lx / 4, 0, "k.")
        for t in (-1, 1):
            box(axes[2], (s * lx / 4, t * ly / 4), (lx / 2, ly / 2))
            axes[2].plot(s * lx / 4, t * ly / 4, "k.")
    arrow(axes[1], (0, -0.36), (lx / 4, -0.36), color="black", style="<|-|>",
          width=0.7)
    axes[1].text(lx / 8, -0.41, "$a_1/4$", ha="center", va="top")
    # Two boxes that have become thinner, and their joint box by the formula.
    centres = numpy.array([(-0.16, 0.02), (0.17, -0.02)])
    lengths = numpy.array([(0.30, 0.62), (0.34, 0.60)])
    volumes = lengths.prod(axis=1)
    w = volumes / volumes.sum()
    d = centres[1] - centres[0]
    joint = numpy.sqrt(w @ lengths**2 + 12 * w.prod() * d**2)
    joint *= numpy.sqrt(volumes.sum() / joint.prod())
    for place, size in zip(centres, lengths):
        box(axes[3], place, size)
        axes[3].plot(*place, "k.")
    box(axes[3], w @ centres, joint, facecolor="none", edgecolor=ARROW,
        linestyle="--", linewidth=1.3, alpha=1)
    axes[3].plot(*(w @ centres), "x", color=ARROW)
    axes[3].text(0, -0.41, "joint cell", color=ARROW, ha="center", va="top")
    save(figure, folder, "method-split.svg")


def free_surface(folder):
    """Vector areas of cells, from the volume fraction at the nodes."""
    n, m = 12, 5  # cells
    S = numpy.zeros((n + 1, m + 1))
    half = 0.25

    def hat_mean(a, b, i):
        """Mean of the hat of node i over [a, b], by its integral."""
        def integral(x):
            x = numpy.clip(x - i, -1, 1)
            return 0.5 + x - 0.5 * x * abs(x)
        return (integral(b) - integral(a)) / (b - a)

    def height(x):
        return 2.6 * max(0., 1 - (max(0., x - 3.) / 6.5)**2)

    boxes = []
    for i in range(2 * n):
        x = 0.25 + 0.5 * i
        top = height(x)
        k = 0
        while k * 0.5 < top - 0.05:
            b = min(0.5, top - k * 0.5)
            boxes.append((x, k * 0.5 + b / 2, 0.5, b))
            k += 1
    for x, y, a, b in boxes:
        for i in range(max(0, int(x) - 1), min(n, int(x) + 2) + 1):
            for j in range(max(0, int(y) - 1), min(m, int(y) + 2) + 1):
                S[i, j] += a * b * (hat_mean(x - a / 2, x + a / 2, i)
                                    * hat_mean(y - b / 2, y + b / 2, j))
    volume = numpy.ones_like(S)
    volume[[0, -1], :] *= 0.5
    volume[:, [0, -1]] *= 0.5
    s = numpy.minimum(1, S / volume)
    figure, axes = plt.subplots(figsize=(7.6, 3.3), constrained_layout=True)
    bare(axes, "Volume fraction $s$ of soil (shaded), boxes of the points, "
         "vector areas of the cells (arrows)")
    x = numpy.linspace(0, n, 12 * n + 1)
    y = numpy.linspace(0, m, 12 * m + 1)
    i, j = (numpy.minimum(v.astype(int), k - 1) for v, k in ((x, n), (y, m)))
    u, v = (x - i)[:, None], (y - j)[None, :]
    field = ((1 - u) * (1 - v) * s[numpy.ix_(i, j)]
             + u * (1 - v) * s[numpy.ix_(i + 1, j)]
             + (1 - u) * v * s[numpy.ix_(i, j + 1)]
             + u * v * s[numpy.ix_(i + 1, j + 1)])
    picture = axes.pcolormesh(x, y, field.T, cmap="YlOrBr", shading="nearest",
                              vmin=0, vmax=1.5, rasterized=True, zorder=-1)
    picture.set_clim(0, 1.5)
    draw_grid(axes, (0, 0), (n, m))
    for bx, by, a, b in boxes:
        box(axes, (bx, by), (a, b), facecolor="none", linewidth=0.4, alpha=0.6)
    for i in range(n):
        for j in range(m):
            # The integral of -grad s over the cell, and c - s at the bottom.
            A = -numpy.array([s[i + 1, j:j + 2].mean() - s[i, j:j + 2].mean(),
                              s[i:i + 2, j + 1].mean() - s[i:i + 2, j].mean()])
            if j == 0:
                covered = float(height(i + 0.5) > 0)
                A[1] += covered - s[i:i + 2, 0].mean()
            if numpy.linalg.norm(A) > 0.04:
                centre = numpy.array([i + 0.5, j + 0.5])
                arrow(axes, centre, centre + 0.9 * A, color=MARK)
    axes.fill_between([0, n], [-0.35, -0.35], 0, color=BED, alpha=0.45,
                      linewidth=0)
    axes.text(0.1, -0.19, "seabed", va="center")
    save(figure, folder, "method-surface.svg")


if __name__ == "__main__":
    folder = (sys.argv[1] if len(sys.argv) > 1
              else os.path.dirname(os.path.abspath(__file__)))
    for draw in (points_and_blocks, boxes_and_domains, reduced_cells, facets,
                 split_and_merge, free_surface):
        draw(folder)

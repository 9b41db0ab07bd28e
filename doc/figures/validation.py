# SPDX-License-Identifier: LGPL-2.1-or-later
"""Experiments in the laboratory beside talus and theory, for doc/validation.md.

    python3 validation.py PICTURE.png FOLDER

FOLDER has the runs of make.sh: syrup, syrup-channel, beads, spreading, cylinder-BASE-STRESS,
cone-STRESS and gum.
"""

import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talus_output import EXACT, SPLIT, UNSPLIT, plt, save, statistics

PRM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "prm", "validation")
FRONT = "front of 99.5 % mass x [m]"
G = 9.81


def measured(name):
    """Times [s] and fronts [m]."""
    return numpy.loadtxt(os.path.join(PRM, name + ".csv"), delimiter=",", skiprows=1).T


def lubrication(height, length, weight, consistency, n, times, dx=0.002):
    """Front [m] beyond the gate by lubrication theory, explicit in time; see
    tests/cases/validation.cc."""
    h = numpy.zeros(round(4 * length / dx))
    h[:round(length / dx)] = height
    factor = n / (2 * n + 1) * (weight / consistency)**(1 / n)
    now, fronts = 0., []
    for time in times:
        while now < time:
            wet = slice(0, numpy.count_nonzero(h) + 1)
            fall = -numpy.diff(h[wet]) / dx
            slope = numpy.maximum(abs(fall), 1e-300)
            conductance = (factor * slope**(1 / n - 1)
                           * (0.5 * (h[wet][1:] + h[wet][:-1]))**(2 + 1 / n))
            dt = min(0.4 * dx * dx * min(n, 1) / conductance.max(), time - now)
            flow = conductance * fall * dt / dx
            h[wet][:-1] -= flow
            h[wet][1:] += flow
            now += dt
        i = numpy.flatnonzero(h > 0.01 * height)[-1]
        fronts.append((i + 0.5 + (h[i] - 0.01 * height) / (h[i] - h[i + 1])) * dx - length)
    return fronts


def slump(height, top, bottom, weight, stress, k):
    """Slump of a frustum: layers flow out until k times the yield stress carries what is above."""
    z = (numpy.arange(2000) + 0.5) * height / 2000
    r = top + (bottom - top) * z / height
    pressure = weight * z * (r**2 + r * top + top**2) / (3 * r**2)
    return numpy.maximum(0, 1 - k * stress / pressure).mean() * height


def final_height(folder):
    """Height at the end [m]."""
    return statistics(folder)["height [m]"][-1]


def draw_syrup(axes, scratch):
    times, fronts = measured("syrup-dam-break")
    axes.plot(times, fronts, ".", color="black", markersize=3, label="measured")
    at = [0.1, 0.3, 0.6, 1, 2, 3, 5, 7, 10, 15, 20]
    axes.plot(at, lubrication(0.0443, 0.2, 1540 * G, 9.712, 0.979, at), "--", color=EXACT,
              label="lubrication theory")
    for name, color, label in (("syrup", SPLIT, "plane strain"),
                               ("syrup-channel", "#3a8f5c", "channel, 3-D")):
        table = statistics(os.path.join(scratch, name))
        time, front = table["time [s]"], table[FRONT] - 0.2
        axes.plot(time, front, color=color, label=f"talus, {label}")
        if name == "syrup":
            axes.plot(1.51 * time, front, ":", color=color, label="1.51 times as viscous")
    axes.set(xlim=(0, 22), ylim=(0, 0.36), xlabel="time [s]",
             title="(a) syrup with glass beads: front [m]")


def draw_beads(axes, scratch):
    times, fronts = measured("bead-dam-break")
    axes.plot(times, fronts, ".", color="black", markersize=3, label="measured")
    table = statistics(os.path.join(scratch, "beads"))
    axes.plot(table["time [s]"], table[FRONT] - 0.2, color=SPLIT, label="talus, 99.5 % of the mass")
    axes.plot(table["time [s]"], table["front x [m]"] - 0.2, color=SPLIT, linewidth=0.6,
              label="talus, outermost point")
    axes.set(xlim=(0, 25), ylim=(0, 0.6), xlabel="time [s]",
             title="(b) syrup with plastic beads: front [m]")


def draw_spreading(axes, scratch):
    table = statistics(os.path.join(scratch, "spreading"))
    time = table["time [s]"]
    volume = 4 * table["mass [kg]"][0] / 970
    with numpy.errstate(divide="ignore"):
        axes.plot(time, 0.894 * (G * volume**3 / (3 * 50 / 970) * time)**0.125, "--", color=EXACT,
                  label="Huppert (1982)")
    axes.plot(time, table["front x [m]"], color=SPLIT, label="talus")
    axes.set(xlim=(0, 10), ylim=(0.04, 0.12), xlabel="time [s]", title="(c) oil on a plate: radius [m]")


def draw_cylinder(axes, scratch):
    stress = numpy.linspace(0.01, 0.35, 60)
    for k, color, name in ((2, EXACT, "Tresca"), (3**0.5, "black", "von Mises")):
        axes.plot(stress, [slump(1, 0.5, 0.5, 1, s, k) for s in stress], "--", color=color,
                  label=f"theory, {name}")
    for base, color, label in (("fixed", SPLIT, "rough base"), ("roller", UNSPLIT, "smooth base")):
        shares = [s for s in ("0.05", "0.10", "0.20")
                  if os.path.isdir(os.path.join(scratch, f"cylinder-{base}-{s}"))]
        axes.plot([float(s) for s in shares],
                  [1 - final_height(os.path.join(scratch, f"cylinder-{base}-{s}")) / 0.1
                   for s in shares], "o", color=color, markersize=4, label=f"talus, {label}")
    axes.set(xlim=(0, 0.35), ylim=(0, 1), xlabel=r"yield stress over $\rho g H$",
             title="(d) cylinder: slump over height")


def draw_cone(axes, scratch):
    stress = numpy.linspace(100, 2500, 60)
    axes.plot(stress, [100 * slump(0.3, 0.05, 0.1, 2400 * G, s, 3**0.5) for s in stress], "--",
              color="black", label="theory, von Mises")
    cm = numpy.linspace(2, 28, 2)
    axes.plot(2400 * (30 - cm) / 34.7 + 212, cm, ":", color=EXACT, label="Ferraris and de Larrard")
    axes.plot(2400 * (30 - cm) / 27, cm, "-.", color=EXACT, label="Hu")
    at = (500, 1000, 1500)
    axes.plot(at, [30 - 100 * final_height(os.path.join(scratch, f"cone-{s}")) for s in at], "o",
              color=SPLIT, markersize=4, label="talus")
    axes.set(xlim=(0, 2500), ylim=(0, 30), xlabel="yield stress [Pa]",
             title="(e) Abrams' cone: slump [cm]")


def draw_gum(axes, scratch):
    axes.loglog(*measured("xanthan-gum"), ".", color="black", markersize=3, label="measured")
    times = numpy.array([3, 746])
    axes.plot(times, 0.01507 * times**(13.8 / 32.5), "--", color=EXACT, label="lubrication theory")
    table = statistics(os.path.join(scratch, "gum"))
    # The gum at the start entered before.
    time = table["time [s]"] + 4 * table["mass [kg]"][0] / 3.8173e-3
    axes.plot(time, 0.5 * (table["front x [m]"] + table["front z [m]"]), color=SPLIT, label="talus")
    for axis, ticks in ((axes.xaxis, (3, 10, 30, 100, 300)), (axes.yaxis, (0.02, 0.05, 0.1, 0.2))):
        axis.set_ticks(ticks, labels=[str(tick) for tick in ticks])
        axis.set_ticks([], minor=True)
    axes.set(xlim=(2, 800), ylim=(0.015, 0.3), xlabel="time [s]",
             title="(f) xanthan gum from a tube: radius [m]")


def main(picture, scratch):
    """Draw all panels."""
    figure, axes = plt.subplots(2, 3, figsize=(9.6, 5.6), constrained_layout=True)
    panels = (draw_syrup, draw_beads, draw_spreading, draw_cylinder, draw_cone, draw_gum)
    for draw, panel in zip(panels, axes.flat):
        draw(panel, scratch)
        panel.grid(linewidth=0.3)
        panel.legend(fontsize=6.5)
    save(figure, picture)


main(*sys.argv[1:])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shear bands in softening soil, and the critical length of a weak layer."""

import math

from talus_tools.errors import UserError
from talus_tools.report.page import COLORS, GREY, Cell, Rows, Section, embed, subplots
from talus_tools.units import show, unit_of

TIME = "time [s]"
# A zone that is weakened at once runs away from about this share of the critical length on.
SUDDEN = 0.8


class Layer:
    """Slab on a weak layer, by the entries of the run: `slab` and `layer` name two bodies."""

    def __init__(self, entries, slab, layer):
        self.entries, self.slab, self.layer = entries, slab, layer
        self.soil, self.weak = (f"Materials/{self.text(f'Bodies/{body}/Material')}/"
                                for body in (slab, layer))

    def text(self, name, default=None):
        """An entry of the run."""
        value = self.entries.get(name, default)
        if value is None:
            raise UserError(f"The critical length needs '{name}', which the run does not have. "
                            "--slab and --weak-layer name two of its bodies.")
        return value

    def number(self, name, default=None):
        """An entry that is one number."""
        try:
            return float(self.text(name, default))
        except ValueError as error:
            raise UserError(f"The critical length needs one number for '{name}', which is "
                            f"'{self.entries[name]}'.") from error

    def thickness(self, body):
        """Height of a box [m]."""
        if self.text(f"Bodies/{body}/Shape") != "box":
            raise UserError(f"The critical length needs the thickness of '{body}', but its Shape "
                            "is not box.")
        low, high = (float(self.text(f"Bodies/{body}/{corner} corner").split(",")[1])
                     for corner in ("Lower", "Upper"))
        return high - low

    def shear_stress(self):
        """Shear stress by weight in the middle of the layer [Pa]."""
        pull = self.number("Gravity/Magnitude", "9.81") * math.sin(
            math.radians(self.number("Gravity/Slope angle", "0")))
        weights = ((body, material, share) for body, material, share in
                   ((self.slab, self.soil, 1.), (self.layer, self.weak, 0.5)))
        return pull * sum(share * self.thickness(body) *
                          float(self.text(material + "Submerged density", "").strip() or
                                self.number(material + "Density", "1000"))
                          for body, material, share in weights)

    def softening(self):
        """Residual strength [Pa], displacement to it (to 95 % of the loss) [m], and whether the
        strength falls linearly."""
        linear = self.text(self.weak + "Law") == "von Mises"
        peak = self.number(self.weak + "Undrained shear strength")
        residual = (self.number(self.weak + "Residual undrained shear strength", "0") if linear
                    else peak * self.number(self.weak + "Remoulded strength ratio", "1"))
        given = self.text(self.weak + "Softening displacement", "").strip()
        cell = self.number("Grid/Cell size")
        slope = self.number(self.weak + "Hardening modulus", "0") if linear else 0.
        if given:
            displacement = float(given)
        elif linear:
            displacement = -3 * (peak - residual) * cell / slope if slope < 0 else 0.
        else:
            displacement = cell * self.number(self.weak + "Plastic shear strain to remould", "10")
        if displacement <= 0 or residual >= peak:
            raise UserError(f"The body '{self.layer}' does not soften, so that it has no critical "
                            "length.")
        return residual, displacement, linear

    def elastic_length_squared(self, stiffness, height):
        """Square of the length over which slab and layer share load before the peak [m^2]."""
        young, poisson = (self.number(self.weak + name, default) for name, default in
                          (("Young's modulus", None), ("Poisson's ratio", "0.3")))
        slab = self.number(self.soil + "Young's modulus") / (
            2 * (1 + self.number(self.soil + "Poisson's ratio", "0.3")))
        compliance = (self.thickness(self.layer) * 2 * (1 + poisson) / young +
                      height / (3 * slab))
        return stiffness * compliance

    def critical_length(self):
        """Length of a zone at residual strength from which a band runs by itself [m]; infinite
        where the weight does not exceed the residual strength."""
        height, driving = self.thickness(self.slab), self.shear_stress()
        peak = self.number(self.weak + "Undrained shear strength")
        residual, displacement, linear = self.softening()
        if driving <= residual:
            return math.inf
        if driving >= peak:
            return 0.
        ratio = (driving - residual) / (peak - residual)
        stiffness = height * self.number(self.soil + "Young's modulus") / (
            1 - self.number(self.soil + "Poisson's ratio", "0.3")**2)
        square = stiffness * displacement / (peak - residual)
        if linear:
            square = max(square, self.elastic_length_squared(stiffness, height))
            return 2 * (1 - ratio) / ratio * math.sqrt(square)
        return 2 / ratio * math.sqrt(2 * square / 3 * (1 - ratio + ratio * math.log(ratio)))


def bodies_of(run):
    """Names of the softening bodies; "length", in 3-D "area"; its unit."""
    kind, unit = ("length", "m") if run.dimension == 2 else ("area", "m^2")
    return [name for name in run.names("Bodies/Names")
            if f"yielded {kind} of {name} [{unit}]" in run.tables["bands"]], kind, unit


def picture(run, lengths):
    """Extent of the bands over time, with the critical lengths."""
    table = run.tables["bands"]
    bodies, kind, unit = bodies_of(run)
    figure, axes = subplots(height=2.8)
    for body, color in zip(bodies, COLORS * len(bodies)):
        for state, style in (("yielded", "-"), ("residual", "--")):
            axes.plot(table[TIME], table[f"{state} {kind} of {body} [{unit}]"], style, color=color,
                      label=f"{body}, {state}")
    for label, length in lengths:
        if 0 < length < math.inf:
            axes.axhline(length, color=GREY, lw=0.9, ls=":" if "static" in label else "-.",
                         label=f"{label}, {show(length, 'm')}")
    axes.set(xlabel="time [s]", ylabel=f"{kind} [{unit}]", xlim=(0, table[TIME][-1]))
    axes.set_ylim(bottom=0)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return embed(figure, "Extent of the soil that has yielded, and of the soil at its residual "
                 f"strength, in plan, by body. {sentence(lengths)}")


def sentence(lengths):
    """On the critical lengths."""
    if not lengths:
        return ("--slab and --weak-layer, with the names of two bodies, add the critical length "
                "of the layer.")
    static = lengths[0][1]
    if static == math.inf:
        return "Weight is below the residual strength of the layer: no band runs by itself."
    if static == 0:
        return "Weight exceeds the strength of the layer: all of it yields."
    return ("A zone at its residual strength that is longer than the critical length runs away: "
            "the static one if it was weakened slowly, about 0.8 of it (the dynamic one, by "
            "experiments) if at once.")


def bands(run):
    """Where bands.csv is, which softening soil writes."""
    table = run.tables["bands"]
    if not table:
        if run.layer:
            raise UserError(f"'{run.folder}' has no bands.csv, since no soil of the run softens: "
                            "leave --slab and --weak-layer out.")
        return None
    lengths = []
    if run.layer and run.dimension == 2:
        static = Layer(run.entries, *run.layer).critical_length()
        lengths = [("static critical length", static),
                   ("dynamic critical length", SUDDEN * static)]
    bodies, kind, unit = bodies_of(run)
    rows = []
    for body in bodies:
        for column in (f"yielded {kind} of {body} [{unit}]", f"residual {kind} of {body} [{unit}]",
                       f"growth of the yielded {kind} of {body} [{unit}/s]",
                       f"plastic work of {body} [J]"):
            at = int(table[column].argmax())
            rows.append([body, column.rpartition(" of " + body)[0],
                         Cell(show(table[column][at], unit_of(column, run.dimension)),
                              repr(float(table[column][at])), column),
                         show(table[TIME][at], "s")])
    return Section("bands", "Shear bands",
                   "How far softening soil has yielded, and what it has dissipated.",
                   [picture(run, lengths),
                    Rows(["body", "quantity", "largest", "at t ="], rows)])

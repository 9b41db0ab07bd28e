# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers with units for people."""

import re

import numpy

EXTENSIVE = re.compile(r"(kg|N|J)\b")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k")]


def unit_of(column, dimension):
    """Unit of a column by its name. In 2-D what is extensive is per metre width."""
    found = re.search(r"\[(.*)\]$", column)
    unit = found[1] if found else ""
    if unit == "-":
        return ""
    if dimension == 2 and EXTENSIVE.match(unit):
        return unit + (" per m" if " " in unit or "/" in unit else "/m")
    return unit


def plain(value, digits=4):
    """A number with so many significant digits, without e+06."""
    if not numpy.isfinite(value):
        return "not a number"
    if value == 0:
        return "0"
    exponent = int(numpy.floor(numpy.log10(abs(float(f"{value:.{digits - 1}e}")))))
    if not -4 <= exponent < 7:
        mantissa = value / 10.0**exponent
        sign = "−" if value < 0 else ""
        power = str(exponent).translate(SUPERSCRIPTS)
        return f"{sign}{abs(mantissa):.{digits - 2}f} · 10{power}"
    text = f"{value:.{max(0, digits - 1 - exponent)}f}".replace("-", "−")
    return text.rstrip("0").rstrip(".") if "." in text else text


def scaled(value, unit):
    """The factor and the unit in which a value of this size is read easily."""
    if re.match(r"(N|J|Pa)\b", unit):
        for factor, prefix in PREFIXES:
            if abs(value) >= factor:
                return factor, prefix + unit
    if re.match(r"kg\b", unit) and abs(value) >= 1e4:
        return 1e3, unit.replace("kg", "t", 1)
    return 1, unit


def show(value, unit=""):
    """With its unit, in kN, MJ and t where these are easier to read."""
    factor, unit = scaled(value, unit)
    return f"{plain(value / factor)} {unit}".strip().replace("^2", "²").replace("^3", "³")


def largest(values):
    """Index of the value with the largest magnitude."""
    return int(numpy.argmax(numpy.abs(values)))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The varied numbers of each member."""

import itertools
import math

import numpy

from talus_tools.errors import UserError

try:
    import scipy.stats
except ImportError as error:
    raise UserError("Python's scipy was not found, which draws the members. Debian's package "
                    "python3-scipy has it.") from error


def distribution(varied):
    """Distribution of a varied number. Mean and standard deviation are those of the number, not
    of its logarithm."""
    n = varied.numbers
    if varied.distribution == "uniform":
        return scipy.stats.uniform(n["Lower"], n["Upper"] - n["Lower"])
    if varied.distribution == "triangular":
        width = n["Upper"] - n["Lower"]
        return scipy.stats.triang((n["Mode"] - n["Lower"]) / width, n["Lower"], width)
    if varied.distribution == "normal":
        return scipy.stats.norm(n["Mean"], n["Standard deviation"])
    variance = math.log1p((n["Standard deviation"] / n["Mean"])**2)
    return scipy.stats.lognorm(math.sqrt(variance), scale=n["Mean"] * math.exp(-variance / 2))


def quantile(varied, share):
    """Values below which these shares of a distribution are."""
    return distribution(varied).ppf(share)


def shares_of(settings, values):
    """Shares of the distributions below numbers, both of shape (members, varied)."""
    values = numpy.asarray(values, dtype=float)
    return numpy.column_stack([distribution(one).cdf(values[:, i])
                               for i, one in enumerate(settings.varied)])


def design(settings):
    """Numbers, shape (members, varied). The same seed gives the same ones."""
    if settings.kind == "grid":
        return numpy.array(list(itertools.product(*(one.values for one in settings.varied))))
    sampler = scipy.stats.qmc.LatinHypercube(len(settings.varied),
                                             seed=numpy.random.default_rng(settings.seed))
    shares = sampler.random(settings.members)
    return numpy.column_stack([quantile(one, shares[:, i])
                               for i, one in enumerate(settings.varied)])

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Emulator of a quantity: a Gaussian process through the results of the finished members.

The inputs are the varied numbers by their shares, the probability of a smaller number: whatever
the distributions, the emulator learns on a unit cube, and samples of the cube are samples of the
parameters.
"""

import warnings

import numpy

from talus_tools.errors import UserError

MIN_MEMBERS = 8  # a Gaussian process with fewer members knows its own lengths badly


def needs_sklearn():
    """The modules of scikit-learn, loaded here, since loading takes a second."""
    try:
        from sklearn.gaussian_process import GaussianProcessRegressor, kernels
    except ImportError as error:
        raise UserError("Python's scikit-learn was not found, which fits the emulator. Debian's "
                        "package python3-sklearn has it.") from error
    return GaussianProcessRegressor, kernels


class Emulator:
    """Gaussian process with a Matern 5/2 kernel, a length for each input, and noise. `shares`:
    array (members, inputs) in [0, 1]; `values`: array (members)."""

    def __init__(self, shares, values):
        regressor, kernels = needs_sklearn()
        n, dimension = shares.shape
        kernel = (kernels.ConstantKernel(1, (1e-3, 1e3))
                  * kernels.Matern(numpy.ones(dimension), (0.05, 50), nu=2.5)
                  + kernels.WhiteKernel(1e-4, (1e-10, 1)))
        self.values = values
        # Numbers about 1 for the limits of the kernel, also for constants.
        self.scale = values.std() or 1.0
        self.process = regressor(kernel, n_restarts_optimizer=4, random_state=0)
        with warnings.catch_warnings():
            # A length or the noise at its limit is a result, not a failure.
            warnings.simplefilter("ignore")
            self.process.fit(shares, self.standard(values))
        mean, deviation = self.leave_one_out()
        # A process that misses its own members by more than it expects is too sure of itself.
        self.inflation = max(1.0, numpy.sqrt(numpy.mean(((mean - values) / deviation) ** 2)))

    def standard(self, values):
        """Values with mean 0 and deviation 1 over the members."""
        return (values - self.values.mean()) / self.scale

    def __call__(self, shares):
        """Mean and standard deviation of the quantity, including the noise of the members. The
        deviation is increased where the leave-one-out errors are larger than expected."""
        means, deviations = [], []
        for part in numpy.array_split(shares, max(1, len(shares) // 5000)):
            mean, deviation = self.process.predict(part, return_std=True)
            means.append(mean)
            deviations.append(deviation)
        return (self.values.mean() + self.scale * numpy.concatenate(means),
                self.inflation * self.scale * numpy.concatenate(deviations))

    def leave_one_out(self):
        """Prediction of each member by all others, with the same kernel, and its standard
        deviation: y_i - (K^-1 y)_i / (K^-1)_ii and (K^-1)_ii^(-1/2)."""
        inverse = numpy.linalg.inv(self.process.kernel_(self.process.X_train_))
        y = self.standard(self.values)
        diagonal = numpy.diag(inverse)
        return (self.values.mean() + self.scale * (y - inverse @ y / diagonal),
                self.scale / numpy.sqrt(diagonal))

    def explained_variance(self):
        """Share of the variance of the members that the others predict, 1 - sum of squared
        errors over that of the mean; 1 is perfect."""
        error = self.leave_one_out()[0] - self.values
        spread = self.values - self.values.mean()
        return 1 - (error @ error) / max(spread @ spread, 1e-300)


def sobol_indices(function, dimension, n, seed):
    """First-order and total Sobol' indices of a function of shares in a unit cube, each an array
    (dimension): the share of the variance due to an input alone, and with all interactions.
    Estimators of Saltelli et al. (2010) and Jansen (1999) on n quasi-random points."""
    import scipy.stats
    points = scipy.stats.qmc.Sobol(2 * dimension, seed=numpy.random.default_rng(seed)).random(n)
    a, b = points[:, :dimension], points[:, dimension:]
    f_a, f_b = function(a), function(b)
    variance = numpy.concatenate([f_a, f_b]).var() or 1.0
    first, total = numpy.empty(dimension), numpy.empty(dimension)
    for i in range(dimension):
        mixed = a.copy()
        mixed[:, i] = b[:, i]
        f_mixed = function(mixed)
        first[i] = (f_b * (f_mixed - f_a)).mean() / variance
        total[i] = ((f_a - f_mixed) ** 2).mean() / (2 * variance)
    return first, total

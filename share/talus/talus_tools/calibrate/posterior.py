# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameters that fit what was observed, by Bayes' rule.

Prior: the distributions of the study. Likelihood: every observation is normal about the quantity
of the emulator, with the variance of the observation plus that of the emulator. The posterior are
the samples of the prior with weights proportional to their likelihood.
"""

import numpy

from talus_tools.errors import UserError
from talus_tools.study.design import quantile

QUANTILES = (0.05, 0.5, 0.95)
MIN_EFFECTIVE = 100  # samples; with fewer, quantiles are noise


class Posterior:
    """Samples of the parameters, shape (samples, varied), with weights of sum 1."""

    def __init__(self, emulation):
        self.settings = settings = emulation.settings
        shares = emulation.samples()
        self.samples = numpy.column_stack([quantile(one, shares[:, i])
                                           for i, one in enumerate(settings.varied)])
        log_likelihood = numpy.zeros(len(shares))
        self.predicted = []  # mean and standard deviation of the observed quantities
        for observation in settings.observed:
            mean, deviation = emulation.emulators[observation.quantity](shares)
            self.predicted.append((mean, deviation))
            variance = observation.deviation**2 + deviation**2
            log_likelihood -= 0.5 * ((mean - observation.value)**2 / variance
                                     + numpy.log(variance))
        weights = numpy.exp(log_likelihood - log_likelihood.max())
        self.weights = weights / weights.sum()
        self.check()

    def effective_samples(self):
        """Number of equally weighted samples that would be as good (Kish)."""
        return 1 / (self.weights @ self.weights)

    def check(self):
        """Observations that no sample comes near are not explained by the study."""
        for observation, (mean, deviation) in zip(self.settings.observed, self.predicted):
            distance = (numpy.abs(mean - observation.value)
                        / numpy.hypot(observation.deviation, deviation)).min()
            if distance > 3:
                raise UserError(
                    f"The observation '{observation.name}' = {observation.value:g} lies "
                    f"{distance:.1f} standard deviations from the nearest result of the study, "
                    f"whose results are from {mean.min():.4g} to {mean.max():.4g}. Widen the "
                    "distributions of 'Varied', or look for what the model lacks.")
        if self.effective_samples() < MIN_EFFECTIVE:
            raise UserError(
                f"The observations leave {self.effective_samples():.0f} effective samples, where "
                f"{MIN_EFFECTIVE} were expected: they contradict each other, or are more precise "
                "than the samples are dense. Increase 'Emulator/Samples', or the 'Standard "
                "deviation' of the observations.")

    def quantiles(self, values):
        """Weighted quantiles QUANTILES of one number per sample."""
        order = numpy.argsort(values)
        return numpy.interp(QUANTILES, numpy.cumsum(self.weights[order]), values[order])

    def rows(self):
        """Rows of calibration.csv: prior and posterior quantiles of each parameter, then of each
        observed quantity."""
        names = [one.name for one in self.settings.varied]
        numbers = list(self.samples.T)
        for observation, (mean, _) in zip(self.settings.observed, self.predicted):
            names.append(self.settings.quantities[observation.quantity].label())
            numbers.append(mean)
        return [[name, *numpy.quantile(values, QUANTILES), *self.quantiles(values)]
                for name, values in zip(names, numbers)]

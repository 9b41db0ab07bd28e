# SPDX-License-Identifier: LGPL-2.1-or-later
"""Emulators of all quantities of a study, and what follows from them."""

import os

import numpy

from talus_tools.errors import UserError
from talus_tools.study.design import shares_of
from talus_tools.study.emulator import MIN_MEMBERS, Emulator, sobol_indices
from talus_tools.study.pile import N_DRAWS, PiledEmulator, joint, pile_of
from talus_tools.study.results import write_csv
from talus_tools.study.settings import MOVING

SOBOL_POINTS = 2**13
CURVE = 200  # points of an exceedance curve
JOINT = 400  # samples of the interval, drawn together
INTERVAL = (0.05, 0.95)  # of the probability of exceedance


class Emulation:
    """An emulator for each quantity, fitted on the finished members."""

    def __init__(self, results):
        settings = results.settings
        if settings.kind == "grid":
            raise UserError(f"'{settings.path}': an emulator needs the distributions of the varied "
                            "parameters, which a grid has not. Set 'Design/Kind' to Latin "
                            "hypercube, or 'Emulator/Write' to false.")
        done = numpy.isfinite(results.values).all(axis=1)
        if done.sum() < MIN_MEMBERS:
            raise UserError(f"{done.sum()} members have finished, where an emulator needs at "
                            f"least {MIN_MEMBERS}. Run the others, or increase "
                            "'Design/Members'.")
        self.settings = settings
        self.shares = shares_of(settings, [member.values for member in results.members])[done]
        self.values = results.values[done]
        self.moving = numpy.array(results.moving)[done]
        self.numbers = numpy.array([member.number for member in results.members])[done]
        self.emulators = [self.fit(column) for column in self.values.T]

    def fit(self, values):
        """Emulator of a quantity, with or without a pile of equal values."""
        pile = pile_of(values)
        if pile is None:
            return Emulator(self.shares, values)
        return PiledEmulator(self.shares, values, pile)

    def samples(self):
        """Shares, shape (samples, varied), drawn independently of each other."""
        generator = numpy.random.default_rng([self.settings.seed, 1])
        return generator.random((self.settings.emulator_samples, self.shares.shape[1]))

    def exceedance(self, index, samples):
        """Values, and the probability that a quantity exceeds each: the mean over the samples,
        with the uncertainty of the emulator."""
        import scipy.stats
        if isinstance(self.emulators[index], PiledEmulator):
            return self.exceedance_beyond_pile(self.emulators[index], samples)
        mean, deviation = self.emulators[index](samples)
        drawn = mean + deviation * scipy.stats.norm.ppf(
            numpy.random.default_rng([self.settings.seed, 2]).random(len(mean)))
        probability = numpy.linspace(1, 0, CURVE)
        return numpy.quantile(drawn, 1 - probability), probability

    def exceedance_beyond_pile(self, emulator, samples):
        """The same for a quantity with a pile: P(hit) times the probability of hits."""
        generator = numpy.random.default_rng([self.settings.seed, 2])
        chances = generator.random((2, len(samples)))
        is_hit = chances[0] < emulator.classifier(samples)
        distances = emulator.draw(samples, chances[1])[is_hit]
        beyond = is_hit.mean() * numpy.linspace(1, 0, CURVE - 1)
        if len(distances) == 0:
            return numpy.array([emulator.pile]), numpy.zeros(1)
        far = numpy.quantile(distances, numpy.linspace(0, 1, CURVE - 1))
        far, beyond = numpy.append(0, far), numpy.append(is_hit.mean(), beyond)
        if emulator.sign > 0:
            return emulator.pile + far, beyond
        return emulator.pile - far[::-1], 1 - beyond[::-1]

    def interval(self, index, values, probability):
        """Range, shape (2, values), of the probability of exceedance, by joint samples of the
        Gaussian process or of the classifier: what few members leave unknown."""
        emulator = self.emulators[index]
        shares = self.samples()[:JOINT]
        generator = numpy.random.default_rng([self.settings.seed, 3])
        if isinstance(emulator, PiledEmulator):
            hit = emulator.classifier.draws(shares, generator)
            chances = generator.random((len(shares), N_DRAWS))
            distances = numpy.stack([emulator.draw(shares, chance) for chance in chances.T], 1)
            above = numpy.array([(hit * (distances > a)).mean(axis=0)
                                 for a in emulator.sign * (values - emulator.pile)])
            above = above if emulator.sign > 0 else 1 - above
        else:
            mean, covariance = emulator.process.predict(shares, return_cov=True)
            drawn = joint(mean, emulator.inflation**2 * covariance, generator)
            above = numpy.array([(drawn > a).mean(axis=0) for a in emulator.standard(values)])
        # The mean of the few samples has an error that the whole curve does not have.
        spread = numpy.quantile(above - above.mean(axis=1, keepdims=True), INTERVAL, axis=1)
        return numpy.clip(probability + spread, 0, 1)

    def sobol(self, index):
        """First-order and total indices of a quantity."""
        return sobol_indices(lambda shares: self.emulators[index](shares)[0],
                             self.shares.shape[1], SOBOL_POINTS, self.settings.seed)


def write_emulation(results):
    """emulator.csv, sobol.csv, emulator-exceedance.csv and emulator.png; one line per quantity
    on the terminal."""
    from talus_tools.study import pictures
    emulation, settings = Emulation(results), results.settings
    labels = [quantity.label() for quantity in settings.quantities]
    members = [["quantity", "value", "prediction by the other members",
                "standard deviation of the prediction", "member", MOVING]]
    indices = [["quantity", "parameter", "first-order index [-]", "total index [-]"]]
    curves = [["quantity", "value", "probability of exceedance [-]",
               *(f"{100 * level:g} % [-]" for level in INTERVAL)]]
    samples, drawn, sobol = emulation.samples(), [], []
    for q, (label, emulator) in enumerate(zip(labels, emulation.emulators)):
        members += [[label, *map(repr, map(float, row)), number, moving] for number, moving, *row
                    in zip(emulation.numbers, emulation.moving, emulator.values,
                           *emulator.leave_one_out())]
        sobol.append(emulation.sobol(q))
        indices += [[label, varied.name, f"{s:.4f}", f"{t:.4f}"]
                    for varied, s, t in zip(settings.varied, *sobol[-1])]
        curve = emulation.exceedance(q, samples)
        drawn.append((*curve, *emulation.interval(q, *curve)))
        curves += [[label, repr(float(v)), *(f"{p:.6g}" for p in chances)]
                   for v, *chances in zip(*drawn[-1])]
        print(f"Emulator of {label}: the other members explain "
              f"{100 * emulator.explained_variance():.1f} % of the variance.")
        if isinstance(emulator, PiledEmulator):
            row = 0 if emulator.sign > 0 else -1
            chances = [column[row] for column in drawn[-1][1:]]
            if emulator.sign < 0:
                chances = [1 - chances[0], 1 - chances[2], 1 - chances[1]]
            print("  {} By the emulator the probability is {:.2f}, from {:.2f} to {:.2f}.".format(
                emulator.describe(), *chances))
    for name, rows in (("emulator", members), ("sobol", indices),
                       ("emulator-exceedance", curves)):
        write_csv(os.path.join(settings.folder, name + ".csv"), rows)
    pictures.emulator(results, emulation, sobol, drawn)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Emulators of all quantities of a study, and what follows from them."""

import os

import numpy

from talus_tools.errors import UserError
from talus_tools.study.design import shares_of
from talus_tools.study.emulator import MIN_MEMBERS, Emulator, sobol_indices
from talus_tools.study.results import write_csv

SOBOL_POINTS = 2**13
CURVE = 200  # points of an exceedance curve


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
        self.emulators = [Emulator(self.shares, column) for column in self.values.T]

    def samples(self):
        """Shares, shape (samples, varied), drawn independently of each other."""
        generator = numpy.random.default_rng([self.settings.seed, 1])
        return generator.random((self.settings.emulator_samples, self.shares.shape[1]))

    def exceedance(self, index, samples):
        """Values, and the probability that a quantity exceeds each: the mean over the samples,
        with the uncertainty of the emulator."""
        import scipy.stats
        mean, deviation = self.emulators[index](samples)
        drawn = mean + deviation * scipy.stats.norm.ppf(
            numpy.random.default_rng([self.settings.seed, 2]).random(len(mean)))
        probability = numpy.linspace(1, 0, CURVE)
        return numpy.quantile(drawn, 1 - probability), probability

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
                "standard deviation of the prediction"]]
    indices = [["quantity", "parameter", "first-order index [-]", "total index [-]"]]
    curves = [["quantity", "value", "probability of exceedance [-]"]]
    samples, drawn, sobol = emulation.samples(), [], []
    for q, (label, emulator) in enumerate(zip(labels, emulation.emulators)):
        members += [[label, *map(repr, map(float, row))]
                    for row in zip(emulator.values, *emulator.leave_one_out())]
        sobol.append(emulation.sobol(q))
        indices += [[label, varied.name, f"{s:.4f}", f"{t:.4f}"]
                    for varied, s, t in zip(settings.varied, *sobol[-1])]
        drawn.append(emulation.exceedance(q, samples))
        curves += [[label, repr(float(v)), f"{p:.6g}"] for v, p in zip(*drawn[-1])]
        print(f"Emulator of {label}: the other members explain "
              f"{100 * emulator.explained_variance():.1f} % of the variance.")
    for name, rows in (("emulator", members), ("sobol", indices),
                       ("emulator-exceedance", curves)):
        write_csv(os.path.join(settings.folder, name + ".csv"), rows)
    pictures.emulator(results, emulation, sobol, drawn)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Emulator of a quantity with a pile: many members have the same smallest, or largest, value.

The thickness at a place is 0 in all members whose soil does not reach the place. A Gaussian
process through such a pile is wrong on both sides of its edge. Here a Gaussian process classifier
gives the probability that a member is off the pile ("hit"), and a Gaussian process through the
hits alone gives the value of a hit, whose normal distribution ends at the pile.
"""

import warnings

import numpy

from talus_tools.study.emulator import MIN_MEMBERS, Emulator, needs_sklearn

MIN_PILE = 3  # members
MIN_DEVIATION = 1e-9  # of the values of hits, over their largest distance from the pile
SLOPES = (1.0, 1.5, 2.0, 3.0, 5.0, 8.0)  # of the logarithm of the odds
N_DRAWS = 400  # of the latent function of the classifier


def pile_of(values):
    """Smallest or largest value that at least MIN_PILE members share, or None. A constant has
    no pile."""
    for value in (values.min(), values.max()):
        if MIN_PILE <= (values == value).sum() < len(values):
            return value
    return None


class Classifier:
    """Probability of a hit at shares. The classifier alone tends to one half: the logarithm of
    the odds is multiplied by `slope`, with which the other members predict a member best, and
    shifted so that the mean probability of the members is the share of hits. `kernel` and
    `slope` are found unless given."""

    def __init__(self, shares, is_hit, kernel=None, slope=None):
        from sklearn.gaussian_process import GaussianProcessClassifier
        _, kernels = needs_sklearn()
        new = kernel or (kernels.ConstantKernel(10, (1, 100))
                         * kernels.RBF(numpy.ones(shares.shape[1]), (0.2, 50)))
        self.constant = None
        if is_hit.all() or not is_hit.any():
            self.constant = float(is_hit[0])
            return
        process = GaussianProcessClassifier(
            new, optimizer=None if kernel else "fmin_l_bfgs_b",
            n_restarts_optimizer=0 if kernel else 2, random_state=0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a length at its limit is a result
            process.fit(shares, is_hit)
        self.process, self.slope, self.shift = process, 1.0, 0.0
        raw, share = self(shares), is_hit.mean()
        if slope is None:
            slope = self.find_slope(self.left_out(shares, is_hit), is_hit)
        self.slope, self.shift = slope, self.find_shift(raw, slope, share)

    def left_out(self, shares, is_hit):
        """Probability of a hit of each member, by a classifier of the other members with the
        same kernel and slope."""
        return numpy.array([
            Classifier(shares[keep], is_hit[keep], self.process.kernel_,
                       self.slope)(shares[i:i + 1])[0]
            for i, keep in enumerate(~numpy.eye(len(shares), dtype=bool))])

    def find_slope(self, probability, is_hit):
        """Slope with the largest likelihood of the members; each of them may err once in as many
        as there are."""
        def loss(slope):
            shift = self.find_shift(probability, slope, is_hit.mean())
            hit = self.scaled(probability, slope, shift)
            right = numpy.where(is_hit, hit, 1 - hit)
            return -numpy.log(right + 1 / len(is_hit)).mean()

        return min(SLOPES, key=loss)

    def find_shift(self, probability, slope, share):
        """Shift with which the mean probability is `share`."""
        from scipy.optimize import brentq
        return brentq(lambda shift: self.scaled(probability, slope, shift).mean() - share,
                      -500, 500)

    @staticmethod
    def scaled(probability, slope, shift):
        """Probabilities whose logarithm of the odds is multiplied and shifted."""
        from scipy.special import expit, logit
        return expit(slope * logit(numpy.clip(probability, 1e-12, 1 - 1e-12)) + shift)

    def __call__(self, shares):
        """Probability of a hit."""
        if self.constant is not None:
            return numpy.full(len(shares), self.constant)
        parts = numpy.array_split(shares, max(1, len(shares) // 5000))
        return self.scaled(numpy.concatenate([self.process.predict_proba(part)[:, 1]
                                              for part in parts]), self.slope, self.shift)

    def draws(self, shares, generator):
        """Probabilities (shares, N_DRAWS) by joint samples of the latent function, Laplace's
        approximation (Rasmussen and Williams 2006, algorithm 3.2)."""
        from scipy.linalg import solve_triangular
        from scipy.special import expit
        fitted = self.process.base_estimator_
        between = fitted.kernel_(fitted.X_train_, shares)
        mean = between.T @ (fitted.y_train_ - fitted.pi_)
        part = solve_triangular(fitted.L_, fitted.W_sr_[:, None] * between, lower=True)
        latent = joint(mean, fitted.kernel_(shares) - part.T @ part, generator)
        return self.scaled(expit(latent), self.slope, self.shift)


def joint(mean, covariance, generator):
    """Samples (points, N_DRAWS) of a normal distribution."""
    squares, vectors = numpy.linalg.eigh(covariance)
    scaled = vectors * numpy.sqrt(numpy.maximum(squares, 0))
    return mean[:, None] + scaled @ generator.standard_normal((len(mean), N_DRAWS))


class PiledEmulator:
    """Same interface as Emulator: mean and standard deviation at shares, over the members."""

    def __init__(self, shares, values, pile):
        self.shares, self.values, self.pile = shares, values, pile
        self.is_hit = values != pile
        # Distances from the pile are positive, whether it is the smallest or the largest value.
        self.sign = 1.0 if (values >= pile).all() else -1.0
        self.distances = self.sign * (values[self.is_hit] - pile)
        self.classifier = Classifier(shares, self.is_hit)
        self.value = None  # of few hits the values themselves are the distribution
        if self.is_hit.sum() >= MIN_MEMBERS:
            self.value = Emulator(shares[self.is_hit], self.distances)

    def of_hits(self, shares):
        """Mean and standard deviation of the distance of a hit before the cut at the pile."""
        mean, deviation = self.value(shares)
        return mean, numpy.maximum(deviation, MIN_DEVIATION * self.distances.max())

    def moments(self, probability, shares):
        """Mean and standard deviation of the quantity with a probability of a hit."""
        import scipy.stats
        if self.value is None:
            mean = numpy.full(len(shares), self.distances.mean())
            deviation = numpy.full(len(shares), self.distances.std())
        else:
            at, scale = self.of_hits(shares)
            cut = scipy.stats.truncnorm(-at / scale, numpy.inf, at, scale)
            mean, deviation = cut.mean(), cut.std()
        variance = probability * (deviation**2 + (1 - probability) * mean**2)
        return self.pile + self.sign * probability * mean, numpy.sqrt(variance)

    def __call__(self, shares):
        """Mean and standard deviation of the quantity, hit or not."""
        return self.moments(self.classifier(shares), shares)

    def leave_one_out(self):
        """Prediction of each member by a classifier of the other members with the same kernel.
        The value of a hit is not left out."""
        return self.moments(self.left_out(), self.shares)

    def left_out(self):
        """Probability of a hit of each member by the other members."""
        return self.classifier.left_out(self.shares, self.is_hit)

    def explained_variance(self):
        """Share of the variance of hit and no hit that the other members predict."""
        error = self.left_out() - self.is_hit
        return 1 - (error @ error) / (len(error) * self.is_hit.var())

    def draw(self, shares, chances):
        """Distances of hits at shares from the pile: quantiles of the shares `chances`."""
        import scipy.stats
        if self.value is None:
            return numpy.quantile(self.distances, chances)
        at, scale = self.of_hits(shares)
        # Far below the pile the quantile is not a number: there a hit is just beyond it.
        drawn = scipy.stats.truncnorm.ppf(chances, -at / scale, numpy.inf, at, scale)
        return numpy.nan_to_num(numpy.maximum(drawn, 0), nan=0.0, posinf=0.0)

    def members_range(self, level):
        """Clopper and Pearson's range of the probability of a hit by the number of hits alone;
        `level`: probability below and above."""
        import scipy.stats
        n, hits = len(self.values), self.is_hit.sum()
        return (scipy.stats.beta.ppf(level, hits, n - hits + 1),
                scipy.stats.beta.ppf(1 - level, hits + 1, n - hits))

    def describe(self):
        """Sentences for the terminal, after the name of the quantity."""
        low, high = self.members_range(0.05)
        text = (f"{(~self.is_hit).sum()} of {len(self.values)} members have the value "
                f"{self.pile + 0.0:g}. Hit (another value) and no hit are modelled by a classifier; by "
                f"the number of hits alone the probability of a hit is from {low:.2f} to "
                f"{high:.2f} (90 %).")
        if self.value is None:
            text += (f" {len(self.distances)} hits are too few for an emulator of their value; "
                     "the curve takes the values themselves.")
        return text

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of a calibration."""

import numpy

from talus_tools.report.page import BLUE, COLORS, plt, subplots

BINS = 40


def draw(posterior, path):
    """Prior and posterior of each parameter on the diagonal; posterior of pairs below."""
    names = [one.name for one in posterior.settings.varied]
    n = len(names)
    figure, axes = subplots(n, n, height=max(2.6, 2.2 * n), squeeze=False)
    for i in range(n):
        for j in range(n):
            if j > i:
                axes[i, j].axis("off")
                continue
            x, y = posterior.samples[:, j], posterior.samples[:, i]
            limits = [numpy.quantile(values, (0.001, 0.999)) for values in (x, y)]
            if i == j:
                axes[i, i].hist(x, BINS, limits[0], density=True, color="0.8", label="prior")
                axes[i, i].hist(x, BINS, limits[0], density=True, weights=posterior.weights,
                                histtype="step", color=BLUE, label="posterior")
                for value in posterior.quantiles(x):
                    axes[i, i].axvline(value, color=COLORS[1], lw=0.7)
                axes[i, i].set(yticks=[])
            else:
                axes[i, j].hist2d(x, y, BINS, limits, weights=posterior.weights, cmap="Blues")
            axes[i, j].set(xlabel=names[j] if i == n - 1 else "",
                           ylabel=names[i] if j == 0 and i > 0 else "")
    axes[0, 0].legend(fontsize=7)
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a study."""

import os

import numpy
import scipy.stats

from talus_tools.report.page import BLUE, COLORS, plt, subplots
from talus_tools.report.sections.maps import GROUND, draw, height_of, meaning, window


def save(figure, settings, name):
    """As PNG in the folder of the study, without a date."""
    figure.savefig(os.path.join(settings.folder, name), dpi=130, metadata={"Software": None})
    plt.close(figure)


def rank_correlation(one, other):
    """Spearman's, as a text; nothing for fewer than five members or a constant."""
    if len(one) < 5 or one.min() == one.max() or other.min() == other.max():
        return ""
    return f"rank correlation {scipy.stats.spearmanr(one, other).statistic:.2f}"


def mark_moving(axes, results, index):
    """Circles around the members that still moved at the end, by their number. Return whether
    there are any."""
    values, shares = results.exceedance(index)
    moving = [(member.number, value) for member, value, flag in zip(
        results.members, results.values[:, index], results.moving) if flag == "1"]
    for number, value in moving:
        at = shares[numpy.searchsorted(values, value)]
        axes.plot(value, at, "o", mfc="none", color=COLORS[1],
                  label="still moving: lower bound" if number == moving[0][0] else None)
        axes.annotate(str(number), (value, at), (2, 2), textcoords="offset points", fontsize=6)
    return bool(moving)


def overview(results):
    """Per quantity its exceedance curve, and its values over each varied parameter."""
    settings = results.settings
    done = [i for i in range(len(results.members)) if results.states[i][0] == "finished"]
    if not done:
        return
    n_rows, n_columns = len(settings.quantities), 1 + len(settings.varied)
    figure, rows = subplots(n_rows, n_columns, height=0.3 + 2.6 * n_rows, squeeze=False)
    numbers = [results.members[i].values for i in done]
    for q, (quantity, axes) in enumerate(zip(settings.quantities, rows)):
        values, share = results.exceedance(q)
        axes[0].step(values, share, where="pre", color=BLUE)
        axes[0].plot(values, share, ".", color=BLUE)
        if mark_moving(axes[0], results, q):
            axes[0].legend(fontsize=7)
        axes[0].set(xlabel=quantity.label(), ylabel="share of members at or above",
                    ylim=(0, 1.05))
        for v, varied in enumerate(settings.varied):
            x = numpy.array([row[v] for row in numbers])
            axes[1 + v].plot(x, results.values[done, q], ".", color=COLORS[1])
            axes[1 + v].set(xlabel=varied.name, ylabel=quantity.label(),
                            title=rank_correlation(x, results.values[done, q]))
    left = len(results.members) - len(done)
    moving = results.moving.count("1")
    figure.suptitle(f"{settings.title or settings.case}: {len(done)} members"
                    + (f"; {left} have not finished and are missing" if left else "")
                    + (f"; {moving} still moved at the end" if moving else ""), fontsize=10)
    save(figure, settings, "study.png")


def emulator(results, emulation, sobol, exceedance):
    """Per quantity: the members over their prediction by the others, the indices of Sobol', and
    the exceedance curve."""
    settings = results.settings
    n_rows = len(settings.quantities)
    figure, rows = subplots(n_rows, 3, height=0.3 + 2.6 * n_rows, squeeze=False)
    for q, (quantity, axes) in enumerate(zip(settings.quantities, rows)):
        fitted = emulation.emulators[q]
        predicted, deviation = fitted.leave_one_out()
        ends = [fitted.values.min(), fitted.values.max()]
        axes[0].plot(ends, ends, color="0.6", lw=0.8)
        axes[0].errorbar(fitted.values, predicted, 2 * deviation, fmt=".", color=BLUE, lw=0.6)
        axes[0].set(xlabel=quantity.label(), ylabel="by the other members",
                    title=f"explained: {100 * fitted.explained_variance():.1f} %")
        first, total = sobol[q]
        places = numpy.arange(len(settings.varied))
        axes[1].barh(places - 0.2, first, 0.4, color=BLUE, label="alone")
        axes[1].barh(places + 0.2, total, 0.4, color=COLORS[1], label="with interactions")
        axes[1].set(yticks=places, yticklabels=[one.name for one in settings.varied],
                    xlabel="share of the variance", xlim=(0, 1.05))
        axes[1].legend(fontsize=7)
        curve, probability, low, high = exceedance[q]
        axes[2].fill_between(curve, low, high, color=BLUE, alpha=0.2, lw=0, label="90 %")
        axes[2].plot(curve, probability, color=BLUE, label="emulator")
        values, shares = results.exceedance(q)
        axes[2].step(values, shares, where="pre", color="0.5", lw=0.8, label="members")
        mark_moving(axes[2], results, q)
        axes[2].set(xlabel=quantity.label(), ylabel="probability of exceedance", ylim=(0, 1.05))
        axes[2].legend(fontsize=7)
    figure.suptitle(f"{settings.title or settings.case}: emulator of {len(emulation.values)} "
                    "members", fontsize=10)
    save(figure, settings, "emulator.png")


def label(settings, threshold):
    """What is exceeded, with the unit if it is known."""
    unit = meaning(settings.map)[0]
    return f"{settings.map.replace('-', ' ')} above {threshold:g} {unit}".strip()


def exceedance_maps(settings, grids, ground):
    """Rasters, one below the other, in 3-D."""
    shown = {str(t): grid for t, grid in grids.items()}
    first = next(iter(grids.values()))
    part = window(shown | ({GROUND: ground} if ground else {}))
    figure, rows = subplots(len(grids), height=len(grids) * height_of(first, part), squeeze=False)
    for axes, (threshold, grid) in zip(rows[:, 0], grids.items()):
        image = draw(axes, grid, ground, part, "YlOrRd", vmin=0, vmax=1)
        axes.set_title(label(settings, threshold))
        figure.colorbar(image, ax=axes, label="share of members [-]", pad=0.01)
    save(figure, settings, "exceedance-maps.png")


def exceedance_lines(settings, places, shares):
    """The same over x, in 2-D."""
    figure, axes = subplots(height=2.6)
    for (threshold, share), color in zip(shares.items(), COLORS * 3):
        axes.step(places, share, where="mid", color=color,
                  label=label(settings, threshold))
    axes.set(xlabel="x [m]", ylabel="share of members [-]", ylim=(0, 1.05))
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, settings, "exceedance-maps.png")

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of the response of a pipe."""

from talus_tools.pipe.response import QUANTITIES
from talus_tools.report.page import BLUE, COLORS, plt, subplots
from talus_tools.units import plain, scaled


def draw(response, path):
    """Deflection, moment, axial force along the pipe, and utilisation in time."""
    figure, axes = subplots(4, 1, height=9)
    row = response.peak_row()
    loaded = response.load.covers(response.s)
    moved = response.s[abs(response.values[:, 0]).max(axis=0) > 1e-3 * abs(
        response.values[:, 0]).max()]
    margin = 0.1 * (moved[-1] - moved[0])
    for ax in axes[:2]:
        ax.set_xlim(moved[0] - margin, moved[-1] + margin)
    for ax, q in zip(axes, (0, 1, 3)):
        name, unit = QUANTITIES[q]
        values = response.values[:, q]
        factor, unit = scaled(abs(values).max(), unit)
        ax.fill_between(response.s, values.min(axis=0) / factor, values.max(axis=0) / factor,
                        color=BLUE, alpha=0.2, lw=0, label="extremes over time")
        ax.plot(response.s, values[row] / factor, color=BLUE, label="at the largest utilisation")
        ax.fill_between(response.s, 0, 1, where=loaded, transform=ax.get_xaxis_transform(),
                        color="0.5", alpha=0.15, lw=0, label="loaded by the slide")
        ax.set(xlabel="along the pipe s [m]", ylabel=f"{name} [{unit}]")
    axes[0].legend(fontsize=7)
    axes[3].plot(response.load.times, response.values[:, -1].max(axis=1), color=COLORS[1])
    axes[3].axhline(1, color="0.4", ls="--", lw=0.8)
    axes[3].set(xlabel="time [s]" if response.has_history else "share of the load [-]",
                ylabel="utilisation [-]", ylim=(0, None))
    figure.suptitle(f"Pipe of {plain(response.settings.pipe.diameter)} m: response to "
                    f"{response.load.label}", fontsize=9)
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)

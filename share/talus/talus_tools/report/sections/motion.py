# SPDX-License-Identifier: LGPL-2.1-or-later
"""The slide in time, moved by a slider."""

from talus_tools.report.film import film, png
from talus_tools.report.page import Section, Slider, SliderView, address

MOST = 40  # times on the page, so that it stays light


def css(window):
    """Place of the frames within their picture."""
    names = ("left", "top", "width", "height")
    return "; ".join(f"{name}: {100 * share:.4f}%" for name, share in zip(names, window))


def motion(run):
    """Where the run wrote fields at two times or more."""
    found = film(run, MOST)
    if found is None:
        return None
    views = [SliderView(address(view.base), css(view.window),
                        [address(png(frame)) for frame in view.frames], address(view.top),
                        view.caption) for view in found.views]
    return Section("motion", "The slide in time",
                   "Move the slider, or press the button to play. talus-animate makes a film of "
                   "it.", [Slider([f"t = {time:.4g} s" for time in found.times], views)])

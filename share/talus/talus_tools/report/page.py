# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of which a page is made; the template draws each by its kind."""

import base64
import dataclasses
import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

STYLE = {
    "font.size": 9, "axes.titlesize": 9, "axes.titlelocation": "left", "axes.linewidth": 0.6,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.linewidth": 0.4, "grid.color": "#dde2e7", "lines.linewidth": 1.4,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "legend.frameon": False,
    "legend.fontsize": 8.5, "axes.edgecolor": "#5b6670", "xtick.color": "#3c464e",
    "ytick.color": "#3c464e", "axes.labelcolor": "#3c464e", "svg.hashsalt": "talus",
    # The default map of PolyCollection and pcolormesh: even in grey and for the colour-blind.
    "image.cmap": "viridis",
}
BLUE, RED, GREEN, VIOLET, GREY, ORANGE = ("#1f5fa8", "#c8442b", "#3a8f5c", "#7a55a3", "#77828c",
                                          "#d08a1d")
COLORS = [BLUE, RED, GREEN, VIOLET, ORANGE, GREY]
WIDTH = 9.6  # of pictures [inch]


@dataclasses.dataclass
class Figure:
    """A picture within the page."""
    source: str
    caption: str
    kind: str = "figure"


@dataclasses.dataclass
class Cell:
    """What a table shows, and the number behind it, with all digits of the file."""
    text: str
    value: str = ""
    column: str = ""


@dataclasses.dataclass
class Rows:
    """A table; a row is a list of Cell or str."""
    head: list
    rows: list
    kind: str = "table"


@dataclasses.dataclass
class Lines:
    """Sentences, each of its own."""
    lines: list
    kind: str = "lines"


@dataclasses.dataclass
class Text:
    """A file as it is."""
    text: str
    kind: str = "text"


@dataclasses.dataclass
class Folded:
    """Parts behind a title, which a click opens."""
    title: str
    parts: list
    kind: str = "folded"


@dataclasses.dataclass
class Slider:
    """Pictures that change with time; the page shows those of the last time until a reader
    moves the slider. `times`: as texts; `views`: list of SliderView."""
    times: list
    views: list
    kind: str = "slider"


@dataclasses.dataclass
class SliderView:
    """Addresses of a picture that stays, of the frames over the window of its axes, and of the
    lines over these; `window`: CSS of the place of the frames."""
    base: str
    window: str
    frames: list
    top: str
    caption: str


@dataclasses.dataclass
class Section:
    """A part of the page with its heading; `lead` says what it is for."""
    anchor: str
    title: str
    lead: str
    parts: list


def subplots(rows=1, columns=1, height=2.6, **options):
    """A figure over the width of the page, in our style."""
    plt.rcParams.update(STYLE)
    return plt.subplots(rows, columns, figsize=(WIDTH, height), constrained_layout=True,
                        **options)


def saved(figure, form="png", **options):
    """The bytes of a figure; of a picture with 64 steps of each colour, which nobody sees and
    which makes it smaller by a third. No date, so that the same run gives the same page."""
    stream = io.BytesIO()
    metadata = {"Date": None} if form == "svg" else {"Software": None}
    figure.savefig(stream, format=form, dpi=130, metadata=metadata, **options)
    plt.close(figure)
    if form == "svg":
        return stream.getvalue()
    smaller = io.BytesIO()
    with Image.open(stream) as image:
        # White stays white: the highest bits fill the lowest.
        image = (image.quantize(256, Image.Quantize.FASTOCTREE) if options.get("transparent") else
                 image.convert("RGB").point(lambda value: value & 0xFC | value >> 6))
        image.save(smaller, "PNG", optimize=True)
    return smaller.getvalue()


def address(data, form="png"):
    """A picture within the page."""
    kind = "image/svg+xml" if form == "svg" else "image/png"
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


def embed(figure, caption, form="svg"):
    """The figure as a part of the page: lines as SVG, pictures as PNG."""
    return Figure(address(saved(figure, form), form), caption)

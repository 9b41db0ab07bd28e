# SPDX-License-Identifier: LGPL-2.1-or-later
"""Styles of QGIS beside the rasters of a run: with NAME.qml beside NAME.asc a map opens in the
colours of the report, the ground in shaded relief."""

import os

import numpy
from matplotlib import colormaps
from matplotlib.colors import to_hex

from talus_tools.report.sections.maps import GROUND, limits, meaning, read_maps, visible
from talus_tools.texts import LENIENT

# By this line a style is known as one that nobody has changed by hand.
MARK = "<!-- Written by talus-report; take this line away to keep a style of your own. -->"
N_COLORS = 9

FRAME = """<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
{mark}
<qgis version="3.22" styleCategories="AllStyleCategories">
  <pipe>
    <provider><resampling enabled="true" maxOversampling="2" \
zoomedInResamplingMethod="{zoomed_in}" zoomedOutResamplingMethod="bilinear"/></provider>
    {renderer}
    <resamplingStage>provider</resamplingStage>
  </pipe>
  <blendMode>0</blendMode>
</qgis>
"""
RELIEF = ('<rasterrenderer type="hillshade" band="1" opacity="1" alphaBand="-1" azimuth="315" '
          'angle="45" zfactor="{steeper:.3g}" multidirection="0"><rasterTransparency/>'
          '</rasterrenderer>')
COLORED = """<rasterrenderer type="singlebandpseudocolor" band="1" opacity="0.85" alphaBand="-1" \
classificationMin="{low!r}" classificationMax="{high!r}">
      <rasterTransparency><singleValuePixelList>
        <pixelListEntry min="0" max="0" percentTransparent="100"/>
      </singleValuePixelList></rasterTransparency>
      <rastershader><colorrampshader colorRampType="INTERPOLATED" classificationMode="1" clip="0" \
minimumValue="{low!r}" maximumValue="{high!r}">
{items}
      </colorrampshader></rastershader>
    </rasterrenderer>"""


def relief(grid):
    """Shaded relief; a slope of a degree is seen as well as one of thirty."""
    heights = numpy.where(numpy.isfinite(grid.values), grid.values, numpy.nanmean(grid.values))
    steepest = (numpy.hypot(*numpy.gradient(heights, grid.dy, grid.dx)).max()
                if min(heights.shape) > 1 else 0)
    return RELIEF.format(steeper=0.7 / (steepest or 1))


def colored(name, grid):
    """The colours and limits of the report."""
    unit, colors, _ = meaning(name)
    span = limits(visible(grid.values), unit) or {"vmin": 0.0, "vmax": 1.0}
    low, high = float(span["vmin"]), float(span["vmax"])
    items = [f'        <item value="{low + share * (high - low)!r}" '
             f'label="{low + share * (high - low):.4g} {unit}" alpha="255" '
             f'color="{to_hex(colormaps[colors](share))}"/>'
             for share in numpy.linspace(0, 1, N_COLORS)]
    return COLORED.format(low=low, high=high, items="\n".join(items))


def is_of_user(path):
    """Whether somebody has made or changed this style."""
    if not os.path.isfile(path):
        return False
    with open(path, **LENIENT) as stream:
        return MARK not in stream.read()


def write_styles(run):
    """A style beside each raster of a run in 3-D."""
    folder = run.path("maps")
    for name, grid in (read_maps(folder) if os.path.isdir(folder) else {}).items():
        path = os.path.join(folder, name + ".qml")
        if is_of_user(path):
            continue
        renderer = relief(grid) if name == GROUND else colored(name, grid)
        with open(path, "w", encoding="utf-8") as stream:
            # Slopes of cells that are drawn as squares would be stripes.
            stream.write(FRAME.format(mark=MARK, renderer=renderer, zoomed_in=(
                "cubic" if name == GROUND else "nearestNeighbour")))

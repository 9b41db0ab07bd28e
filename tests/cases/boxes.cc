// SPDX-License-Identifier: LGPL-2.1-or-later
// What the boxes of the points, as they are written, cover of the soil.

#include "landslide.h"

#include <talus/base/errors.h>
#include <talus/observers/boxes.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace talus;
using namespace talus::cases;

namespace
{
  struct Boxes
  {
    double cover = 0.; // sum of their areas over that of the soil
    double longest =
      0.; // side before it is cut to what the weights allow, cells
  };

  Boxes
  boxes_at(const std::string &file,
           const double       time,
           const Overrides   &overrides)
  {
    Case<2> slide(file, overrides);
    while (slide->state().time < time)
      slide->advance();
    const auto      &state  = slide->state();
    const Points<2> &points = state.points;
    Boxes            boxes;
    double           area = 0., soil = 0.;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto lengths = box_lengths(state, p);
        area += lengths[0] * lengths[1];
        soil += volume_of_points<2, double>(points, p);
        for (unsigned int d = 0; d < 2; ++d)
          boxes.longest =
            std::max(boxes.longest,
                     points.data(points.box_length, d)[p] /
                       state.grid.cells()[points.cell_of(p)].size);
      }
    boxes.cover = area / soil;
    return boxes;
  }
} // namespace



TEST(Boxes, CoverTheSlideOnce)
{
  Verification    gates("Boxes of the landslide at rest, h = 0.5 m",
                     "prm/landslide-quick.prm, Grid/Cell size=0.5, "
                        "Splitting/Directions=stretched, "
                        "Splitting/Shear=ignored",
                     "the area of the soil");
  const Overrides coarse = {"Grid/Cell size=0.5",
                            "Splitting/Directions=stretched",
                            "Splitting/Shear=ignored"};
  const Boxes     boxes  = boxes_at("landslide-quick.prm", 30., coarse);
  gates.at_most("sum of the boxes over the soil, - 1",
                std::abs(boxes.cover - 1.),
                0.1);
  gates.at_most("longest side of a box [cells]", boxes.longest, 1.);
}



TEST(Boxes, CoverABlockThatSpreadsWithoutSlip)
{
  Verification gates("Boxes of a block that spreads on a base without slip",
                     "prm/verification/spreading-block.prm",
                     "the area of the soil");
  const Boxes  boxes = boxes_at("verification/spreading-block.prm", 10., {});
  gates.falls_short("sum of the boxes over the soil",
                    boxes.cover,
                    1.2,
                    {1.4,
                     "points at the limit of generations: noise of the "
                     "velocities stretches thin soil"});
}

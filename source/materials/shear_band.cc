// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/shear_band.h>

namespace talus
{
  // Softening has no length scale, so shear bands are as wide as cells of size
  // h: the strain of softening is reached by the displacement xi h, and the
  // work is G_f = h times the work per volume (doc/method.md, section 4). The
  // remark gives both numbers for h and h/2. Otherwise users might compare
  // results on two meshes that belong to two different materials.
  std::string
  shear_band_note(const Softening   &softening,
                  const double       cell_size,
                  const std::string &advice)
  {
    const auto numbers = [&](const double h) {
      return text(std::setprecision(6),
                  softening.strain * h,
                  " m and ",
                  softening.work * h,
                  " J/m^2 on cells of ",
                  h,
                  " m");
    };
    return text(std::setprecision(6),
                "The material of section ",
                softening.section,
                " softens, and a shear band settles in about one row of cells, "
                "so the results depend on the cell size: the displacement "
                "across the band that takes away ",
                softening.share_of_loss,
                " of the strength loss, and the work per area above the "
                "remaining strength, are ",
                numbers(cell_size),
                ", but ",
                numbers(cell_size / 2.),
                ". When you change the cell size, ",
                advice);
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/shear_band.h>

namespace talus
{
  // The widths of shear bands are those of the cells, as softening has no
  // length of its own here: with h the strain to soften is reached over the
  // displacement xi h, at the work G_f = h times that per volume
  // (doc/method.md, section 4). The user is told both, for h and h/2, because
  // results on two meshes would else be compared that are those of two
  // materials.
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
                " of the strength there is to lose, and the work per area "
                "above the strength that remains, are ",
                numbers(cell_size),
                ", but ",
                numbers(cell_size / 2.),
                ". When you change the cell size, ",
                advice);
  }
} // namespace talus

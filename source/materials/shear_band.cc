// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/shear_band.h>

namespace talus
{
  // Softening by strain has no length scale, so shear bands are as wide as
  // cells of size h: the strain of softening is reached by the displacement xi
  // h, and the work is G_f = h times the work per volume (doc/method.md,
  // section 4). The remark gives both numbers for h and h/2. Otherwise users
  // might compare results on two meshes that belong to two different materials.
  Remark
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
    return {text(std::setprecision(6),
                 "the material softens, and a shear band is as wide as its row "
                 "of cells (2.0 "
                 "to 2.7 cells if inclined), so the results depend on the cell "
                 "size: the displacement across a row that takes away ",
                 softening.share_of_loss,
                 " of the strength loss, and the work per area above the "
                 "remaining strength, are ",
                 numbers(cell_size),
                 ", but ",
                 numbers(cell_size / 2.),
                 ". Give `Softening displacement`, which holds on cells of any "
                 "size; or, when you change the cell size, ",
                 advice),
            Severity::look,
            "section " + softening.section};
  }



  // The widths are those measured in a slab on a weak row (doc/method.md,
  // section 4).
  Remark
  band_note(const SofteningOfBand &softening)
  {
    return {
      text(std::setprecision(6),
           "the material softens with the displacement across a shear band: ",
           softening.displacement,
           " m take away ",
           softening.share_of_loss,
           " of the strength loss, with a work of ",
           softening.work,
           " J/m^2 above the remaining strength, in a band along a row of "
           "cells of any size. A band that crosses rows at an angle is 2.0 "
           "to 2.7 cells wide and takes as many times both."),
      Severity::information,
      "section " + softening.section};
  }
} // namespace talus

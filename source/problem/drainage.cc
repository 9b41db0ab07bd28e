// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/drainage.h>

#include <cmath>

namespace talus
{
  template <int dim>
  std::vector<Remark>
  notes_on_drainage(const Materials<dim>             &materials,
                    const std::vector<BodyThickness> &bodies,
                    const double                      duration)
  {
    std::vector<Remark> notes;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const std::string        subject = "body '" + bodies[b].body + "'";
        const WaterResponse<dim> water   = materials.of_body(b).pore_water();
        if (water.stiffness > 0.)
          notes.emplace_back(text(std::setprecision(4),
                                  "the pore water has a stiffness K_f of ",
                                  water.stiffness,
                                  " Pa, so that Skempton's B is ",
                                  1. / (1. + water.soil_bulk / water.stiffness),
                                  "."),
                             Severity::information,
                             subject);
        const double way = std::sqrt(water.consolidation * duration);
        if (way == 0.)
          continue;
        const double h = bodies[b].cell_size, thickness = bodies[b].n_cells * h;
        const std::string given =
          water.stiffness > 0. ? "undrained" : "drained";
        const std::string right = way < h ? "undrained"
                                  : way > thickness
                                    ? "drained"
                                    : "neither drained nor undrained";
        notes.emplace_back(text(std::setprecision(3),
                                "in ",
                                duration,
                                " s water moves ",
                                way,
                                " m (c_v ",
                                water.consolidation,
                                " m^2/s), a cell is ",
                                h,
                                " m and the soil ",
                                thickness,
                                " m thick: ",
                                right,
                                " is right",
                                given == right
                                  ? "."
                                  : ", but 'Pore water/Drainage' is '" + given +
                                      "'. Compare with a run of the other."),
                           given == right ? Severity::information
                                          : Severity::look,
                           subject);
      }
    return notes;
  }



  template decltype(notes_on_drainage<2>) notes_on_drainage<2>;
  template decltype(notes_on_drainage<3>) notes_on_drainage<3>;
} // namespace talus

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
        const bool               is_undrained = water.stiffness > 0.;
        if (is_undrained)
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
        const bool stays    = way<h, crosses = way> thickness;
        const bool is_right = is_undrained ? stays : crosses;
        notes.emplace_back(
          text(std::setprecision(3),
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
               stays     ? "undrained is right"
               : crosses ? "drained is right"
                         : "run both drained and undrained, the ends of what "
                           "is possible",
               is_right ? "."
                        : text(", but 'Pore water/Drainage' is '",
                               is_undrained ? "undrained'." : "drained'.")),
          is_right ? Severity::information : Severity::look,
          subject);
      }
    return notes;
  }



  template decltype(notes_on_drainage<2>) notes_on_drainage<2>;
  template decltype(notes_on_drainage<3>) notes_on_drainage<3>;
} // namespace talus

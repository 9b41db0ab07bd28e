// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/stiffness.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Ratio of a load to a modulus [-], up to which elastic strains do not
    /// count.
    struct LoadRatio
    {
      std::string name;
      double      value, limit;
    };



    // The limits are measured at a dam break
    // (doc/verification/experiments.md#stiffness). Volume counts less than
    // shape: soil that is compressed runs out a little less far.
    std::vector<LoadRatio>
    load_ratios(const double weight,
                const double G,
                const double K,
                const double strain_at_yield)
    {
      return {{"rho' g H/G", weight / G, 0.5},
              {"rho' g H/K", weight / K, 0.1},
              {"s_u/G", strain_at_yield, 0.5}};
    }



    /// Round up to two digits.
    double
    rounded_up(const double value)
    {
      const double digit = std::pow(10., std::floor(std::log10(value)) - 1.);
      return std::ceil((1. - 1e-9) * value / digit) * digit;
    }



    /// @param weight of the soil per area, Pa
    /// @param largest shear modulus, Pa, wave modulus, Pa, and strength over
    ///   shear modulus [-]
    std::string
    sentence_on_stiffness(const double                 weight,
                          const std::array<double, 3> &largest)
    {
      const double G = largest[0], M = largest[1];
      std::string  excess;
      double       factor = 1.;
      for (const LoadRatio &ratio :
           load_ratios(weight, G, M - 4. / 3. * G, largest[2]))
        if (ratio.value > ratio.limit)
          {
            excess += text(std::setprecision(3),
                           excess.empty() ? "" : ", ",
                           ratio.name,
                           " = ",
                           ratio.value,
                           " where at most ",
                           ratio.limit,
                           " was expected");
            factor = std::max(factor, ratio.value / ratio.limit);
          }
      if (excess.empty())
        return "";
      const double young_modulus = G * (3. * M - 4. * G) / (M - G);
      return text(
        std::setprecision(3),
        "the soil is too soft: ",
        excess,
        ", with the weight rho' g H = ",
        weight,
        " Pa of the thickest soil. Elastic strains are then a part of "
        "the motion, and soil runs out too far. A Young's modulus ",
        factor,
        " times larger is enough: ",
        rounded_up(factor * young_modulus),
        " Pa where the soil is stiffest.");
    }
  } // namespace



  template <int dim>
  std::vector<Remark>
  notes_on_stiffness(const Points<dim>                &points,
                     const Materials<dim>             &materials,
                     const std::vector<BodyThickness> &bodies,
                     const double                      gravity,
                     const MPI_Comm                    communicator)
  {
    std::vector<Remark> notes;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const MaterialModel<dim> &law = materials.of_body(b);
        if (!law.has_strength())
          continue;
        std::array<double, 3> largest{};
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            {
              const double G = law.largest_shear_modulus(points, p, p + 1);
              double       M = 0.;
              law.wave_modulus(points, p, p + 1, &M);
              largest = {
                {std::max(largest[0], G),
                 std::max(largest[1], M),
                 std::max(largest[2], law.shear_strength(points, p) / G)}};
            }
        for (double &value : largest)
          value = Utilities::MPI::max(value, communicator);
        if (largest[0] > 0.)
          notes.emplace_back(
            sentence_on_stiffness(law.submerged_density() * gravity *
                                    bodies[b].n_cells * bodies[b].cell_size,
                                  largest),
            Severity::look,
            "body '" + bodies[b].body + "'");
      }
    return notes;
  }



  template decltype(notes_on_stiffness<2>) notes_on_stiffness<2>;
  template decltype(notes_on_stiffness<3>) notes_on_stiffness<3>;
} // namespace talus

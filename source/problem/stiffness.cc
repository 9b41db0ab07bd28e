// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/stiffness.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <tuple>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // The limits are measured at a dam break
    // (doc/verification/experiments.md#stiffness). Volume counts less than
    // shape: soil that is compressed runs out a little less far.
    /// Return a remark on the ratios of loads to moduli; empty within limits.
    /// @param weight of the soil per area, Pa
    /// @param G shear modulus, Pa
    /// @param M wave modulus, Pa
    /// @param strain at yield, the strength over G [-]
    std::string
    sentence_on_stiffness(const double weight,
                          const double G,
                          const double M,
                          const double strain)
    {
      const double K = M - 4. / 3. * G, E = 9. * K * G / (3. * K + G);
      std::string  excess;
      double       factor = 1.;
      for (const auto &[name, ratio, limit] :
           {std::tuple("rho' g H/G", weight / G, 0.5),
            std::tuple("rho' g H/K", weight / K, 0.1),
            std::tuple("s_u/G", strain, 0.5)})
        if (ratio > limit)
          {
            excess += text(std::setprecision(3),
                           name,
                           " = ",
                           ratio,
                           " where at most ",
                           limit,
                           " was expected, ");
            factor = std::max(factor, ratio / limit);
          }
      if (excess.empty())
        return "";
      return text(
        std::setprecision(3),
        "the soil is too soft: ",
        excess,
        "with the weight rho' g H = ",
        weight,
        " Pa of the thickest soil. Elastic strains are then a part of "
        "the motion, and soil runs out too far. Make `Young's "
        "modulus` ",
        1.01 * factor,
        " times larger, ",
        1.01 * factor * E,
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
        // The stiffness of clay by its stress is not for the user to choose.
        if (!law.has_strength() || law.overconsolidation_ratio() != nullptr)
          continue;
        double G = 0., M = 0., strain = 0.; // the largest
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            {
              const double modulus =
                law.largest_shear_modulus(points, p, p + 1);
              double wave_modulus = 0.;
              law.wave_modulus(points, p, p + 1, &wave_modulus);
              G = std::max(G, modulus);
              M = std::max(M, wave_modulus);
              strain =
                std::max(strain, law.shear_strength(points, p) / modulus);
            }
        for (double *const value : {&G, &M, &strain})
          *value = Utilities::MPI::max(*value, communicator);
        if (G > 0.)
          notes.emplace_back(
            sentence_on_stiffness(law.submerged_density() * gravity *
                                    bodies[b].n_cells * bodies[b].cell_size,
                                  G,
                                  M,
                                  strain),
            Severity::look,
            "body '" + bodies[b].body + "'");
      }
    return notes;
  }



  template decltype(notes_on_stiffness<2>) notes_on_stiffness<2>;
  template decltype(notes_on_stiffness<3>) notes_on_stiffness<3>;
} // namespace talus

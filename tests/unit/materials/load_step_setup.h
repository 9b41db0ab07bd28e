// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_load_step_setup_h
#define talus_tests_unit_load_step_setup_h

#include <talus/base/errors.h>

#include "specimen.h"

// Laws in a load step of the search for equilibrium, at one point.

namespace
{
  using namespace talus;

  const Elastic clay{250e3, 0.3};

  /// A law, its parameters and where the load step starts and goes.
  struct LoadCase
  {
    std::string name;
    std::string law;
    std::string more; ///< parameters besides the elastic ones

    bool   flows           = false;
    double plastic         = 0.; ///< plastic variable at the start
    double strength_factor = 0.; ///< 0: there is no such column
    double softening       = 0.; ///< column at the start, if there is one
  };



  constexpr double size_of_cell = 0.5; // m



  inline const std::vector<LoadCase> &
  load_cases()
  {
    const std::string su     = "set Undrained shear strength = 2500\n";
    const std::string harder = su + "set Hardening modulus = 60e3\n";
    const std::string softer = su +
                               "set Hardening modulus = -30e3\n"
                               "set Residual undrained shear strength = 600\n";
    const std::string remoulds = su +
                                 "set Remoulded strength ratio = 0.3\n"
                                 "set Plastic shear strain to remould = 2\n";
    static const std::vector<LoadCase> cases = {
      {"elastic", "linear elastic", ""},
      {"von Mises, elastic", "von Mises", su},
      {"von Mises", "von Mises", su, true},
      {"hardening", "von Mises", harder, true, 0.02},
      {"softening", "von Mises", softer, true, 0.01},
      {"residual", "von Mises", softer, true, 0.3},
      {"hardening, weakened", "von Mises", harder, true, 0.02, 0.6},
      {"softening, weakened", "von Mises", softer, true, 0.01, 0.6},
      {"Bingham", "Bingham", remoulds + "set Viscosity = 40", true, 0.3},
      {"Bingham, elastic", "Bingham", su + "set Viscosity = 40"},
      {"Bingham, weakened",
       "Bingham",
       remoulds + "set Viscosity = 40",
       true,
       0.3,
       0.6},
      {"Herschel-Bulkley",
       "Herschel-Bulkley",
       remoulds + "set Consistency = 200",
       true,
       0.3},
      // The same curves by displacement: d = 3 (s_u - s_res) h/30e3, d = 2 h.
      {"von Mises by displacement",
       "von Mises",
       su + "set Softening displacement = 0.095\n"
            "set Residual undrained shear strength = 600\n",
       true,
       0.01,
       0.,
       std::sqrt(3.) * 0.01 * size_of_cell / 0.095},
      {"Bingham by displacement, weakened",
       "Bingham",
       su + "set Remoulded strength ratio = 0.3\n"
            "set Softening displacement = 1\nset Viscosity = 40",
       true,
       0.3,
       0.6,
       0.3 * size_of_cell / 1.}};
    return cases;
  }



  /// A point in a stressed and deformed state, and a displacement gradient
  /// that makes it flow or not as the case says.
  template <int dim>
  struct LoadStep : Specimen<dim>
  {
    using Gradient = Matrix<dim, double>;
    using Base     = Specimen<dim>;
    using Base::law;
    using Base::points;
    using Base::workspace;

    LoadStep(const LoadCase &load_case, const unsigned int sample)
      : Base(load_case.law, clay.parameters(load_case.more))
    {
      std::mt19937 random(sample);
      const bool   is_calm = law->has_strength() && !load_case.flows;
      this->set_F(
        add(identity<dim, double>(), random_matrix<dim>(random, 0.15), 1.));
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        points.data(points.stress, c)[0] =
          (is_calm ? 0.1 : 1.) * random_matrix<dim>(random, 1500.)[0][0];
      for (const Column &column : points.columns())
        if (column.name.find("plastic") == 0 && column.unit == "-")
          plastic = column.first;
      for (const Column &column : points.columns())
        if (column.name == "softening")
          {
            points.data(column.first)[0]             = load_case.softening;
            points.data(points.find("cell size"))[0] = size_of_cell;
          }
      if (plastic != dealii::numbers::invalid_unsigned_int)
        points.data(plastic)[0] = load_case.plastic;
      if (load_case.strength_factor > 0.)
        {
          const unsigned int column =
            points.add_column("strength factor", "-", 1, Inheritance::copied);
          points.data(column)[0] = load_case.strength_factor;
          law->use_strength_factor(column);
        }
      H = random_matrix<dim>(random, is_calm ? 2e-3 : 0.06);
      if (load_case.flows)
        {
          H[0][1] += 0.1;
          H[1][0] += 0.1;
        }
      set_gradient(H);
    }

    void
    set_gradient(const Gradient &gradient)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          workspace.velocity_gradient(i, j)[0] = gradient[i][j];
    }

    /// At the displacement gradient @p gradient.
    StressTangent<dim>
    linearization(const Gradient &gradient)
    {
      StressTangent<dim> result;
      set_gradient(gradient);
      law->linearize(points, workspace, 0, 1, &result);
      set_gradient(H);
      return result;
    }

    double
    plastic_variable() const
    {
      return points.data(plastic)[0];
    }

    Gradient     H;
    unsigned int plastic = dealii::numbers::invalid_unsigned_int;
  };



  constexpr unsigned int n_samples = 12;

  /// Call action(load case, sample) for all cases and several samples of each.
  template <int dim, typename Action>
  void
  for_load_steps(const Action &action)
  {
    for (const LoadCase &load_case : load_cases())
      for (unsigned int sample = 1; sample <= n_samples; ++sample)
        {
          SCOPED_TRACE(text(dim, "-D, ", load_case.name, ", sample ", sample));
          action(load_case, sample);
        }
  }



  /// The tangent against central differences of the stress, over the shear
  /// modulus. Returns the largest error.
  template <int dim>
  double
  error_of_tangent(LoadStep<dim> &step)
  {
    const double eps     = 1e-6;
    const auto   tangent = step.linearization(step.H).tangent;
    double       error   = 0.;
    for (unsigned int k = 0; k < dim * dim; ++k)
      {
        auto plus = step.H, minus = step.H;
        plus[k / dim][k % dim] += eps;
        minus[k / dim][k % dim] -= eps;
        const auto P_plus  = step.linearization(plus).stress;
        const auto P_minus = step.linearization(minus).stress;
        for (unsigned int i = 0; i < dim * dim; ++i)
          error = std::max(error,
                           std::abs(tangent[i][k] -
                                    (P_plus[i] - P_minus[i]) / (2. * eps)));
      }
    return error / clay.mu;
  }
} // namespace

#endif

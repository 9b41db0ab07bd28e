// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/kinematics_kernel.h>
#include <talus/materials/material_model.h>
#include <talus/materials/pore_water.h>
#include <talus/points/points_kernel.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  PoreWater::PoreWater(const std::string &section)
    : ParameterAcceptor(section + "/Pore water")
  {
    add_parameter("Drainage",
                  drainage_,
                  "drained: water flows as the soil needs it, and the excess "
                  "pore pressure is that of the section `Excess pore "
                  "pressure`; undrained: water stays in the soil, and its "
                  "pressure follows the volume of the soil. The strength must "
                  "then be one in effective stress.",
                  this->prm,
                  Patterns::Selection("drained|undrained"));
    add_parameter("Undrained Poisson's ratio",
                  undrained_poisson_ratio_,
                  "Poisson's ratio nu_u of soil and water together [-], for "
                  "the stiffness of the water, K_f = 3 (nu_u - nu)/((1 - 2 "
                  "nu_u)(1 + nu)) K. With 0.49 time steps are those of "
                  "undrained clay.",
                  this->prm,
                  Patterns::Double(0., 0.4999));
    add_parameter("Stiffness",
                  stiffness_,
                  "Stiffness K_f of the water, bulk modulus over porosity "
                  "[Pa]. Empty: by `Undrained Poisson's ratio`.",
                  this->prm,
                  Patterns::List(Patterns::Double(1.), 0, 1));
    add_parameter("Largest suction",
                  largest_suction_,
                  "Excess pore pressure below zero at which the water "
                  "cavitates [Pa], about the pressure of the air and of the "
                  "water above. Empty: never.",
                  this->prm,
                  Patterns::List(Patterns::Double(0.), 0, 1));
    add_parameter("Coefficient of consolidation",
                  consolidation_,
                  "Coefficient c_v [m^2/s]: the log then says how far water "
                  "moves in the run, and whether `Drainage` is right. Empty: "
                  "not known.",
                  this->prm,
                  Patterns::List(Patterns::Double(1e-20), 0, 1));
  }



  void
  PoreWater::check(const double poisson_ratio) const
  {
    AssertThrow(!is_undrained() || !stiffness_.empty() ||
                  undrained_poisson_ratio_ > poisson_ratio,
                ExcUser(text("'",
                             get_section_path().back(),
                             "': `Undrained Poisson's ratio` is ",
                             undrained_poisson_ratio_,
                             ", not more than `Poisson's ratio`, ",
                             poisson_ratio,
                             ": the water would have no stiffness. Give a "
                             "number between the two and 0.5, 0.49 for "
                             "instance.")));
  }



  double
  PoreWater::stiffness(const double poisson_ratio, const double bulk) const
  {
    if (!is_undrained())
      return 0.;
    if (!stiffness_.empty())
      return stiffness_.front();
    const double nu_u = undrained_poisson_ratio_;
    return 3. * (nu_u - poisson_ratio) /
           ((1. - 2. * nu_u) * (1. + poisson_ratio)) * bulk;
  }



  template <int dim>
  void
  WaterResponse<dim>::advance(Points<dim>              &points,
                              const StepWorkspace<dim> &workspace,
                              const unsigned int        begin,
                              const unsigned int        end,
                              const double              dt) const
  {
    if (!points.have_pore_pressure())
      return;
    const auto    columns = points.view();
    const auto    work    = workspace.view(begin, end);
    double *const u       = points.data(points.pore_pressure());
    const double  least   = -largest_suction;
    for_each_simd(
      begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number = decltype(number);
        auto H       = load_velocity_gradient<dim, Number>(work, p);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            H[i][j] *= dt;
        const Number growth = log(1. + determinant_increment<dim, Number>(H));
        const Number before = load<Number>(u + p);
        if (stiffness > 0.)
          store(u + p, max(Number(before - stiffness * growth), Number(least)));
        else
          {
            const Number mean =
              mean_normal(load_stress<dim, Number>(columns, p));
            const Number loss     = soil_bulk * max(growth, Number(0.));
            const Number lowered  = max(Number(before - loss), Number(0.));
            const auto   is_loose = mean + 1e-3 * before > Number(0.);
            store(u + p, select(is_loose, min(before, lowered), before));
          }
      });
  }



  namespace
  {
    /// Pressure at the end of a load step, Pa, and its derivative by the change
    /// of volume.
    template <int dim>
    std::pair<double, double>
    pressure_after(const WaterResponse<dim> &water,
                   const double              u,
                   const WorkspaceView<dim> &workspace,
                   const unsigned int        p)
    {
      double change = 0;
      for (unsigned int d = 0; d < dim; ++d)
        change += workspace.velocity_gradient(d, d)[p];
      const double after = u - water.stiffness * change;
      if (water.stiffness > 0. && after < -water.largest_suction)
        return {-water.largest_suction, 0.};
      return {after, -water.stiffness};
    }
  } // namespace



  template <int dim>
  void
  WaterResponse<dim>::linearize(const Points<dim>        &points,
                                const StepWorkspace<dim> &workspace,
                                const unsigned int        begin,
                                const unsigned int        end,
                                StressTangent<dim>       *linearization) const
  {
    const auto work = workspace.view(begin, end);
    for (unsigned int p = begin; p < end; ++p, ++linearization)
      {
        const auto [u, slope] = pressure_after(
          *this, points.data(points.pore_pressure())[p], work, p);
        for (unsigned int i = 0; i < dim * dim; i += dim + 1)
          {
            linearization->stress[i] -= u;
            for (unsigned int j = 0; j < dim * dim; j += dim + 1)
              linearization->tangent[i][j] -= slope;
          }
      }
  }



  template <int dim>
  void
  WaterResponse<dim>::commit_load_step(Points<dim>              &points,
                                       const StepWorkspace<dim> &workspace,
                                       const unsigned int        begin,
                                       const unsigned int        end) const
  {
    if (stiffness == 0.)
      return;
    const auto    work = workspace.view(begin, end);
    double *const u    = points.data(points.pore_pressure());
    for (unsigned int p = begin; p < end; ++p)
      u[p] = pressure_after(*this, u[p], work, p).first;
  }



  template struct WaterResponse<2>;
  template struct WaterResponse<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_undrained_law_templates_h
#define talus_materials_undrained_law_templates_h

#include <talus/materials/rate_effect_kernel.h>
#include <talus/materials/rate_law.templates.h>
#include <talus/materials/undrained_law.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace talus
{
  template <int dim, typename FlowRule>
  UndrainedLaw<dim, FlowRule>::UndrainedLaw(const std::string &section,
                                            const std::string &plastic_variable,
                                            const std::string &sentence,
                                            const std::string &softening_strain)
    : RateLaw<dim, FlowRule>(section, plastic_variable)
  {
    using dealii::ParameterAcceptor;
    namespace Patterns = dealii::Patterns;
    this->add_parameter(
      "Undrained shear strength",
      strength_.words(),
      sentence +
        " A number, an expression in x, y (, z), the depth below the mudline "
        "and the names of surfaces, as 2000 + 1500*depth*ratio, or 'table "
        "FILE': a CSV file with the "
        "columns 'depth [m]' and 'undrained shear strength [Pa]'. Place and "
        "depth [m] are taken at the start, without initial displacement; the "
        "strength moves with the soil.");
    this->add_parameter(
      "Stiffness ratio",
      stiffness_ratio_,
      "Young's modulus over the undrained shear strength of undisturbed soil, "
      "E/s_u [-], at each point; replaces `Young's modulus`. Empty: `Young's "
      "modulus` is used.",
      ParameterAcceptor::prm,
      Patterns::List(Patterns::Double(1e-12), 0, 1));
    this->add_parameter(
      "Softening displacement",
      softening_displacement_,
      "Displacement d across a shear band [m] over which the strength falls to "
      "the residual strength (under Bingham and Herschel-Bulkley by 95 % of "
      "the "
      "loss), on cells of any size: the band is taken to be as wide as the "
      "cell "
      "of the point. A band along a row of cells is one cell wide. An inclined "
      "band is 2.0 to 2.7 cells wide, on any mesh, and so needs 2.0 to 2.7 d. "
      "Replaces " +
        softening_strain + ". Empty: that is used.",
      ParameterAcceptor::prm,
      Patterns::List(Patterns::Double(1e-12), 0, 1));
    this->add_parameter(
      "Rate coefficient",
      rate_coefficient_,
      "Gain of strength per decade of the shear rate [-], 0.05 to 0.2 in clay: "
      "soil sheared plastically at the rate gdot has R = 1 + mu/ln(10) "
      "asinh(gdot/gdot_ref) times the strength. Static stages are infinitely "
      "slow, R = 1. 0: no rate effect.",
      ParameterAcceptor::prm,
      Patterns::Double(0.));
    this->add_parameter(
      "Reference shear rate",
      reference_rate_,
      "Shear rate gdot_ref [1/s] below which the strength is the undrained "
      "shear strength: the rate of the test that gave the strength, such as "
      "3e-6 (1 % per hour) in the laboratory, about 0.5 with a T-bar.",
      ParameterAcceptor::prm,
      Patterns::Double(1e-12));
    strength_.variation().add_parameters(*this);
  }



  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::check_softening_is_given_once(
    const bool is_given, const std::string &other) const
  {
    AssertThrow(!softens_by_displacement() || !is_given,
                ExcUser(text("Section ",
                             this->section(),
                             ": both `Softening displacement` and `",
                             other,
                             "` are given, but the strength softens by one of "
                             "them: remove the other.")));
  }



  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::check() const
  {
    RateLaw<dim, FlowRule>::check();
    strength_.variation().check(dim, this->section());
    AssertThrow(!has_moduli_of_points() || this->pore_water().stiffness == 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Stiffness ratio` makes the soil stiff in "
                             "proportion to its strength, but undrained pore "
                             "water needs one Young's modulus for its "
                             "stiffness. Remove the ratio, or let `Pore "
                             "water/Drainage` be drained.")));
  }



  namespace internal
  {
    // Soil is not sheared faster, 1/s.
    inline constexpr double highest_shear_rate = 1e4;
  } // namespace internal



  template <int dim, typename FlowRule>
  double
  UndrainedLaw<dim, FlowRule>::steepening_by_rate() const
  {
    const double m = rate_coefficient_ / std::log(10.);
    return 1. +
           m *
             (std::asinh(internal::highest_shear_rate / reference_rate_) + 2.);
  }



  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::check_strength(const StrengthRange &range) const
  {
    AssertThrow(range.least > 0. || !has_moduli_of_points(),
                ExcUser(text("Section ",
                             this->section(),
                             ": `Undrained shear strength` is ",
                             range.least,
                             " Pa, but the stiffness is proportional to it. "
                             "Give a positive number.")));
    const double largest = this->largest_strength_factor(range);
    AssertThrow(
      largest >= 1.,
      ExcUser(text("Section ",
                   this->section(),
                   ": with `Undrained shear strength` of up to ",
                   range.largest,
                   " Pa the material would soften faster than it can unload "
                   "elastically. Give ",
                   softens_by_displacement()
                     ? text("a `Softening displacement` of at least ",
                            softening_displacement() / largest,
                            " m, or a `Grid/Cell size` of at most ",
                            largest * this->largest_cell_size(),
                            " m")
                     : slower_softening(1. / largest),
                   has_rate_effect() ? ", a smaller `Rate coefficient`" : "",
                   ", or more stiffness.")));
  }



  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::add_columns(Points<dim> &points)
  {
    RateLaw<dim, FlowRule>::add_columns(points);
    strength_column_ = points.add_column("undrained shear strength",
                                         "Pa",
                                         1,
                                         Inheritance::copied);
    if (!softens_by_displacement())
      return;
    softening_column_ =
      points.add_column("softening", "-", 1, Inheritance::copied);
    cell_size_column_ =
      points.add_column("cell size", "m", 1, Inheritance::copied);
  }



  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::initialize(Points<dim>       &points,
                                          const unsigned int begin,
                                          const unsigned int end) const
  {
    RateLaw<dim, FlowRule>::initialize(points, begin, end);
    double *const strength = points.data(strength_column_);
    std::fill(strength + begin,
              strength + end,
              strength_.number().value_or(0.));
  }



  // Softening by displacement is the shear across a band as wide as the cell,
  // over the displacement.
  template <int dim, typename FlowRule>
  StrengthOfPoints
  UndrainedLaw<dim, FlowRule>::strength_of(const Points<dim> &points) const
  {
    StrengthOfPoints strength = RateLaw<dim, FlowRule>::strength_of(points);
    strength.strength.column  = points.data(strength_column_);
    if (has_moduli_of_points())
      strength.stiffness = strength.strength;
    if (!softens_by_displacement())
      return strength;
    strength.cell_size.column = points.data(cell_size_column_);
    strength.softening_rate =
      shear_per_plastic_variable() / softening_displacement();
    strength.softening_column = softening_column_;
    return strength;
  }



  template <int dim, typename FlowRule>
  double
  UndrainedLaw<dim, FlowRule>::shear_strength(const Points<dim> &points,
                                              const unsigned int p) const
  {
    return this->flow_rule(infinitely_slow)
             .curve(this->softening(points, p),
                    strength_of(points)(p, double()))
             .strength /
           shear_per_plastic_variable();
  }



  // A flow rule of its own, so that soil without rate effect does not pay.
  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::update_stress(
    Points<dim>              &points,
    const StepWorkspace<dim> &workspace,
    const unsigned int        begin,
    const unsigned int        end,
    const double              dt) const
  {
    const FlowRule rule = this->flow_rule(dt);
    if (!has_rate_effect())
      this->update_stress_by(rule, points, workspace, begin, end, dt);
    else
      this->update_stress_by(
        RateDependentFlow<FlowRule>{rule,
                                    {rate_coefficient_ / std::log(10.),
                                     reference_rate_ * dt /
                                       shear_per_plastic_variable()}},
        points,
        workspace,
        begin,
        end,
        dt);
  }



  template <int dim, typename FlowRule>
  void
  UndrainedLaw<dim, FlowRule>::wave_modulus(const Points<dim> &points,
                                            const unsigned int begin,
                                            const unsigned int end,
                                            double            *modulus) const
  {
    RateLaw<dim, FlowRule>::wave_modulus(points, begin, end, modulus);
    if (has_moduli_of_points())
      std::transform(modulus,
                     modulus + (end - begin),
                     points.data(strength_column_) + begin,
                     modulus,
                     std::multiplies<>());
  }



  template <int dim, typename FlowRule>
  double
  UndrainedLaw<dim, FlowRule>::largest_shear_modulus(
    const Points<dim> &points,
    const unsigned int begin,
    const unsigned int end) const
  {
    const double mu = this->moduli().mu;
    if (!has_moduli_of_points() || begin == end)
      return mu;
    const double *strength = points.data(strength_column_);
    return mu * *std::max_element(strength + begin, strength + end);
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/modified_cam_clay.h>
#include <talus/materials/rate_law.templates.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using dealii::ParameterAcceptor;
  namespace Patterns = dealii::Patterns;

  template <int dim>
  ModifiedCamClay<dim>::ModifiedCamClay(const std::string &section)
    : RateLaw<dim, CamClayFlow>(section, "preconsolidation pressure", "Pa")
  {
    const auto add = [&](const std::string &name,
                         double            &value,
                         const std::string &sentence,
                         const double       largest =
                           Patterns::Double::max_double_value) {
      this->add_parameter(name,
                          value,
                          sentence,
                          ParameterAcceptor::prm,
                          Patterns::Double(0., largest));
    };
    add("Friction angle",
        friction_angle_,
        "Effective friction angle phi' at the critical state [degrees], where "
        "clay shears at constant volume and stress, for any direction of "
        "shear.",
        60.);
    add("Slope of compression line",
        compression_,
        "Slope lambda of normal compression [-]: loss of void ratio per "
        "natural logarithm of the mean effective stress, 0.434 C_c.");
    add("Slope of swelling line",
        swelling_,
        "Slope kappa of swelling and recompression [-], as lambda; 0.1 to "
        "0.3 lambda in clay. The bulk modulus is p' (1 + e_0)/kappa.");
    add("Initial void ratio", void_ratio_, "Void ratio e_0 at the start [-].");
    add("Attraction",
        attraction_,
        "Mean effective tension [Pa] at which the soil has no stiffness and no "
        "strength, added to the mean effective stress everywhere: soil at the "
        "mudline needs some.",
        1e6);
    this->add_parameter(
      "Overconsolidation ratio",
      ratio_,
      "Largest vertical effective stress of the past over that at the start "
      "[-], 1 or more: a number, an expression in x, y (, z), depth and the "
      "names of surfaces, or 'table FILE', a CSV file of the columns depth [m] "
      "and overconsolidation ratio [-].");
    this->add_parameter("K0 of normal compression",
                        K0_,
                        "Horizontal over vertical effective stress in the past "
                        "[-]. Empty: 1 - sin(phi').",
                        ParameterAcceptor::prm,
                        Patterns::List(Patterns::Double(0.), 0, 1));
  }



  template <int dim>
  void
  ModifiedCamClay<dim>::check() const
  {
    RateLaw<dim, CamClayFlow>::check();
    AssertThrow(swelling_ > 0. && compression_ > swelling_,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Slope of compression line` is ",
                             compression_,
                             " and `Slope of swelling line` is ",
                             swelling_,
                             ", but soil that yields loses more volume than "
                             "soil that swells back: give a positive slope of "
                             "swelling, and more for compression.")));
    AssertThrow(friction_angle_ > 0. && attraction_ > 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Friction angle` is ",
                             friction_angle_,
                             " degrees and `Attraction` is ",
                             attraction_,
                             " Pa. Give positive numbers; a small attraction, "
                             "100 Pa for instance, has no effect but at the "
                             "mudline.")));
  }



  template <int dim>
  void
  ModifiedCamClay<dim>::add_columns(Points<dim> &points)
  {
    RateLaw<dim, CamClayFlow>::add_columns(points);
    strength_column_ = points.add_column("undrained shear strength",
                                         "Pa",
                                         1,
                                         Inheritance::copied);
  }



  template <int dim>
  void
  ModifiedCamClay<dim>::initialize(Points<dim>       &points,
                                   const unsigned int begin,
                                   const unsigned int end) const
  {
    RateLaw<dim, CamClayFlow>::initialize(points, begin, end);
    double *const pressure =
      points.data(this->strength_of(points).softening_column);
    std::fill(pressure + begin, pressure + end, attraction_);
  }



  // In level ground q/p = 3 (1 - K0)/(1 + 2 K0), at the Lode angle of triaxial
  // compression, where M = 6 sin(phi)/(3 - sin(phi)).
  template <int dim>
  double
  ModifiedCamClay<dim>::consolidate(Points<dim>       &points,
                                    const unsigned int p,
                                    const double       vertical_stress,
                                    const double       ratio) const
  {
    const CamClayFlow rule    = flow_rule(infinitely_slow);
    const double      sine    = rule.sine(1.);
    const double      K0      = K0_.empty() ? 1. - sine : K0_.front();
    const double      largest = ratio * vertical_stress;
    const double      mean    = largest * (1. + 2. * K0) / 3. + attraction_;
    const double      slope   = 6. * sine / (3. - sine);
    const double past = mean + std::pow((1. - K0) * largest / slope, 2) / mean;

    StressStep<dim, double> now{};
    const auto              stress = load_stress<dim, double>(points, p);
    now.mean_after                 = mean_normal(stress);
    now.deviator_after             = add_mean(stress, -now.mean_after);
    const double pressure_now      = rule.pressure(now.mean_after);
    const double shear =
      rule.equation<dim, double>(now, 1., pressure_now, sine).shear;
    const double preconsolidation =
      std::max(past, pressure_now + shear * shear / pressure_now);
    points.data(this->strength_of(points).softening_column)[p] =
      preconsolidation;
    return points.data(strength_column_)[p] =
             sine * critical_pressure(pressure_now, preconsolidation);
  }



  template <int dim>
  void
  ModifiedCamClay<dim>::list_state(StateList &list)
  {
    list.add("largest initial pressure of " + this->get_section_path().back(),
             "Pa",
             largest_pressure_,
             Reduction::equal);
  }



  template <int dim>
  double
  ModifiedCamClay<dim>::pressure(const Points<dim> &points,
                                 const unsigned int p) const
  {
    auto sigma    = load_stress<dim, double>(points, p);
    auto strength = this->strength_of(points)(p, double());
    stiffen<dim>(flow_rule(infinitely_slow),
                 this->softening(points, p),
                 strength,
                 sigma);
    return strength.stiffness;
  }



  // Swelling line through the state, compression line through the yield
  // surface.
  template <int dim>
  double
  ModifiedCamClay<dim>::critical_pressure(const double pressure,
                                          const double preconsolidation) const
  {
    return pressure * std::pow(preconsolidation / (2. * pressure),
                               1. - swelling_ / compression_);
  }



  // At the Lode angle of the stress, sqrt(s:s/2) is the shear of the criterion
  // over a share that depends on the angle.
  template <int dim>
  double
  ModifiedCamClay<dim>::shear_strength(const Points<dim> &points,
                                       const unsigned int p) const
  {
    const double sine =
      flow_rule(infinitely_slow).sine(this->strength_factor(points, p));
    const double now = pressure(points, p);
    const double at_failure =
      this->pore_water().stiffness > 0.
        ? critical_pressure(now, this->softening(points, p))
        : now;
    return sine * at_failure /
           mohr_coulomb_share<dim>(load_stress<dim, double>(points, p), sine);
  }



  template <int dim>
  double
  ModifiedCamClay<dim>::largest_shear_modulus(const Points<dim> &points,
                                              const unsigned int begin,
                                              const unsigned int end) const
  {
    double largest = 0.;
    for (unsigned int p = begin; p < end; ++p)
      largest = std::max(largest, pressure(points, p));
    return this->moduli().mu * largest;
  }



  template <int dim>
  void
  ModifiedCamClay<dim>::wave_modulus(const Points<dim> &points,
                                     const unsigned int begin,
                                     const unsigned int end,
                                     double            *modulus) const
  {
    const double of_soil = this->moduli().longitudinal();
    const double water   = this->pore_water().stiffness;
    for (unsigned int p = begin; p < end; ++p)
      modulus[p - begin] = of_soil * pressure(points, p) + water;
  }



  template <int dim>
  double
  ModifiedCamClay<dim>::young_modulus() const
  {
    return 3. * (1. - 2. * this->poisson_ratio()) * (1. + void_ratio_) /
           swelling_;
  }



  template <int dim>
  CamClayFlow
  ModifiedCamClay<dim>::flow_rule(const double /*dt*/) const
  {
    const double volume = 1. + void_ratio_;
    return {std::tan(friction_angle_ * dealii::numbers::PI / 180.),
            this->moduli().mu,
            volume / swelling_,
            volume / (compression_ - swelling_),
            attraction_};
  }



  template class ModifiedCamClay<2>;
  template class ModifiedCamClay<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/herschel_bulkley.h>
#include <talus/materials/herschel_bulkley_kernel.h>
#include <talus/materials/shear_band.h>
#include <talus/materials/undrained_law.templates.h>

#include <limits>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

  // Bingham is the law with exponent 1. It is a separate law for the user only:
  // the unit of the consistency depends on the exponent, and for Bingham the
  // consistency is a viscosity in Pa s.
  template <int dim>
  HerschelBulkley<dim>::HerschelBulkley(const std::string &section,
                                        const FlowLaw      flow_law)
    : UndrainedLaw<dim, HerschelBulkleyFlow>(
        section,
        "plastic shear strain",
        "Undrained shear strength s_u [Pa]: the shear stress at which the "
        "undisturbed material yields in slow simple shear.",
        "`Plastic shear strain to remould`")
    , flow_law_(flow_law)
  {
    const auto add = [&](const std::string &name,
                         double            &value,
                         const std::string &sentence,
                         const Double      &range = Double(0.)) {
      this->add_parameter(name, value, sentence, ParameterAcceptor::prm, range);
    };
    if (flow_law_ == FlowLaw::bingham)
      add("Viscosity",
          consistency_,
          "Viscosity [Pa s]: increase of the shear stress of flowing material "
          "per rate of plastic shear.");
    else
      {
        exponent_ = 0.5;
        add("Consistency",
            consistency_,
            "Consistency K [Pa s^n]: at the rate gdot of plastic shear the "
            "shear stress is s_u + K gdot^n.");
        add("Flow exponent",
            exponent_,
            "Exponent n of the rate of plastic shear [-], more than 0; below 1 "
            "the material thins with the rate.");
      }
    add("Remoulded strength ratio",
        remoulded_ratio_,
        "Remoulded over undisturbed undrained shear strength [-], the inverse "
        "of the sensitivity. 1: no remoulding.",
        Double(0., 1.));
    add("Plastic shear strain to remould",
        strain_to_remould_,
        "Accumulated plastic shear strain xi_95 [-] at which 95 % of the "
        "strength loss by remoulding is reached: the loss remaining falls as "
        "exp(-3 xi/xi_95).");
  }



  template <int dim>
  void
  HerschelBulkley<dim>::check() const
  {
    UndrainedLaw<dim, HerschelBulkleyFlow>::check();
    AssertThrow(exponent_ > 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Flow exponent` is ",
                             exponent_,
                             ". Give a positive number; for strength that does "
                             "not depend on the rate set `Consistency` to "
                             "0.")));
    this->check_softening_is_given_once(strain_to_remould_ != default_strain,
                                        "Plastic shear strain to remould");
    AssertThrow(!this->softens_by_displacement() || remoulded_ratio_ < 1.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Softening displacement` is given, but "
                             "`Remoulded strength ratio` is 1, so that nothing "
                             "softens: give a ratio of less than 1, or remove "
                             "the displacement.")));
    AssertThrow(!this->has_rate_effect() || consistency_ == 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Rate coefficient` is more than 0, and ",
                             name_of_consistency(),
                             " is ",
                             consistency_,
                             ", but only one of them can describe how the "
                             "strength grows with the rate: set the other to "
                             "0.")));
  }



  // With the decay 3/xi_95, e^-3 or 5 % of the removable strength is left at
  // xi_95. Without remoulding the decay is 0, which saves the exponentials of
  // the iteration (stress_taken() in viscoplastic_return_kernel.h, which also
  // explains the implicit return). An explicit return would limit the time step
  // to the relaxation time of viscous soil, K/G for n = 1.
  template <int dim>
  HerschelBulkleyFlow
  HerschelBulkley<dim>::flow_rule(const double dt) const
  {
    return {remoulded_ratio_,
            {this->moduli().mu,
             consistency_,
             exponent_,
             softens() ? 3. / scale_of_softening() : 0.,
             dt}};
  }



  // Softening at which 95 % of the loss is reached: softening by displacement
  // is 1 at the softening displacement.
  template <int dim>
  double
  HerschelBulkley<dim>::scale_of_softening() const
  {
    return this->softens_by_displacement() ? 1. : strain_to_remould_;
  }



  template <int dim>
  std::string
  HerschelBulkley<dim>::slower_softening(const double times) const
  {
    return text("a `Plastic shear strain to remould` of more than ",
                strain_to_remould_ * times);
  }



  template <int dim>
  std::string
  HerschelBulkley<dim>::name_of_consistency() const
  {
    return flow_law_ == FlowLaw::bingham ? "`Viscosity`" : "`Consistency`";
  }



  // Plastic shear strain that remoulds to 95 % in cells of the given size.
  template <int dim>
  double
  HerschelBulkley<dim>::strain_to_remould(const double cell_size) const
  {
    return this->softens_by_displacement()
             ? this->softening_displacement() / cell_size
             : strain_to_remould_;
  }



  template <int dim>
  bool
  HerschelBulkley<dim>::softens() const
  {
    return remoulded_ratio_ < 1.;
  }



  template <int dim>
  double
  HerschelBulkley<dim>::fraction_of_strength_loss(const Points<dim> &points,
                                                  const unsigned int p) const
  {
    return softens() ? -std::expm1(-3. * this->softening(points, p) /
                                   scale_of_softening())
                     : 0.;
  }



  // If the strength falls with the plastic shear faster than the elastic
  // stress, ds_u/dxi < -G, a trial stress has several returns, or a stress
  // jumps: the equation
  //   tau_trial - G dgamma = s_u(xi + dgamma) + K (dgamma/dt)^n
  // has a single root only if the right side minus the left side increases. The
  // strength falls fastest at xi = 0, at the rate 3 (1 - r) s_u0/xi_95, which
  // must be less than G. Viscosity would help only in short steps, and load
  // steps of the static stages have no viscosity. The condition holds for the
  // strength times the factor, with a margin of 1 %: at equality the return has
  // no slope.
  template <int dim>
  double
  HerschelBulkley<dim>::largest_strength_factor(
    const StrengthRange &range) const
  {
    // Use the strongest soil, unless moduli are proportional to the strength.
    const double lost = (1. - remoulded_ratio_) *
                        (this->has_moduli_of_points() ? 1. : range.largest);
    if (lost == 0.)
      return std::numeric_limits<double>::infinity();
    return 0.99 * this->moduli().mu *
           strain_to_remould(this->largest_cell_size()) / (3. * lost) /
           this->steepening_by_rate();
  }



  // The work is the integral of s_u(xi) - r s_u0 over all xi.
  template <int dim>
  Remark
  HerschelBulkley<dim>::note(const double cell_size) const
  {
    const double lost = (1. - remoulded_ratio_) *
                        this->undrained_strength()->uniform().value_or(0.);
    if (lost == 0.)
      return "";
    if (this->softens_by_displacement())
      return band_note({this->section(),
                        this->softening_displacement(),
                        lost * this->softening_displacement() / 3.,
                        "95 %"});
    const std::string viscosity = name_of_consistency();
    return shear_band_note(
      {this->section(),
       strain_to_remould_,
       lost * strain_to_remould_ / 3.,
       "95 %"},
      cell_size,
      text(
        std::setprecision(6),
        "keep `Plastic shear strain to remould` times the cell size at ",
        strain_to_remould_ * cell_size,
        " m, ",
        consistency_ > 0.
          ? text("unless ",
                 viscosity,
                 " makes the bands several cells wide, which a run on smaller "
                 "cells would show.")
          : text("or set ",
                 viscosity,
                 " to more than 0, which gives the band a width of its "
                 "own.")));
  }



  template class HerschelBulkley<2>;
  template class HerschelBulkley<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/mohr_coulomb.h>
#include <talus/materials/rate_law.templates.h>

#include <cmath>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

  namespace
  {
    double
    radians(const double degrees)
    {
      return degrees * dealii::numbers::PI / 180.;
    }
  } // namespace



  template <int dim>
  MohrCoulomb<dim>::MohrCoulomb(const std::string &section)
    : RateLaw<dim, MohrCoulombFlow>(section, "plastic shear strain")
  {
    const auto add = [&](const std::string &name,
                         double            &value,
                         const std::string &sentence,
                         const Double      &range) {
      this->add_parameter(name, value, sentence, ParameterAcceptor::prm, range);
    };
    add("Cohesion", cohesion_, "Effective cohesion c' [Pa].", Double(0.));
    add("Friction angle",
        friction_angle_,
        "Effective friction angle phi' [degrees], in drained shear. The "
        "strength is c' cos(phi') - s sin(phi') with the mean s of the largest "
        "and the smallest principal effective stress, tension positive.",
        Double(0., 60.));
    add("Dilatancy angle",
        dilatancy_angle_,
        "Dilatancy angle psi [degrees], -phi' to phi': in plane strain soil "
        "that is sheared plastically grows in volume by sin(psi) per shear "
        "strain.",
        Double(-60., 60.));
    this->add_parameter("Dilation strain",
                        dilation_strain_,
                        "Plastic shear strain xi_d [-] over which psi fades as "
                        "exp(-xi/xi_d). Empty: psi stays, and soil grows as "
                        "long as it is sheared.",
                        ParameterAcceptor::prm,
                        dealii::Patterns::List(Double(1e-12), 0, 1));
    add("Tension cut-off",
        tension_,
        "Largest mean effective tension [Pa]; at most c'/tan(phi') acts.",
        Double(0.));
  }



  // Flow with psi > phi' would do negative plastic work under compression.
  template <int dim>
  void
  MohrCoulomb<dim>::check() const
  {
    RateLaw<dim, MohrCoulombFlow>::check();
    AssertThrow(std::abs(dilatancy_angle_) <= friction_angle_,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Dilatancy angle` is ",
                             dilatancy_angle_,
                             " degrees, more than the friction angle, ",
                             friction_angle_,
                             " degrees: plastic flow would create energy. Give "
                             "an angle between -phi' and phi'.")));
    AssertThrow(friction_angle_ > 0. || cohesion_ > 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Cohesion` and `Friction angle` are 0, so the "
                             "soil has no strength. Give one of them.")));
  }



  // The criterion bounds t K(theta): at the Lode angle of the stress, t may
  // reach the bound over K.
  template <int dim>
  double
  MohrCoulomb<dim>::shear_strength(const Points<dim> &points,
                                   const unsigned int p) const
  {
    const double factor  = this->strength_factor(points, p);
    const double tangent = std::tan(radians(friction_angle_)) * factor;
    const double root    = std::sqrt(1. + tangent * tangent);
    const auto   stress  = load_stress<dim, double>(points, p);
    const double share   = mohr_coulomb_share<dim>(stress, tangent / root);
    return std::max(0.,
                    (cohesion_ * factor - mean_normal(stress) * tangent) /
                      (root * share));
  }



  template <int dim>
  Remark
  MohrCoulomb<dim>::note(const double /*cell_size*/) const
  {
    const WaterResponse<dim> water = this->pore_water();
    if (water.stiffness == 0. || dilatancy_angle_ == 0. ||
        !dilation_strain_.empty() || std::isfinite(water.largest_suction))
      return "";
    return {text("undrained soil with a dilatancy angle of ",
                 dilatancy_angle_,
                 dilatancy_angle_ > 0.
                   ? " degrees gets stronger without end as it shears"
                   : " degrees loses all strength as it shears",
                 ". Give 'Dilation strain', 'Pore water/Largest suction', or a "
                 "dilatancy angle of 0."),
            Severity::look,
            "section " + this->section()};
  }



  template <int dim>
  Remark
  MohrCoulomb<dim>::note_on_safety() const
  {
    if (dilatancy_angle_ == friction_angle_ || is_associated_)
      return "";
    return {text("Plastic flow of this material is not associated (dilatancy "
                 "angle ",
                 dilatancy_angle_,
                 ", friction angle ",
                 friction_angle_,
                 " degrees), so the factor of safety depends on the initial "
                 "stress, such as 'K0'. With 'Strength reduction/"
                 "Non-associated flow = Davis' it does not."),
            Severity::look,
            "section " + this->section()};
  }



  template <int dim>
  MohrCoulombFlow
  MohrCoulomb<dim>::flow_rule(const double /*dt*/) const
  {
    const Moduli moduli = this->moduli();
    return {moduli.mu,
            moduli.bulk,
            cohesion_,
            std::tan(radians(friction_angle_)),
            radians(dilatancy_angle_),
            dilation_strain_.empty() ? 0. : 1. / dilation_strain_.front(),
            tension_,
            is_associated_};
  }



  template class MohrCoulomb<2>;
  template class MohrCoulomb<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/shear_band.h>
#include <talus/materials/undrained_law.templates.h>
#include <talus/materials/von_mises.h>
#include <talus/materials/von_mises_kernel.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

  template <int dim>
  VonMises<dim>::VonMises(const std::string &section)
    : UndrainedLaw<dim, VonMisesFlow>(
        section,
        "plastic strain",
        "Undrained shear strength s_u [Pa]: the shear stress at which the "
        "undisturbed material yields in simple shear.",
        "a negative `Hardening modulus`")
  {
    this->add_parameter("Hardening modulus",
                        hardening_,
                        "Slope of the yield stress sqrt(3) s_u over the "
                        "equivalent plastic strain [Pa]. Negative: the "
                        "material softens, down to the residual strength.",
                        ParameterAcceptor::prm,
                        Double());
    this->add_parameter("Residual undrained shear strength",
                        residual_strength_,
                        "Undrained shear strength [Pa] below which the "
                        "material does not soften.",
                        ParameterAcceptor::prm,
                        Double(0.));
  }



  template <int dim>
  void
  VonMises<dim>::check() const
  {
    UndrainedLaw<dim, VonMisesFlow>::check();
    this->check_softening_is_given_once(hardening_ != 0., "Hardening modulus");
  }



  template <int dim>
  void
  VonMises<dim>::check_strength(const StrengthRange &range) const
  {
    AssertThrow(residual_strength_ <= range.least,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Residual undrained shear strength` is ",
                             residual_strength_,
                             " Pa. It must not exceed `Undrained shear "
                             "strength`, which is ",
                             range.least,
                             range.least < range.largest ? " Pa at a point."
                                                         : " Pa.")));
    AssertThrow(residual_strength_ == 0. ||
                  residual_strength_ == range.largest || hardening_ != 0. ||
                  this->softens_by_displacement(),
                ExcUser(text("Section ",
                             this->section(),
                             ": `Residual undrained shear strength` is ",
                             residual_strength_,
                             " Pa, but nothing says over what the material "
                             "softens: give `Softening displacement`, or a "
                             "negative `Hardening modulus`.")));
    UndrainedLaw<dim, VonMisesFlow>::check_strength(range);
  }



  template <int dim>
  std::string
  VonMises<dim>::slower_softening(const double times) const
  {
    return text("a `Hardening modulus` of more than ",
                hardening_ / times,
                " Pa");
  }



  // The equivalent plastic strain of simple shear by gamma is gamma/sqrt(3).
  template <int dim>
  double
  VonMises<dim>::shear_per_plastic_variable() const
  {
    return std::sqrt(3.);
  }



  // In simple shear q = sqrt(3) tau, so the yield stress is sqrt(3) s_u. The
  // return of von_mises_kernel.h is in closed form, since the yield stress is
  // linear in the plastic strain or constant: no iteration, and exact for steps
  // of any size.
  template <int dim>
  VonMisesFlow
  VonMises<dim>::flow_rule(const double /*dt*/) const
  {
    return {this->moduli().mu,
            hardening_,
            std::sqrt(3.) * residual_strength_,
            this->softens_by_displacement()};
  }



  template <int dim>
  bool
  VonMises<dim>::softens() const
  {
    return this->softens_by_displacement() || hardening_ < 0.;
  }



  // Soil whose initial and residual strengths are equal has nothing to lose.
  // Softening by displacement ends at 1. Hardening is a slope of the yield
  // stress, sqrt(3) times the strength.
  template <int dim>
  double
  VonMises<dim>::fraction_of_strength_loss(const Points<dim> &points,
                                           const unsigned int p) const
  {
    const double lost = this->strength(points, p) - residual_strength_;
    if (!softens() || !(lost > 0.))
      return 0.;
    const double slope =
      this->softens_by_displacement() ? 1. : -hardening_ / std::sqrt(3.) / lost;
    return std::min(1., slope * this->softening(points, p));
  }



  // A trial stress q is returned by q - 3 mu dep = sigma_y(ep + dep). A root
  // exists for all q only if the yield stress falls less steeply than the
  // elastic stress, H > -3 mu; otherwise the stress would have to jump. The
  // condition holds for the hardening modulus times the factor, with a margin
  // of 1 %: at equality the return has no slope. In simple shear the condition
  // is ds_u/dgamma > -G, with a displacement (s_u - s_res) h/d < G: the
  // strongest soil decides, also if G is proportional to s_u. The rate of
  // shearing multiplies the slope, too.
  template <int dim>
  double
  VonMises<dim>::largest_strength_factor(const StrengthRange &range) const
  {
    const double infinity = std::numeric_limits<double>::infinity();
    const double mu = 0.99 * this->moduli().mu / this->steepening_by_rate();
    if (this->softens_by_displacement())
      {
        const double lost = range.largest - residual_strength_;
        return lost > 0.
                 ? mu * (this->has_moduli_of_points() ? range.largest : 1.) *
                     this->softening_displacement() /
                     (lost * this->largest_cell_size())
                 : infinity;
      }
    if (hardening_ >= 0.)
      return infinity;
    // Use the softest soil if moduli differ.
    return -3. * mu * (this->has_moduli_of_points() ? range.least : 1.) /
           hardening_;
  }



  // With ep = gamma/sqrt(3) in simple shear, the strength is s_u + H gamma/3.
  template <int dim>
  Remark
  VonMises<dim>::note(const double cell_size) const
  {
    const auto   strength = this->undrained_strength()->uniform();
    const double lost     = strength.value_or(0.) - residual_strength_;
    if (!strength || !softens() || lost == 0.)
      return "";
    if (this->softens_by_displacement())
      return band_note({this->section(),
                        this->softening_displacement(),
                        lost * this->softening_displacement() / 2.,
                        "all"});
    const double strain = -3. * lost / hardening_;
    return shear_band_note(
      {this->section(), strain, lost * strain / 2., "all"},
      cell_size,
      text(std::setprecision(6),
           "keep `Hardening modulus` over the cell size at ",
           hardening_ / cell_size,
           " Pa/m, or take the law Bingham or Herschel-Bulkley, whose "
           "viscosity gives the band a width of its own."));
  }



  template class VonMises<2>;
  template class VonMises<3>;
} // namespace talus

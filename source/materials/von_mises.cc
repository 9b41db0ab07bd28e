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



  // A trial stress q is returned by q - 3 mu dep = sigma_y(ep + dep). A root
  // exists for all q only if the yield stress falls less steeply than the
  // elastic stress, H > -3 mu. Otherwise the stress would have to jump.
  template <int dim>
  void
  VonMises<dim>::check() const
  {
    UndrainedLaw<dim, VonMisesFlow>::check();
    this->check_softening_is_given_once(hardening_ != 0., "Hardening modulus");
    const double mu = this->moduli().mu;
    AssertThrow(
      this->has_strength_column() || 3. * mu + hardening_ > 0.,
      ExcUser(text("Section ",
                   this->section(),
                   ": `Hardening modulus` is ",
                   hardening_,
                   " Pa, but the material must not soften faster than it can "
                   "unload elastically: give more than ",
                   -3. * mu,
                   " Pa (minus three times the shear modulus).")));
    if (!this->has_strength_column())
      check_strength({this->strength(), this->strength()});
    this->check_rate_effect();
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
            std::sqrt(3.) * this->strength(),
            hardening_,
            std::sqrt(3.) * residual_strength_};
  }



  // Yield stress over sqrt(3). Hardening is a slope of the yield stress and
  // divided by sqrt(3), too. Softening by displacement ends at 1.
  template <int dim>
  double
  VonMises<dim>::strength_without_factor(const Points<dim> &points,
                                         const unsigned int p) const
  {
    const double initial = this->strength(points, p);
    const double slope   = this->softens_by_displacement()
                             ? residual_strength_ - initial
                             : hardening_ / std::sqrt(3.);
    const double on_line = initial + slope * this->softening(points, p);
    return std::max(on_line, residual_strength_);
  }



  template <int dim>
  double
  VonMises<dim>::shear_strength(const Points<dim> &points,
                                const unsigned int p) const
  {
    return this->strength_factor(points, p) *
           strength_without_factor(points, p);
  }



  template <int dim>
  bool
  VonMises<dim>::softens() const
  {
    return (this->softens_by_displacement() || hardening_ < 0.) &&
           (this->has_strength_column() ||
            residual_strength_ < this->strength());
  }



  // Soil whose initial and residual strengths are equal has nothing to lose.
  template <int dim>
  double
  VonMises<dim>::fraction_of_strength_loss(const Points<dim> &points,
                                           const unsigned int p) const
  {
    const double initial = this->strength(points, p);
    return softens() && initial > residual_strength_
             ? (initial - strength_without_factor(points, p)) /
                 (initial - residual_strength_)
             : 0.;
  }



  // Condition of check() for the hardening modulus times the factor, with a
  // margin of 1 %: at equality the return has no slope. If residual and initial
  // strength are equal, nothing softens. In simple shear the condition is
  // ds_u/dgamma > -G, which is (s_u - s_res) h/d < G: the strongest soil
  // decides, also if G is proportional to s_u. The rate of shearing multiplies
  // the slope, too.
  template <int dim>
  double
  VonMises<dim>::largest_strength_factor(const StrengthRange &range) const
  {
    if (this->softens_by_displacement())
      {
        const double strongest =
          this->has_strength_column() ? range.largest : this->strength();
        const double lost = strongest - residual_strength_;
        const double mu =
          this->moduli().mu * (this->has_moduli_of_points() ? strongest : 1.);
        return lost > 0. ? 0.99 * mu * this->softening_displacement() /
                             (lost * this->largest_cell_size()) /
                             this->steepening_by_rate()
                         : std::numeric_limits<double>::infinity();
      }
    if (hardening_ >= 0. || (!this->has_strength_column() &&
                             residual_strength_ == this->strength()))
      return std::numeric_limits<double>::infinity();
    // Use the softest soil if moduli differ.
    const double stiffness = this->has_moduli_of_points() ? range.least : 1.;
    return -0.99 * 3. * this->moduli().mu * stiffness / hardening_ /
           this->steepening_by_rate();
  }



  // With ep = gamma/sqrt(3) in simple shear, the strength is s_u + H gamma/3.
  template <int dim>
  Remark
  VonMises<dim>::note(const double cell_size) const
  {
    const double lost = this->strength() - residual_strength_;
    if (this->softens_by_displacement() && !this->has_strength_column())
      return band_note({this->section(),
                        this->softening_displacement(),
                        lost * this->softening_displacement() / 2.,
                        "all"});
    if (hardening_ >= 0. || lost == 0. || this->has_strength_column())
      return "";
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/material_model.h>
#include <talus/points/points_kernel.h>

#include <algorithm>
#include <limits>

namespace talus
{
  namespace Patterns = dealii::Patterns;

  // Two densities: pore water moves with the soil and has inertia, but its
  // weight is borne by the surrounding water.
  template <int dim>
  MaterialModel<dim>::MaterialModel(const std::string &section)
    : ParameterAcceptor(section)
    , section_(section)
  {
    this->add_parameter("Density",
                        density_,
                        "Density of the undeformed material, for inertia "
                        "[kg/m^3].",
                        ParameterAcceptor::prm,
                        Patterns::Double(0.));
    this->add_parameter("Submerged density",
                        submerged_density_,
                        "Density of the undeformed material minus the density "
                        "of water, for weight [kg/m^3]. Empty: as `Density`.",
                        ParameterAcceptor::prm,
                        Patterns::List(Patterns::Double(0.), 0, 1));
    this->add_parameter("Cell mean",
                        bbar_,
                        "Average dilatation and mean stress over a cell, so "
                        "that nearly incompressible material does not lock: "
                        "on, off, or auto, that is on for Poisson's ratio "
                        "above 0.4 and for plastic laws.",
                        ParameterAcceptor::prm,
                        Patterns::Selection("auto|on|off"));
  }



  // Forces are divided by mass: soil without mass would have no acceleration.
  template <int dim>
  void
  MaterialModel<dim>::check() const
  {
    AssertThrow(density_ > 0.,
                ExcUser(text("Section ",
                             section_,
                             ": `Density` is ",
                             density_,
                             " kg/m^3. Give a positive number.")));
    AssertThrow(submerged_density() <= density_,
                ExcUser(text("Section ",
                             section_,
                             ": `Submerged density` is ",
                             submerged_density(),
                             " kg/m^3 and `Density` ",
                             density_,
                             " kg/m^3, but weight is smaller under water. Give "
                             "at most the density.")));
  }



  // New columns contain zero, a factor for soil without strength.
  template <int dim>
  void
  MaterialModel<dim>::initialize(Points<dim>       &points,
                                 const unsigned int begin,
                                 const unsigned int end) const
  {
    if (strength_factor_ != dealii::numbers::invalid_unsigned_int)
      std::fill(points.data(strength_factor_) + begin,
                points.data(strength_factor_) + end,
                1.);
  }



  // Infinite, so that a minimum over several laws needs no test for strength.
  template <int dim>
  double
  MaterialModel<dim>::shear_strength(const Points<dim> &, unsigned int) const
  {
    return std::numeric_limits<double>::infinity();
  }



  // Soil that has lost all strength bears no more than it has.
  template <int dim>
  double
  MaterialModel<dim>::mobilized_strength(const Points<dim> &points,
                                         const unsigned int p) const
  {
    const double strength = shear_strength(points, p);
    return strength > 0.
             ? shear_stress(load_stress<dim, double>(points, p)) / strength
             : 1.;
  }



  // Plastic laws count as nearly incompressible for any Poisson's ratio, since
  // plastic flow keeps the volume (RateLaw).
  template <int dim>
  bool
  MaterialModel<dim>::uses_bbar() const
  {
    return bbar_ == "auto" ? is_nearly_incompressible() : bbar_ == "on";
  }



  // Parsed as a list, as deal.II's numbers cannot be empty.
  template <int dim>
  double
  MaterialModel<dim>::submerged_density() const
  {
    return submerged_density_.empty() ? density_ : submerged_density_.front();
  }



  // c = sqrt(M/rho) with the current density, m/V. For a single point; the time
  // step has its own version for many points at a time.
  template <int dim>
  double
  MaterialModel<dim>::wave_speed(const Points<dim> &points,
                                 const unsigned int p) const
  {
    double modulus;
    wave_modulus(points, p, p + 1, &modulus);
    return std::sqrt(modulus * volume_of_points<dim, double>(points, p) /
                     points.data(points.mass)[p]);
  }



  template class MaterialModel<2>;
  template class MaterialModel<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/elastic_law.h>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

  // K is 5e4 times mu at the limit, 1e3 times as much as with nu = 0.49.
  constexpr double largest_poisson_ratio = 0.49999;

  template <int dim>
  ElasticLaw<dim>::ElasticLaw(const std::string &section,
                              const bool         has_young_modulus)
    : MaterialModel<dim>(section)
    , pore_water_(section)
  {
    if (has_young_modulus)
      this->add_parameter("Young's modulus",
                          young_modulus_,
                          "Young's modulus E for small strains [Pa].",
                          ParameterAcceptor::prm,
                          Double(0.));
    this->add_parameter(
      "Poisson's ratio",
      poisson_ratio_,
      "Poisson's ratio nu for small strains [-]; more than -1 "
      "and at most 0.49999, as 0.5 is incompressible and cannot "
      "be reached. Undrained clay: 0.49.",
      ParameterAcceptor::prm,
      Double(-1., 0.5));
  }



  // The ranges of the parameters include their ends, where a modulus is zero or
  // infinite; a stable material needs mu > 0 and K > 0.
  template <int dim>
  void
  ElasticLaw<dim>::check() const
  {
    MaterialModel<dim>::check();
    AssertThrow(young_modulus_ > 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Young's modulus` is ",
                             young_modulus_,
                             " Pa. Give a positive number.")));
    AssertThrow(poisson_ratio_ > -1. && poisson_ratio_ <= largest_poisson_ratio,
                ExcUser(text(
                  std::setprecision(17),
                  "Section ",
                  this->section(),
                  ": `Poisson's ratio` is ",
                  poisson_ratio_,
                  ", which makes an elastic modulus zero, infinite or so large "
                  "that time steps become very short. Give a number above -1 "
                  "and up to ",
                  std::setprecision(6),
                  largest_poisson_ratio,
                  "; 0.49 for undrained clay.")));
    pore_water_.check(poisson_ratio_);
  }



  // The water has one stiffness in all soil of a material, also where the soil
  // is softer: liquefied soil would lose its incompressibility otherwise.
  template <int dim>
  WaterResponse<dim>
  ElasticLaw<dim>::pore_water() const
  {
    const double bulk = bulk_modulus_for_water();
    return {pore_water_.stiffness(poisson_ratio_, bulk),
            pore_water_.largest_suction(),
            bulk,
            pore_water_.consolidation()};
  }



  // 2-D uses the constants of the solid, too: the strain is plane, and the
  // stress out of the plane follows from the 3-D law. lambda and K grow without
  // bound towards nu = 1/2. The stable time step falls with the root of
  // lambda + 2 mu: with nu = 0.49 it is 3.6 times smaller than with 0.3.
  template <int dim>
  Moduli
  ElasticLaw<dim>::moduli() const
  {
    const double E = young_modulus(), nu = poisson_ratio_;
    return {E * nu / ((1. + nu) * (1. - 2. * nu)),
            E / (2. * (1. + nu)),
            E / (3. * (1. - 2. * nu))};
  }



  template class ElasticLaw<2>;
  template class ElasticLaw<3>;
} // namespace talus

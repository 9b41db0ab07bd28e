// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/strength_variation.h>

#include <algorithm>

namespace talus
{
  namespace Patterns = dealii::Patterns;

  void
  StrengthVariation::add_parameters(dealii::ParameterAcceptor &section)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    section.enter_subsection("Strength field");
    section.add_parameter(
      "Coefficient of variation",
      coefficient_,
      "Standard deviation over mean [-] of a lognormal random field by which "
      "`Undrained shear strength` is multiplied at the place of each point at "
      "the start. The mean of the field is 1. 0: no random field.",
      prm,
      Patterns::Double(0., 10.));
    section.add_parameter(
      "Correlation lengths",
      lengths_,
      "Distances [m] along x, y (, z) over which the correlation of the "
      "logarithm of the field falls to 0.37 (exponential), 0.48 (Matern 3/2), "
      "0.52 (Matern 5/2); a single number holds for all axes. A fluctuation "
      "scale of exp(-2 d/theta) is twice the length. 1e30: the same random "
      "factor everywhere.",
      prm,
      Patterns::List(Patterns::Double(1e-6), 0, 3));
    section.add_parameter(
      "Kernel",
      kernel_,
      "Correlation over the distance r, in correlation lengths: exponential, "
      "exp(-r); Matern 3/2, (1 + a) exp(-a) with a = sqrt(3) r; Matern 5/2, "
      "(1 + a + a^2/3) exp(-a) with a = sqrt(5) r. The last two fields are "
      "smooth.",
      prm,
      Patterns::Selection("exponential|Matern 3/2|Matern 5/2"));
    section.add_parameter("Seed",
                          seed_,
                          "Number of the realization. The same seed gives the "
                          "same field on any mesh and any number of ranks.",
                          prm,
                          Patterns::Integer(0));
    section.leave_subsection();
  }



  void
  StrengthVariation::check(const unsigned int dim,
                           const std::string &section) const
  {
    if (!is_active())
      return;
    AssertThrow(lengths_.size() == 1 || lengths_.size() == dim,
                ExcUser(text("Section ",
                             section,
                             "/Strength field: `Correlation lengths` has ",
                             lengths_.size(),
                             " numbers, where 1 or ",
                             dim,
                             " were expected: give one length, m, for all axes "
                             "or one for each axis.")));
  }



  unsigned int
  StrengthVariation::twice_smoothness() const
  {
    return kernel_ == "exponential" ? 1 : kernel_ == "Matern 3/2" ? 3 : 5;
  }
} // namespace talus

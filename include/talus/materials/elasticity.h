#ifndef talus_materials_elasticity_h
#define talus_materials_elasticity_h

#include <talus/materials/moduli.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// The two elastic parameters that all laws have.
  class Elasticity
  {
  public:
    /// Declare the parameters in the section of @p law.
    void
    declare(dealii::ParameterAcceptor &law);

    /// Throw ExcUser, naming @p section, unless the elastic energy is positive:
    /// E > 0 and -1 < nu < 1/2.
    void
    check(const std::string &section) const;

    Moduli
    moduli() const;

    /// True if linear cells answer shear with pressure, so that they lock.
    bool
    nearly_incompressible() const
    {
      return poisson_ratio_ > 0.4;
    }

  private:
    double young_modulus_ = 1e6;
    double poisson_ratio_ = 0.3;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_elastic_law_h
#define talus_materials_elastic_law_h

#include <talus/materials/material_model.h>
#include <talus/materials/moduli.h>

namespace talus
{
  /// Base of laws with an isotropic elastic part, given by Young's modulus and
  /// Poisson's ratio.
  template <int dim>
  class ElasticLaw : public MaterialModel<dim>
  {
  public:
    /// Declare Poisson's ratio and, if @p has_young_modulus, Young's modulus.
    ElasticLaw(const std::string &section, bool has_young_modulus = true);

    /// Throw ExcUser unless E > 0 and -1 < nu <= 0.49999, so that elastic
    /// moduli are positive and finite.
    void
    check() const override;

    double
    largest_shear_modulus(const Points<dim> & /*points*/,
                          unsigned int /*begin*/,
                          unsigned int /*end*/) const override
    {
      return moduli().mu;
    }

    /// Return whether Poisson's ratio of soil and water exceeds 0.4: linear
    /// cells would then respond to shear with pressure and lock.
    bool
    is_nearly_incompressible() const override
    {
      return poisson_ratio_ > 0.4 || pore_water_.is_undrained();
    }

    WaterResponse<dim>
    pore_water() const override;

  protected:
    Moduli
    moduli() const;

    double
    poisson_ratio() const
    {
      return poisson_ratio_;
    }

    /// Young's modulus, Pa.
    virtual double
    young_modulus() const
    {
      return young_modulus_;
    }

    /// Bulk modulus, Pa, that an undrained Poisson's ratio refers to.
    virtual double
    bulk_modulus_for_water() const
    {
      return moduli().bulk;
    }

  private:
    double    young_modulus_ = 1e6;
    double    poisson_ratio_ = 0.3;
    PoreWater pore_water_;
  };
} // namespace talus

#endif

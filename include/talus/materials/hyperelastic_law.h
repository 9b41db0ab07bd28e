// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_hyperelastic_law_h
#define talus_materials_hyperelastic_law_h

#include <talus/materials/elastic_law.h>

namespace talus
{
  /// Base of laws whose stress is the derivative of an energy by the
  /// deformation gradient. A law is given by its @p StrainEnergy, a trivially
  /// copyable structure of the constants in its formulas, with two functions
  /// for any Number:
  ///   StateResponse<dim, Number>
  ///   response(const DeformationState<dim, Number> &) const
  /// returns energy and Kirchhoff stress, and
  ///   Number
  ///   largest_modulus(const DeformationState<dim, Number> &) const
  /// returns J M, where M is the largest eigenvalue of the acoustic tensor over
  /// all directions, or an upper bound, Pa. The explicit step calls both for
  /// several points at once; static stages refuse such laws. The functions of
  /// HyperelasticLaw are in hyperelastic_law.templates.h, to be included by the
  /// .cc file of a law.
  template <int dim, typename StrainEnergy>
  class HyperelasticLaw : public ElasticLaw<dim>
  {
  public:
    using ElasticLaw<dim>::ElasticLaw;

    void
    add_columns(Points<dim> &points) override;

    void
    initialize(Points<dim> &points,
               unsigned int begin,
               unsigned int end) const override;

    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const override;

    void
    wave_modulus(const Points<dim> &points,
                 unsigned int       begin,
                 unsigned int       end,
                 double            *modulus) const override;

    bool
    is_hyperelastic() const override
    {
      return true;
    }

  private:
    virtual StrainEnergy
    strain_energy() const = 0;

    /// Column of the deformation gradient F.
    unsigned int deformation_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif

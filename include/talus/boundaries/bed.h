// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_bed_h
#define talus_boundaries_bed_h

#include <talus/boundaries/interface_friction.h>
#include <talus/geometry/place_expression.h>

#include <optional>
#include <string>

namespace talus
{
  /// Surface on which soil slides, a seabed on faces of the mesh or the surface
  /// of an obstacle: law of friction, and maximum shear stress by place. All
  /// rules that change a surface (trigger, strength reduction, depth below the
  /// mudline) go through the list Problem::beds().
  template <int dim>
  class Bed : public InterfaceFriction
  {
  public:
    /// @param section of the parameter file, "/Boundaries/Seabed" for example
    /// @param maximum_shear_stress default of the parameter
    /// @param description of the parameter
    Bed(const std::string &section,
        const std::string &maximum_shear_stress,
        const std::string &description);

    /// Parse the maximum shear stress and check the parameters. Call after
    /// parsing. Throws ExcUser.
    /// @param surfaces surfaces with names, if there are any
    void
    prepare(const Constants          &constants,
            const SurfaceSource<dim> *surfaces = nullptr);

    /// Whether the surface has a maximum shear stress.
    bool
    limits_shear_stress() const
    {
      return !maximum_shear_stress_text_.empty();
    }

    /// Text of the parameter `Maximum shear stress`.
    const std::string &
    maximum_shear_stress_text() const
    {
      return maximum_shear_stress_text_;
    }

    /// Maximum shear stress that the intact surface passes to the soil at @p x,
    /// Pa; infinite without limit. Throws ExcUser if it is negative.
    double
    maximum_shear_stress(const dealii::Point<dim> &x) const;

    /// Whether the maximum shear stress differs from place to place.
    bool
    depends_on_place() const
    {
      return cap_ && !cap_->number();
    }

    /// Whether set_depth() must be called before maximum_shear_stress().
    bool
    depends_on_depth() const
    {
      return cap_ && cap_->depends_on_depth();
    }

    void
    set_depth(const typename PlaceExpression<dim>::Depth &depth)
    {
      if (cap_)
        cap_->set_depth(depth);
    }

  private:
    std::string                         section_;
    std::string                         maximum_shear_stress_text_;
    std::optional<PlaceExpression<dim>> cap_; ///< Pa, if limited
  };
} // namespace talus

#endif

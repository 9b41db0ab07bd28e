// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_water_h
#define talus_water_water_h

#include <talus/interaction/nodal_interaction.h>
#include <talus/materials/materials.h>
#include <talus/water/free_surface.h>

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>
#include <vector>

namespace talus
{
  /// Ambient water at rest that acts on moving soil, in addition to buoyancy:
  /// water is accelerated with the soil (added mass) and drags at the free
  /// surface. doc/method.md, section "Water".
  template <int dim>
  class Water : public dealii::ParameterAcceptor, public NodalInteraction<dim>
  {
  public:
    /// Obstacles of @p contact bound the soil; @p materials give the densities.
    Water(const Materials<dim> &materials, const Contact<dim> &contact);

    /// Whether any effect of water is switched on.
    bool
    acts() const
    {
      return added_mass_ > 0 || skin_friction_ > 0 || pressure_drag_ > 0;
    }

    /// Density of the water, kg/m^3.
    double
    density() const
    {
      return density_;
    }

    /// Return the mass of water that moves with the soil divided by the mass of
    /// the soil [-], by body; empty if water has no effect.
    std::vector<double>
    added_mass_of_bodies() const;

    void
    open_accounts(Accounts<dim> &accounts) override;

    void
    prepare(const Grid<dim> &grid) override;

    /// Update the free surface and add the inertia of the water to the nodes.
    void
    begin_step(State<dim> &state) override;

    void
    correct_velocities(State<dim> &state) override;

    /// List drag, momentum of the added mass, and Froude number.
    void
    list_quantities(const State<dim> &state, Quantities &list) const override;

    /// Add the facets of the free surface.
    void
    list_state(StateList &list) override;

    /// Return a sentence if buoyancy does not fit the density of the soil.
    std::vector<std::string>
    notes() const override;

    const FreeSurface<dim> &
    free_surface() const
    {
      return surface_;
    }

  private:
    dealii::Tensor<1, dim>
    drag_impulse(const SurfaceFacet<dim> &facet, double dt) const;
    dealii::Tensor<1, dim>
    impulse_at(unsigned int node) const;
    void
    find_impulses(const State<dim> &state);
    void
    add_inertia(NodalFields<dim> &nodes) const;

    const Materials<dim> &materials_;
    const Contact<dim>   &contact_;

    double density_       = 1000.;
    double added_mass_    = 0.;
    double skin_friction_ = 0.;
    double pressure_drag_ = 0.;

    FreeSurface<dim> surface_;
    /// State::max_path at the search for surface_, m.
    double             path_at_surface_ = std::numeric_limits<double>::lowest();
    NodalExchange<dim> exchange_of_impulses_;
    std::vector<double>
      impulses_; ///< impulses of the drag in the step, by node, N s
  };
} // namespace talus

#endif

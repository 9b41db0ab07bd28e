// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_water_h
#define talus_water_water_h

#include <talus/base/quantity.h>
#include <talus/materials/materials.h>
#include <talus/water/free_surface.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// What ambient water at rest does to soil that moves, beyond taking off its
  /// weight: it must be accelerated with the soil (added mass), and drags at
  /// its free surface. doc/method.md, section "Water".
  template <int dim>
  class Water : public dealii::ParameterAcceptor
  {
  public:
    Water();

    /// Whether it does anything.
    bool
    acts() const
    {
      return added_mass_ > 0 || skin_friction_ > 0 || pressure_drag_ > 0;
    }

    /// Added mass of the soil of each body, as a share of its mass [-]; empty
    /// if water does nothing.
    std::vector<double>
    added_mass_of_bodies(const Materials<dim> &materials,
                         unsigned int          n_bodies) const;

    /// A sentence if buoyancy does not fit the density; empty if it does.
    std::string
    note(const Materials<dim> &materials, unsigned int n_bodies) const;

    /// To be called after each change of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Add the inertia of the water to the nodes, and drag to their forces; when
    /// sums are complete and before the momentum update. Collective.
    void
    apply(State<dim> &state, const FacetContact<dim> &contact);

    /// Book what drag did, when the velocities of owned nodes are final.
    void
    book(State<dim> &state);

    /// List drag, added mass and Froude number; @p gravity normal to the slope,
    /// m/s^2. Collective.
    void
    list_quantities(const State<dim> &state,
                    double            gravity,
                    Quantities       &list) const;

    const FreeSurface<dim> &
    free_surface() const
    {
      return surface_;
    }

  private:
    dealii::Tensor<1, dim>
    drag(const SurfaceFacet<dim> &facet) const;
    dealii::Tensor<1, dim>
    force_at(unsigned int node) const;
    void
    add_inertia(NodalFields<dim> &nodes) const;
    void
    add_drag(NodalFields<dim> &nodes, const Grid<dim> &grid);

    double density_       = 1000.;
    double added_mass_    = 0.;
    double skin_friction_ = 0.;
    double pressure_drag_ = 0.;

    FreeSurface<dim>    surface_;
    NodalExchange<dim>  exchange_of_forces_;
    std::vector<double> forces_; ///< of the step, by node, N
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_interaction_nodal_interaction_h
#define talus_interaction_nodal_interaction_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

#include <string>
#include <vector>

namespace talus
{
  /// Effect of the surroundings on the soil at the nodes of the background
  /// grid: boundaries, obstacles, water, damping.
  ///
  /// A step calls the members below in the order of declaration, each for all
  /// interactions of the run (NodalInteractions), between the transfer from the
  /// points to the grid and the transfer back. All members are collective and
  /// do nothing by default. A new effect is a class derived from
  /// NodalInteraction and a line in the constructor of Problem.
  template <int dim>
  class NodalInteraction
  {
  public:
    virtual ~NodalInteraction() = default;

    /// Open the accounts of energy and impulse for record(). Called once,
    /// before the run starts or is resumed.
    virtual void
    open_accounts(Accounts<dim> & /*accounts*/)
    {}

    /// Prepare for the cells and nodes of @p grid. Called after each change of
    /// the mesh or its partition.
    virtual void
    prepare(const Grid<dim> & /*grid*/)
    {}

    /// Begin a step of state.time_step, s: masses, momenta and forces at the
    /// nodes owned by this rank are complete.
    virtual void
    begin_step(State<dim> & /*state*/)
    {}

    /// Add forces to the nodes, before the momentum update.
    virtual void
    add_forces(State<dim> & /*state*/)
    {}

    /// Change the velocities of the nodes after the momentum update.
    virtual void
    correct_velocities(State<dim> & /*state*/)
    {}

    /// Record energies and impulses of the step, when the velocities of all
    /// nodes are final. The work of an impulse is the product with the mean of
    /// the velocities before and after the step (NodalFields::mean_velocity()).
    virtual void
    record(State<dim> & /*state*/)
    {}

    /// Append columns of statistics.csv, complete on the first rank.
    virtual void
    list_quantities(const State<dim> & /*state*/, Quantities & /*list*/) const
    {}

    /// Add the data that a resumed run needs to continue with bit-identical
    /// results.
    virtual void
    list_state(StateList & /*list*/)
    {}

    /// Return sentences on settings that the user may not have meant.
    virtual std::vector<std::string>
    notes() const
    {
      return {};
    }
  };
} // namespace talus

#endif

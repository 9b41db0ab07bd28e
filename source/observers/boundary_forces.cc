// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/boundary_forces.h>

namespace talus
{
  template <int dim>
  BoundaryForces<dim>::BoundaryForces(BoundaryReactions<dim> &reactions)
    : QuantityTable<dim>("boundaries.csv")
    , reactions_(reactions)
  {}



  template <int dim>
  bool
  BoundaryForces<dim>::is_enabled(const OutputSettings & /*settings*/) const
  {
    return reactions_.is_enabled();
  }



  template <int dim>
  Quantities
  BoundaryForces<dim>::evaluate(const State<dim> &state) const
  {
    Quantities row = {{"time", "s", state.time}};
    reactions_.list_quantities(row);
    return row;
  }



  template <int dim>
  void
  BoundaryForces<dim>::observe(const State<dim> &state)
  {
    QuantityTable<dim>::observe(state);
    reactions_.start_interval();
  }



  template <int dim>
  void
  BoundaryForces<dim>::list_state(StateList &list)
  {
    if (reactions_.is_enabled())
      TableObserver<dim>::list_state(list);
  }



  template class BoundaryForces<2>;
  template class BoundaryForces<3>;
} // namespace talus

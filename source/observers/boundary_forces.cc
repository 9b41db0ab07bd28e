// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/boundary_forces.h>

namespace talus
{
  template <int dim>
  BoundaryForces<dim>::BoundaryForces(const BoundaryReactions<dim> &reactions)
    : ReactionTable<dim>("boundaries.csv")
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
    for (unsigned int k = 0; k < reactions_.all().size(); ++k)
      this->list_reaction(k, row);
    return row;
  }



  template class BoundaryForces<2>;
  template class BoundaryForces<3>;
} // namespace talus

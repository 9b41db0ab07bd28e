// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/boundary_reactions.h>

namespace talus
{
  template <int dim>
  void
  BoundaryReactions<dim>::prepare(const std::vector<std::string> &names,
                                  const bool                      is_enabled)
  {
    is_enabled_ = is_enabled;
    names_      = names;
    steps_.assign(names.size(), {});
    reactions_.assign(names.size(), {});
  }



  template <int dim>
  void
  BoundaryReactions<dim>::finish_step(const double   dt,
                                      const MPI_Comm communicator)
  {
    if (!is_enabled_)
      return;
    add_to_reactions(steps_, dt, averaging_time_, communicator, reactions_);
    steps_.assign(names_.size(), {});
  }



  template <int dim>
  void
  BoundaryReactions<dim>::start_interval()
  {
    for (Reaction<dim> &reaction : reactions_)
      reaction.start_interval();
  }



  template <int dim>
  void
  BoundaryReactions<dim>::list_quantities(Quantities &row) const
  {
    for (unsigned int k = 0; k < names_.size(); ++k)
      reactions_[k].list_quantities(names_[k], row);
  }



  template <int dim>
  void
  BoundaryReactions<dim>::list_state(StateList &list)
  {
    if (is_enabled_)
      for (unsigned int k = 0; k < names_.size(); ++k)
        reactions_[k].list_state("face " + names_[k], list);
  }



  template class BoundaryReactions<2>;
  template class BoundaryReactions<3>;
} // namespace talus

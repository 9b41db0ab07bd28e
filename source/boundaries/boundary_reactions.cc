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
    reactions_.assign(is_enabled ? names.size() : 0, {});
  }



  template <int dim>
  void
  BoundaryReactions<dim>::finish_step(const MPI_Comm communicator)
  {
    if (!is_enabled_)
      return;
    add_to_reactions(steps_, communicator, reactions_);
    steps_.assign(names_.size(), {});
  }



  template <int dim>
  void
  BoundaryReactions<dim>::list_state(StateList &list)
  {
    for (unsigned int k = 0; k < reactions_.size(); ++k)
      reactions_[k].list_state("face " + names_[k], list);
  }



  template class BoundaryReactions<2>;
  template class BoundaryReactions<3>;
} // namespace talus

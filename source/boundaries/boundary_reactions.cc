// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/boundary_reactions.h>
#include <talus/grid/mesh_layout.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  BoundaryReactions<dim>::prepare(const std::vector<unsigned int> &faces,
                                  const bool                       is_enabled)
  {
    is_enabled_ = is_enabled;
    faces_      = faces;
    steps_.fill({});
    reactions_.assign(is_enabled ? faces.size() : 0, {});
  }



  template <int dim>
  void
  BoundaryReactions<dim>::finish_step(const MPI_Comm communicator)
  {
    if (!is_enabled_)
      return;
    std::vector<StepReaction<dim>> steps;
    for (const unsigned int face : faces_)
      steps.push_back(steps_[face]);
    add_to_reactions(steps, communicator, reactions_);
    steps_.fill({});
  }



  template <int dim>
  const std::string &
  BoundaryReactions<dim>::name(const unsigned int k) const
  {
    return face_names[faces_[k]];
  }



  template <int dim>
  void
  BoundaryReactions<dim>::list_state(StateList &list)
  {
    for (unsigned int k = 0; k < reactions_.size(); ++k)
      reactions_[k].list_state("face " + name(k), list);
  }



  template class BoundaryReactions<2>;
  template class BoundaryReactions<3>;
} // namespace talus

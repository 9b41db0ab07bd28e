// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundary_reactions_h
#define talus_boundaries_boundary_reactions_h

#include <talus/boundaries/reaction.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// Forces of the soil on each face of the mesh with a condition. Moments are
  /// about the origin.
  template <int dim>
  class BoundaryReactions
  {
  public:
    /// Prepare one reaction for each of @p faces of the mesh if @p is_enabled,
    /// otherwise none.
    void
    prepare(const std::vector<unsigned int> &faces, bool is_enabled);

    bool
    is_enabled() const
    {
      return is_enabled_;
    }

    /// Return what soil on this rank does to @p face in the current step, to be
    /// added to.
    StepReaction<dim> &
    in_step(const unsigned int face)
    {
      return steps_[face];
    }

    /// Sum the impulses added in the step over the ranks. Collective.
    void
    finish_step(MPI_Comm communicator);

    /// Return one reaction per face with a condition if enabled, otherwise
    /// none.
    const std::vector<Reaction<dim>> &
    all() const
    {
      return reactions_;
    }

    /// Name of the face of reaction @p k.
    const std::string &
    name(unsigned int k) const;

    void
    list_state(StateList &list);

  private:
    bool                                   is_enabled_ = false;
    std::vector<unsigned int>              faces_; ///< faces of reactions_
    std::array<StepReaction<dim>, 2 * dim> steps_; ///< by face, of this rank
    std::vector<Reaction<dim>>             reactions_;
  };
} // namespace talus

#endif

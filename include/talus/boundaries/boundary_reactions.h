// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundary_reactions_h
#define talus_boundaries_boundary_reactions_h

#include <talus/boundaries/reaction.h>

#include <deal.II/base/point.h>

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
    /// Prepare one reaction for each of @p names if @p is_enabled, otherwise
    /// none.
    void
    prepare(const std::vector<std::string> &names, bool is_enabled);

    bool
    is_enabled() const
    {
      return is_enabled_;
    }

    /// Add impulses on the soil at one place.
    /// @param k index of the reaction
    /// @param x position, m
    /// @param normal impulse along the normal and by walls, N s
    /// @param tangential impulse by friction, N s
    /// @param v mean velocity of the soil in the step, m/s
    void
    add(const unsigned int            k,
        const dealii::Point<dim>     &x,
        const dealii::Tensor<1, dim> &normal,
        const dealii::Tensor<1, dim> &tangential,
        const dealii::Tensor<1, dim> &v)
    {
      StepReaction<dim> &step = steps_[k];
      step.add_impulse_on_soil(dealii::Tensor<1, dim>(x), normal + tangential);
      step.tangential -= tangential;
      step.friction_work -= tangential * v;
      step.contact_work -= normal * v;
    }

    /// Add an area in contact, m^(dim-1).
    void
    add_area(const unsigned int k, const double area)
    {
      steps_[k].area += area;
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
    name(const unsigned int k) const
    {
      return names_[k];
    }

    void
    list_state(StateList &list);

  private:
    bool                           is_enabled_ = false;
    std::vector<std::string>       names_;
    std::vector<StepReaction<dim>> steps_; ///< share of this rank
    std::vector<Reaction<dim>>     reactions_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundary_reactions_h
#define talus_boundaries_boundary_reactions_h

#include <talus/boundaries/reaction.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace talus
{
  /// What the soil does to each face of the mesh that has a condition. Moments
  /// are about the origin.
  template <int dim>
  class BoundaryReactions
  {
  public:
    /// One for each of @p names; none is booked unless it @p is_enabled.
    void
    prepare(const std::vector<std::string> &names, bool is_enabled);

    /// Average forces over @p time, s; see Reaction::add().
    void
    set_averaging_time(const double time)
    {
      averaging_time_ = time;
    }

    bool
    is_enabled() const
    {
      return is_enabled_;
    }

    /// Add impulses on the soil, N s, at @p x, where it moves with @p v, m/s, in
    /// the mean of the step: those along the normal and by walls, and those by
    /// friction.
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

    /// The step of @p dt, s, is over. Collective.
    void
    finish_step(double dt, MPI_Comm communicator);

    /// A row of the output was written.
    void
    start_interval();

    /// Append those of all faces.
    void
    list_quantities(Quantities &row) const;

    void
    list_state(StateList &list);

  private:
    bool                           is_enabled_     = false;
    double                         averaging_time_ = 0; ///< s
    std::vector<std::string>       names_;
    std::vector<StepReaction<dim>> steps_; ///< this rank's share
    std::vector<Reaction<dim>>     reactions_;
  };
} // namespace talus

#endif

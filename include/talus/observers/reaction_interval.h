// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_reaction_interval_h
#define talus_observers_reaction_interval_h

#include <talus/base/quantity.h>
#include <talus/boundaries/reaction.h>

#include <string>

namespace talus
{
  /// Means and extremes of the force of the soil on a surface since the
  /// previous row of a table.
  template <int dim>
  class ReactionInterval
  {
  public:
    /// Add a step of @p dt, s. The running mean of the force forgets past steps
    /// as exp(-t/T) with T = @p averaging_time, s: impacts of single steps do
    /// not count. If T is 0, the running mean is the force of the step.
    void
    add(const StepReaction<dim> &step, double dt, double averaging_time);

    /// Begin a new interval. The running mean continues.
    void
    restart()
    {
      ReactionInterval<dim> next;
      next.running_mean_     = running_mean_;
      next.has_running_mean_ = has_running_mean_;
      *this                  = next;
    }

    /// Append forces and moments as means of the interval, extremes of the
    /// force, and impulse and works since the start from @p total. The headings
    /// begin with @p name.
    void
    list_quantities(const std::string       &name,
                    const StepReaction<dim> &total,
                    Quantities              &row) const;

    void
    list_state(const std::string &name, StateList &list);

    /// Maximum of each component of the force in a step of the interval, N.
    const dealii::Tensor<1, dim> &
    max() const
    {
      return max_;
    }

    /// Running mean of the force, and minimum and maximum of each component in
    /// the interval, N.
    const dealii::Tensor<1, dim> &
    running_mean() const
    {
      return running_mean_;
    }

    const dealii::Tensor<1, dim> &
    min_mean() const
    {
      return min_mean_;
    }

    const dealii::Tensor<1, dim> &
    max_mean() const
    {
      return max_mean_;
    }

  private:
    void
    update_extremes(const dealii::Tensor<1, dim> &force,
                    double                        dt,
                    double                        averaging_time);

    double                 duration_ = 0;         ///< s
    dealii::Tensor<1, dim> impulse_, tangential_; ///< N s
    std::array<double, StepReaction<dim>::n_moments>
                           angular_impulse_{}; ///< N m s
    double                 area_time_ = 0;     ///< integral, m^(dim-1) s
    dealii::Tensor<1, dim> min_, max_;         ///< force of a step, N
    dealii::Tensor<1, dim> running_mean_;      ///< force, N
    bool                   has_running_mean_ = false;
    dealii::Tensor<1, dim> min_mean_, max_mean_; ///< running mean, N
  };
} // namespace talus

#endif

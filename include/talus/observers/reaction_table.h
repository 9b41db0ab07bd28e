// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_reaction_table_h
#define talus_observers_reaction_table_h

#include <talus/base/quantity.h>
#include <talus/boundaries/reaction.h>
#include <talus/observers/quantity_table.h>

#include <string>
#include <vector>

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



  /// Table of the forces of the soil on surfaces, one row per interval of the
  /// statistics: means and extremes over all steps since the previous row;
  /// impulses and works since the start. A derived class names the surfaces.
  template <int dim>
  class ReactionTable : public QuantityTable<dim>
  {
  public:
    /// @p file_name of the table and @p kind of surface, for the names of
    /// checkpoint entries.
    ReactionTable(const std::string &file_name, const std::string &kind)
      : QuantityTable<dim>(file_name)
      , kind_(kind)
    {}

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          const Beginning       beginning) override
    {
      averaging_time_ = settings.averaging_time;
      intervals_.resize(reactions().size());
      QuantityTable<dim>::begin(settings, state, beginning);
    }

    void
    follow(const State<dim> &state) override
    {
      for (unsigned int k = 0; k < intervals_.size(); ++k)
        intervals_[k].add(reactions()[k].last,
                          state.time_step,
                          averaging_time_);
    }

    void
    observe(const State<dim> &state) override
    {
      QuantityTable<dim>::observe(state);
      for (ReactionInterval<dim> &interval : intervals_)
        interval.restart();
    }

    /// Return the time and the columns of all surfaces.
    Quantities
    evaluate(const State<dim> &state) const override
    {
      Quantities row = {{"time", "s", state.time}};
      for (unsigned int k = 0; k < intervals_.size(); ++k)
        list_reaction(k, row);
      return row;
    }

    /// Add the intervals to the state of the run, unless there are no surfaces.
    void
    list_state(StateList &list) override
    {
      // A checkpoint is loaded before begin().
      if (reactions().empty())
        return;
      intervals_.resize(reactions().size());
      for (unsigned int k = 0; k < intervals_.size(); ++k)
        intervals_[k].list_state(kind_ + ' ' + name(k), list);
      QuantityTable<dim>::list_state(list);
    }

  protected:
    /// Append the columns of surface @p k.
    void
    list_reaction(const unsigned int k, Quantities &row) const
    {
      intervals_[k].list_quantities(name(k), reactions()[k].total, row);
    }

  private:
    /// Return one reaction per surface, none if the table is disabled.
    virtual const std::vector<Reaction<dim>> &
    reactions() const = 0;

    /// Return the name of surface @p k.
    virtual const std::string &
    name(unsigned int k) const = 0;

    std::string                        kind_;
    std::vector<ReactionInterval<dim>> intervals_;
    double                             averaging_time_ = 0; ///< s
  };
} // namespace talus

#endif

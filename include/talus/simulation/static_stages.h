// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_static_stages_h
#define talus_simulation_static_stages_h

#include <talus/equilibrium/equilibrium.h>
#include <talus/equilibrium/strength_reduction.h>
#include <talus/io/log.h>
#include <talus/observers/output.h>
#include <talus/simulation/failure_depth.h>
#include <talus/simulation/newton_table.h>
#include <talus/simulation/stages.h>
#include <talus/transfer/transfer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Static stages of a run, without time: search for equilibrium and for the
  /// factor of safety.
  template <int dim>
  class StaticStages
  {
  public:
    /// All arguments must outlive the object.
    StaticStages(State<dim>          &state,
                 Problem<dim>        &problem,
                 const Transfer<dim> &transfer,
                 const Output<dim>   &output,
                 Log                 &log);

    /// Throw ExcUser if the list of stages is invalid. Call after parsing,
    /// before any query of the stages.
    void
    check_list()
    {
      stages_.check();
    }

    /// Throw ExcUser if a listed stage cannot work. Call after the problem has
    /// been prepared.
    void
    check() const;

    /// Start the files of the stages; in a resumed run continue the files.
    void
    begin(const std::filesystem::path &folder, Beginning beginning);

    /// Throw ExcUser if the files of the stages differ from the checkpoint.
    /// Call before any file is truncated. Collective.
    void
    check_resumable(const std::filesystem::path &folder) const;

    /// Run the next stage, which must be static. If a signal stops the stage,
    /// the state is restored, and the same stage is still next. Collective.
    void
    run_next();

    /// Prepare the soil of a finished run without dynamics for the dynamics of
    /// a resumed run, as run_next() does before the dynamics. Collective.
    void
    continue_with_dynamics();

    /// Throw ExcUser if the dynamics would start from a balance that needs more
    /// than the actual strength.
    void
    check_soil_stands() const;

    const Stages &
    stages() const
    {
      return stages_;
    }

    const Equilibrium<dim> &
    equilibrium() const
    {
      return equilibrium_;
    }

    const StrengthReduction &
    strength_reduction() const
    {
      return strength_reduction_;
    }

    void
    list_state(StateList &list);

  private:
    /// State of points and contact, modified by a search.
    struct Saved
    {
      std::vector<std::vector<double>> columns; ///< columns of the points
      StaticContact<dim>               contact;
      std::vector<double>              facet_forces;
      std::vector<double>              slip; ///< BedSlip::rows()
    };

    Saved
    save() const;

    /// Restore a state in place: same points in the same order as at save().
    void
    restore(const Saved &saved);

    StaticProblem<dim>
    problem();

    /// Search for balance, starting from the current state without loads.
    /// Returns false if there is no balance, or if a signal to any rank stops
    /// the search. Collective.
    bool
    solve(const StaticOptions &options, const SearchLabel &label);

    void
    begin_stage();
    void
    find_equilibrium(const Saved &before);
    void
    tell_of_well_balanced_load() const;
    void
    let_weight_act();
    [[noreturn]] void
    throw_no_equilibrium(const std::string &sentence) const;
    void
    find_equilibrium_with_more_strength(const Saved &before);
    std::string
    no_equilibrium() const;
    void
    divide_strength(double factor);
    void
    reduce_strength(const Saved &before);
    bool
    search_standing_factor(const Saved &before, const StaticOptions &options);
    void
    search_factor(const Saved &before);
    void
    follow_path();
    void
    start_reduction();
    void
    undo_stage(const Saved &before);
    void
    write_mechanism(const std::string &name) const;

    State<dim>          &state_;
    Problem<dim>        &problem_;
    const Transfer<dim> &transfer_;
    const Output<dim>   &output_;
    Log                 &log_;
    Stages               stages_;
    Equilibrium<dim>     equilibrium_;
    NewtonTable          table_;
    std::uintmax_t       n_table_bytes_ = 0; ///< at the beginning of the stage
    StrengthReduction    strength_reduction_;
    FailureDepth<dim>    failure_depth_;

    /// The soil is in balance with strengths divided by this factor [-]: 1, or
    /// less if the soil does not stand with the actual strength.
    double standing_factor_ = 1.;
  };
} // namespace talus

#endif

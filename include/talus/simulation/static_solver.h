// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_static_solver_h
#define talus_simulation_static_solver_h

#include <talus/equilibrium/equilibrium.h>
#include <talus/equilibrium/static_problem.h>
#include <talus/io/log.h>
#include <talus/problem/problem.h>
#include <talus/simulation/newton_table.h>
#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Static solver of a run: finds balance by load steps, reports the load
  /// steps, and restores earlier states of the soil.
  template <int dim>
  class StaticSolver
  {
  public:
    /// All arguments must outlive the object.
    StaticSolver(State<dim>          &state,
                 Problem<dim>        &problem,
                 const Transfer<dim> &transfer,
                 Log                 &log);

    /// Start newton.csv; in a resumed run continue the table.
    void
    begin(const std::filesystem::path &folder, Beginning beginning);

    /// Return the reason why newton.csv cannot be continued; empty on all ranks
    /// except the first.
    std::string
    cannot_resume(const std::filesystem::path &folder) const;

    /// Begin a stage: points and mesh may differ from the previous stage.
    void
    begin_stage();

    /// Return whether a signal to any rank stopped the last search without
    /// result.
    bool
    is_stopped() const
    {
      return equilibrium_.is_stopped();
    }

    /// Description of a search for newton.csv and log.
    struct Label
    {
      unsigned int stage;           ///< one-based number of the stage
      double       strength_factor; ///< factor that divides strengths [-]
      /// Whether the search starts from a balance, with other strengths or
      /// loads. Load steps are then written to newton.csv only.
      bool is_trial = false;
    };

    /// Search for balance, starting from the current state without loads.
    /// Returns false if there is no balance; see no_equilibrium(). Collective.
    bool
    find(const StaticOptions &options, const Label &label);

    /// Sentence with the reason why find() failed.
    std::string
    no_equilibrium() const;

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

    /// Undo a stage, including newton.csv. @p saved is the state at
    /// begin_stage(). Collective.
    void
    undo_stage(const Saved &saved);

    const Equilibrium<dim> &
    equilibrium() const
    {
      return equilibrium_;
    }

    void
    list_state(StateList &list);

    /// Add the contact of the last load step, if @p is_needed() when saving.
    void
    list_contact(StateList &list, const std::function<bool()> &is_needed)
    {
      equilibrium_.contact().list_state(list, is_needed);
    }

  private:
    /// Data of a load step for the log.
    struct StepNote
    {
      unsigned int        step = 0;
      double              load = 0;
      std::vector<double> residuals;
      unsigned int        n_linear_iterations = 0;
      double              seconds             = 0;
    };

    StaticProblem<dim>
    problem();
    bool
    observe(const EquilibriumProgress &progress,
            const Label               &label,
            StepNote                  &note);
    void
    tell(const StepNote &note);

    State<dim>          &state_;
    Problem<dim>        &problem_;
    const Transfer<dim> &transfer_;
    Log                 &log_;
    Equilibrium<dim>     equilibrium_;
    NewtonTable          table_;
    std::uintmax_t       n_table_bytes_ = 0; ///< at the beginning of the stage
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_static_solver_h
#define talus_simulation_static_solver_h

#include <talus/equilibrium/equilibrium.h>
#include <talus/equilibrium/static_problem.h>
#include <talus/io/log.h>
#include <talus/problem/problem.h>
#include <talus/simulation/background_mesh.h>
#include <talus/simulation/newton_table.h>
#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Brings the soil of a run into balance, load step by load step, tells of
  /// them, and can take the soil back to where it was.
  template <int dim>
  class StaticSolver
  {
  public:
    StaticSolver(State<dim>          &state,
                 Problem<dim>        &problem,
                 const Transfer<dim> &transfer,
                 BackgroundMesh<dim> &mesh,
                 Log                 &log);

    /// Start newton.csv, or go on with it.
    void
    begin(const std::filesystem::path &folder, Beginning beginning);

    /// Why newton.csv cannot be gone on with; empty on other ranks than the
    /// first.
    std::string
    cannot_resume(const std::filesystem::path &folder) const;

    /// A stage begins: points and mesh may be others than in the last one.
    void
    begin_stage();

    /// Whether a signal to any rank stopped the last search, which then found
    /// nothing.
    bool
    is_stopped() const
    {
      return equilibrium_.is_stopped();
    }

    /// What is told of a search: the number of its stage and the factor that
    /// strengths are divided by.
    struct Label
    {
      unsigned int stage;
      double       strength_factor;
    };

    /// Search from the state as it is without loads. Returns false if there is
    /// no balance: then no_equilibrium() says why. Collective.
    bool
    find(StrainMeasure measure, const Label &label);

    /// Whether soil in balance with all its load, but with other strengths now,
    /// finds it again within these limits, in small strain. Collective.
    bool
    find_again(const EquilibriumLimits &limits, const Label &label);

    /// Whether soil in balance with a well-balanced load finds a balance with
    /// its weight as the dynamics takes it, too, in small strain. Collective.
    bool
    find_with_weight(const Label &label);

    /// Why find() failed, a sentence.
    std::string
    no_equilibrium() const;

    /// State of points and contact, which a search changes.
    struct Saved
    {
      std::vector<std::vector<double>> columns; ///< of the points
      StaticContact<dim>               contact;
      std::vector<double>              facet_forces;
    };

    Saved
    save() const;

    /// Go back; the points are still where they were.
    void
    restore(const Saved &saved);

    /// Go back; points may have moved since, the mesh with them, and to other
    /// ranks. Collective.
    void
    bring_back(const Saved &saved);

    /// Go back to the beginning of the stage, newton.csv too; @p saved is the
    /// state since begin_stage(). Collective.
    void
    undo_stage(const Saved &saved);

    const Equilibrium<dim> &
    equilibrium() const
    {
      return equilibrium_;
    }

    void
    list_state(StateList &list);

    /// Add the contact of the last load step, if @p is_needed.
    void
    list_contact(StateList &list, const std::function<bool()> &is_needed)
    {
      equilibrium_.contact().list_state(list, is_needed);
    }

  private:
    /// What a load step is told of.
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
    take_all_steps(const Label &label);
    bool
    take_load_step(const Label &label, StepNote &note);
    bool
    observe(const EquilibriumProgress &progress,
            const Label               &label,
            StepNote                  &note);
    void
    tell(const StepNote &note);

    State<dim>          &state_;
    Problem<dim>        &problem_;
    const Transfer<dim> &transfer_;
    BackgroundMesh<dim> &mesh_;
    Log                 &log_;
    Equilibrium<dim>     equilibrium_;
    NewtonTable          table_;
    std::uintmax_t       n_table_bytes_ = 0; ///< at the beginning of the stage
  };
} // namespace talus

#endif

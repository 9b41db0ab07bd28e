// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/base/interrupt.h>
#include <talus/simulation/static_solver.h>
#include <talus/simulation/yielded_extent.h>

#include <deal.II/base/mpi.h>

#include <iomanip>

namespace talus
{
  using namespace dealii;

  template <int dim>
  StaticSolver<dim>::StaticSolver(State<dim>          &state,
                                  Problem<dim>        &problem,
                                  const Transfer<dim> &transfer,
                                  Log                 &log)
    : state_(state)
    , problem_(problem)
    , transfer_(transfer)
    , log_(log)
  {}



  /// Only the first rank writes the table.
  template <int dim>
  void
  StaticSolver<dim>::begin(const std::filesystem::path &folder,
                           const Beginning              beginning)
  {
    if (is_first_rank(state_.communicator()))
      table_.begin(folder, beginning);
  }



  template <int dim>
  std::string
  StaticSolver<dim>::cannot_resume(const std::filesystem::path &folder) const
  {
    return is_first_rank(state_.communicator()) ? table_.cannot_resume(folder)
                                                : std::string();
  }



  template <int dim>
  void
  StaticSolver<dim>::begin_stage()
  {
    problem_.contact.slip().begin_step(state_.communicator());
    if (is_first_rank(state_.communicator()))
      n_table_bytes_ = table_.length();
  }



  /// Collect references to the state and to all forces, with the loads at the
  /// current time, constant during a static stage.
  template <int dim>
  StaticProblem<dim>
  StaticSolver<dim>::problem()
  {
    problem_.loading.update(state_.points, state_.time);
    return {state_,
            transfer_,
            problem_.materials,
            problem_.boundaries,
            problem_.loading.loads(),
            problem_.contact,
            problem_.bodies().mudline()};
  }



  /// Apply the load from zero to full. Nothing moves, which keeps the shape for
  /// which a factor of safety is sought.
  ///
  /// In a trial the soil was in balance and may have become weaker. First a
  /// load step without displacement returns the stress to the new yield
  /// surface, and the resulting imbalance is the load. Collective.
  template <int dim>
  bool
  StaticSolver<dim>::find(const StaticOptions &options, const Label &label)
  {
    equilibrium_.begin(options);
    if (label.is_trial)
      {
        StaticProblem<dim> before = problem();
        equilibrium_.return_stress(before);
      }
    while (!equilibrium_.is_balanced())
      {
        StaticProblem<dim> now = problem();
        StepNote           note;
        if (!equilibrium_.advance(now, [&](const auto &progress) {
              return observe(progress, label, note);
            }))
          return false;
        if (!label.is_trial && !note.residuals.empty())
          tell(note);
      }
    return true;
  }



  /// Write each iteration to newton.csv, and collect the iterations of the last
  /// attempt of a step in @p note. Returns false after a signal, possibly
  /// received by some ranks only.
  template <int dim>
  bool
  StaticSolver<dim>::observe(const EquilibriumProgress &progress,
                             const Label               &label,
                             StepNote                  &note)
  {
    if (is_first_rank(state_.communicator()))
      table_.add(label.stage, label.strength_factor, progress);
    if (progress.iteration.number == 0)
      note.residuals.clear(); // after a cut, or a change at the seabed
    note.step = progress.load_step;
    note.load = progress.load;
    note.residuals.push_back(progress.iteration.residual);
    note.n_linear_iterations += progress.iteration.n_linear_iterations;
    note.seconds += progress.iteration.seconds;
    return !Utilities::MPI::logical_or(!remembered_signal().empty(),
                                       state_.communicator());
  }



  /// Write a line per load step to the log: the residuals show whether
  /// convergence was quadratic.
  template <int dim>
  void
  StaticSolver<dim>::tell(const StepNote &note)
  {
    std::string residuals;
    for (const double residual : note.residuals)
      residuals +=
        text(residuals.empty() ? "" : ", ", std::setprecision(2), residual);
    log_.say(LogLevel::result,
             text(std::setprecision(6),
                  "  step ",
                  note.step,
                  ", load ",
                  note.load,
                  ": residuals ",
                  residuals,
                  note.n_linear_iterations > 0
                    ? text("; ", note.n_linear_iterations, " linear iterations")
                    : std::string(),
                  ", ",
                  note.seconds,
                  " s"));
  }



  /// State the fraction of the load reached and, in softening soil, how far it
  /// has yielded, in sentences for the user. The points are in the last
  /// balance.
  template <int dim>
  std::string
  StaticSolver<dim>::no_equilibrium() const
  {
    return text("The stage 'equilibrium' found no balance ",
                equilibrium_.load() > 0. ? text(std::setprecision(6),
                                                "beyond ",
                                                equilibrium_.load(),
                                                " of the load. ")
                                         : text("at any load. "),
                equilibrium_.failure(),
                ".",
                note_on_softening(state_, problem_));
  }



  /// Copies all columns, and the contact with seabed and obstacles, in memory:
  /// trials must be undone, and a checkpoint on disk would take longer.
  template <int dim>
  typename StaticSolver<dim>::Saved
  StaticSolver<dim>::save() const
  {
    const Points<dim> &points = state_.points;
    Saved              saved;
    for (unsigned int i = 0; i < points.n_arrays(); ++i)
      saved.columns.emplace_back(points.data(i),
                                 points.data(i) + points.size());
    saved.contact      = equilibrium_.newton().equations().contact();
    saved.facet_forces = problem_.contact.save();
    saved.slip         = problem_.contact.slip().rows();
    return saved;
  }



  template <int dim>
  void
  StaticSolver<dim>::restore(const Saved &saved)
  {
    Points<dim> &points = state_.points;
    for (unsigned int i = 0; i < points.n_arrays(); ++i)
      std::copy(saved.columns[i].begin(),
                saved.columns[i].end(),
                points.data(i));
    equilibrium_.contact() = saved.contact;
    problem_.contact.restore(saved.facet_forces);
    problem_.contact.slip().restore(saved.slip);
  }



  template <int dim>
  void
  StaticSolver<dim>::undo_stage(const Saved &saved)
  {
    restore(saved);
    if (is_first_rank(state_.communicator()))
      table_.cut(n_table_bytes_);
  }



  template <int dim>
  void
  StaticSolver<dim>::list_state(StateList &list)
  {
    table_.file().list_state(table_.file_name, list);
  }



  template class StaticSolver<2>;
  template class StaticSolver<3>;
} // namespace talus

// The part of Simulation for the stages in which time stands still.

#include <talus/base/errors.h>
#include <talus/simulation/simulation.h>
#include <talus/transfer/far_points.h>

#include <deal.II/base/mpi.h>

#include <iomanip>

namespace talus
{
  using namespace dealii;

  /// Throw ExcUser if a stage could not do its work; loads have been prepared.
  template <int dim>
  void
  Simulation<dim>::check_static_stages(
    const std::vector<std::string> &names_of_bodies) const
  {
    if (stages_.contain(Stage::equilibrium))
      equilibrium_.check(materials_, names_of_bodies);
    AssertThrow(!stages_.have_static() || loading_.share_of_gravity(0.) > 0.,
                ExcUser("Stages lists a stage before 'dynamics', which takes "
                        "the loads of t = 0, but there is no gravity at t = 0. "
                        "Set 'Gravity/Ramp time' to 0: the load comes on in "
                        "the steps of the stage."));
    if (!stages_.contain(Stage::strength_reduction))
      return;
    bool has_strength =
      boundaries_.has_seabed() && strength_reduction_.includes_seabed();
    for (unsigned int b = 0; b < names_of_bodies.size(); ++b)
      has_strength |= materials_.of_body(b).has_strength();
    AssertThrow(has_strength,
                ExcUser("Stages lists 'strength reduction', but nothing has a "
                        "strength that could be reduced: all bodies are made "
                        "of materials as that of section " +
                        materials_.of_body(0).section() +
                        ". Choose the law " +
                        names_of_laws_with_strength<dim>() +
                        ", let a face be a seabed with "
                        "'Strength reduction/Seabed', or remove the stage."));
  }



  /// What is to be brought to equilibrium: all that acts at the time it is now.
  template <int dim>
  Soil<dim>
  Simulation<dim>::soil()
  {
    loading_.update(points_, time_);
    return {points_,
            workspace_,
            grid_,
            nodes_,
            transfer_,
            materials_,
            boundaries_,
            loading_.loads(),
            time_,
            least_mass_};
  }



  /// Returns false if the run was stopped between two stages.
  template <int dim>
  bool
  Simulation<dim>::run_static_stages()
  {
    while (stages_.next_is_static())
      {
        {
          PhaseTimer::Scope scope(timer_, "static stages");
          if (stages_.next() == Stage::equilibrium)
            find_equilibrium();
          else
            reduce_strength();
          workspace_.clear();
        }
        stages_.count_one();
        if (!stages_.next_is_static())
          output_.start(snapshot());
        const Wish wish =
          static_cast<Wish>(Utilities::MPI::max(static_cast<int>(own_wish()),
                                                grid_.communicator()));
        if (act_on(std::max(wish, Wish::checkpoint)))
          return false;
      }
    check_soil_stands();
    return true;
  }



  template <int dim>
  void
  Simulation<dim>::find_equilibrium()
  {
    say("Stage 'equilibrium':");
    const bool  may_strengthen = stages_.contain(Stage::strength_reduction);
    StaticState before;
    if (may_strengthen)
      before = static_state();
    if (!bring_to_equilibrium(1., equilibrium_.measure()))
      {
        if (!may_strengthen)
          throw_no_equilibrium(no_equilibrium());
        find_equilibrium_with_more_strength(before);
      }
    const auto [largest, place] = equilibrium_.newton().largest_imbalance();
    say_and_note(text("Equilibrium was found in ",
                      equilibrium_.n_steps(),
                      " steps with ",
                      equilibrium_.newton().n_unknowns(),
                      " unknowns (linear solver: ",
                      equilibrium_.newton().linear_solver(),
                      "). The force out of balance is ",
                      equilibrium_.imbalance(),
                      " of that of the loads; the largest one of a node is ",
                      largest,
                      " N, at ",
                      place,
                      "."));
  }



  /// Returns false if no step, however small, succeeds.
  template <int dim>
  bool
  Simulation<dim>::take_load_step(const double factor, StepNote &note)
  {
    Soil<dim> all = soil();
    return equilibrium_.advance(all, [&](const auto &progress) {
      observe(progress, factor, note);
    });
  }



  /// Returns false if the soil, whose strengths are divided by @p factor, finds
  /// no balance.
  template <int dim>
  bool
  Simulation<dim>::bring_to_equilibrium(const double        factor,
                                        const StrainMeasure measure)
  {
    equilibrium_.begin(measure);
    while (!equilibrium_.is_found())
      {
        StepNote note;
        if (!take_load_step(factor, note))
          return false;
        if (!note.residuals.empty())
          tell(note);
        if (measure == StrainMeasure::large)
          follow_points();
      }
    return true;
  }



  /// Cells and mesh after all points may have moved, in a step that fails much
  /// farther than to a neighbouring cell.
  template <int dim>
  void
  Simulation<dim>::follow_points()
  {
    if (Utilities::MPI::n_mpi_processes(grid_.communicator()) > 1)
      {
        points_.forget_order();
        send_far_points(points_, grid_);
      }
    if (relocation_.update(points_, grid_))
      nodes_.activate(grid_, relocation_.occupied_cells());
    adapt_mesh();
  }



  /// Why the last search for equilibrium ended, a sentence.
  template <int dim>
  std::string
  Simulation<dim>::no_equilibrium() const
  {
    return text("The stage 'equilibrium' found no balance ",
                equilibrium_.load() > 0.
                  ? text("beyond ", equilibrium_.load(), " of the load. ")
                  : text("with any share of the load that was tried. "),
                equilibrium_.failure(),
                ".");
  }



  /// Show what moved, and end the run with @p sentence.
  template <int dim>
  void
  Simulation<dim>::throw_no_equilibrium(const std::string &sentence)
  {
    output_.write_mechanism(snapshot(),
                            "no-equilibrium",
                            equilibrium_.newton().mechanism(points_));
    throw ExcUser(
      sentence +
      " 'no-equilibrium' in the output folder shows where it moved. Either "
      "the soil cannot bear its weight, and needs more strength or support "
      "before the trigger" +
      (stages_.contain(Stage::strength_reduction)
         ? ""
         : " (the stage 'strength reduction' after this one finds how much)") +
      "; or the search needs more 'Equilibrium/Load steps'.");
  }



  template <int dim>
  void
  Simulation<dim>::observe(const EquilibriumProgress &progress,
                           const double               factor,
                           StepNote                  &note)
  {
    if (Utilities::MPI::this_mpi_process(grid_.communicator()) == 0)
      newton_table_.add(stages_.number(), factor, progress);
    if (progress.iteration.number == 0)
      note.residuals.clear(); // after a cut, or a change at the seabed
    note.step = progress.load_step;
    note.load = progress.load;
    note.residuals.push_back(progress.iteration.residual);
    note.n_linear_iterations += progress.iteration.n_linear_iterations;
    note.seconds += progress.iteration.seconds;
  }



  template <int dim>
  void
  Simulation<dim>::tell(const StepNote &note)
  {
    std::string residuals;
    for (const double residual : note.residuals)
      residuals +=
        text(residuals.empty() ? "" : ", ", std::setprecision(2), residual);
    const std::string sentence =
      text("  step ",
           note.step,
           ", load ",
           note.load,
           ": residuals ",
           residuals,
           note.n_linear_iterations > 0
             ? text("; ", note.n_linear_iterations, " linear iterations")
             : std::string());
    say(sentence);
    output_.note(text(sentence, ", ", note.seconds, " s"), false);
  }



  template <int dim>
  void
  Simulation<dim>::say_and_note(const std::string &sentence)
  {
    say(sentence);
    output_.note(sentence, false);
  }



#define INSTANTIATE(dim)                                                      \
  template void Simulation<dim>::check_static_stages(                         \
    const std::vector<std::string> &) const;                                  \
  template Soil<dim> Simulation<dim>::soil();                                 \
  template bool      Simulation<dim>::run_static_stages();                    \
  template void      Simulation<dim>::find_equilibrium();                     \
  template bool Simulation<dim>::bring_to_equilibrium(double, StrainMeasure); \
  template bool Simulation<dim>::take_load_step(double, StepNote &);          \
  template void Simulation<dim>::follow_points();                             \
  template std::string Simulation<dim>::no_equilibrium() const;               \
  template void Simulation<dim>::throw_no_equilibrium(const std::string &);   \
  template void Simulation<dim>::observe(const EquilibriumProgress &,         \
                                         double,                              \
                                         StepNote &);                         \
  template void Simulation<dim>::tell(const StepNote &);                      \
  template void Simulation<dim>::say_and_note(const std::string &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

// The part of Simulation for the stages in which time stands still.

#include <talus/base/errors.h>
#include <talus/simulation/simulation.h>

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
                        ". Choose the law 'von Mises', 'Bingham' or "
                        "'Herschel-Bulkley', let a face be a seabed with "
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
    return true;
  }



  template <int dim>
  void
  Simulation<dim>::find_equilibrium()
  {
    equilibrium_.begin(equilibrium_.measure());
    say("Stage 'equilibrium':");
    while (!equilibrium_.is_found())
      {
        StepNote  note;
        Soil<dim> all = soil();
        if (!equilibrium_.advance(all, [&](const auto &progress) {
              observe(progress, 1., note);
            }))
          throw_no_equilibrium();
        if (!note.residuals.empty())
          tell(note);
        if (equilibrium_.measure() == StrainMeasure::large)
          {
            if (relocation_.update(points_, grid_)) // all may have moved
              nodes_.activate(grid_, relocation_.occupied_cells());
            adapt_mesh();
          }
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



  /// Show what moved, and end the run.
  template <int dim>
  void
  Simulation<dim>::throw_no_equilibrium()
  {
    output_.write_mechanism(snapshot(),
                            "no-equilibrium",
                            equilibrium_.newton().mechanism(points_));
    throw ExcUser(
      text("The stage 'equilibrium' found no balance beyond ",
           equilibrium_.load(),
           " of the load. ",
           equilibrium_.failure(),
           ". 'no-equilibrium' in the output folder shows where it "
           "moved. Either the soil cannot bear its weight, and needs "
           "more strength or support before the trigger; or the "
           "search needs more 'Equilibrium/Load steps'."));
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



  namespace
  {
    /// All columns of the points, which stay where they are.
    template <int dim>
    std::vector<std::vector<double>>
    copy_columns(const Points<dim> &points)
    {
      std::vector<std::vector<double>> columns;
      for (unsigned int i = 0; i < points.n_arrays(); ++i)
        columns.emplace_back(points.data(i), points.data(i) + points.size());
      return columns;
    }



    template <int dim>
    void
    restore_columns(const std::vector<std::vector<double>> &columns,
                    Points<dim>                            &points)
    {
      for (unsigned int i = 0; i < points.n_arrays(); ++i)
        std::copy(columns[i].begin(), columns[i].end(), points.data(i));
    }
  } // namespace



  /// Every trial goes on from the largest factor with which the soil stood.
  template <int dim>
  void
  Simulation<dim>::reduce_strength()
  {
    say("Stage 'strength reduction':");
    const auto before = copy_columns(points_);
    auto       state  = before;
    strength_reduction_.begin();
    while (!strength_reduction_.is_done())
      {
        const double factor = strength_reduction_.next();
        const bool   stands = stands_with(factor);
        strength_reduction_.heed(factor, stands);
        say_and_note(stands ? text("  strength / ", factor, ": stands")
                            : text("  strength / ",
                                   factor,
                                   ": fails. ",
                                   equilibrium_.failure()));
        if (stands)
          state = copy_columns(points_);
        else // of all that fail the last one has the smallest factor
          output_.write_mechanism(snapshot(),
                                  "mechanism",
                                  equilibrium_.newton().mechanism(points_));
        restore_columns(state, points_);
      }
    restore_columns(before, points_);
    boundaries_.scale_seabed_strength(1.);
    say_and_note(strength_reduction_.result());
  }



  /// Look for balance with all strengths divided by @p factor.
  template <int dim>
  bool
  Simulation<dim>::stands_with(const double factor)
  {
    double *strength_factor = points_.data(materials_.strength_factor());
    std::fill(strength_factor, strength_factor + points_.size(), 1. / factor);
    if (strength_reduction_.includes_seabed())
      boundaries_.scale_seabed_strength(1. / factor);
    equilibrium_.begin(StrainMeasure::small,
                       strength_reduction_.smallest_step());
    while (!equilibrium_.is_found())
      {
        StepNote  note;
        Soil<dim> all = soil();
        if (!equilibrium_.advance(all, [&](const auto &progress) {
              observe(progress, factor, note);
            }))
          return false;
      }
    return true;
  }



#define INSTANTIATE(dim)                                                   \
  template void Simulation<dim>::check_static_stages(                      \
    const std::vector<std::string> &) const;                               \
  template Soil<dim> Simulation<dim>::soil();                              \
  template bool      Simulation<dim>::run_static_stages();                 \
  template bool      Simulation<dim>::stands_with(double);                 \
  template void      Simulation<dim>::reduce_strength();                   \
  template void      Simulation<dim>::find_equilibrium();                  \
  template void      Simulation<dim>::throw_no_equilibrium();              \
  template void      Simulation<dim>::observe(const EquilibriumProgress &, \
                                         double,                      \
                                         StepNote &);                 \
  template void      Simulation<dim>::tell(const StepNote &);              \
  template void      Simulation<dim>::say_and_note(const std::string &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

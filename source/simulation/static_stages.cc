// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/base/interrupt.h>
#include <talus/simulation/shear_bands.h>
#include <talus/simulation/static_stages.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  StaticStages<dim>::StaticStages(State<dim>          &state,
                                  Problem<dim>        &problem,
                                  const Transfer<dim> &transfer,
                                  const Output<dim>   &output,
                                  Log                 &log)
    : state_(state)
    , problem_(problem)
    , transfer_(transfer)
    , output_(output)
    , log_(log)
    , table_(log)
  {}



  /// Only the first rank writes the table.
  template <int dim>
  void
  StaticStages<dim>::begin(const std::filesystem::path &folder,
                           const Beginning              beginning)
  {
    if (stages_.has_static() && is_first_rank(state_.communicator()))
      table_.begin(folder, beginning);
  }



  template <int dim>
  void
  StaticStages<dim>::check_resumable(const std::filesystem::path &folder) const
  {
    if (!stages_.has_static())
      return;
    const std::string sentence =
      first_sentence(is_first_rank(state_.communicator())
                       ? table_.cannot_resume(folder)
                       : std::string(),
                     state_.communicator());
    AssertThrow(sentence.empty(), ExcUser(sentence));
  }



  /// Points and mesh may differ from the previous stage.
  template <int dim>
  void
  StaticStages<dim>::begin_stage()
  {
    problem_.contact.slip().begin_step(state_.communicator());
    if (is_first_rank(state_.communicator()))
      n_table_bytes_ = table_.length();
  }



  /// Time does not advance. The workspace is freed at the end: a static stage
  /// needs memory for all points, a time step only for a batch. Collective.
  template <int dim>
  void
  StaticStages<dim>::run_next()
  {
    begin_stage(); // slip of a checkpoint goes to its ranks
    const auto before = save();
    if (stages_.next() == Stage::equilibrium)
      find_equilibrium(before);
    else
      reduce_strength(before);
    if (!equilibrium_.is_stopped() && stages_.next_precedes_dynamics() &&
        equilibrium_.newton().equations().has_well_balanced_load())
      let_weight_act();
    state_.workspace.clear();
    if (equilibrium_.is_stopped())
      undo_stage(before);
    else
      stages_.mark_done();
  }



  /// A stage cannot be resumed in the middle: its searches form a chain of
  /// states not stored in checkpoints.
  template <int dim>
  void
  StaticStages<dim>::undo_stage(const Saved &before)
  {
    restore(before);
    if (is_first_rank(state_.communicator()))
      table_.cut(n_table_bytes_);
    if (strength_reduction_.includes_seabed())
      problem_.scale_seabed_strength(1. / standing_factor_);
    log_.say(LogLevel::result,
             "The stage was stopped by a signal: a resumed run starts the "
             "stage again.");
  }



  /// The strength reduction continues with the contact of the previous stage.
  template <int dim>
  void
  StaticStages<dim>::list_state(StateList &list)
  {
    stages_.list_state(list);
    list.add("standing factor", "-", standing_factor_, Reduction::equal);
    table_.file().list_state(table_.file_name, list);
    if (stages_.contain(Stage::strength_reduction))
      equilibrium_.contact().list_state(list, [this]() {
        return stages_.next_is_static();
      });
  }



  /// Invalid stages are reported before the mesh is created.
  template <int dim>
  void
  StaticStages<dim>::check() const
  {
    const std::vector<std::string> names_of_bodies = problem_.bodies().names();
    if (stages_.has_static())
      Equilibrium<dim>::check(problem_.materials, names_of_bodies);
    AssertThrow(!stages_.has_static() ||
                  problem_.loading.share_of_gravity(0.) > 0.,
                ExcUser("Stages lists a stage before 'dynamics', computed with "
                        "the loads of t = 0, but there is no gravity at t = 0. "
                        "Set 'Gravity/Ramp time' to 0: the stage itself "
                        "applies the load in steps."));
    if (!stages_.contain(Stage::strength_reduction))
      {
        AssertThrow(!problem_.pore_pressure.is_final_in_stage(),
                    ExcUser("'Excess pore pressure/Stage value' is 'final', "
                            "but Stages lists no 'strength reduction', the "
                            "stage that would see this pressure. Add the "
                            "stage, or use 'initial'."));
        return;
      }
    strength_reduction_.check();
    bool has_strength =
      problem_.has_seabed() && strength_reduction_.includes_seabed();
    for (unsigned int b = 0; b < names_of_bodies.size(); ++b)
      has_strength |= problem_.materials.of_body(b).has_strength();
    AssertThrow(has_strength,
                ExcUser("Stages lists 'strength reduction', but there is no "
                        "strength to reduce: the materials of all bodies are "
                        "like section " +
                        problem_.materials.of_body(0).section() +
                        ". Choose the law " +
                        names_of_laws_with_strength<dim>() +
                        ", let a face be a seabed or give an obstacle, with "
                        "'Strength reduction/Seabed', or remove the stage."));
  }



  /// Collect references to the state and to all forces, with the loads at the
  /// current time, constant during a static stage.
  template <int dim>
  StaticProblem<dim>
  StaticStages<dim>::problem()
  {
    problem_.loading.update(state_.points, state_.time, true);
    return {state_,
            transfer_,
            problem_.materials,
            problem_.boundaries,
            problem_.loading.loads(),
            problem_.contact,
            problem_.bodies().mudline(),
            [this](const double factor) { divide_strength(factor); }};
  }



  /// Copies all columns, and the contact with seabed and obstacles, in memory:
  /// trials must be undone, and a checkpoint on disk would take longer.
  template <int dim>
  typename StaticStages<dim>::Saved
  StaticStages<dim>::save() const
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
  StaticStages<dim>::restore(const Saved &saved)
  {
    for (unsigned int i = 0; i < saved.columns.size(); ++i)
      std::copy(saved.columns[i].begin(),
                saved.columns[i].end(),
                state_.points.data(i));
    equilibrium_.contact() = saved.contact;
    problem_.contact.restore(saved.facet_forces);
    problem_.contact.slip().restore(saved.slip);
  }



  /// Apply the load from zero to full. Nothing moves, which keeps the shape for
  /// which a factor of safety is sought. A signal may be received by some ranks
  /// only.
  template <int dim>
  bool
  StaticStages<dim>::solve(const StaticOptions &options,
                           const SearchLabel   &label)
  {
    const bool is_first = is_first_rank(state_.communicator());
    const auto observe  = [&](const EquilibriumProgress &progress) {
      table_.add(label, progress, is_first);
      return !Utilities::MPI::logical_or(!remembered_signal().empty(),
                                         state_.communicator());
    };
    StaticProblem<dim> now = problem();
    equilibrium_.begin(options);
    bool is_sound = true;
    while (is_sound && !equilibrium_.is_balanced())
      {
        is_sound = equilibrium_.advance(now, observe);
        table_.end_step(
          {label.stage, label.strength_factor, label.is_trial || !is_sound});
      }
    return is_sound;
  }



  /// If no balance is found, the run ends, unless a following strength
  /// reduction can determine the missing strength. @p before is the state
  /// without loads.
  template <int dim>
  void
  StaticStages<dim>::find_equilibrium(const Saved &before)
  {
    log_.say(LogLevel::result, "Stage 'equilibrium':");
    if (!solve(equilibrium_.options(), {stages_.number(), 1.}) &&
        !equilibrium_.is_stopped())
      {
        if (!stages_.contain(Stage::strength_reduction))
          throw_no_equilibrium(no_equilibrium());
        find_equilibrium_with_more_strength(before);
      }
    if (equilibrium_.is_stopped())
      return;
    const auto [largest, place] =
      equilibrium_.newton().equations().largest_imbalance();
    log_.say(LogLevel::result,
             text(std::setprecision(6),
                  "Equilibrium was found in ",
                  counted(equilibrium_.n_steps(), "step"),
                  " with ",
                  equilibrium_.newton().n_unknowns(),
                  " unknowns (linear solver: ",
                  equilibrium_.newton().linear_solver(),
                  "). The force out of balance, relative to the loads, is ",
                  equilibrium_.imbalance(),
                  "; the largest nodal force out of balance is ",
                  largest,
                  " N, at ",
                  place,
                  "."));
    if (equilibrium_.newton().equations().reference_force() == 0.)
      log_.remark("The stage 'equilibrium' had nothing to balance: neither "
                  "gravity, 'Gravity/Magnitude', nor another load acts on "
                  "the soil, and the soil has no stress.");
    tell_of_well_balanced_load();
  }



  /// Write the size of the correction to the log. Collective.
  template <int dim>
  void
  StaticStages<dim>::tell_of_well_balanced_load() const
  {
    const auto &equations = equilibrium_.newton().equations();
    if (!equations.has_well_balanced_load())
      return;
    const double        share = equations.well_balanced_share();
    const unsigned long n_without =
      equations.well_balanced_load().n_nodes_without();
    log_.say(LogLevel::result,
             text(std::setprecision(3),
                  "The load is well-balanced: the correction in partly filled "
                  "cells is ",
                  share,
                  " of the loads (Euclidean norms of the forces at the "
                  "nodes)",
                  n_without > 0 ? text(". There is no correction at ",
                                       counted(n_without, "node"),
                                       " beside free faces of the soil, as at "
                                       "cliffs.")
                                : "."));
  }



  template <int dim>
  void
  StaticStages<dim>::continue_with_dynamics()
  {
    if (!equilibrium_.options().is_well_balanced)
      return;
    begin_stage();
    let_weight_act();
    state_.workspace.clear();
  }



  /// The explicit scheme has no well-balanced load: the correction is released
  /// in a further load step. If the soil at the mudline cannot carry the
  /// additional load, the dynamics starts from the balance with the
  /// well-balanced load. Collective.
  template <int dim>
  void
  StaticStages<dim>::let_weight_act()
  {
    if (!stages_.contain(Stage::equilibrium) || standing_factor_ != 1.)
      return;
    const auto before = save();
    // The last static stage, which is done if a resumed run adds the dynamics.
    const unsigned int stage =
      stages_.number() - (stages_.next_is_static() ? 0 : 1);
    StaticOptions options    = equilibrium_.options();
    options.is_well_balanced = false;
    if (solve(options, {stage, 1., true}))
      log_.say(LogLevel::result,
               text("For the dynamics the weight acts without the correction "
                    "of the well-balanced load; balance was found in ",
                    counted(equilibrium_.n_steps(), "step"),
                    "."));
    else if (!equilibrium_.is_stopped())
      {
        restore(before);
        log_.remark(
          "The dynamics takes the weight without the correction "
          "of the well-balanced load, for which no balance was found. " +
          equilibrium_.failure() +
          ". It starts from the balance with the correction, so that soil in "
          "partly filled cells may move a little in the first seconds.");
      }
  }



  /// State the fraction of the load reached and, in softening soil, how far it
  /// has yielded, in sentences for the user. The points are in the last
  /// balance.
  template <int dim>
  std::string
  StaticStages<dim>::no_equilibrium() const
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



  /// Write the failure mechanism, and end the run with @p sentence.
  template <int dim>
  void
  StaticStages<dim>::throw_no_equilibrium(const std::string &sentence) const
  {
    write_mechanism("no-equilibrium");
    throw ExcUser(
      sentence +
      " 'no-equilibrium' in the output folder shows where the soil moved. "
      "Either the soil needs more strength or support before the trigger" +
      (stages_.contain(Stage::strength_reduction)
         ? ""
         : " (a following stage 'strength reduction' finds how much)") +
      "; or the search needs more 'Equilibrium/Load steps'.");
  }



  /// Divide all strengths by @p factor [-]. The factors are set, not
  /// multiplied: a trial does not depend on previous trials.
  template <int dim>
  void
  StaticStages<dim>::divide_strength(const double factor)
  {
    double *strength_factor =
      state_.points.data(problem_.materials.strength_factor());
    std::fill(strength_factor,
              strength_factor + state_.points.size(),
              1. / factor);
    if (strength_reduction_.includes_seabed())
      problem_.scale_seabed_strength(1. / factor);
  }



  /// The soil does not stand with the actual strength. To provide an initial
  /// state for the stage 'strength reduction', search for a strength with which
  /// the soil stands. @p before is the state without loads.
  template <int dim>
  void
  StaticStages<dim>::find_equilibrium_with_more_strength(const Saved &before)
  {
    const std::string sentence = no_equilibrium();
    log_.say(LogLevel::result,
             sentence +
               " The soil seems too weak for its weight. For the following "
               "stage 'strength reduction', a balance is looked for with more "
               "strength.");
    strength_reduction_.begin(
      problem_.materials.largest_strength_factor(state_.points,
                                                 state_.communicator()));
    // Uses the search of the reduction, from above: factors less than one.
    strength_reduction_.record(1., false);
    if (!search_standing_factor(before, equilibrium_.options()) &&
        !equilibrium_.is_stopped())
      throw_no_equilibrium(sentence +
                           " No balance was found with more strength either. " +
                           strength_reduction_.result());
    standing_factor_ = strength_reduction_.lower();
  }



  /// Apply the full load to soil of more and more strength, from the state
  /// @p before without loads, until it stands. Returns whether it does.
  /// Collective.
  template <int dim>
  bool
  StaticStages<dim>::search_standing_factor(const Saved         &before,
                                            const StaticOptions &options)
  {
    while (strength_reduction_.lower() == 0. && !strength_reduction_.is_done())
      {
        const double factor = strength_reduction_.next();
        restore(before);
        divide_strength(factor);
        const bool stands = solve(options, {stages_.number(), factor});
        if (equilibrium_.is_stopped())
          return false;
        strength_reduction_.record(factor, stands);
        log_.say(LogLevel::result,
                 text(std::setprecision(6),
                      "  strength / ",
                      factor,
                      stands ? ": stands"
                             : ": fails. " + equilibrium_.failure()));
      }
    return strength_reduction_.lower() > 0.;
  }



  /// At the end soil and seabed are restored to @p before, the state at the
  /// beginning of the stage. Collective.
  template <int dim>
  void
  StaticStages<dim>::reduce_strength(const Saved &before)
  {
    log_.say(LogLevel::result, "Stage 'strength reduction':");
    strength_reduction_.begin(
      problem_.materials.largest_strength_factor(state_.points,
                                                 state_.communicator()));
    // Soil that stands as it is may fail with Davis' strength, or under the
    // pressure at the end.
    const bool is_final = problem_.pore_pressure.is_final_in_stage();
    if (is_final)
      problem_.pore_pressure.add(state_.points, 1.);
    problem_.materials.use_associated_flow(strength_reduction_.is_associated());
    if (stages_.contain(Stage::equilibrium) && !is_final &&
        !strength_reduction_.is_associated())
      start_reduction();
    search_factor(is_final ? save() : before);
    const auto remarks = problem_.materials.notes_on_safety();
    problem_.materials.use_associated_flow(false);
    if (equilibrium_.is_stopped())
      return;
    for (const Remark &remark : remarks)
      log_.remark(remark);
    restore(before);
    problem_.scale_seabed_strength(
      strength_reduction_.includes_seabed() ? 1. / standing_factor_ : 1.);
    log_.say(LogLevel::result, strength_reduction_.result());
    if (!stages_.contain(Stage::equilibrium))
      tell_of_well_balanced_load();
    const auto notes =
      failure_depth_.notes(state_, problem_, strength_reduction_.factor());
    if (!notes.empty())
      log_.say(LogLevel::result, notes[0].sentence);
    if (notes.size() > 1)
      log_.remark(notes[1]);
  }



  /// Without the stage 'equilibrium', a factor with which the soil stands is
  /// searched first.
  template <int dim>
  void
  StaticStages<dim>::search_factor(const Saved &before)
  {
    if (search_standing_factor(
          before, strength_reduction_.options(equilibrium_.options())))
      follow_path();
    if (!equilibrium_.is_stopped() && strength_reduction_.upper() > 0.)
      {
        write_mechanism("mechanism");
        failure_depth_.record(equilibrium_.newton().mechanism(state_.points));
      }
  }



  /// Points and contact change only in steps that are found. A signal ends the
  /// search.
  template <int dim>
  void
  StaticStages<dim>::follow_path()
  {
    const bool    is_first = is_first_rank(state_.communicator());
    StrengthPath &path     = strength_reduction_.path();
    equilibrium_.begin(strength_reduction_.options(equilibrium_.options()));
    while (!strength_reduction_.is_done())
      {
        SearchLabel        label{stages_.number(), path.factor, true};
        unsigned int       n_iterations = 0;
        StaticProblem<dim> now          = problem();
        const bool         is_found     = equilibrium_.follow(
          now, path, [&](const EquilibriumProgress &progress) {
            label.strength_factor = path.factor;
            ++n_iterations;
            table_.add(label, progress, is_first);
            return !Utilities::MPI::logical_or(!remembered_signal().empty(),
                                               state_.communicator());
          });
        table_.end_step(label);
        if (equilibrium_.is_stopped())
          return;
        log_.say(LogLevel::result,
                 text(std::setprecision(6),
                      "  strength / ",
                      label.strength_factor,
                      is_found
                        ? ": stands"
                        : ": the step fails. " + equilibrium_.failure()));
        strength_reduction_.record_step(is_found, n_iterations);
      }
  }



  /// The soil is in equilibrium. Verify the balance by the measure of the
  /// reduction, or else every factor would appear to cause failure.
  template <int dim>
  void
  StaticStages<dim>::start_reduction()
  {
    strength_reduction_.record(standing_factor_, true);
    divide_strength(standing_factor_);
    AssertThrow(
      solve(strength_reduction_.options(equilibrium_.options()),
            {stages_.number(), standing_factor_, true}) ||
        equilibrium_.is_stopped(),
      ExcUser(text(
        "The stage 'strength reduction' starts from soil that is out of "
        "balance, so that no factor of safety exists. ",
        equilibrium_.failure(),
        ". Set 'Equilibrium/Allowed imbalance' to less; or, if the imbalance "
        "is small against the required 'Tolerance' of the factor, set "
        "'Strength reduction/Allowed imbalance' to more.")));
  }



  template <int dim>
  void
  StaticStages<dim>::check_soil_stands() const
  {
    AssertThrow(
      standing_factor_ == 1. || !stages_.contain(Stage::dynamics),
      ExcUser(text(
        std::setprecision(6),
        "The stage 'equilibrium' found no balance with the strength of the "
        "soil, only with ",
        1. / standing_factor_,
        " times as much, so that there is no state of rest for the start of "
        "the stage 'dynamics'; log.txt has the factor of safety. Either the "
        "soil cannot bear its weight, and needs more strength or support "
        "before the trigger; or, if the factor is more than 1, the search "
        "needs more 'Equilibrium/Load steps'. To let the soil fall without "
        "stress from t = 0 list 'dynamics' alone.")));
  }



  /// Write the motion of the soil where the search failed.
  template <int dim>
  void
  StaticStages<dim>::write_mechanism(const std::string &name) const
  {
    output_.write_mechanism(state_,
                            name,
                            equilibrium_.newton().mechanism(state_.points));
  }



  template class StaticStages<2>;
  template class StaticStages<3>;
} // namespace talus

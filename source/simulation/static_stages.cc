// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/simulation/static_stages.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  StaticStages<dim>::StaticStages(State<dim>          &state,
                                  Problem<dim>        &problem,
                                  const Transfer<dim> &transfer,
                                  BackgroundMesh<dim> &mesh,
                                  const Output<dim>   &output,
                                  Log                 &log)
    : state_(state)
    , problem_(problem)
    , output_(output)
    , log_(log)
    , solver_(state, problem, transfer, mesh, log)
  {}



  template <int dim>
  void
  StaticStages<dim>::begin(const std::filesystem::path &folder,
                           const Beginning              beginning)
  {
    if (stages_.have_static())
      solver_.begin(folder, beginning);
  }



  template <int dim>
  void
  StaticStages<dim>::check_resumable(const std::filesystem::path &folder) const
  {
    if (!stages_.have_static())
      return;
    const std::string sentence =
      first_sentence(solver_.cannot_resume(folder), state_.communicator());
    AssertThrow(sentence.empty(), ExcUser(sentence));
  }



  /// Time stands still. The workspace is freed, which a static stage makes as
  /// large as all points: a step needs it for a batch only. Collective.
  template <int dim>
  void
  StaticStages<dim>::run_next()
  {
    const auto before = solver_.save();
    solver_.begin_stage();
    if (stages_.next() == Stage::equilibrium)
      find_equilibrium(before);
    else
      reduce_strength(before);
    if (!solver_.is_stopped() && stages_.next_is_last_static())
      let_weight_act();
    state_.workspace.clear();
    if (solver_.is_stopped())
      undo_stage(before);
    else
      stages_.count_one();
  }



  /// A stage cannot be resumed in the middle: its searches are a chain of states
  /// that no checkpoint has.
  template <int dim>
  void
  StaticStages<dim>::undo_stage(const typename StaticSolver<dim>::Saved &before)
  {
    solver_.undo_stage(before);
    if (strength_reduction_.includes_seabed())
      problem_.scale_seabed_strength(1. / standing_factor_);
    log_.say(LogLevel::result,
             "The stage was stopped by a signal: a resumed run begins it "
             "anew.");
  }



  /// The strength reduction goes on with the contact of the stage before it.
  template <int dim>
  void
  StaticStages<dim>::list_state(StateList &list)
  {
    stages_.list_state(list);
    list.add("standing factor", "-", standing_factor_, Reduction::equal);
    solver_.list_state(list);
    if (stages_.contain(Stage::strength_reduction))
      solver_.list_contact(list, [this]() { return stages_.next_is_static(); });
  }



  /// What the stages cannot do is said before the mesh is made.
  template <int dim>
  void
  StaticStages<dim>::check() const
  {
    const std::vector<std::string> names_of_bodies = problem_.names_of_bodies();
    if (stages_.contain(Stage::equilibrium))
      equilibrium().check(problem_.materials, names_of_bodies);
    AssertThrow(!stages_.have_static() ||
                  problem_.loading.share_of_gravity(0.) > 0.,
                ExcUser("Stages lists a stage before 'dynamics', which takes "
                        "the loads of t = 0, but there is no gravity at t = 0. "
                        "Set 'Gravity/Ramp time' to 0: the load comes on in "
                        "the steps of the stage."));
    if (!stages_.contain(Stage::strength_reduction))
      return;
    strength_reduction_.check();
    bool has_strength =
      problem_.has_seabed() && strength_reduction_.includes_seabed();
    for (unsigned int b = 0; b < names_of_bodies.size(); ++b)
      has_strength |= problem_.materials.of_body(b).has_strength();
    AssertThrow(has_strength,
                ExcUser("Stages lists 'strength reduction', but nothing has a "
                        "strength that could be reduced: all bodies are made "
                        "of materials as that of section " +
                        problem_.materials.of_body(0).section() +
                        ". Choose the law " +
                        names_of_laws_with_strength<dim>() +
                        ", let a face be a seabed or give an obstacle, with "
                        "'Strength reduction/Seabed', or remove the stage."));
  }



  /// Soil that finds no balance ends the run, unless the strength reduction
  /// that follows can tell how much it lacks. @p before is the state without
  /// loads.
  template <int dim>
  void
  StaticStages<dim>::find_equilibrium(
    const typename StaticSolver<dim>::Saved &before)
  {
    log_.say(LogLevel::result, "Stage 'equilibrium':");
    if (!solver_.find(equilibrium().measure(), label(1.)) &&
        !solver_.is_stopped())
      {
        if (!stages_.contain(Stage::strength_reduction))
          throw_no_equilibrium(solver_.no_equilibrium());
        find_equilibrium_with_more_strength(before);
      }
    if (solver_.is_stopped())
      return;
    const auto [largest, place] =
      equilibrium().newton().equations().largest_imbalance();
    log_.say(LogLevel::result,
             text(std::setprecision(6),
                  "Equilibrium was found in ",
                  equilibrium().n_steps(),
                  " steps with ",
                  equilibrium().newton().n_unknowns(),
                  " unknowns (linear solver: ",
                  equilibrium().newton().linear_solver(),
                  "). The force out of balance is ",
                  equilibrium().imbalance(),
                  " of that of the loads; the largest one of a node is ",
                  largest,
                  " N, at ",
                  place,
                  "."));
    if (equilibrium().newton().equations().reference_force() == 0.)
      log_.remark("The stage 'equilibrium' had nothing to balance: neither "
                  "gravity, 'Gravity/Magnitude', nor another load acts on the "
                  "soil, and it has no stress.");
    tell_of_well_balanced_load();
  }



  /// Collective.
  template <int dim>
  void
  StaticStages<dim>::tell_of_well_balanced_load() const
  {
    const auto &equations = equilibrium().newton().equations();
    if (!equations.has_well_balanced_load())
      return;
    const double        share = equations.well_balanced_share();
    const unsigned long n_without =
      equations.well_balanced_load().n_nodes_without();
    log_.say(LogLevel::result,
             text(std::setprecision(3),
                  "The load is well-balanced: its correction in cells that "
                  "are not full is ",
                  share,
                  " of the loads (Euclidean norms of the forces at the "
                  "nodes)",
                  n_without > 0
                    ? text(". There is none at ",
                           n_without,
                           " nodes beside free faces of the soil, as at "
                           "cliffs.")
                    : "."));
  }



  /// The explicit scheme knows no well-balanced load: what this has subtracted
  /// acts as one more load step. If the soil at the mudline cannot bear it, the
  /// dynamics starts from the balance with the well-balanced load. Collective.
  template <int dim>
  void
  StaticStages<dim>::let_weight_act()
  {
    if (!stages_.contain(Stage::equilibrium) || standing_factor_ != 1. ||
        equilibrium().measure() == StrainMeasure::large ||
        !equilibrium().newton().equations().has_well_balanced_load())
      return;
    const auto before = solver_.save();
    if (solver_.find_with_weight(label(1.)))
      log_.say(LogLevel::result,
               text("For the dynamics the weight acts without the correction "
                    "of the well-balanced load; balance was found in ",
                    equilibrium().n_steps(),
                    " steps."));
    else if (!solver_.is_stopped())
      {
        solver_.restore(before);
        log_.remark(
          "The dynamics takes the weight without the correction "
          "of the well-balanced load, for which no balance was found. " +
          equilibrium().failure() +
          ". It starts from the balance with the correction, so that "
          "soil in cells that are not full may move a little in the "
          "first seconds.");
      }
  }



  /// Show what moved, and end the run with @p sentence.
  template <int dim>
  void
  StaticStages<dim>::throw_no_equilibrium(const std::string &sentence) const
  {
    write_mechanism("no-equilibrium");
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



  /// Divide all strengths by @p factor.
  /// Set, not multiplied: each trial is that of a factor, whatever was before.
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



  /// Small strain, in which the slope keeps the shape whose factor of safety is
  /// asked for: with large strain a little more strength would let it stand
  /// after a long way. Hyperelastic laws know large strain only.
  template <int dim>
  StrainMeasure
  StaticStages<dim>::measure_of_stronger_soil() const
  {
    return problem_.has_hyperelastic_body() ? StrainMeasure::large
                                            : StrainMeasure::small;
  }



  /// The soil does not stand with the strength that it has. So that the stage
  /// 'strength reduction' has where to start from, look for a strength with
  /// which it does; @p before is the state without loads.
  template <int dim>
  void
  StaticStages<dim>::find_equilibrium_with_more_strength(
    const typename StaticSolver<dim>::Saved &before)
  {
    const std::string sentence = solver_.no_equilibrium();
    log_.say(LogLevel::result,
             sentence +
               " The soil seems not to bear its weight. Since the stage "
               "'strength reduction' follows, one is looked for with more "
               "strength.");
    strength_reduction_.begin(
      problem_.materials.largest_strength_factor(state_.points,
                                                 state_.communicator()));
    // The search of the reduction itself, from above: factors less than one.
    strength_reduction_.record(1., false);
    while (strength_reduction_.lower() == 0.)
      {
        if (strength_reduction_.is_done())
          throw_no_equilibrium(sentence +
                               " Nor was one found with more strength. " +
                               strength_reduction_.result());
        const double factor = strength_reduction_.next();
        solver_.bring_back(before);
        divide_strength(factor);
        const bool stands =
          solver_.find(measure_of_stronger_soil(), label(factor));
        if (solver_.is_stopped())
          return;
        strength_reduction_.record(factor, stands);
        log_.say(LogLevel::result,
                 text(std::setprecision(6),
                      "  strength x ",
                      1. / factor,
                      stands ? ": stands"
                             : ": fails. " + equilibrium().failure()));
      }
    standing_factor_ = strength_reduction_.lower();
  }



  /// Afterwards soil and seabed are as @p before, in the state at the beginning
  /// of the stage. Collective.
  template <int dim>
  void
  StaticStages<dim>::reduce_strength(
    const typename StaticSolver<dim>::Saved &before)
  {
    log_.say(LogLevel::result, "Stage 'strength reduction':");
    strength_reduction_.begin(
      problem_.materials.largest_strength_factor(state_.points,
                                                 state_.communicator()));
    if (stages_.contain(Stage::equilibrium))
      start_reduction();
    search_factor();
    if (solver_.is_stopped())
      return;
    solver_.restore(before);
    problem_.scale_seabed_strength(
      strength_reduction_.includes_seabed() ? 1. / standing_factor_ : 1.);
    log_.say(LogLevel::result, strength_reduction_.result());
    if (!stages_.contain(Stage::equilibrium) ||
        equilibrium().measure() == StrainMeasure::large)
      tell_of_well_balanced_load();
    if (const std::string note = failure_depth_.note(state_, problem_);
        !note.empty())
      log_.say(LogLevel::result, note);
  }



  /// Every trial goes on from the largest factor with which the soil stood.
  /// What stood is the better start: less is put out of balance than from full
  /// strength, and the search costs less. But the result must not depend on the
  /// way, hence the second look that StrengthReduction takes at its upper end.
  /// A signal ends the search, also before it begins.
  template <int dim>
  void
  StaticStages<dim>::search_factor()
  {
    auto state = solver_.save();
    while (!solver_.is_stopped() && !strength_reduction_.is_done())
      {
        const double factor = strength_reduction_.next();
        const bool   stands = stands_with(factor);
        if (solver_.is_stopped())
          return;
        strength_reduction_.record(factor, stands);
        log_.say(
          LogLevel::result,
          stands
            ? text(std::setprecision(6), "  strength / ", factor, ": stands")
            : text(std::setprecision(6),
                   "  strength / ",
                   factor,
                   ": fails. ",
                   equilibrium().failure()));
        if (stands)
          state = solver_.save();
        else // of all that fail the last one has the smallest factor
          {
            write_mechanism("mechanism");
            failure_depth_.record(
              equilibrium().newton().mechanism(state_.points));
          }
        solver_.restore(state);
      }
  }



  /// The soil is in equilibrium. By the measure of the reduction it must be so,
  /// too, or every factor would seem to fell it.
  template <int dim>
  void
  StaticStages<dim>::start_reduction()
  {
    strength_reduction_.record(standing_factor_, true);
    AssertThrow(
      stands_with(standing_factor_) || solver_.is_stopped(),
      ExcUser(text(
        "The stage 'strength reduction' starts from soil that is out of "
        "balance by its measure, which is small strain, so that there is no "
        "factor of safety. ",
        equilibrium().failure(),
        ". Set 'Equilibrium/Strain' to small or 'Equilibrium/Allowed "
        "imbalance' to less; or, if that is small against the 'Tolerance' of "
        "the factor that you need, set 'Strength reduction/Allowed "
        "imbalance' to more.")));
  }



  /// Look for balance with all strengths divided by @p factor.
  template <int dim>
  bool
  StaticStages<dim>::stands_with(const double factor)
  {
    divide_strength(factor);
    return solver_.find_again(
      strength_reduction_.limits(factor,
                                 equilibrium().limits(StrainMeasure::small)),
      label(factor));
  }



  template <int dim>
  void
  StaticStages<dim>::check_soil_stands() const
  {
    AssertThrow(
      standing_factor_ == 1. || !stages_.contain(Stage::dynamics),
      ExcUser(text(
        std::setprecision(6),
        "The stage 'equilibrium' found no balance with the strength that the "
        "soil has, only with ",
        1. / standing_factor_,
        " times as much, so that there is no state of rest that the stage "
        "'dynamics' could start from; log.txt has the factor of safety. "
        "Either the soil cannot bear its weight, and needs more strength or "
        "support before the trigger; or, if the factor is more than 1, the "
        "search needs more 'Equilibrium/Load steps'. To let the soil fall "
        "without stress from t = 0 list 'dynamics' alone.")));
  }



  /// Show how the soil moves where the search failed.
  template <int dim>
  void
  StaticStages<dim>::write_mechanism(const std::string &name) const
  {
    output_.write_mechanism(state_,
                            name,
                            equilibrium().newton().mechanism(state_.points));
  }



  template class StaticStages<2>;
  template class StaticStages<3>;
} // namespace talus

// The part of Simulation that looks for the factor of safety.

#include <talus/base/errors.h>
#include <talus/simulation/simulation.h>
#include <talus/transfer/far_points.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  /// What a trial may change: all columns of the points, and the seabed.
  template <int dim>
  typename Simulation<dim>::StaticState
  Simulation<dim>::static_state() const
  {
    StaticState state;
    for (unsigned int i = 0; i < points_.n_arrays(); ++i)
      state.columns.emplace_back(points_.data(i),
                                 points_.data(i) + points_.size());
    state.contact = equilibrium_.contact();
    return state;
  }



  /// The points are still where they were.
  template <int dim>
  void
  Simulation<dim>::restore(const StaticState &state)
  {
    for (unsigned int i = 0; i < points_.n_arrays(); ++i)
      std::copy(state.columns[i].begin(),
                state.columns[i].end(),
                points_.data(i));
    equilibrium_.set_contact(state.contact);
  }



  /// The points may have moved since, the mesh with them, and to other ranks.
  template <int dim>
  void
  Simulation<dim>::bring_back(const StaticState &state)
  {
    points_.clear();
    points_.append(state.columns[0].size());
    restore(state);
    send_far_points(points_, grid_);
    relocation_.update(points_, grid_);
    nodes_.activate(grid_, relocation_.occupied_cells());
    adapt_mesh();
  }



  /// Divide all strengths by @p factor.
  template <int dim>
  void
  Simulation<dim>::divide_strength(const double factor)
  {
    double *strength_factor = points_.data(materials_.strength_factor());
    std::fill(strength_factor, strength_factor + points_.size(), 1. / factor);
    if (strength_reduction_.includes_seabed())
      boundaries_.scale_seabed_strength(1. / factor);
  }



  /// Small strain, in which the slope keeps the shape whose factor of safety is
  /// asked for: with large strain a little more strength would let it stand
  /// after a long way. Hyperelastic laws know large strain only.
  template <int dim>
  StrainMeasure
  Simulation<dim>::measure_of_stronger_soil() const
  {
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      if (materials_.of_body(b).is_hyperelastic())
        return StrainMeasure::large;
    return StrainMeasure::small;
  }



  /// The soil does not stand with the strength that it has. So that the stage
  /// 'strength reduction' has where to start from, look for a strength with
  /// which it does; @p before is the state without loads.
  template <int dim>
  void
  Simulation<dim>::find_equilibrium_with_more_strength(
    const StaticState &before)
  {
    const std::string sentence = no_equilibrium();
    say_and_note(sentence +
                 " The soil seems not to bear its weight. Since the stage "
                 "'strength reduction' follows, one is looked for with more "
                 "strength.");
    strength_reduction_.begin(materials_.largest_strength_factor());
    strength_reduction_.heed(1., false);
    while (strength_reduction_.lower() == 0.)
      {
        if (strength_reduction_.is_done())
          throw_no_equilibrium(sentence +
                               " Nor was one found with more strength. " +
                               strength_reduction_.result());
        const double factor = strength_reduction_.next();
        bring_back(before);
        divide_strength(factor);
        const bool stands =
          bring_to_equilibrium(factor, measure_of_stronger_soil());
        strength_reduction_.heed(factor, stands);
        say_and_note(
          text("  strength x ",
               1. / factor,
               stands ? ": stands" : ": fails. " + equilibrium_.failure()));
      }
    standing_factor_ = strength_reduction_.lower();
  }



  /// Every trial goes on from the largest factor with which the soil stood.
  template <int dim>
  void
  Simulation<dim>::reduce_strength()
  {
    say("Stage 'strength reduction':");
    const StaticState before = static_state();
    strength_reduction_.begin(materials_.largest_strength_factor());
    if (stages_.contain(Stage::equilibrium))
      start_reduction();
    StaticState state = static_state();
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
          state = static_state();
        else // of all that fail the last one has the smallest factor
          output_.write_mechanism(snapshot(),
                                  "mechanism",
                                  equilibrium_.newton().mechanism(points_));
        restore(state);
      }
    restore(before);
    boundaries_.scale_seabed_strength(
      strength_reduction_.includes_seabed() ? 1. / standing_factor_ : 1.);
    say_and_note(strength_reduction_.result());
  }



  /// The soil is in equilibrium. By the measure of the reduction it must be so,
  /// too, or every factor would seem to fell it.
  template <int dim>
  void
  Simulation<dim>::start_reduction()
  {
    strength_reduction_.heed(standing_factor_, true);
    AssertThrow(
      stands_with(standing_factor_),
      ExcUser(text(
        "The stage 'strength reduction' starts from soil that is out of "
        "balance by its measure, which is small strain, so that there is no "
        "factor of safety. ",
        equilibrium_.failure(),
        ". Set 'Equilibrium/Strain' to small or 'Equilibrium/Allowed "
        "imbalance' to less; or, if that is small against the 'Tolerance' of "
        "the factor that you need, set 'Strength reduction/Allowed "
        "imbalance' to more.")));
  }



  /// Look for balance with all strengths divided by @p factor.
  template <int dim>
  bool
  Simulation<dim>::stands_with(const double factor)
  {
    divide_strength(factor);
    equilibrium_.begin(StrainMeasure::small,
                       strength_reduction_.limits(
                         factor, equilibrium_.limits(StrainMeasure::small)));
    Soil<dim> before = soil();
    equilibrium_.return_stress(before);
    while (!equilibrium_.is_found())
      {
        StepNote note;
        if (!take_load_step(factor, note))
          return false;
      }
    return true;
  }



  /// Throw ExcUser if the dynamics would start from a balance that takes more
  /// strength than there is.
  template <int dim>
  void
  Simulation<dim>::check_soil_stands() const
  {
    AssertThrow(
      standing_factor_ == 1. || !stages_.contain(Stage::dynamics),
      ExcUser(text(
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



#define INSTANTIATE(dim)                                                       \
  template typename Simulation<dim>::StaticState                               \
                         Simulation<dim>::static_state() const;                \
  template void          Simulation<dim>::restore(const StaticState &);        \
  template void          Simulation<dim>::bring_back(const StaticState &);     \
  template void          Simulation<dim>::divide_strength(double);             \
  template StrainMeasure Simulation<dim>::measure_of_stronger_soil() const;    \
  template void          Simulation<dim>::find_equilibrium_with_more_strength( \
    const StaticState &);                                             \
  template void Simulation<dim>::reduce_strength();                            \
  template void Simulation<dim>::start_reduction();                            \
  template bool Simulation<dim>::stands_with(double);                          \
  template void Simulation<dim>::check_soil_stands() const;

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_statistics_h
#define talus_observers_statistics_h

#include <talus/base/quantity.h>
#include <talus/contact/obstacles.h>
#include <talus/observers/table_observer.h>
#include <talus/state/state.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Force of the seabed on the soil, N: mean since the last restart().
  /// The force of a single step tells little.
  template <int dim>
  class SeabedForce
  {
  public:
    /// Begin a new mean at the time of @p state. Collective.
    void
    restart(const State<dim> &state);

    /// Append the mean force, N, and the impulse since the start, N s.
    /// Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    void
    list_state(StateList &list);

  private:
    double                 previous_time_ = 0; // s
    dealii::Tensor<1, dim> previous_impulse_;  // N s
  };



  /// Energy budget of the run over all ranks, J; in 2-D J per metre width:
  ///   remainder = energy supplied - energy taken - change of energy stored.
  /// Every term counts from the start of the motion. The points store kinetic
  /// energy, elastic energy and plastic work; State::accounts has all other
  /// terms, such as the work of gravity. The budget uses the kinetic energy of
  /// the points, so the remainder contains the dissipation of the transfer. A
  /// negative remainder is energy made from nothing.
  template <int dim>
  class EnergyBudget
  {
  public:
    /// Begin the budget at @p state. Collective.
    void
    begin(const State<dim> &state);

    /// Return the terms, the kinetic energy of the background grid (no part of
    /// the budget), and the remainder. Collective.
    Quantities
    evaluate(const State<dim> &state) const;

    /// Add the terms at the start to the state of the run.
    void
    list_state(StateList &list);

  private:
    std::vector<double> start_; ///< terms at the start, J
  };



  /// statistics.csv: one row of global quantities per output time, for plots
  /// and tests. Positions and speeds belong to the centres of the points;
  /// quantities of 2-D runs are per metre width.
  ///
  /// - `height [m]` is the maximum height of a centre above the ground.
  /// - `maximum speed [m/s]` belongs to the background grid, without the FLIP
  ///   noise of the points: 99.9 % of the mass is not faster.
  /// - `seabed force x [N]`, ... is the mean force of the seabed on the soil
  ///   since the previous row (0 in the first row); `seabed impulse x [N s]`,
  ///   ... is the impulse since the start. Both are negative while friction
  ///   brakes a slide towards positive x.
  /// - `kinetic energy [J]` belongs to the points. `grid kinetic energy [J]`
  ///   belongs to the background grid, without the FLIP noise of the points,
  ///   and shows whether the slide has come to rest; 0 before the first step.
  /// - `clipped boxes` counts axes of boxes that the weights clip now.
  /// - EnergyBudget gives the energy terms; FractureCounts, the splitter and
  ///   the merger give the columns from `empty interior cells` on.
  template <int dim>
  class Statistics : public TableObserver<dim>
  {
  public:
    /// @p obstacles may belong to the ground; null for none. They must outlive
    /// the statistics.
    explicit Statistics(const Obstacles<dim> *obstacles = nullptr)
      : TableObserver<dim>(file_name)
      , obstacles_(obstacles)
    {}

    /// Function that appends further quantities. Collective.
    using Source = std::function<void(const State<dim> &, Quantities &)>;

    /// Add columns behind the columns of motion, seabed, energies and
    /// fractures.
    void
    add_source(const Source &source)
    {
      sources_.push_back(source);
    }

    /// Add the columns of front and rear of thick soil behind the columns of
    /// motion, if runout is written.
    void
    set_thick_soil(const Source &source)
    {
      thick_soil_ = source;
    }

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          const Beginning       beginning = Beginning::fresh) override
    {
      has_runout_ = settings.write_runout;
      TableObserver<dim>::begin(settings, state, beginning);
    }

    /// Begin the energy budget and the mean of the seabed force at @p state.
    void
    start(const State<dim> &state) override
    {
      // Called after the static stages, whose energies do not count.
      budget_.begin(state);
      seabed_force_.restart(state);
    }

    /// Append a row.
    void
    observe(const State<dim> &state) override;

    /// Return the quantities of a row in the order of the columns, complete on
    /// the first rank. Collective.
    Quantities
    evaluate(const State<dim> &state, bool with_runout = true) const;

    void
    list_state(StateList &list) override
    {
      seabed_force_.list_state(list);
      TableObserver<dim>::list_state(list);
      budget_.list_state(list);
    }

    static constexpr const char *file_name = "statistics.csv";

  private:
    std::vector<std::string>
    columns(const OutputSettings &settings,
            const State<dim>     &state) const override
    {
      // Drop the values of the evaluation: the headings are needed once per
      // run.
      std::vector<std::string> result;
      for (const Quantity &quantity : evaluate(state, settings.write_runout))
        result.push_back(quantity.heading());
      return result;
    }

    const Obstacles<dim> *obstacles_;
    SeabedForce<dim>      seabed_force_;
    EnergyBudget<dim>     budget_;
    Source                thick_soil_;
    std::vector<Source>   sources_;
    bool                  has_runout_ = true;
  };
} // namespace talus

#endif

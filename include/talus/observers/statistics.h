// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_statistics_h
#define talus_observers_statistics_h

#include <talus/base/quantity.h>
#include <talus/contact/obstacles.h>
#include <talus/observers/energy_budget.h>
#include <talus/observers/seabed_force.h>
#include <talus/observers/table_observer.h>
#include <talus/state/state.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// statistics.csv: one row of global quantities per output time, for plots
  /// and tests. Places and speeds are those of the points' centres; quantities
  /// of 2-D runs are per metre width.
  ///
  /// - `height [m]` is the largest one of a centre above the ground below it.
  /// - `seabed force x [N]` is the mean force of the seabed on the soil since
  ///   the row before (0 in the first one); `seabed impulse x [N s]` is the
  ///   impulse since the start. Both are negative while friction brakes a
  ///   slide that moves towards positive x.
  /// - `kinetic energy [J]` is that of the points, `grid kinetic energy [J]`
  ///   that of the background grid, without the points' FLIP noise: what tells
  ///   whether the slide has come to rest. It is 0 before the first step.
  /// - `clipped boxes` counts axes of boxes that the weights clip now.
  /// - The energy terms are those of EnergyBudget; the columns from `empty
  ///   interior cells` on are those of FractureCounts, of the splitter and
  ///   of the merger.
  template <int dim>
  class Statistics : public TableObserver<dim>
  {
  public:
    /// @p obstacles that belong to the ground, null for none, must outlive it.
    explicit Statistics(const Obstacles<dim> *obstacles = nullptr);

    /// Appends the quantities of somebody; collective.
    using Source = std::function<void(const State<dim> &, Quantities &)>;

    /// Add columns behind those of motion, seabed, energies and fractures.
    void
    add_source(const Source &source);

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning = Beginning::fresh) override;

    /// Count energies from here.
    void
    start(const State<dim> &state) override;

    /// Append a row.
    void
    observe(const State<dim> &state) override;

    /// What a row holds, in the order of the columns; right on the first rank.
    /// Collective.
    Quantities
    evaluate(const State<dim> &state, bool with_runout = true) const;

    /// Names of the columns; collective.
    std::vector<std::string>
    names(const State<dim> &state, bool with_runout) const;

    void
    list_state(StateList &list) override;

    static constexpr const char *file_name = "statistics.csv";

  private:
    std::vector<std::string>
    columns(const OutputSettings &settings,
            const State<dim>     &state) const override;

    const Obstacles<dim> *obstacles_;
    SeabedForce<dim>      seabed_force_;
    EnergyBudget<dim>     budget_;
    std::vector<Source>   sources_;
    bool                  has_runout_ = true;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_grid_output_h
#define talus_observers_grid_output_h

#include <talus/io/series.h>
#include <talus/observers/observer.h>

namespace talus
{
  /// The series of files called grid, in one of the formats of FieldWriter: the cells of
  /// the background grid that hold points, with the mass, velocity and force of
  /// the step before at their nodes. All three are zero at nodes the step did
  /// not touch, and at the start; mass and force of a hanging node went to its
  /// masters.
  template <int dim>
  class GridOutput : public Observer<dim>
  {
  public:
    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_grid;
    }

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning = Beginning::fresh) override;

    void
    list_state(StateList &list) override;

    void
    observe(const State<dim> &state) override;

    void
    sync() override;

  private:
    FieldSeries series_;
  };
} // namespace talus

#endif

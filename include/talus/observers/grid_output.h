// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_grid_output_h
#define talus_observers_grid_output_h

#include <talus/observers/series_observer.h>

namespace talus
{
  /// The series of files called grid: the cells of the background grid that
  /// hold points, with the mass, velocity and force of the step before at their
  /// nodes. All three are zero at nodes the step did not touch, and at the
  /// start; mass and force of a hanging node went to its masters.
  template <int dim>
  class GridOutput : public SeriesObserver<dim>
  {
  public:
    GridOutput()
      : SeriesObserver<dim>("grid")
    {}

    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_grid;
    }

    void
    observe(const State<dim> &state) override;
  };
} // namespace talus

#endif

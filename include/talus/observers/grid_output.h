// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_grid_output_h
#define talus_observers_grid_output_h

#include <talus/observers/series_observer.h>

namespace talus
{
  /// Series of files "grid": the cells of the background grid with points, and
  /// mass, velocity and force of the previous step at the nodes. All three
  /// fields are zero at the start and at nodes not used by the step; mass and
  /// force of a hanging node are included in the master nodes.
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

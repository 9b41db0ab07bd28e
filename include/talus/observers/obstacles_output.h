// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_obstacles_output_h
#define talus_observers_obstacles_output_h

#include <talus/contact/obstacles.h>
#include <talus/observers/series_observer.h>

namespace talus
{
  /// Series of files "obstacles": the surfaces of all obstacles in the mesh, of
  /// any shape, as lines (in 3-D triangles). Written once at the start, or at
  /// each output time if an obstacle moves.
  template <int dim>
  class ObstaclesOutput : public SeriesObserver<dim>
  {
  public:
    /// @p obstacles must outlive the observer.
    explicit ObstaclesOutput(const Obstacles<dim> &obstacles)
      : SeriesObserver<dim>("obstacles")
      , obstacles_(obstacles)
    {}

    /// Return whether obstacle output is requested and obstacles exist.
    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_obstacles && !obstacles_.empty();
    }

    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override
    {
      // Without obstacles the checkpoint has no entry for the series.
      if (!obstacles_.empty())
        SeriesObserver<dim>::list_state(list);
    }

  private:
    const Obstacles<dim> &obstacles_;
  };
} // namespace talus

#endif

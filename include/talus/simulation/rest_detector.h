// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_rest_detector_h
#define talus_simulation_rest_detector_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>

namespace talus
{
  /// Finds out whether a slide has come to rest. Soil is at rest when, for
  /// `Rest/Duration`, the kinetic energy of the background grid has stayed below
  /// `Rest/Kinetic energy ratio` times its maximum so far, and the outermost
  /// material points have moved by less than a fiftieth of the smallest cell in
  /// plan. What has never moved as a whole by a cell is no slide, and is never
  /// said to be at rest: a column that settles, or a bar that swings. Without any
  /// material points, when all of them have left the mesh, there is rest. The
  /// state is looked at ten times in each `Duration`.
  template <int dim>
  class RestDetector : public dealii::ParameterAcceptor
  {
  public:
    RestDetector();

    /// Look at the state after a step. Nothing counts as rest before
    /// @p last_change, s, when loads and strengths stop to change in time.
    /// Collective.
    void
    update(const State<dim> &state, double last_change);

    bool
    is_at_rest() const
    {
      return is_at_rest_;
    }

    /// Sentence for the end of a run at @p time, s, that was to end at
    /// @p end_time, s: that the soil is at rest, or that it still moves. Empty if
    /// there was no slide.
    std::string
    sentence(double time, double end_time) const;

    /// Add whether the soil is at rest, 1 or 0.
    void
    list_quantities(Quantities &list) const;

    void
    list_state(StateList &list);

  private:
    /// Least and largest coordinates of the points' centres in plan, m.
    using Extent = Box<dim>;

    bool
    has_slid(const State<dim> &state) const;
    Extent
    extent_in_plan(const State<dim> &state) const;
    bool
    has_kept_still(const Extent &extent, double length) const;

    // Parameters
    double ratio_    = 1e-3;
    double duration_ = 5.; ///< s

    double next_look_   = 0.; ///< time, s
    double peak_energy_ = 0.; ///< of the grid, J
    double energy_      = 0.; ///< of the grid at the last look, J
    double quiet_since_ = std::numeric_limits<double>::max(); ///< time, s
    Extent extent_; ///< at the time quiet_since_
    bool   has_slid_   = false;
    bool   has_left_   = false;
    bool   is_at_rest_ = false;
  };
} // namespace talus

#endif

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
  /// Detects whether a slide has come to rest. Soil is at rest if two
  /// conditions hold for `Rest/Duration`: the kinetic energy of the background
  /// grid is below `Rest/Kinetic energy ratio` times its maximum so far, and
  /// the ends of 99.9 % of the mass in plan move by less than a fiftieth of the
  /// smallest cell. Outer points of hardly any mass may creep on, and are
  /// reported. Soil without an overall displacement of at least a cell is not a
  /// slide and never counts as at rest, such as a settling column or a
  /// vibrating bar. If all points have left the mesh, the slide is at rest. The
  /// state is checked ten times per `Duration`.
  template <int dim>
  class RestDetector : public dealii::ParameterAcceptor
  {
  public:
    RestDetector();

    /// Check the state after a step. Soil in the mesh is never at rest before
    /// @p last_change, s, the time of the last change of loads and strengths.
    /// Collective.
    void
    update(const State<dim> &state, double last_change);

    bool
    is_at_rest() const
    {
      return is_at_rest_;
    }

    /// Sentence for the end of a run: the soil is at rest, or still moves.
    /// Empty if there was no slide.
    ///
    /// @param time of the end, s
    /// @param end_time planned end, s
    std::string
    sentence(double time, double end_time) const;

    /// Append whether the soil is at rest, 1 or 0.
    void
    list_quantities(Quantities &list) const;

    void
    list_state(StateList &list);

  private:
    /// Ends of a share of the mass in plan, m.
    using Extent = Box<dim>;

    bool
    has_slid(const State<dim> &state) const;
    Extent
    extent_in_plan(const State<dim> &state, double share) const;
    bool
    has_kept_still(const Extent &before,
                   const Extent &extent,
                   double        length) const;

    std::string
    stragglers() const;

    // Parameters
    double ratio_    = 1e-3;
    double duration_ = 5.; ///< s

    double next_look_   = 0.; ///< time of the next check, s
    double peak_energy_ = 0.; ///< maximum kinetic energy of the grid, J
    double energy_      = 0.; ///< grid energy at the last check, J
    double quiet_since_ = std::numeric_limits<double>::max(); ///< time, s
    Extent extent_;    ///< ends of nearly all mass at the time quiet_since_
    Extent outermost_; ///< ends of all mass at the time quiet_since_
    bool   creeps_     = false; ///< whether outer points move on
    bool   has_slid_   = false;
    bool   has_left_   = false;
    bool   is_at_rest_ = false;
  };
} // namespace talus

#endif

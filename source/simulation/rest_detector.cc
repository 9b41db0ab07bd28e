// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/observers/point_motion.h>
#include <talus/simulation/rest_detector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Share of the mass whose ends must keep still. Single points that stretch
    // or slide off would otherwise keep a slide from its rest for ever.
    constexpr double share_at_rest = 0.999;
  } // namespace



  template <int dim>
  RestDetector<dim>::RestDetector()
    : ParameterAcceptor("/Rest")
  {
    add_parameter("Kinetic energy ratio",
                  ratio_,
                  "Kinetic energy of the background grid over the maximum so "
                  "far [-], below which the soil is at rest after 'Duration'.",
                  this->prm,
                  Patterns::Double(0., 1.));
    add_parameter("Duration",
                  duration_,
                  "Time for which the kinetic energy must stay small, and the "
                  "ends of 99.9 % of the mass must not move in plan by more "
                  "than a fiftieth of the smallest cell [s].",
                  this->prm,
                  Patterns::Double(1e-6));
  }



  /// Return whether the mass-weighted root mean square displacement exceeds the
  /// smallest cell. Collective.
  template <int dim>
  bool
  RestDetector<dim>::has_slid(const State<dim> &state) const
  {
    const Points<dim>  &points = state.points;
    std::vector<double> sums(2, 0.); // kg m^2, kg
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double mass = points.data(points.mass)[p];
        sums[0] += mass * load_place(points, points.position, p)
                            .distance_square(
                              load_place(points, points.initial_position, p));
        sums[1] += mass;
      }
    Utilities::MPI::sum(sums, state.communicator(), sums);
    const double h = state.grid.finest_size();
    return sums[0] > h * h * sums[1];
  }



  /// Ends in plan with the share 1 - @p share [-] of the mass beyond each.
  /// Collective.
  template <int dim>
  typename RestDetector<dim>::Extent
  RestDetector<dim>::extent_in_plan(const State<dim> &state,
                                    const double      share) const
  {
    const auto end = [&](const unsigned int axis, const double fraction) {
      return front_of_mass(state.points, axis, fraction, state.communicator());
    };
    Extent extent;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != 1)
        {
          extent.lower[d] = end(d, 1. - share);
          extent.upper[d] = end(d, share);
        }
    return extent;
  }



  template <int dim>
  bool
  RestDetector<dim>::has_kept_still(const Extent &before,
                                    const Extent &extent,
                                    const double  length) const
  {
    bool is_still = true;
    for (unsigned int d = 0; d < dim; ++d)
      is_still = is_still &&
                 std::abs(extent.lower[d] - before.lower[d]) <= length &&
                 std::abs(extent.upper[d] - before.upper[d]) <= length;
    return is_still;
  }



  template <int dim>
  void
  RestDetector<dim>::update(const State<dim> &state, const double last_change)
  {
    // Checked in every step, because a step without points goes to the end
    // time.
    has_left_ =
      state.outflow.is_open() &&
      Utilities::MPI::sum(1. * state.points.size(), state.communicator()) == 0;
    is_at_rest_ = is_at_rest_ || has_left_;
    if (has_left_ || state.time < next_look_)
      return;
    // A change of the mesh after the step has emptied the nodes.
    if (Utilities::MPI::max(state.nodes.active_nodes().size(),
                            state.communicator()) == 0)
      return;
    next_look_ = state.time + 0.1 * duration_;
    energy_ =
      Utilities::MPI::sum(state.nodes.kinetic_energy(), state.communicator());
    peak_energy_ = std::max(peak_energy_, energy_);
    has_slid_    = has_slid_ || has_slid(state);
    if (!has_slid_ || state.time < last_change ||
        energy_ > ratio_ * peak_energy_)
      {
        quiet_since_ = std::numeric_limits<double>::max();
        is_at_rest_  = false;
        return;
      }
    const double length = 0.02 * state.grid.finest_size();
    const Extent extent = extent_in_plan(state, share_at_rest),
                 all    = extent_in_plan(state, 1.);
    if (quiet_since_ > state.time || !has_kept_still(extent_, extent, length))
      {
        quiet_since_ = state.time;
        extent_      = extent;
        outermost_   = all;
      }
    creeps_     = !has_kept_still(outermost_, all, length);
    is_at_rest_ = state.time >= quiet_since_ + duration_;
  }



  /// Part of sentence() on points beyond the ends of nearly all mass.
  template <int dim>
  std::string
  RestDetector<dim>::stragglers() const
  {
    std::string ends;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != 1)
        ends += text(ends.empty() ? "" : ", ",
                     std::setprecision(6),
                     d == 0 ? "x" : "z",
                     " from ",
                     extent_.lower[d],
                     " to ",
                     extent_.upper[d],
                     " m");
    return ", but for single points of less than 0.1 % of the mass that creep "
           "on outside of " +
           ends;
  }



  template <int dim>
  std::string
  RestDetector<dim>::sentence(const double time, const double end_time) const
  {
    if (has_left_)
      return text("All soil has left the mesh through faces of outflow by t = ",
                  time,
                  " s.");
    if (!has_slid_)
      return "";
    if (!is_at_rest_)
      return text(std::setprecision(4),
                  "The soil still moves at the end of the run, t = ",
                  time,
                  " s: the kinetic energy is ",
                  peak_energy_ > 0. ? energy_ / peak_energy_ : 0.,
                  " of the maximum. Rest is a ratio below ",
                  ratio_,
                  " and ends of 99.9 % of the mass that move in plan by less "
                  "than a fiftieth of the smallest cell, for ",
                  duration_,
                  " s. The runout is not final: continue with a later 'End "
                  "time' and --resume.");
    const std::string rest = text(std::setprecision(6),
                                  "The soil is at rest since t = ",
                                  quiet_since_,
                                  " s",
                                  creeps_ ? stragglers() : std::string());
    return time < end_time ? text(std::setprecision(6),
                                  rest,
                                  ", so that the run ends at t = ",
                                  time,
                                  " s, before 'End time' = ",
                                  end_time,
                                  " s ('End when at rest').")
                           : rest + ".";
  }



  template <int dim>
  void
  RestDetector<dim>::list_quantities(Quantities &list) const
  {
    list.push_back({"at rest", "", is_at_rest_ ? 1. : 0.});
  }



  template <int dim>
  void
  RestDetector<dim>::list_state(StateList &list)
  {
    list.add("next look for rest", "s", next_look_, Reduction::equal);
    list.add("largest grid kinetic energy",
             "J",
             peak_energy_,
             Reduction::equal);
    list.add("grid kinetic energy at the last look for rest",
             "J",
             energy_,
             Reduction::equal);
    list.add("quiet since", "s", quiet_since_, Reduction::equal);
    list.add_components(
      "lower end of quiet soil", "m", extent_.lower, dim, Reduction::equal);
    list.add_components(
      "upper end of quiet soil", "m", extent_.upper, dim, Reduction::equal);
    list.add_components(
      "lower end of all soil", "m", outermost_.lower, dim, Reduction::equal);
    list.add_components(
      "upper end of all soil", "m", outermost_.upper, dim, Reduction::equal);
    list.add("outer points creep", "-", creeps_, Reduction::equal);
    list.add("has slid", "-", has_slid_, Reduction::equal);
    list.add("has left", "-", has_left_, Reduction::equal);
    list.add("is at rest", "-", is_at_rest_, Reduction::equal);
  }



  template class RestDetector<2>;
  template class RestDetector<3>;
} // namespace talus

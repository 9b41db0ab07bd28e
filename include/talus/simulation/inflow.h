// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_inflow_h
#define talus_simulation_inflow_h

#include <talus/adaptivity/splitter.h>
#include <talus/base/quantity.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Soil that enters through faces of the mesh. The points of a body that
  /// touch the face at the start feed the flow: in each step a feeding point
  /// grows at the face by the mass density times normal velocity of the face
  /// times area times time step, in the state of the point. A point with 1.5
  /// times the initial mass is divided: a point of the initial mass flows on,
  /// and the rest feeds, in the shape of the opening. The points that enter
  /// are as large as the points of the filling.
  template <int dim>
  class Inflow
  {
  public:
    /// All arguments must outlive the object.
    Inflow(State<dim> &state, Problem<dim> &problem, Splitter<dim> &splitter);

    /// Open columns and accounts if a body has an inflow. Throws ExcUser if the
    /// face has no prescribed normal velocity or if the law does not allow
    /// growing points.
    void
    prepare();

    /// Mark the points that feed. Throws ExcUser if a body does not touch its
    /// face. Collective.
    void
    mark_feeding_points();

    /// Let soil enter for the length of the current step, after the points have
    /// moved. Adds all changed points to the points out of their cell.
    void
    feed();

    /// Append the mass that entered, summed over all ranks. Collective.
    void
    list_quantities(Quantities &list) const;

    void
    list_state(StateList &list);

  private:
    bool
    is_open() const
    {
      return !faces_.empty();
    }

    unsigned int
    face_of(unsigned int p) const;
    double
    distance_to_face(unsigned int p) const;
    bool
    touches_face(unsigned int p) const;
    void
    start_feeding(unsigned int p);
    double
    speed_of_entry(unsigned int p) const;
    void
    grow(unsigned int p);
    void
    divide(unsigned int p);
    void
    take_shape_of_opening(unsigned int p);

    State<dim>               &state_;
    Problem<dim>             &problem_;
    Splitter<dim>            &splitter_;
    std::vector<unsigned int> faces_;    ///< by body; invalid: no inflow
    double                    mass_ = 0; ///< mass that entered on this rank, kg
  };
} // namespace talus

#endif

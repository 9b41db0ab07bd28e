// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/seabed_force.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  namespace
  {
    /// Impulse of the seabed on the soil along x since the start of the run, N
    /// s. Collective.
    template <int dim>
    double
    impulse(const State<dim> &state)
    {
      return dealii::Utilities::MPI::sum(
        state.accounts.impulse("seabed impulse")[0], state.communicator());
    }
  } // namespace



  template <int dim>
  void
  SeabedForce<dim>::restart(const State<dim> &state)
  {
    previous_time_    = state.time;
    previous_impulse_ = impulse(state);
  }



  /// The mean force is the impulse divided by the interval: the force of a
  /// single step jumps with every node that touches the seabed or leaves it,
  /// the impulse does not.
  template <int dim>
  void
  SeabedForce<dim>::list_quantities(const State<dim> &state,
                                    Quantities       &list) const
  {
    const double now      = impulse(state);
    const double interval = state.time - previous_time_;
    list.push_back({"seabed force x",
                    "N",
                    interval > 0 ? (now - previous_impulse_) / interval : 0.});
    list.push_back({"seabed impulse x", "N s", now});
  }



  /// With these values, the first row after a restart has the mean of the whole
  /// interval.
  template <int dim>
  void
  SeabedForce<dim>::list_state(StateList &list)
  {
    list.add("time of the last row", "s", previous_time_, Reduction::equal);
    list.add("seabed impulse at the last row",
             "N s",
             previous_impulse_,
             Reduction::equal);
  }



  template class SeabedForce<2>;
  template class SeabedForce<3>;
} // namespace talus

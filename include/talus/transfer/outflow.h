// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_outflow_h
#define talus_transfer_outflow_h

#include <talus/base/box.h>
#include <talus/base/quantity.h>
#include <talus/base/state_list.h>
#include <talus/points/points.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <vector>

namespace talus
{
  /// Account of the material points that leave the mesh through the faces of
  /// kind `outflow`. A point is removed from the run when its centre lies
  /// beyond the face. Mass, momentum and energy of the point are added to the
  /// account, so that the balances of the run close. Each rank accounts for the
  /// points that left from the rank.
  template <int dim>
  class Outflow
  {
  public:
    /// Let points leave through the faces of the mesh marked in @p is_open.
    void
    open(const std::array<bool, 2 * dim> &is_open);

    /// Whether any face is open.
    bool
    is_open() const;

    /// Whether position @p x, m, lies beyond an open face of @p domain. False
    /// if a coordinate is not a number.
    bool
    is_beyond(const dealii::Point<dim> &x, const Box<dim> &domain) const;

    /// Add point @p p to the account. @p added_mass is
    /// RunConstants::added_mass: added mass divided by mass [-] of each body,
    /// or empty.
    void
    record(const Points<dim>         &points,
           unsigned int               p,
           const std::vector<double> &added_mass);

    /// Energy of the points that left from this rank, J: kinetic energy of soil
    /// and added mass, elastic energy, and plastic work.
    double
    energy() const
    {
      return energy_;
    }

    /// Append number, mass and momentum of the points that left, summed over
    /// all ranks, if any face is open. Collective.
    void
    list_quantities(MPI_Comm communicator, Quantities &list) const;

    /// Add the account to the state of the run, if any face is open.
    void
    list_state(StateList &list);

  private:
    std::array<bool, 2 * dim> faces_{};
    unsigned long             n_points_ = 0;
    double                    mass_     = 0;
    dealii::Tensor<1, dim>    momentum_;
    double                    energy_ = 0;
  };
} // namespace talus

#endif

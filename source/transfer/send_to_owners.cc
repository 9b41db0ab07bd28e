// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/transfer/send_to_owners.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// All arrays of a point, in sequence.
    using PackedPoint = std::vector<double>;



    /// Whether a point lies in a cell owned by this rank.
    template <int dim>
    bool
    is_at_home(const PackedPoint &record,
               const Points<dim> &points,
               const Grid<dim>   &grid)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = record[points.position + d];
      // The relocation reports points outside of the mesh.
      const unsigned int c = grid.find_cell(x);
      return c != numbers::invalid_unsigned_int && c < grid.n_owned_cells();
    }
  } // namespace



  // No rank knows the owner of a distant cell. Therefore each rank broadcasts
  // its points in cells of others, and picks the points in its own cells. The
  // message of all to all, with memory for all these points on every rank, is
  // simple and good enough when points are created or the mesh changes; in a
  // step points go to neighbours only (PointExchange). Points that stay come
  // first, in their order, then points received, by rank.
  template <int dim>
  void
  send_points_to_owners(Points<dim> &points, const Grid<dim> &grid)
  {
    const MPI_Comm communicator = grid.communicator();
    TalusAssert(points.n_sorted() == 0, ExcInternalError());
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;

    std::vector<PackedPoint> here, far;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        PackedPoint record(points.n_arrays());
        for (unsigned int array = 0; array < points.n_arrays(); ++array)
          record[array] = points.data(array)[p];
        (is_at_home(record, points, grid) ? here : far).push_back(record);
      }
    for (const auto &records : Utilities::MPI::all_gather(communicator, far))
      for (const PackedPoint &record : records)
        if (is_at_home(record, points, grid))
          here.push_back(record);

    // A position has one cell and a cell has one owner, so no point is lost or
    // doubled, unless the ranks have different meshes.
    const double n_before =
      Utilities::MPI::sum(1. * points.size(), communicator);
    points.clear();
    points.append(here.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int array = 0; array < points.n_arrays(); ++array)
        points.data(array)[p] = here[p][array];
    const double n_after =
      Utilities::MPI::sum(1. * points.size(), communicator);
    AssertThrow(n_before == n_after,
                ExcMessage(text("Points were lost or counted twice: ",
                                n_before,
                                " before they were sent to the ranks of their "
                                "cells, ",
                                n_after,
                                " after.")));
  }



  template decltype(send_points_to_owners<2>) send_points_to_owners<2>;
  template decltype(send_points_to_owners<3>) send_points_to_owners<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/load_balance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstring>

namespace talus
{
  using namespace dealii;

  template <int dim>
  LoadBalance<dim>::LoadBalance()
    : ParameterAcceptor("/Load balance")
  {
    add_parameter(
      "Allowed imbalance",
      allowed_imbalance_,
      "The mesh is shared out anew among the ranks when the largest "
      "number of points of a rank exceeds this many times the mean "
      "[-].",
      this->prm,
      Patterns::Double(1.));
    add_parameter("Interval",
                  interval_,
                  "Number of steps between two looks at the imbalance [-].",
                  this->prm,
                  Patterns::Integer(1));
  }



  template <int dim>
  double
  LoadBalance<dim>::imbalance(const Points<dim> &points,
                              const MPI_Comm     communicator)
  {
    const auto n = Utilities::MPI::min_max_avg(points.size(), communicator);
    return n.sum > 0 ? n.max / n.avg : 1.;
  }



  // Counting takes a message of all ranks, too much for every step.
  template <int dim>
  bool
  LoadBalance<dim>::is_due(const unsigned long step,
                           const MPI_Comm      communicator) const
  {
    return Utilities::MPI::n_mpi_processes(communicator) > 1 &&
           step % interval_ == 0;
  }



  // A cell goes to one rank as a whole, so with few cells per rank the goal may
  // be out of reach: without the second bound the cells would be shared out in
  // vain at each look. A twentieth more than was reached then is reason to try
  // again.
  template <int dim>
  bool
  LoadBalance<dim>::is_needed(const Points<dim> &points,
                              const MPI_Comm     communicator) const
  {
    return imbalance(points, communicator) >
           std::max(allowed_imbalance_, 1.05 * reached_imbalance_);
  }



  namespace
  {
    /// First point of each owned cell, and one more entry.
    template <int dim>
    std::vector<unsigned int>
    first_points(const Points<dim> &points, const Grid<dim> &grid)
    {
      std::vector<unsigned int> first(grid.n_owned_cells() + 1, 0);
      for (const Segment &segment : points.segments())
        first[segment.cell + 1] = segment.end;
      for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
        first[c + 1] = std::max(first[c + 1], first[c]);
      return first;
    }



    /// Weight of a cell with so many points. One without costs next to nothing,
    /// but not nothing.
    /// Integers, as p4est has them. The cost of a step follows the points; but
    /// if empty cells weighed nothing one rank could get all of those at the
    /// end of the curve, and the memory they take.
    unsigned int
    weight(const unsigned int n_points)
    {
      return 1 + 100 * n_points;
    }
  } // namespace



  // Cells and points travel together, by deal.II's means for data of variable
  // size attached to cells: points may go to any rank, and p4est knows where
  // each cell goes, which we would else have to find out. The data of a cell
  // are its points column by column, in their order, and so the order within a
  // cell, which is part of the state, survives.
  //
  // Points in cells that stay are packed and unpacked as well: it happens
  // rarely, and the indices of all cells change.
  template <int dim>
  std::vector<unsigned int>
  LoadBalance<dim>::repartition(Grid<dim> &grid, Points<dim> &points)
  {
    using CellIterator = typename Triangulation<dim>::cell_iterator;
    using CellStatus   = typename Triangulation<dim>::CellStatus;
    auto              &triangulation = grid.triangulation();
    const auto         first         = first_points(points, grid);
    const unsigned int n_arrays      = points.n_arrays();

    const auto weights = triangulation.signals.weight.connect(
      [&](const CellIterator &cell, const CellStatus) -> unsigned int {
        const unsigned int c = grid.index_of(cell);
        return weight(first[c + 1] - first[c]);
      });
    const unsigned int handle = triangulation.register_data_attach(
      [&](const CellIterator &cell, const CellStatus) {
        const unsigned int c = grid.index_of(cell);
        const std::size_t  n = first[c + 1] - first[c];
        std::vector<char>  data(n * n_arrays * sizeof(double));
        for (unsigned int a = 0; a < n_arrays && n > 0; ++a)
          std::memcpy(data.data() + a * n * sizeof(double),
                      points.data(a) + first[c],
                      n * sizeof(double));
        return data;
      },
      /*returns_variable_size_data=*/true);
    triangulation.repartition();
    weights.disconnect();
    grid.prepare();

    // The numbers of arrays are the same on all ranks: materials add columns
    // for all.
    points.clear();
    std::vector<unsigned int> cells;
    triangulation.notify_ready_to_unpack(
      handle,
      [&](const CellIterator &cell, const CellStatus, const auto &range) {
        const std::size_t  bytes = range.end() - range.begin();
        const unsigned int n     = bytes / (n_arrays * sizeof(double));
        if (n == 0)
          return;
        const unsigned int begin = points.append(n);
        cells.resize(begin + n, grid.index_of(cell));
        for (unsigned int a = 0; a < n_arrays; ++a)
          std::memcpy(points.data(a) + begin,
                      &*range.begin() + a * n * sizeof(double),
                      n * sizeof(double));
      });
    reached_imbalance_ = imbalance(points, grid.communicator());
    // Kept, so that a resumed run gets the same cells on the same ranks, by
    // these weights; the points have moved on by then.
    weights_.assign(grid.n_owned_cells(), weight(0));
    for (const unsigned int c : cells)
      weights_[c] += weight(1) - weight(0);
    return cells;
  }



  template <int dim>
  void
  LoadBalance<dim>::list_state(StateList &list)
  {
    list.add("reached imbalance", "-", reached_imbalance_, Reduction::equal);
  }



  template class LoadBalance<2>;
  template class LoadBalance<3>;
} // namespace talus

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
      "Largest number of points of a rank over the mean [-], above which "
      "the mesh is distributed anew among the ranks.",
      this->prm,
      Patterns::Double(1.));
    add_parameter("Interval",
                  interval_,
                  "Number of steps between two checks of the imbalance [-].",
                  this->prm,
                  Patterns::Integer(1));
  }



  namespace
  {
    /// Index of the first point of each owned cell, and at the end the number
    /// of points.
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



    /// Weight of a cell with @p n_points points, for p4est: an integer. The
    /// cost of a step is proportional to the number of points. Empty cells
    /// weigh a little, as otherwise a single rank could receive all empty cells
    /// at the end of the space-filling curve, and run out of memory.
    unsigned int
    weight(const unsigned int n_points)
    {
      return 1 + 100 * n_points;
    }
  } // namespace



  // Points travel with their cells, as deal.II's data of variable size attached
  // to cells: p4est knows the new rank of each cell, and points may go to any
  // rank. The data of a cell are its points, column by column. The order of the
  // points within a cell is part of the state and is kept.
  //
  // Points in cells that stay on their rank are packed and unpacked as well:
  // repartitions are rare, and the indices of all cells change.
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

    // All ranks have the same number of arrays, as materials add their columns
    // on all ranks.
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
    // Keep the weights: by the time of a checkpoint the points have moved, but
    // a resumed run must distribute the same cells to the same ranks.
    weights_.assign(grid.n_owned_cells(), weight(0));
    for (const unsigned int c : cells)
      weights_[c] += weight(1) - weight(0);
    return cells;
  }



  template class LoadBalance<2>;
  template class LoadBalance<3>;
} // namespace talus

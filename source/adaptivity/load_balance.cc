// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/load_balance.h>
#include <talus/transfer/points_of_cells.h>

#include <deal.II/base/mpi.h>

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



  /// The cost of a step is proportional to the number of points. Empty cells
  /// weigh a little, as otherwise a single rank could receive all empty cells
  /// at the end of the space-filling curve, and run out of memory.
  template <int dim>
  std::vector<unsigned int>
  LoadBalance<dim>::repartition(Grid<dim> &grid, Points<dim> &points)
  {
    std::vector<double> weights(grid.n_owned_cells(), 1.);
    for (const Segment &segment : points.segments())
      weights[segment.cell] += 100. * (segment.end - segment.begin);
    const auto cells   = repartition(grid, points, weights);
    reached_imbalance_ = imbalance(points, grid.communicator());
    return cells;
  }



  /// The weights are kept: by the time of a checkpoint the points have moved,
  /// but a resumed run must distribute the same cells to the same ranks.
  template <int dim>
  std::vector<unsigned int>
  LoadBalance<dim>::repartition(Grid<dim>                 &grid,
                                Points<dim>               &points,
                                const std::vector<double> &weights)
  {
    const unsigned int handle = attach_points(grid, points, weights);
    grid.repartition(weights);
    grid.prepare();
    return points_of_cells(grid, handle, points, weights_);
  }



  template class LoadBalance<2>;
  template class LoadBalance<3>;
} // namespace talus

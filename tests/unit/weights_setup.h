// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef weights_setup_h
#define weights_setup_h

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  struct Sum
  {
    double         value = 0;
    Tensor<1, dim> gradient;
  };

  /// Weights by node.
  template <int dim>
  using Weights = std::map<unsigned int, Sum<dim>>;

  template <int dim>
  Weights<dim>
  by_definition(const Grid<dim>      &grid,
                const Point<dim>     &centre,
                const Tensor<1, dim> &half)
  {
    std::vector<NodeWeight<dim>> list;
    general_weights(grid, grid.find_cell(centre), centre, half, list);
    Weights<dim> weights;
    for (const auto &w : list)
      {
        weights[w.node].value += w.value;
        weights[w.node].gradient += w.gradient;
      }
    return weights;
  }



  template <int dim>
  void
  expect_equal(Weights<dim> a, Weights<dim> b, const double tolerance)
  {
    for (const auto &weight : b)
      a[weight.first];
    for (const auto &[node, weight] : a)
      {
        EXPECT_NEAR(weight.value, b[node].value, tolerance);
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_NEAR(weight.gradient[d], b[node].gradient[d], tolerance);
      }
  }



  /// A box that belongs to the cell that holds its centre, which may lie
  /// outside of the mesh by half of that cell.
  template <int dim>
  std::pair<Point<dim>, Tensor<1, dim>>
  random_box(Core<dim> &core)
  {
    const auto  &domain = core.grid.domain();
    Point<dim>   centre = core.place(-0.5);
    const double size   = core.grid.cells()[core.grid.find_cell(centre)].size;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = std::clamp(centre[d],
                             domain.lower[d] - 0.5 * size,
                             domain.upper[d] + 0.5 * size);
    // Floor and cap as often as all between them.
    Tensor<1, dim> half;
    for (unsigned int d = 0; d < dim; ++d)
      half[d] = size * std::clamp(core.number(-0.3, 0.9), 0.1, 0.5);
    return {centre, half};
  }
} // namespace

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/film.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Thickness in cells below which soil is a film. A row of full cells is a
    // film, whatever the round-off.
    constexpr double film_thickness = 1.1;
  } // namespace



  // Summed over the nodes of a cell, the shape functions are one in the cell
  // and fall to zero across its neighbours: a layer of thickness t in the cell
  // and in the cells beside counts t (2 h)^(dim - 1), and full cells below the
  // cell count as a layer of h/2. At the surface of thick soil a cell is no
  // film if 0.6 of the cell are full.
  template <int dim>
  bool
  is_film(const Cell<dim> &cell, const NodalFields<dim> &nodes)
  {
    double volume = 0;
    for (const unsigned int node : cell.nodes())
      volume += nodes.volume(node);
    return volume < film_thickness * (1u << (dim - 1)) *
                      Utilities::fixed_power<dim>(cell.size);
  }



  template <int dim>
  void
  sum_volumes(const Points<dim> &points,
              const Grid<dim>   &grid,
              NodalFields<dim>  &nodes)
  {
    nodes.clear();
    points.for_each_point([&](const Segment &segment, const unsigned int p) {
      const double share =
        points.data(points.reference_volume)[p] / (1u << dim);
      for (const unsigned int node : grid.cells()[segment.cell].nodes())
        nodes.sum(node)[NodalSum<dim>::volume] += share;
    });
    nodes.sum_over_ranks(grid);
    nodes.share_volumes();
  }



  template decltype(is_film<2>)     is_film<2>;
  template decltype(is_film<3>)     is_film<3>;
  template decltype(sum_volumes<2>) sum_volumes<2>;
  template decltype(sum_volumes<3>) sum_volumes<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/convected_domain.h>

#include <limits>

namespace talus
{
  using namespace dealii;

  // All corners must lie in cells that touch the cell of the point. The size of
  // the smallest touching cell limits the domain, so the condition holds for
  // any position of the point in its cell.
  template <int dim>
  double
  smallest_size_around(const Grid<dim> &grid, const unsigned int c)
  {
    double size = grid.cells()[c].size;
    for (const unsigned int t : grid.touching_cells(c))
      size = std::min(size, grid.cells()[t].size);
    return size;
  }



  // The nearest cell is taken, because round-off may put the position between
  // two cells. The mesh is not searched: corners reach no farther than touching
  // cells. Corners beyond the boundary get the shape functions of the nearest
  // position in the mesh, constant along the normal, as for boxes.
  template <int dim>
  const Cell<dim> &
  touching_cell_at(const Grid<dim> &grid, const unsigned int c, Point<dim> &x)
  {
    const Box<dim> &domain = grid.domain();
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = std::clamp(x[d], domain.lower[d], domain.upper[d]);
    const Cell<dim> *nearest = &grid.cells()[c];
    double           least   = std::numeric_limits<double>::max();
    for (const unsigned int t : grid.touching_cells(c))
      {
        const Cell<dim> &cell     = grid.cells()[t];
        double           distance = 0;
        for (unsigned int d = 0; d < dim; ++d)
          distance = std::max(
            {distance, cell.lower[d] - x[d], x[d] - cell.lower[d] - cell.size});
        if (distance < least)
          {
            least   = distance;
            nearest = &cell;
          }
      }
    return *nearest;
  }



  template decltype(smallest_size_around<2>) smallest_size_around<2>;
  template decltype(smallest_size_around<3>) smallest_size_around<3>;
  template decltype(touching_cell_at<2>)     touching_cell_at<2>;
  template decltype(touching_cell_at<3>)     touching_cell_at<3>;
} // namespace talus

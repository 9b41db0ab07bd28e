// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/convected_domain.h>

#include <limits>

namespace talus
{
  using namespace dealii;

  // A corner must lie in one of the cells that touch the point's own. Since the
  // smallest of these decides how far it may reach, this holds wherever in its
  // cell the point lies.
  template <int dim>
  double
  smallest_size_around(const Grid<dim> &grid, const unsigned int c)
  {
    double size = grid.cells()[c].size;
    for (const unsigned int t : grid.touching_cells(c))
      size = std::min(size, grid.cells()[t].size);
    return size;
  }



  // Of all cells the one least far away, as round-off may put the place between
  // two of them.
  // No search in the mesh is needed, as corners reach no farther than these
  // cells. Corners beyond the boundary see the shape functions of the nearest
  // place of the mesh: constant along the normal, as boxes do.
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

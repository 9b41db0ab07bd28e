// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/node_places.h>

namespace talus
{
  using namespace dealii;

  // For expressions in x, y, z at nodes. A node on a periodic face has two
  // places, of which that of the last cell is taken: what is given there must
  // repeat with the mesh (doc/method.md, section 9).
  template <int dim>
  std::vector<Point<dim>>
  places_of_owned_nodes(const Grid<dim> &grid)
  {
    std::vector<Point<dim>> places(grid.n_owned_nodes());
    // Each owned node is the corner of an owned cell.
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        const Cell<dim> &cell  = grid.cells()[c];
        const auto       place = grid.place_of_cell(c);
        for (unsigned int v = 0; v < power(2, dim); ++v)
          {
            auto corner = place;
            for (unsigned int d = 0; d < dim; ++d)
              corner[d] += (v >> d) & 1;
            const unsigned int node = cell.patch[patch_of_vertex<dim>(v)];
            if (node < grid.n_owned_nodes())
              places[node] =
                grid.lower_corner_of(corner, grid.level_of_cell(c));
          }
      }
    return places;
  }



  template decltype(places_of_owned_nodes<2>) places_of_owned_nodes<2>;
  template decltype(places_of_owned_nodes<3>) places_of_owned_nodes<3>;
} // namespace talus

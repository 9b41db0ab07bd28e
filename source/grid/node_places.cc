// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/node_places.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Call action(node, place, level) for all corners of owned cells whose
    /// node this rank owns. All owned nodes are visited, some more than once.
    template <int dim, typename Action>
    void
    for_each_owned_corner(const Grid<dim> &grid, const Action &action)
    {
      for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
        for (unsigned int v = 0; v < power(2, dim); ++v)
          {
            Lattice<dim> corner = grid.place_of_cell(c);
            for (unsigned int d = 0; d < dim; ++d)
              corner[d] += (v >> d) & 1;
            const unsigned int node =
              grid.cells()[c].patch[patch_of_vertex<dim>(v)];
            if (node < grid.n_owned_nodes())
              action(node, corner, grid.level_of_cell(c));
          }
    }
  } // namespace



  // For expressions in x, y, z at nodes. A node on a periodic face has two
  // positions; the position in the last cell is returned. Expressions must
  // therefore have the period of the mesh (doc/method.md, section 9).
  template <int dim>
  std::vector<Point<dim>>
  places_of_owned_nodes(const Grid<dim> &grid)
  {
    std::vector<Point<dim>> places(grid.n_owned_nodes());
    for_each_owned_corner(grid,
                          [&](const unsigned int  node,
                              const Lattice<dim> &place,
                              const unsigned int  level) {
                            places[node] = grid.lower_corner_of(place, level);
                          });
    return places;
  }



  // A position with even coordinates is also in the lattice one level coarser:
  // the key belongs to the coarsest possible lattice.
  template <int dim>
  std::vector<unsigned long>
  keys_of_owned_nodes(const Grid<dim> &grid)
  {
    std::vector<unsigned long> keys(grid.n_owned_nodes());
    for_each_owned_corner(
      grid,
      [&](const unsigned int node, Lattice<dim> place, unsigned int level) {
        grid.periodicity().wrap(place, grid.extent_of_lattice(level));
        const auto is_even = [](const long i) { return i % 2 == 0; };
        for (; level > 0 && std::all_of(place.begin(), place.end(), is_even);
             --level)
          for (long &i : place)
            i /= 2;
        keys[node] = key_of_place<dim>(place, level);
      });
    return keys;
  }



  template decltype(places_of_owned_nodes<2>) places_of_owned_nodes<2>;
  template decltype(places_of_owned_nodes<3>) places_of_owned_nodes<3>;
  template decltype(keys_of_owned_nodes<2>)   keys_of_owned_nodes<2>;
  template decltype(keys_of_owned_nodes<3>)   keys_of_owned_nodes<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_node_places_h
#define talus_grid_node_places_h

#include <talus/grid/grid.h>

#include <deal.II/base/point.h>

#include <vector>

namespace talus
{
  /// Return the positions of the nodes owned by this rank, m, by node. Computed
  /// from the lattice, hence identical on any number of ranks.
  template <int dim>
  std::vector<dealii::Point<dim>>
  places_of_owned_nodes(const Grid<dim> &grid);

  /// Return the keys of the positions of the nodes owned by this rank, by node.
  /// Keys do not depend on mesh and ranks. A node on an upper periodic face has
  /// the key of its twin on the lower face.
  template <int dim>
  std::vector<unsigned long>
  keys_of_owned_nodes(const Grid<dim> &grid);
} // namespace talus

#endif

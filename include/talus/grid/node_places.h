// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_node_places_h
#define talus_grid_node_places_h

#include <talus/grid/grid.h>

#include <deal.II/base/point.h>

#include <vector>

namespace talus
{
  /// Places of the nodes this rank owns, m: counted on the lattice, and so the
  /// same on any number of ranks.
  template <int dim>
  std::vector<dealii::Point<dim>>
  places_of_owned_nodes(const Grid<dim> &grid);

  /// Keys of the places of the nodes this rank owns, by node. Keys do not depend
  /// on mesh and ranks. A node on a periodic face has the key of its twin on the
  /// lower face.
  template <int dim>
  std::vector<unsigned long>
  keys_of_owned_nodes(const Grid<dim> &grid);
} // namespace talus

#endif

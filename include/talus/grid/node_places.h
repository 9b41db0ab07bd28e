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

  /// Names of the places of the nodes this rank owns on faces of the mesh, by
  /// node, and 0 for all others. Names do not depend on mesh and ranks. A node on
  /// a periodic face has the name of its twin on the lower face.
  template <int dim>
  std::vector<unsigned long>
  keys_of_face_nodes(const Grid<dim> &grid);
} // namespace talus

#endif

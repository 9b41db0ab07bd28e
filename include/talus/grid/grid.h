// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_grid_h
#define talus_grid_grid_h

#include <talus/grid/boundary_nodes.h>

namespace talus
{
  /// The background grid: a p4est mesh of square (cubic) cells over a box, with
  /// Q1 elements, and what the transfer needs to know of it. It is what its
  /// parts are, and adds nothing but the order in which they follow from each
  /// other; who needs one part only takes that one by reference.
  template <int dim>
  class Grid : public Mesh<dim>,
               public NodeNumbering<dim>,
               public CellCache<dim>,
               public BoundaryNodes<dim>
  {
  public:
    explicit Grid(MPI_Comm communicator);

    /// Number the nodes, list the cells and find the boundary; to be called
    /// after each change of the mesh. Collective.
    void
    prepare();
  };
} // namespace talus

#endif

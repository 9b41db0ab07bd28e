// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_grid_h
#define talus_grid_grid_h

#include <talus/grid/boundary_nodes.h>

namespace talus
{
  /// The background grid: a p4est mesh of square (cubic) cells in a box with Q1
  /// elements, and the tables for the transfer. The base classes do the work;
  /// Grid adds only the order of their preparation. Code that needs one part
  /// takes a reference to the base class.
  template <int dim>
  class Grid : public Mesh<dim>,
               public NodeNumbering<dim>,
               public CellCache<dim>,
               public BoundaryNodes<dim>
  {
  public:
    explicit Grid(MPI_Comm communicator);

    /// Number the nodes, build the tables of cells and find the boundary. Call
    /// after each change of the mesh. Collective.
    void
    prepare();
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_fracture_h
#define talus_observers_fracture_h

#include <talus/base/quantity.h>
#include <talus/contact/ground.h>
#include <talus/state/state.h>

namespace talus
{
  /// Signs of numerical fracture: where the points no longer form a continuum.
  /// Counted on cells of size h (`Grid/Cell size`) (see CellLattice); a cell is
  /// occupied when the centre of a point is in it.
  struct FractureCounts
  {
    unsigned long occupied_cells = 0;
    /// Unoccupied cells below an occupied one of their column, which has the
    /// same x (and z), down to the next occupied one or to the ground: to the
    /// bottom face of the mesh or a cell whose centre lies in an obstacle. Down
    /// to the ground only if the occupied one belongs to a connected body with
    /// a cell that lies on it: below soil that hangs there is none to miss.
    unsigned long empty_interior_cells = 0;
    /// Columns of the mesh without an occupied cell between the first and the
    /// last with one; in 3-D slabs of cells with the same x.
    unsigned long empty_columns = 0;
    /// Groups of occupied cells that touch across faces, edges or corners.
    unsigned long connected_bodies = 0;
    /// Cells with exactly one point.
    unsigned long cells_with_one_point = 0;
  };



  /// Count; collective over the ranks of the grid, the result is on the first
  /// one. The points need not be sorted. The cost follows the points, not the
  /// mesh.
  template <int dim>
  FractureCounts
  count_fractures(const Points<dim> &points,
                  const Grid<dim>   &grid,
                  const Ground<dim> &ground);



  /// List the counts but for that of the occupied cells. Collective.
  template <int dim>
  void
  list_fractures(const State<dim>  &state,
                 const Ground<dim> &ground,
                 Quantities        &list);
} // namespace talus

#endif

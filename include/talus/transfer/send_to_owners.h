// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_send_to_owners_h
#define talus_transfer_send_to_owners_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>

namespace talus
{
  /// Send new, unsorted points to the ranks that own their cells, at any
  /// distance. Relocation sends to neighbour ranks only. Collective.
  template <int dim>
  void
  send_points_to_owners(Points<dim> &points, const Grid<dim> &grid);
} // namespace talus

#endif

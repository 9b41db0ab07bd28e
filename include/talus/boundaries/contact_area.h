// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_contact_area_h
#define talus_boundaries_contact_area_h

#include <talus/grid/nodal_fields.h>

#include <algorithm>

namespace talus
{
  /// Area in which soil touches @p face at @p node, m^(dim-1): the node's share
  /// of the face times the degree to which soil fills the node's share of the
  /// cells at the face, at most one.
  template <int dim>
  double
  contact_area(const NodalFields<dim> &nodes,
               const Grid<dim>        &grid,
               const unsigned int      face,
               const unsigned int      node)
  {
    const auto &share = grid.face_share(face, node);
    return share.area * std::min(1., nodes.volume(node) / share.volume);
  }
} // namespace talus

#endif

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
    const auto  &share  = grid.face_share(face, node);
    const double volume = nodes.sum(node)[NodalSum<dim>::volume];
    return share.area * std::min(1., volume / share.volume);
  }
} // namespace talus

#endif

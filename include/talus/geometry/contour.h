// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_contour_h
#define talus_geometry_contour_h

#include <talus/geometry/cut_box.h>

#include <vector>

namespace talus
{
  /// Ends of a segment (2-D) or corners of a triangle (3-D). The distance is
  /// positive on the left of the segment, and on the side from which the
  /// corners appear counter-clockwise.
  template <int dim>
  using SurfaceElement = std::array<dealii::Point<dim>, dim>;

  /// Return the surface in a box on which a distance is zero, for plots. Where
  /// radii of curvature are at least @p size, m (in 3-D three times @p size),
  /// the error is at most size/50. Edges and corners are cut off by at most
  /// size/2; features smaller than size/2 may be missed. Plane parts have few
  /// elements, with gaps of up to size/50 between elements. @p bounds, a box
  /// around the surface, reduces the search.
  template <int dim>
  std::vector<SurfaceElement<dim>>
  contour(const Box<dim>              &box,
          const Box<dim>              &bounds,
          const DistanceFunction<dim> &distance,
          double                       size);
} // namespace talus

#endif

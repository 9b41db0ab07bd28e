// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_contour_h
#define talus_geometry_contour_h

#include <talus/geometry/cut_box.h>

#include <vector>

namespace talus
{
  /// Ends of a segment (2-D) or corners of a triangle (3-D). On its left, or
  /// where its corners are seen counter-clockwise from, the distance is
  /// positive.
  template <int dim>
  using SurfaceElement = std::array<dealii::Point<dim>, dim>;

  /// The surface in a box on which a distance is zero, to be drawn. Where it is
  /// curved, with radii of @p size, m, or more (in 3-D three times that), it is
  /// right to a fiftieth of it; edges and corners are cut off by half of it at
  /// most. Plane parts have few elements, whatever the size; there may be gaps of
  /// a fiftieth of it between elements. What is smaller than half of it may be
  /// missed. @p bounds, a box around the surface, saves a search where it is not.
  template <int dim>
  std::vector<SurfaceElement<dim>>
  contour(const Box<dim>              &box,
          const Box<dim>              &bounds,
          const DistanceFunction<dim> &distance,
          double                       size);
} // namespace talus

#endif

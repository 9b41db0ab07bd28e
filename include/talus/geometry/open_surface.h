// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_open_surface_h
#define talus_geometry_open_surface_h

#include <talus/geometry/cut_box.h>

#include <vector>

namespace talus
{
  /// Solid that may cover parts of the surface of another solid.
  template <int dim>
  struct Cover
  {
    DistanceFunction<dim> distance;
    /// Unit normal out of this solid at the place of the surface nearest to x.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> normal;
    /// Whether this solid covers a coincident surface that faces the same way,
    /// for instance the upper faces of two adjacent boxes. Set for one of the
    /// two solids: a common surface counts once.
    bool covers_common_surface;
  };

  /// Clip the plane @p pieces of a surface by solids: return the parts outside
  /// of all @p covers. Surfaces in contact that face each other, as the foot of
  /// a box on a plane, are covered. The result is exact where covers are plane
  /// within a piece; edges of covers are resolved to 1/64 of the cell (2-D) or
  /// 1/32 (3-D).
  /// @param size edge length of the cell around the pieces, m
  template <int dim>
  std::vector<Facet<dim>>
  uncovered_pieces(const std::vector<Facet<dim>> &pieces,
                   const std::vector<Cover<dim>> &covers,
                   double                         size);

  /// Sum plane pieces up to surfaces with a direction each: the normals of the
  /// pieces differ by at most 60 degrees from the first piece, or turn around a
  /// convex edge. Faces of a notch stay apart, and also both sides of a thin
  /// wall, whose mean normal would be meaningless.
  template <int dim>
  std::vector<CutSurface<dim>>
  surfaces_by_direction(const std::vector<Facet<dim>> &pieces);
} // namespace talus

#endif

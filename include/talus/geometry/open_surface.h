// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_open_surface_h
#define talus_geometry_open_surface_h

#include <talus/geometry/cut_box.h>

#include <vector>

namespace talus
{
  /// Solid that may cover parts of the surface of another one.
  template <int dim>
  struct Cover
  {
    DistanceFunction<dim> distance;
    /// Unit normal out of this solid at the place of its surface nearest to x.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> normal;
    /// Whether this solid covers a surface that coincides with its own and faces
    /// the same way, as the upper faces of two boxes side by side may. One of two
    /// solids does, so that a common surface counts once.
    bool covers_common_surface;
  };

  /// Clip the plane @p pieces of a surface by solids: return the parts outside of
  /// all @p covers. Surfaces that face each other in contact, as the foot of a
  /// box on a plane, are covered. @p size, m: edge length of the cell that the
  /// pieces lie in. The result is exact where covers are plane within a piece;
  /// edges of covers are resolved to 1/64 of the cell (2-D) or 1/32 (3-D).
  template <int dim>
  std::vector<Facet<dim>>
  uncovered_pieces(const std::vector<Facet<dim>> &pieces,
                   const std::vector<Cover<dim>> &covers,
                   double                         size);

  /// Sum plane pieces up to surfaces, each of which has a direction: the normals
  /// of its pieces differ by at most 60 degrees from the first one, or turn around
  /// a convex edge. Faces of a notch stay apart, and so do both sides of a thin
  /// wall, whose mean normal would have no meaning.
  template <int dim>
  std::vector<CutSurface<dim>>
  surfaces_by_direction(const std::vector<Facet<dim>> &pieces);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_clip_simplex_h
#define talus_geometry_clip_simplex_h

#include <talus/base/box.h>

#include <deal.II/base/tensor.h>

#include <boost/container/static_vector.hpp>

#include <array>
#include <vector>

namespace talus
{
  /// Corners of a triangle (2-D) or tetrahedron (3-D), in any order.
  template <int dim>
  using Simplex = std::array<dealii::Point<dim>, dim + 1>;

  /// Part of a plane: the ends of a segment (2-D), or the corners of a triangle
  /// or plane quadrilateral in order (3-D).
  template <int dim>
  using Facet =
    boost::container::static_vector<dealii::Point<dim>, dim == 2 ? 2 : 4>;

  /// Result of clip_simplex().
  template <int dim>
  struct ClippedSimplex
  {
    /// Simplices that tile the part where the function is not positive.
    boost::container::static_vector<Simplex<dim>, dim == 2 ? 2 : 3> parts;
    /// Part of the plane where the function is zero; empty if all values have
    /// the same sign.
    Facet<dim> facet;
  };

  /// Cut a simplex by the zero of the linear function with @p values at the
  /// corners. Zero counts as negative; a face on which the function is zero is
  /// a facet only of the simplex where the function is positive. The facet's
  /// vector_area() points to positive values. Give negative values to obtain
  /// the opposite part.
  template <int dim>
  ClippedSimplex<dim>
  clip_simplex(const Simplex<dim>                &simplex,
               const std::array<double, dim + 1> &values);

  /// Return the volume, in 2-D the area, m^dim, not negative.
  template <int dim>
  double
  volume(const Simplex<dim> &simplex);

  template <int dim>
  dealii::Point<dim>
  centroid(const Simplex<dim> &simplex);

  /// Return the integral of the normal, m^(dim-1). The normal points to the
  /// left of a segment, and to the side of a polygon from which the corners
  /// appear counter-clockwise.
  template <int dim>
  dealii::Tensor<1, dim>
  vector_area(const Facet<dim> &facet);

  /// Return the centroid of a facet with positive area.
  template <int dim>
  dealii::Point<dim>
  centroid(const Facet<dim> &facet);

  /// Return the 2 triangles or 6 tetrahedra around a diagonal that tile @p box
  /// (Kuhn's tiling). The diagonal begins at the corner nearest to @p centre,
  /// the centre of a cell with parts like @p box. So the tiling of the cell is
  /// symmetric about @p centre, and faces of adjacent boxes match.
  template <int dim>
  std::array<Simplex<dim>, dim == 2 ? 2 : 6>
  simplices_of(const Box<dim> &box, const dealii::Point<dim> &centre);
} // namespace talus

#endif

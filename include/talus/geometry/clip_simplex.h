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

  /// Part of a plane: the ends of a segment (2-D) or the corners of a triangle
  /// or plane quadrilateral (3-D) in order.
  template <int dim>
  using Facet =
    boost::container::static_vector<dealii::Point<dim>, dim == 2 ? 2 : 4>;

  /// What clip_simplex() leaves of a simplex.
  template <int dim>
  struct ClippedSimplex
  {
    /// Simplices that tile the part where the function is not positive.
    boost::container::static_vector<Simplex<dim>, dim == 2 ? 2 : 3> parts;
    /// Where the function is zero; empty if it has one sign.
    Facet<dim> facet;
  };

  /// Cut a simplex by the zero of the linear function that has @p values at its
  /// corners. Zero counts as negative; a face of the simplex on which the
  /// function is zero is a facet of the simplex in which it is positive, and of
  /// that one alone. The facet's vector_area() points to where the function is
  /// positive. Give negative values for the other side.
  template <int dim>
  ClippedSimplex<dim>
  clip_simplex(const Simplex<dim>                &simplex,
               const std::array<double, dim + 1> &values);

  /// Area in 2-D, m^dim, not negative.
  template <int dim>
  double
  volume(const Simplex<dim> &simplex);

  template <int dim>
  dealii::Point<dim>
  centroid(const Simplex<dim> &simplex);

  /// Integral of the normal, m^(dim-1): on the left of a segment, and of a
  /// polygon where its corners are seen counter-clockwise from.
  template <int dim>
  dealii::Tensor<1, dim>
  vector_area(const Facet<dim> &facet);

  /// Of a facet that is no point.
  template <int dim>
  dealii::Point<dim>
  centroid(const Facet<dim> &facet);

  /// The 2 triangles or 6 tetrahedra around a diagonal of @p box that tile it
  /// (Kuhn's), so that boxes side by side match at their faces.
  template <int dim>
  std::array<Simplex<dim>, dim == 2 ? 2 : 6>
  simplices_of(const Box<dim> &box);
} // namespace talus

#endif

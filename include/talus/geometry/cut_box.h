// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_cut_box_h
#define talus_geometry_cut_box_h

#include <talus/geometry/clip_simplex.h>

#include <array>
#include <functional>
#include <vector>

namespace talus
{
  /// Distance from a surface, m, by place; may grow by at most 1.5 m per m.
  template <int dim>
  using DistanceFunction = std::function<double(const dealii::Point<dim> &)>;

  /// Surface in a box on which a distance is zero.
  template <int dim>
  struct CutSurface
  {
    double                 area = 0;    ///< m^(dim-1); 0 without surface
    dealii::Tensor<1, dim> vector_area; ///< integral of the normal, m^(dim-1);
                                        ///< points to positive distance
    dealii::Point<dim> centroid;        ///< m
  };

  /// Return the surface in a box as plane pieces, in a fixed order. The nonzero
  /// vector_area() of a piece points to positive distance. Pieces are four
  /// times as fine if the body @p is_thin, or where the surface faces two
  /// opposite directions within the box. Pieces in adjacent boxes match if
  /// @p is_thin is set for all boxes, or if no box sees opposite directions.
  template <int dim>
  std::vector<Facet<dim>>
  surface_pieces(const Box<dim>              &box,
                 const DistanceFunction<dim> &distance,
                 bool                         is_thin = false);

  /// Sum plane pieces up to one surface.
  template <int dim>
  CutSurface<dim>
  sum_of_pieces(const std::vector<Facet<dim>> &pieces);

  /// Return the sum of surface_pieces().
  template <int dim>
  CutSurface<dim>
  surface_in_box(const Box<dim> &box, const DistanceFunction<dim> &distance)
  {
    return sum_of_pieces<dim>(surface_pieces<dim>(box, distance));
  }

  /// Return the integrals of the 2^dim multilinear shape functions of a box
  /// over the part of the box with positive distance, m^dim; corners in the
  /// order of deal.II, x fastest.
  template <int dim>
  std::array<double, (1u << dim)>
  open_shape_integrals(const Box<dim>              &box,
                       const DistanceFunction<dim> &distance);

  /// Return the values of the shape functions of open_shape_integrals() at
  /// @p x.
  template <int dim>
  std::array<double, (1u << dim)>
  shape_values_at(const Box<dim> &box, const dealii::Point<dim> &x);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_cut_box_h
#define talus_geometry_cut_box_h

#include <talus/geometry/clip_simplex.h>

#include <array>
#include <functional>
#include <vector>

namespace talus
{
  /// Distance from a surface, m, by place; it may grow by no more than 1.5 m
  /// per m.
  template <int dim>
  using DistanceFunction = std::function<double(const dealii::Point<dim> &)>;

  /// The surface in a box on which a distance is zero.
  template <int dim>
  struct CutSurface
  {
    double                 area = 0;    ///< m^(dim-1); 0 if there is none
    dealii::Tensor<1, dim> vector_area; ///< integral of the normal, m^(dim-1),
      ///< which points to where it is positive
    dealii::Point<dim> centroid; ///< m
  };

  /// Return the surface in a box as plane pieces, in a fixed order; the
  /// vector_area() of a piece points to where the distance is positive and is
  /// not zero. Pieces are four times as fine if the body @p is_thin, or where its
  /// surface faces two opposite directions within the box. The pieces of a body
  /// in boxes side by side match if @p is_thin is set for all of them or if no
  /// box sees opposite directions.
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

  /// Integrals of the 2^dim multilinear shape functions of a box over that part
  /// of it in which the distance is positive, m^dim; corners in the order of
  /// deal.II, x fastest.
  template <int dim>
  std::array<double, (1u << dim)>
  open_shape_integrals(const Box<dim>              &box,
                       const DistanceFunction<dim> &distance);

  /// Values of these shape functions at @p x.
  template <int dim>
  std::array<double, (1u << dim)>
  shape_values_at(const Box<dim> &box, const dealii::Point<dim> &x);
} // namespace talus

#endif

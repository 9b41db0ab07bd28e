// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_cut_box_h
#define talus_geometry_cut_box_h

#include <talus/base/box.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <functional>

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

  template <int dim>
  CutSurface<dim>
  surface_in_box(const Box<dim> &box, const DistanceFunction<dim> &distance);

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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_shape_h
#define talus_geometry_shape_h

#include <talus/base/box.h>

#include <deal.II/base/tensor.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace talus
{
  /// Region of space: initially filled by a body, or kept free of soil by an
  /// obstacle.
  template <int dim>
  class Shape
  {
  public:
    virtual ~Shape() = default;

    /// Euclidean distance to the surface, m: negative inside, positive outside.
    virtual double
    signed_distance(const dealii::Point<dim> &x) const = 0;

    /// Unit vector along which signed_distance() grows: the outward normal at
    /// the place of the surface nearest to @p x. If several places are equally
    /// near, the normal of any one of them.
    virtual dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const = 0;

    /// Return signed_distance() and normal() together, at lower cost.
    virtual std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const dealii::Point<dim> &x) const
    {
      return {signed_distance(x), normal(x)};
    }

    /// Return whether the shape, including the surface, contains @p x; false
    /// for NaN.
    virtual bool
    contains(const dealii::Point<dim> &x) const
    {
      return signed_distance(x) <= 0.;
    }

    /// Smallest axis-aligned box around the shape, infinite along endless
    /// directions.
    virtual Box<dim>
    bounding_box() const = 0;

    /// Return whether the surface may be nearer to @p x than @p radius, m. If
    /// not, the whole ball is on one side. Some shapes do not know the
    /// Euclidean distance far from the surface.
    virtual bool
    may_cut_ball(const dealii::Point<dim> &x, const double radius) const
    {
      return std::abs(signed_distance(x)) < radius;
    }

    /// Return whether a distance costs as much as hundreds of operations, so
    /// that a table pays where many points need distances.
    virtual bool
    is_costly() const
    {
      return false;
    }

    /// Width across the shape, m, if equal in all directions but one, for
    /// instance of a pipe in any direction. Infinite for all remaining shapes,
    /// whose thickness follows from the bounding box.
    virtual double
    width() const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// Shapes whose intersection is this shape: the shape itself, or parts that
    /// meet in sharp edges.
    virtual std::vector<const Shape *>
    parts() const
    {
      return {this};
    }
  };
} // namespace talus

#endif

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
  /// Region of space that a body fills at the start, or that an obstacle keeps
  /// free of soil.
  template <int dim>
  class Shape
  {
  public:
    virtual ~Shape() = default;

    /// Euclidean distance to the surface, m: negative inside, positive outside.
    virtual double
    signed_distance(const dealii::Point<dim> &x) const = 0;

    /// Unit vector along which signed_distance() grows: the outward normal at
    /// the place of the surface that is nearest to @p x. Where several are
    /// equally near it is that of one of them.
    virtual dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const = 0;

    /// Both at once, where whoever asks needs both.
    virtual std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const dealii::Point<dim> &x) const
    {
      return {signed_distance(x), normal(x)};
    }

    /// The surface belongs to the shape; a place that is no number does not.
    virtual bool
    contains(const dealii::Point<dim> &x) const
    {
      return signed_distance(x) <= 0.;
    }

    /// Smallest axis-aligned box around the shape; infinite where it has no
    /// end.
    virtual Box<dim>
    bounding_box() const = 0;

    /// Whether the surface may be nearer to @p x than @p radius, m. If not, the
    /// whole ball is on one side. Not all shapes know the Euclidean distance far
    /// from their surface.
    virtual bool
    may_cut_ball(const dealii::Point<dim> &x, const double radius) const
    {
      return std::abs(signed_distance(x)) < radius;
    }

    /// Width across the shape, m, where this is the same along all directions but
    /// one, which may be oblique, as of a pipe. Infinite for all other shapes, of
    /// which the bounding box tells how thin they are.
    virtual double
    width() const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// Shapes whose intersection this is: itself, or those that meet in sharp
    /// edges.
    virtual std::vector<const Shape *>
    parts() const
    {
      return {this};
    }
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_intersection_h
#define talus_geometry_intersection_h

#include <talus/geometry/shape.h>

#include <memory>
#include <vector>

namespace talus
{
  /// Intersection of at least one shape. The distance is the maximum of the
  /// distances to the shapes: a lower bound outside, where the nearest place is
  /// an edge.
  template <int dim>
  class Intersection : public Shape<dim>
  {
  public:
    using Parts = std::vector<std::unique_ptr<Shape<dim>>>;

    explicit Intersection(Parts parts)
      : parts_(std::move(parts))
    {}

    double
    signed_distance(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const override;

    bool
    contains(const dealii::Point<dim> &x) const override;

    Box<dim>
    bounding_box() const override;

    bool
    may_cut_ball(const dealii::Point<dim> &x, double radius) const override;

    std::vector<const Shape<dim> *>
    parts() const override;

  private:
    Parts parts_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_vertical_prism_h
#define talus_geometry_vertical_prism_h

#include <talus/geometry/shape.h>

#include <limits>
#include <memory>

namespace talus
{
  /// Endless vertical prism above and below an outline in plan.
  class VerticalPrism : public Shape<3>
  {
  public:
    /// The first axis of @p outline is x, the second z.
    explicit VerticalPrism(std::unique_ptr<const Shape<2>> outline)
      : outline_(std::move(outline))
    {}

    double
    signed_distance(const dealii::Point<3> &x) const override
    {
      return outline_->signed_distance(in_plan(x));
    }

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override
    {
      const dealii::Tensor<1, 2> n = outline_->normal(in_plan(x));
      return dealii::Tensor<1, 3>({n[0], 0., n[1]});
    }

    bool
    contains(const dealii::Point<3> &x) const override
    {
      return outline_->contains(in_plan(x));
    }

    Box<3>
    bounding_box() const override
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const Box<2>     box      = outline_->bounding_box();
      return {dealii::Point<3>(box.lower[0], -infinity, box.lower[1]),
              dealii::Point<3>(box.upper[0], infinity, box.upper[1])};
    }

  private:
    static dealii::Point<2>
    in_plan(const dealii::Point<3> &x)
    {
      return {x[0], x[2]};
    }

    std::unique_ptr<const Shape<2>> outline_;
  };
} // namespace talus

#endif

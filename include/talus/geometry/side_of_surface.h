// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_side_of_surface_h
#define talus_geometry_side_of_surface_h

#include <talus/geometry/shape.h>
#include <talus/geometry/surface.h>

#include <memory>

namespace talus
{
  /// Everything below or above a surface y = b(x, z). The distance is measured
  /// to the tangent plane, (y - b)/sqrt(1 + |grad b|^2): accurate near the
  /// surface, and everywhere for planes.
  template <int dim>
  class SideOfSurface : public Shape<dim>
  {
  public:
    enum class Side
    {
      below,
      above
    };

    SideOfSurface(std::shared_ptr<const Surface<dim>> surface, Side side)
      : surface_(std::move(surface))
      , sign_(side == Side::below ? 1. : -1.)
    {}

    double
    signed_distance(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const override;

    std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const dealii::Point<dim> &x) const override;

    bool
    contains(const dealii::Point<dim> &x) const override;

    /// Infinite box.
    Box<dim>
    bounding_box() const override;

    bool
    may_cut_ball(const dealii::Point<dim> &x, double radius) const override;

    /// Surfaces are rasters and expressions.
    bool
    is_costly() const override
    {
      return true;
    }

    /// Return whether the surface is defined at the place of @p x in plan.
    bool
    is_known_at(const dealii::Point<dim> &x) const
    {
      return surface_->is_known_at(x);
    }

    /// Return whether @p other is the opposite side of the same surface.
    bool
    is_beyond(const Shape<dim> &other) const;

  private:
    std::shared_ptr<const Surface<dim>> surface_;
    double                              sign_;
  };
} // namespace talus

#endif

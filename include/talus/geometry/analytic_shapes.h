// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_analytic_shapes_h
#define talus_geometry_analytic_shapes_h

#include <talus/geometry/polygon.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace talus
{
  /// Everything on one side of a plane (in 2-D of a line).
  template <int dim>
  class HalfSpace : public Shape<dim>
  {
  public:
    /// @p point lies on the plane; @p normal, of any nonzero length, points out
    /// of the solid.
    HalfSpace(const dealii::Point<dim>     &point,
              const dealii::Tensor<1, dim> &normal);

    double
    signed_distance(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &) const override
    {
      return normal_;
    }

    Box<dim>
    bounding_box() const override;

  private:
    dealii::Point<dim>     point_;
    dealii::Tensor<1, dim> normal_;
  };



  /// Box along the axes, possibly infinite.
  template <int dim>
  class BoxRegion : public Shape<dim>
  {
  public:
    explicit BoxRegion(const Box<dim> &box)
      : box_(box)
    {}

    double
    signed_distance(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const override;

    bool
    contains(const dealii::Point<dim> &x) const override
    {
      return box_.contains(x);
    }

    Box<dim>
    bounding_box() const override
    {
      return box_;
    }

  private:
    Box<dim> box_;
  };



  /// Disc in 2-D, sphere in 3-D, optionally with a concentric hollow.
  template <int dim>
  class Ball : public Shape<dim>
  {
  public:
    /// Radii in m; @p inner_radius is the radius of the hollow, 0 for none.
    Ball(const dealii::Point<dim> &centre,
         const double              radius,
         const double              inner_radius = 0.)
      : centre_(centre)
      , radius_(radius)
      , inner_radius_(inner_radius)
    {}

    double
    signed_distance(const dealii::Point<dim> &x) const override;

    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const override;

    bool
    contains(const dealii::Point<dim> &x) const override
    {
      const double distance = x.distance(centre_);
      return distance <= radius_ && distance >= inner_radius_;
    }

    Box<dim>
    bounding_box() const override;

  private:
    dealii::Point<dim> centre_;
    double             radius_, inner_radius_;
  };



  /// Prism over a plane shape: along z over a shape in the x-y plane, or
  /// upright over an outline in plan, whose first axis is x, the second z.
  class Prism : public Shape<3>
  {
  public:
    /// Construct the prism over @p base between the ends @p lower and @p upper,
    /// m, possibly infinite, along @p axis: 2 for z, 1 for y, upright.
    Prism(std::unique_ptr<const Shape<2>> base,
          double                          lower,
          double                          upper,
          unsigned int                    axis = 2);

    double
    signed_distance(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    bool
    contains(const dealii::Point<3> &x) const override;

    Box<3>
    bounding_box() const override;

  private:
    /// Place in the plane of the base.
    dealii::Point<2>
    foot(const dealii::Point<3> &x) const
    {
      return {x[0], x[3 - axis_]};
    }

    /// Place from coordinates in the plane of the base and along the axis.
    dealii::Point<3>
    place(double first, double second, double along) const;

    /// Distance to the nearer end, m: negative between both ends.
    double
    distance_to_ends(double along) const;

    std::unique_ptr<const Shape<2>> base_;
    double                          lower_, upper_;
    unsigned int                    axis_;
  };



  /// Return a unit vector at a right angle to @p direction.
  dealii::Tensor<1, 3>
  perpendicular(const dealii::Tensor<1, 3> &direction);



  /// Frustum of a cone with any axis: a cylinder, a cone, or a tube.
  class Frustum : public Shape<3>
  {
  public:
    /// The axis leads from @p from to @p to, where the radii are @p radius and
    /// @p end_radius, which may be 0. A tube has the inner radius
    /// @p inner_radius throughout. All in m.
    Frustum(const dealii::Point<3> &from,
            const dealii::Point<3> &to,
            double                  radius,
            double                  end_radius,
            double                  inner_radius = 0.);

    double
    signed_distance(const dealii::Point<3> &x) const override
    {
      return profile_.signed_distance(in_profile(x));
    }

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    Box<3>
    bounding_box() const override;

    double
    width() const override
    {
      return 2. * std::max(radius_, end_radius_);
    }

  private:
    /// Distance from the axis and place along the axis, m.
    dealii::Point<2>
    in_profile(const dealii::Point<3> &x) const;

    dealii::Point<3>     from_, to_;
    dealii::Tensor<1, 3> along_; ///< unit vector
    double               radius_, end_radius_;
    /// Section through the axis; of solids on both sides of the axis.
    Polygon profile_;
  };
} // namespace talus

#endif

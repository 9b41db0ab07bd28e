// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_shape_h
#define talus_geometry_shape_h

#include <talus/base/box.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <string>

namespace talus
{
  /// Region of space that a body fills at the start.
  template <int dim>
  class Shape
  {
  public:
    virtual ~Shape() = default;

    virtual bool
    contains(const dealii::Point<dim> &x) const = 0;

    /// Smallest axis-aligned box around the shape.
    virtual Box<dim>
    bounding_box() const = 0;
  };



  template <int dim>
  class BoxRegion : public Shape<dim>
  {
  public:
    explicit BoxRegion(const Box<dim> &box)
      : box_(box)
    {}

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



  /// Disc in 2-D, sphere in 3-D, or what is left of it around a hollow.
  template <int dim>
  class Ball : public Shape<dim>
  {
  public:
    Ball(const dealii::Point<dim> &centre,
         const double              radius,
         const double              inner_radius)
      : centre_(centre)
      , radius_(radius)
      , inner_radius_(inner_radius)
    {}

    bool
    contains(const dealii::Point<dim> &x) const override
    {
      const double distance = x.distance(centre_);
      return distance <= radius_ && distance >= inner_radius_;
    }

    Box<dim>
    bounding_box() const override
    {
      Box<dim> box{centre_, centre_};
      for (unsigned int d = 0; d < dim; ++d)
        {
          box.lower[d] -= radius_;
          box.upper[d] += radius_;
        }
      return box;
    }

  private:
    dealii::Point<dim> centre_;
    double             radius_, inner_radius_;
  };



  /// Polygon in the x-y plane; in 3-D a prism over it from z_lower to z_upper.
  template <int dim>
  class Polygon : public Shape<dim>
  {
  public:
    /// @p vertices are listed in either sense, the last one need not repeat the
    /// first. Throws ExcUser, starting with @p name, if the polygon intersects
    /// itself or has no area.
    Polygon(const std::string                        &name,
            const std::vector<std::array<double, 2>> &vertices,
            const double                              z_lower,
            const double                              z_upper);

    bool
    contains(const dealii::Point<dim> &x) const override;

    Box<dim>
    bounding_box() const override;

  private:
    using BoostPoint = boost::geometry::model::d2::point_xy<double>;
    boost::geometry::model::polygon<BoostPoint> polygon_;
    double                                      z_lower_, z_upper_;
  };
} // namespace talus

#endif

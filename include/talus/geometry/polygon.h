// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_polygon_h
#define talus_geometry_polygon_h

#include <talus/geometry/shape.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <string>
#include <vector>

namespace talus
{
  /// A line of straight edges: the one place where the distance to it is
  /// computed.
  class EdgeLine
  {
  public:
    /// Where the line is nearest to a place.
    struct Nearest
    {
      /// Distance, m, never negative.
      double distance;
      /// Unit vector from the line to the place; if that lies on the line, the
      /// normal on its left.
      dealii::Tensor<1, 2> direction;
      /// Whether the place lies on the left of the line, seen along it.
      bool on_left;
    };

    /// @p vertices follow each other; those of a closed line end where they
    /// begin. The edges at the ends of an open one are endless.
    EdgeLine(const std::vector<dealii::Point<2>> &vertices, bool is_closed);

    Nearest
    nearest(const dealii::Point<2> &x) const;

  private:
    /// Unit vector to the left of edge @p e.
    dealii::Tensor<1, 2>
    left_of(std::size_t e) const;
    /// Left at vertex @p v: the sum of those of the edges that meet there.
    dealii::Tensor<1, 2>
    left_at(std::size_t v) const;

    std::vector<dealii::Point<2>> vertices_;
    bool                          is_closed_;
  };



  /// Polygon in the x-y plane.
  class Polygon : public Shape<2>
  {
  public:
    /// @p vertices are listed in either sense, the last one need not repeat the
    /// first. Throws ExcUser, starting with @p name, if the polygon intersects
    /// itself or has no area.
    Polygon(const std::string                   &name,
            const std::vector<dealii::Point<2>> &vertices);

    double
    signed_distance(const dealii::Point<2> &x) const override;

    dealii::Tensor<1, 2>
    normal(const dealii::Point<2> &x) const override;

    bool
    contains(const dealii::Point<2> &x) const override;

    Box<2>
    bounding_box() const override;

  private:
    using BoostPoint = boost::geometry::model::d2::point_xy<double>;
    boost::geometry::model::polygon<BoostPoint> polygon_;
    EdgeLine                                    edges_;
  };



  /// Everything on the right of a line of straight edges whose first and last
  /// go on for ever: below a seabed that is listed from left to right.
  class OpenPolygon : public Shape<2>
  {
  public:
    /// Throws ExcUser, starting with @p name, if there are less than two
    /// vertices, two that follow each other coincide, or the line crosses
    /// itself.
    OpenPolygon(const std::string                   &name,
                const std::vector<dealii::Point<2>> &vertices);

    double
    signed_distance(const dealii::Point<2> &x) const override;

    dealii::Tensor<1, 2>
    normal(const dealii::Point<2> &x) const override;

    Box<2>
    bounding_box() const override;

  private:
    EdgeLine edges_;
  };
} // namespace talus

#endif

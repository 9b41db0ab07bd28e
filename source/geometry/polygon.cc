// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/polygon.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;
  namespace bg = boost::geometry;

  EdgeLine::EdgeLine(const std::vector<Point<2>> &vertices,
                     const bool                   is_closed)
    : vertices_(vertices)
    , is_closed_(is_closed)
  {}



  Tensor<1, 2>
  EdgeLine::left_of(const std::size_t e) const
  {
    const Tensor<1, 2> edge = vertices_[e + 1] - vertices_[e];
    return Tensor<1, 2>({-edge[1], edge[0]}) / edge.norm();
  }



  Tensor<1, 2>
  EdgeLine::left_at(const std::size_t v) const
  {
    const std::size_t last = vertices_.size() - 1;
    if (v == 0 || v == last)
      return is_closed_ ? left_of(0) + left_of(last - 1)
                        : left_of(v == 0 ? 0 : last - 1);
    return left_of(v - 1) + left_of(v);
  }



  /// All edges are tested: polygons have few. At a corner neither edge alone
  /// tells the side of the place; the sum of the normals of both edges does
  /// (Baerentzen and Aanaes 2005).
  EdgeLine::Nearest
  EdgeLine::nearest(const Point<2> &x) const
  {
    Nearest result{std::numeric_limits<double>::infinity(), {}, false};
    const std::size_t n_edges = vertices_.size() - 1;
    for (std::size_t e = 0; e < n_edges; ++e)
      {
        const Tensor<1, 2> edge = vertices_[e + 1] - vertices_[e];
        double             t = (x - vertices_[e]) * edge / edge.norm_square();
        if (is_closed_ || e > 0)
          t = std::max(t, 0.);
        if (is_closed_ || e + 1 < n_edges)
          t = std::min(t, 1.);
        const Tensor<1, 2> away =
          x - (t == 1. ? vertices_[e + 1] : vertices_[e] + t * edge);
        const double distance = away.norm();
        if (!(distance < result.distance))
          continue;
        const Tensor<1, 2> left = t == 0.   ? left_at(e)
                                  : t == 1. ? left_at(e + 1)
                                            : left_of(e);
        result.distance         = distance;
        result.on_left          = away * left > 0.;
        // Within round-off of the line the direction would be noise.
        const bool is_on_line = distance <= 1e-12 * edge.norm();
        result.direction      = is_on_line ? left_of(e) : away / distance;
        if (is_on_line && !result.on_left)
          result.direction *= -1.;
      }
    return result;
  }



  namespace
  {
    /// Return the vertices of Boost's polygon, the first repeated at the end.
    template <typename BoostPolygon>
    std::vector<Point<2>>
    ring(const BoostPolygon &polygon)
    {
      std::vector<Point<2>> vertices;
      for (const auto &v : polygon.outer())
        if (const Point<2> vertex(v.x(), v.y());
            vertices.empty() || vertex != vertices.back())
          vertices.push_back(vertex);
      return vertices;
    }



    /// Close @p vertices and bring them into Boost's sense of rotation, for the
    /// convenience of the user. A polygon that crosses itself is refused: the
    /// inside would depend on the convention.
    template <typename BoostPolygon>
    BoostPolygon
    valid_polygon(const std::string           &name,
                  const std::vector<Point<2>> &vertices)
    {
      // Boost, because it also gives the reason why a polygon is not valid.
      BoostPolygon polygon;
      for (const auto &v : vertices)
        bg::append(polygon.outer(),
                   typename BoostPolygon::point_type(v[0], v[1]));
      bg::correct(polygon);
      std::string reason;
      AssertThrow(bg::is_valid(polygon, reason),
                  ExcUser(text(name,
                               " do not form a simple polygon: ",
                               reason,
                               ". List the corners in order around the body, "
                               "without crossing edges.")));
      return polygon;
    }
  } // namespace



  Polygon::Polygon(const std::string           &name,
                   const std::vector<Point<2>> &vertices)
    : polygon_(valid_polygon<decltype(polygon_)>(name, vertices))
    , edges_(ring(polygon_), true)
  {}



  double
  Polygon::signed_distance(const Point<2> &x) const
  {
    const double distance = edges_.nearest(x).distance;
    return contains(x) ? -distance : distance;
  }



  /// Boost lists the corners clockwise: the left of an edge is outside.
  Tensor<1, 2>
  Polygon::normal(const Point<2> &x) const
  {
    const EdgeLine::Nearest nearest = edges_.nearest(x);
    return nearest.on_left ? nearest.direction : -nearest.direction;
  }



  /// The edge belongs to the polygon, like the faces of a box to the box. A
  /// place that is NaN is not contained.
  bool
  Polygon::contains(const Point<2> &x) const
  {
    return bg::covered_by(BoostPoint(x[0], x[1]), polygon_);
  }



  /// Points are searched only within the box.
  Box<2>
  Polygon::bounding_box() const
  {
    const auto envelope =
      bg::return_envelope<bg::model::box<BoostPoint>>(polygon_);
    return {Point<2>(envelope.min_corner().x(), envelope.min_corner().y()),
            Point<2>(envelope.max_corner().x(), envelope.max_corner().y())};
  }



  namespace
  {
    /// Check that the line divides the plane in two. The endless ends are
    /// followed for a million times the size of the line.
    void
    check_open(const std::string &name, const std::vector<Point<2>> &vertices)
    {
      AssertThrow(vertices.size() >= 2,
                  ExcUser(text(name,
                               " are ",
                               vertices.size(),
                               ", but an open polygon needs at least two.")));
      double size = 0.;
      for (std::size_t v = 0; v + 1 < vertices.size(); ++v)
        {
          const double length = vertices[v].distance(vertices[v + 1]);
          AssertThrow(length > 0.,
                      ExcUser(text(name,
                                   " list (",
                                   vertices[v],
                                   ") twice in a row. Remove one.")));
          size += length;
        }
      const auto beyond = [size](const Point<2> &from, const Point<2> &end) {
        return end + 1e6 * size / end.distance(from) * (end - from);
      };
      using BoostPoint = bg::model::d2::point_xy<double>;
      bg::model::linestring<BoostPoint> line;
      const auto                        append = [&line](const Point<2> &x) {
        line.emplace_back(x[0], x[1]);
      };
      append(beyond(vertices[1], vertices[0]));
      for (std::size_t v = 1; v + 1 < vertices.size(); ++v)
        append(vertices[v]);
      append(beyond(vertices[vertices.size() - 2], vertices.back()));
      AssertThrow(
        bg::is_simple(line),
        ExcUser(text(name,
                     " form a line that crosses itself, possibly beyond the "
                     "ends: the first and last edges of an open polygon are "
                     "endless. List the vertices in order along the surface, "
                     "with the solid on the right.")));
    }



    const std::vector<Point<2>> &
    valid_line(const std::string &name, const std::vector<Point<2>> &vertices)
    {
      check_open(name, vertices);
      return vertices;
    }
  } // namespace



  OpenPolygon::OpenPolygon(const std::string           &name,
                           const std::vector<Point<2>> &vertices)
    : edges_(valid_line(name, vertices), false)
  {}



  double
  OpenPolygon::signed_distance(const Point<2> &x) const
  {
    const EdgeLine::Nearest nearest = edges_.nearest(x);
    return nearest.on_left ? nearest.distance : -nearest.distance;
  }



  Tensor<1, 2>
  OpenPolygon::normal(const Point<2> &x) const
  {
    const EdgeLine::Nearest nearest = edges_.nearest(x);
    return nearest.on_left ? nearest.direction : -nearest.direction;
  }



  /// Not a tight box, but valid for all slopes of the endless edges.
  Box<2>
  OpenPolygon::bounding_box() const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Point<2>(-infinity, -infinity), Point<2>(infinity, infinity)};
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/polygon.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;
  namespace bg = boost::geometry;

  namespace
  {
    using BoostPoint   = bg::model::d2::point_xy<double>;
    using BoostPolygon = bg::model::polygon<BoostPoint>;

    // All edges of a run of this length or less are tested.
    constexpr std::size_t short_run = 8;
  } // namespace



  EdgeLine::EdgeLine(const std::vector<Point<2>> &vertices,
                     const bool                   is_closed)
    : vertices_(vertices)
    , is_closed_(is_closed)
  {
    double size = 1.;
    for (const Point<2> &vertex : vertices_)
      size = std::max({size, std::abs(vertex[0]), std::abs(vertex[1])});
    round_off_ = 1e-12 * size;
    enclose({1, 0, n_edges()});
  }



  /// Set the boxes of @p run and of the halves of the run.
  void
  EdgeLine::enclose(const Run &run)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool       is_endless =
      !is_closed_ && (run.begin == 0 || run.end == n_edges());
    Box<2> box{vertices_[run.begin], vertices_[run.begin]};
    for (std::size_t v = run.begin; v <= run.end; ++v)
      for (unsigned int d = 0; d < 2; ++d)
        {
          box.lower[d] =
            is_endless ? -infinity : std::min(box.lower[d], vertices_[v][d]);
          box.upper[d] =
            is_endless ? infinity : std::max(box.upper[d], vertices_[v][d]);
        }
    boxes_.resize(std::max(boxes_.size(), run.k + 1));
    boxes_[run.k] = box;
    if (run.end - run.begin <= short_run)
      return;
    const std::size_t middle = (run.begin + run.end) / 2;
    enclose({2 * run.k, run.begin, middle});
    enclose({2 * run.k + 1, middle, run.end});
  }



  /// Call @p use for the edges of @p run, except for runs whose @p bound of the
  /// box exceeds @p limit, m, which @p use may lower. The half with the lower
  /// bound comes first.
  template <typename Bound, typename Use>
  void
  EdgeLine::visit(const Run    &run,
                  const Bound  &bound,
                  const double &limit,
                  const Use    &use) const
  {
    if (run.end - run.begin <= short_run)
      {
        for (std::size_t e = run.begin; e < run.end; ++e)
          use(e);
        return;
      }
    const std::size_t      k = 2 * run.k, middle = (run.begin + run.end) / 2;
    std::pair<double, Run> first{bound(boxes_[k]), {k, run.begin, middle}};
    std::pair<double, Run> last{bound(boxes_[k + 1]), {k + 1, middle, run.end}};
    if (last.first < first.first)
      std::swap(first, last);
    if (!(first.first > limit))
      visit(first.second, bound, limit, use);
    if (!(last.first > limit))
      visit(last.second, bound, limit, use);
  }



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



  EdgeLine::Foot
  EdgeLine::foot(const std::size_t e, const Point<2> &x) const
  {
    const Tensor<1, 2> edge = vertices_[e + 1] - vertices_[e];
    double             t    = (x - vertices_[e]) * edge / edge.norm_square();
    if (is_closed_ || e > 0)
      t = std::max(t, 0.);
    if (is_closed_ || e + 1 < n_edges())
      t = std::min(t, 1.);
    return {t, x - (t == 1. ? vertices_[e + 1] : vertices_[e] + t * edge)};
  }



  namespace
  {
    /// Return the distance of @p x from the range of @p box along axis @p d, m.
    double
    distance_along(const unsigned int d, const Point<2> &x, const Box<2> &box)
    {
      return std::max({box.lower[d] - x[d], x[d] - box.upper[d], 0.});
    }
  } // namespace



  /// Among equally near edges the first counts. At a corner neither edge alone
  /// tells the side of the place; the sum of the normals of both edges does
  /// (Baerentzen and Aanaes 2005).
  EdgeLine::Nearest
  EdgeLine::nearest(const Point<2> &x) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double           distance = infinity, limit = infinity;
    std::size_t      e = n_edges();
    visit(
      {1, 0, n_edges()},
      [&x](const Box<2> &box) {
        return Point<2>(distance_along(0, x, box), distance_along(1, x, box))
          .norm();
      },
      limit,
      [&](const std::size_t other) {
        const double to_other = foot(other, x).away.norm();
        if (!(to_other < distance || (to_other == distance && other < e)))
          return;
        distance = to_other;
        limit    = distance * (1. + 1e-12) + round_off_;
        e        = other;
      });
    if (e == n_edges()) // x is NaN
      return {infinity, {}, false};
    const Foot         nearest = foot(e, x);
    const Tensor<1, 2> left    = nearest.t == 0.   ? left_at(e)
                                 : nearest.t == 1. ? left_at(e + 1)
                                                   : left_of(e);
    const bool         on_left = nearest.away * left > 0.;
    // Within round-off of the line the direction would be noise.
    if (distance > 1e-12 * vertices_[e].distance(vertices_[e + 1]))
      return {distance, nearest.away / distance, on_left};
    return {distance, on_left ? left_of(e) : -left_of(e), on_left};
  }



  /// Only edges above or below the place, along the second axis, count in the
  /// rule of Boost.
  bool
  EdgeLine::encloses(const Point<2> &x) const
  {
    using Rule = bg::strategy::within::cartesian_winding<>;
    Rule::state_type state;
    visit(
      {1, 0, n_edges()},
      [&x](const Box<2> &box) { return distance_along(0, x, box); },
      round_off_,
      [&](const std::size_t e) {
        const auto place = [](const Point<2> &p) {
          return BoostPoint(p[0], p[1]);
        };
        Rule::apply(place(x),
                    place(vertices_[e]),
                    place(vertices_[e + 1]),
                    state);
      });
    return Rule::result(state) >= 0;
  }



  namespace
  {
    /// Return the vertices of Boost's polygon, the first repeated at the end.
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
    BoostPolygon
    valid_polygon(const std::string           &name,
                  const std::vector<Point<2>> &vertices)
    {
      // Boost, because it also gives the reason why a polygon is not valid.
      BoostPolygon polygon;
      for (const auto &v : vertices)
        bg::append(polygon.outer(), BoostPoint(v[0], v[1]));
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
    : edges_(ring(valid_polygon(name, vertices)), true)
  {}



  double
  Polygon::signed_distance(const Point<2> &x) const
  {
    return distance_and_normal(x).first;
  }



  Tensor<1, 2>
  Polygon::normal(const Point<2> &x) const
  {
    return distance_and_normal(x).second;
  }



  /// Boost lists the corners clockwise: the left of an edge is outside.
  std::pair<double, Tensor<1, 2>>
  Polygon::distance_and_normal(const Point<2> &x) const
  {
    const EdgeLine::Nearest nearest = edges_.nearest(x);
    return {contains(x) ? -nearest.distance : nearest.distance,
            nearest.on_left ? nearest.direction : -nearest.direction};
  }



  /// The edge belongs to the polygon, like the faces of a box to the box. A
  /// place that is NaN is not contained.
  bool
  Polygon::contains(const Point<2> &x) const
  {
    return edges_.encloses(x);
  }



  /// Points are searched only within the box.
  Box<2>
  Polygon::bounding_box() const
  {
    return edges_.bounding_box();
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

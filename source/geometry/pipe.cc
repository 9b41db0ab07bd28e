// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/pipe.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    Point<3>
    nearest_on_segment(const Point<3> &x, const Point<3> &a, const Point<3> &b)
    {
      const Tensor<1, 3> ab = b - a;
      return a + std::clamp((x - a) * ab / ab.norm_square(), 0., 1.) * ab;
    }



    double
    square_of_distance(const Point<3> &x, const BoundingBox<3> &box)
    {
      const auto &[lower, upper] = box.get_boundary_points();
      double sum                 = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        sum += std::pow(std::max({lower[d] - x[d], x[d] - upper[d], 0.}), 2);
      return sum;
    }
  } // namespace



  Pipe::Pipe(std::vector<Point<3>> axis, const double radius)
    : axis_(std::move(axis))
    , radius_(radius)
  {
    TalusAssert(axis_.size() >= 2, ExcMessage("A pipe needs two corners."));
    std::vector<std::pair<BoundingBox<3>, unsigned int>> boxes;
    for (unsigned int i = 0; i + 1 < axis_.size(); ++i)
      {
        Point<3> lower, upper;
        for (unsigned int d = 0; d < 3; ++d)
          std::tie(lower[d], upper[d]) =
            std::minmax(axis_[i][d], axis_[i + 1][d]);
        boxes.emplace_back(BoundingBox<3>({lower, upper}), i);
      }
    segments_ = pack_rtree(boxes);
    box_      = talus::bounding_box(axis_);
    for (unsigned int d = 0; d < 3; ++d)
      {
        box_.lower[d] -= radius_;
        box_.upper[d] += radius_;
      }
  }



  /// Boxes of segments come in the order of distance: the search ends at the
  /// first box farther than the nearest segment so far.
  Pipe::Nearest
  Pipe::nearest_on_axis(const Point<3> &x) const
  {
    Nearest result{axis_[0], 0};
    double  least = std::numeric_limits<double>::max();
    for (auto entry = segments_.qbegin(
           boost::geometry::index::nearest(x, segments_.size()));
         entry != segments_.qend();
         ++entry)
      {
        const auto &[box, i] = *entry;
        if (square_of_distance(x, box) > least)
          break;
        const Point<3> place  = nearest_on_segment(x, axis_[i], axis_[i + 1]);
        const double   square = place.distance_square(x);
        // Among segments at equal distance the first wins, independently of the
        // order.
        if (square < least || (square == least && i < result.segment))
          {
            least  = square;
            result = {place, i};
          }
      }
    return result;
  }



  double
  Pipe::signed_distance(const Point<3> &x) const
  {
    return distance_and_normal(x).first;
  }



  Tensor<1, 3>
  Pipe::normal(const Point<3> &x) const
  {
    return distance_and_normal(x).second;
  }



  /// On the axis any direction across the axis is valid.
  std::pair<double, Tensor<1, 3>>
  Pipe::distance_and_normal(const Point<3> &x) const
  {
    const auto [place, i]       = nearest_on_axis(x);
    const Tensor<1, 3> outwards = x - place;
    const double       distance = outwards.norm();
    return {distance - radius_,
            distance > 0. ? outwards / distance
                          : perpendicular(axis_[i + 1] - axis_[i])};
  }
} // namespace talus

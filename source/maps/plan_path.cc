// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/plan_path.h>

#include <talus/base/assertion.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  PlanPath::PlanPath(const std::vector<Point<2>> &corners)
  {
    double chainage = 0;
    for (unsigned int i = 0; i + 1 < corners.size(); ++i)
      {
        const double length = corners[i].distance(corners[i + 1]);
        TalusAssert(length > 0., ExcMessage("Two corners of a path coincide."));
        segments_.push_back({corners[i],
                             (corners[i + 1] - corners[i]) / length,
                             length,
                             chainage});
        chainage += length;
      }
    TalusAssert(!segments_.empty(), ExcMessage("A path needs two corners."));
  }



  double
  PlanPath::chainage(const Point<2> &x) const
  {
    double result = 0, min_distance = std::numeric_limits<double>::max();
    for (const Segment &segment : segments_)
      {
        double along = (x - segment.start) * segment.direction;
        if (&segment != &segments_.front())
          along = std::max(along, 0.);
        if (&segment != &segments_.back())
          along = std::min(along, segment.length);
        const double distance =
          x.distance(segment.start + along * segment.direction);
        if (distance < min_distance)
          {
            min_distance = distance;
            result       = segment.chainage + along;
          }
      }
    return result;
  }
} // namespace talus

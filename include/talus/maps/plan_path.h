// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_plan_path_h
#define talus_maps_plan_path_h

#include <deal.II/base/point.h>

#include <vector>

namespace talus
{
  /// Polyline in plan for measuring distances along the path. The first and the
  /// last segment extend straight beyond the ends.
  class PlanPath
  {
  public:
    /// @p corners in plan, m; at least two, and consecutive corners must
    /// differ.
    explicit PlanPath(const std::vector<dealii::Point<2>> &corners);

    /// Distance along the path, m, from the first corner to the point of the
    /// path nearest to @p x; negative before the first corner.
    double
    chainage(const dealii::Point<2> &x) const;

  private:
    struct Segment
    {
      dealii::Point<2>     start;
      dealii::Tensor<1, 2> direction; ///< unit vector
      double               length;    ///< m
      double               chainage;  ///< at the start, m
    };

    std::vector<Segment> segments_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_plan_path_h
#define talus_maps_plan_path_h

#include <deal.II/base/point.h>

#include <vector>

namespace talus
{
  /// A polyline in plan, along which distances are measured. The first and the
  /// last segment go on straight beyond the ends.
  class PlanPath
  {
  public:
    /// @p corners in plan, m; two at least, and neighbours differ.
    explicit PlanPath(const std::vector<dealii::Point<2>> &corners);

    /// Distance along the path, m, from the first corner to the place on the
    /// path that is nearest to @p x: negative in front of the first corner.
    double
    chainage(const dealii::Point<2> &x) const;

  private:
    struct Segment
    {
      dealii::Point<2>     start;
      dealii::Tensor<1, 2> direction; ///< of length 1
      double               length;    ///< m
      double               chainage;  ///< of the start, m
    };

    std::vector<Segment> segments_;
  };
} // namespace talus

#endif

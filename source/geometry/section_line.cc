// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/section_line.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  /// A corner on the other line belongs to only one segment: no crossing is
  /// lost or found twice.
  std::vector<SectionCrossing>
  find_crossings(const std::vector<Point<2>> &section,
                 const std::vector<Point<2>> &route)
  {
    std::vector<SectionCrossing> result;
    for (std::size_t r = 1; r < route.size(); ++r)
      {
        const Tensor<1, 2> segment = route[r] - route[r - 1];
        double             before  = 0.; // length of the legs before this one
        for (std::size_t s = 1; s < section.size(); ++s)
          {
            const Tensor<1, 2> leg    = section[s] - section[s - 1];
            const double       length = leg.norm();
            const Tensor<1, 2> along  = leg / length;
            const auto         beside = [&](const Point<2> &x) {
              return cross_product_2d(along) * (x - section[s - 1]);
            };
            const double from = beside(route[r - 1]), to = beside(route[r]);
            if ((from < 0.) != (to < 0.))
              {
                const Point<2> place =
                  route[r - 1] + from / (from - to) * segment;
                const double x      = along * (place - section[s - 1]);
                const bool is_first = s == 1, is_last = s + 1 == section.size();
                if ((is_first || x >= 0.) && (is_last || x < length))
                  result.push_back(
                    {before + x, std::abs(from - to) / segment.norm()});
              }
            before += length;
          }
      }
    return result;
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/terrain/smooth_raster.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  namespace
  {
    /// Smooth the @p n values from @p first on, @p stride apart, over @p reach
    /// values on each side, with sums up to each value and the numbers of
    /// values since the last missing one.
    void
    smooth_line(double           *first,
                const std::size_t stride,
                const std::size_t n,
                const std::size_t reach)
    {
      std::vector<double>      sum(n + 1, 0.);
      std::vector<std::size_t> before(n), behind(n);
      const auto               known = [&](const std::size_t i) {
        return !std::isnan(first[i * stride]);
      };
      for (std::size_t i = 0; i < n; ++i)
        {
          sum[i + 1] = sum[i] + (known(i) ? first[i * stride] : 0.);
          before[i]  = i > 0 && known(i - 1) ? before[i - 1] + 1 : 0;
        }
      for (std::size_t i = n; i-- > 0;)
        behind[i] = i + 1 < n && known(i + 1) ? behind[i + 1] + 1 : 0;
      for (std::size_t i = 0; i < n; ++i)
        if (const auto arm = std::min({reach, before[i], behind[i]});
            known(i) && arm > 0)
          first[i * stride] =
            (sum[i + arm + 1] - sum[i - arm]) / (2. * arm + 1.);
    }
  } // namespace



  void
  smooth(Raster &raster, const double width)
  {
    const std::size_t reach_x =
                        std::lround(std::floor(0.5 * width / raster.dx)),
                      reach_y =
                        std::lround(std::floor(0.5 * width / raster.dy)),
                      columns = raster.n_columns, rows = raster.n_rows;
    double *const values = raster.values.data();
    for (std::size_t r = 0; r < rows && reach_x > 0; ++r)
      smooth_line(values + r * columns, 1, columns, reach_x);
    for (std::size_t c = 0; c < columns && reach_y > 0; ++c)
      smooth_line(values + c, columns, rows, reach_y);
    if (reach_x + reach_y > 0)
      raster.smoothed_over = width;
  }
} // namespace talus

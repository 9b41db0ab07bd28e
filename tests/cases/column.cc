// SPDX-License-Identifier: LGPL-2.1-or-later
#include "column.h"

#include <talus/base/errors.h>
#include <talus/observers/boxes.h>

#include <algorithm>
#include <cmath>

namespace talus::cases
{
  Overrides
  column_of(const unsigned int n)
  {
    const std::string corner = text(column_length / n, ',', column_length);
    return {text("Grid/Cell size=", column_length / n),
            "Grid/Upper corner=" + corner,
            "Bodies/column/Upper corner=" + corner};
  }



  ColumnAtRest
  measure_column(const State<2> &state)
  {
    const Points<2> &points = state.points;
    const double    *Y      = points.data(points.initial_position, 1);
    const double    *stress = points.data(points.stress, stress_index<2>(1, 1));
    std::vector<unsigned int> order(points.size()); // all of one volume
    for (unsigned int p = 0; p < points.size(); ++p)
      order[p] = p;
    std::sort(order.begin(), order.end(), [&](const auto p, const auto q) {
      return Y[p] < Y[q];
    });
    constexpr double l0 = column_length, weight = column_weight;
    ColumnAtRest     result;
    for (const unsigned int p : order)
      {
        result.Y.push_back(Y[p]);
        result.talus.push_back(-1e-3 * stress[p]);
        result.closed_form.push_back(1e-3 * weight * (l0 - Y[p]));
        result.stress_error +=
          std::abs(result.talus.back() - result.closed_form.back()) /
          (1e-3 * weight * l0) / points.size();
      }
    result.height = points.data(points.position, 1)[order.back()] +
                    0.5 * box_lengths(state, order.back())[1];
    return result;
  }



  std::vector<std::pair<std::string, double>>
  column_heights()
  {
    return {{"linear elastic", 12.27105},
            {"neo-Hookean", 16.16959},
            {"Hencky", 24.05965}};
  }
} // namespace talus::cases

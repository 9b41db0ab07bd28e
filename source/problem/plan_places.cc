// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/problem/plan_places.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  std::vector<Point<dim>>
  plan_places(const Box<dim> &domain, const double distance)
  {
    std::vector<Point<dim>> places = {domain.lower};
    for (unsigned int d = 0; d < dim; d += 2)
      {
        std::vector<Point<dim>> row;
        const unsigned int      n =
          std::max(1., std::round(domain.length(d) / distance));
        for (const Point<dim> &first : places)
          for (unsigned int i = 0; i < n; ++i)
            {
              Point<dim> x = first;
              x[d] += (i + 0.5) * domain.length(d) / n;
              row.push_back(x);
            }
        places = row;
      }
    return places;
  }



  template decltype(plan_places<2>) plan_places<2>;
  template decltype(plan_places<3>) plan_places<3>;
} // namespace talus

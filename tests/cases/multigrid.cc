// SPDX-License-Identifier: LGPL-2.1-or-later
// Linear systems of elastic soil by CG with multigrid: the number of iterations
// hardly depends on the cells. tests/benchmark/multigrid.py measures the time.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace talus;
using namespace talus::cases;

namespace
{
  template <int dim>
  void
  hold(const std::string &file, const std::vector<double> &cell_sizes)
  {
    Verification gates(text("Multigrid, elastic soil in ", dim, "-D"),
                       "tests/cases/" + file +
                         ".prm Grid/Cell size, "
                         "Materials/elastic/Poisson's "
                         "ratio",
                       "multigrid: iterations hardly depend on the cells");
    for (const double nu : {0.3, 0.49})
      {
        std::string list;
        double      last = 0, growth = 0;
        for (const double h : cell_sizes)
          {
            const StaticCase<dim> found(
              file + ".prm",
              text(file, '-', nu, '-', h),
              {text("Grid/Cell size=", h),
               text("Materials/elastic/Poisson's ratio=", nu)});
            const auto  &all   = found.newton()["linear iterations"];
            const double count = *std::max_element(all.begin(), all.end());
            list += text(list.empty() ? "" : ", ", count);
            growth = (last == 0. ? 0. : std::max(growth, count / last - 1.));
            last   = count;
          }
        const std::string name =
          text("largest growth per halving, nu = ", nu, "; iterations ", list);
        if (dim == 3 && nu > 0.4)
          gates.falls_short(name,
                            growth,
                            0.3,
                            {0.4,
                             "from the coarsest mesh to the next; the next two "
                             "halvings stay below"});
        else
          gates.at_most(name, growth, 0.3);
      }
  }
} // namespace



TEST(Multigrid, TwoDimensions)
{
  hold<2>("multigrid", {0.625, 0.3125, 0.15625, 0.078125, 0.0390625});
}



TEST(Multigrid, ThreeDimensions)
{
  hold<3>("multigrid-3d", {0.25, 0.125, 0.0625});
}

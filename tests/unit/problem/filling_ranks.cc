// SPDX-License-Identifier: LGPL-2.1-or-later
// Clipped points are the same on any number of ranks, on meshes of any kind.
#include <talus/geometry/analytic_shapes.h>
#include <talus/problem/filling.h>

#include "ranks_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(FillingOnRanks, 2, 3);

namespace
{
  /// Place and lengths of all points of all ranks, sorted.
  template <int dim>
  std::vector<std::vector<double>>
  all_points(const Core<dim> &core, const unsigned int n_per_axis)
  {
    Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = 1.1 + 0.3 * d;
    const BoxRegion<dim> mesh(core.grid.domain());
    const Ball<dim>      ball(centre, 1.7, 0.6);
    Tensor<1, dim>       up = Point<dim>::unit_vector(1);
    up[0]                   = 0.1;
    const HalfSpace<dim> bed(Point<dim>(), up);
    Region<dim>          region(ball);
    region.restrict_to(mesh);
    region.cut_away({&bed});
    std::array<unsigned int, dim> n;
    n.fill(n_per_axis);
    std::vector<std::vector<double>> own, all;
    for (const auto &point :
         clipped_filling<dim>(core.grid, region, core.grid.domain(), n))
      {
        own.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          {
            own.back().push_back(point.x[d]);
            own.back().push_back(point.length[d]);
          }
      }
    for (const auto &part : MPI::all_gather(core.grid.communicator(), own))
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
  }



  /// To the bit.
  template <int dim>
  void
  expect_same_points(const unsigned int n_per_axis)
  {
    on_all_meshes<dim>(
      "",
      [&](Core<dim> &alone) { return all_points(alone, n_per_axis); },
      [&](Core<dim> &core, const std::vector<std::vector<double>> &alone) {
        EXPECT_GT(alone.size(), 5u);
        EXPECT_EQ(all_points(core, n_per_axis), alone);
      });
  }



  TEST(FillingOnRanks, PointsAreTheSame)
  {
    expect_same_points<2>(1);
    expect_same_points<2>(2);
    expect_same_points<3>(1);
  }
} // namespace

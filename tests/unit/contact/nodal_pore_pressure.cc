// SPDX-License-Identifier: LGPL-2.1-or-later
// Excess pore pressure of the soil at places of contact.

#include <talus/contact/nodal_pore_pressure.h>
#include <talus/grid/node_places.h>
#include <talus/points/points_kernel.h>

#include "ranks_setup.h"
#include "suites.h"

namespace nodal_pore_pressure_test
{
  TALUS_ALSO_ON_RANKS(NodalPorePressure, 2, 3);

  /// Number of a node that does not depend on the ranks.
  template <int dim>
  using Place = std::array<long, dim>;

  template <int dim>
  Place<dim>
  number_at(const Point<dim> &x)
  {
    Place<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = std::lround(64. * x[d]);
    return place;
  }



  /// A cloud of points whose pressure is linear along an oblique normal.
  template <int dim>
  struct Cloud
  {
    /// Volume V, V s and V s^2 with s = x.n, by place of the node.
    using Sums = std::map<Place<dim>, std::array<double, 3>>;

    static Tensor<1, dim>
    normal()
    {
      Tensor<1, dim> result;
      result[0] = -0.6;
      result[1] = 0.8;
      return result;
    }

    static double
    pressure(const Point<dim> &x)
    {
      return 5000. + 300. * (Tensor<1, dim>(x) * normal());
    }

    static void
    add_points(Core<dim> &core)
    {
      core.points.add_pore_pressure();
      core.constants.box_shape = core.transfer.box_shape();
      add_shared(core, dim == 2 ? 100 : 300, 1, [&]() { return core.place(); });
      core.sort();
      core.scatter();
      auto &points = core.points;
      for (unsigned int p = 0; p < points.size(); ++p)
        points.data(points.pore_pressure())[p] =
          pressure(load_place(points, points.position, p));
    }

    /// Sums over all points, one by one.
    static Sums
    search(Core<dim> &core)
    {
      add_points(core);
      const auto                   places = places_of_owned_nodes(core.grid);
      std::vector<NodeWeight<dim>> weights;
      Sums                         sums;
      for (const Segment &segment : core.points.segments())
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            weights_of_point(core.points,
                             core.grid,
                             core.constants.box_shape,
                             segment.cell,
                             p,
                             weights);
            const double s =
              Tensor<1, dim>(core.get(core.points.position, p)) * normal();
            const double V = volume_of_points<dim, double>(core.points, p);
            for (const NodeWeight<dim> &weight : weights)
              {
                auto &sum = sums[number_at<dim>(places[weight.node])];
                sum[0] += V * weight.value;
                sum[1] += V * weight.value * s;
                sum[2] += V * weight.value * s * s;
              }
          }
      return sums;
    }

    /// Standard deviation of s, m: points beside one another have no slope.
    static double
    spread(const std::array<double, 3> &sum)
    {
      const double mean = sum[1] / sum[0];
      return std::sqrt(std::max(0., sum[2] / sum[0] - mean * mean));
    }

    static void
    compare(Core<dim> &core, const Sums &sums)
    {
      add_points(core);
      NodalPorePressure<dim> field;
      field.prepare(core.grid);
      field.find(core, std::vector<unsigned char>(core.grid.n_nodes(), 1));
      const auto   places     = places_of_owned_nodes(core.grid);
      unsigned int n_compared = 0;
      for (unsigned int node = 0; node < core.grid.n_owned_nodes(); ++node)
        if (const auto at = sums.find(number_at<dim>(places[node]));
            at != sums.end() &&
            spread(at->second) > 0.05 * core.grid.cell_size())
          {
            ++n_compared;
            const double one = 1.;
            EXPECT_NEAR(
              field.at(
                &node, &one, 1, places[node], normal(), core.grid.cell_size()),
              pressure(places[node]),
              1e-6)
              << places[node];
          }
      EXPECT_GT(MPI::sum(n_compared, core.grid.communicator()), 10u);
    }
  };
} // namespace nodal_pore_pressure_test



TEST(NodalPorePressure, LinearFieldIsExact)
{
  using namespace nodal_pore_pressure_test;
  on_all_meshes<2>("", Cloud<2>::search, Cloud<2>::compare);
  on_all_meshes<3>("", Cloud<3>::search, Cloud<3>::compare);
}

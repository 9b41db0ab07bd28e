// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/shape_function_cache.h>

#include <set>

#include "equilibrium_setup.h"
#include "transfer_setup.h"
#include "weights_setup.h"

namespace
{
  /// Weights by node, those of hanging nodes passed on to their masters.
  template <int dim>
  Weights<dim>
  expected_weights(const Core<dim>     &core,
                   const unsigned int   c,
                   const unsigned int   p,
                   const Unknowns<dim> &unknowns)
  {
    std::vector<NodeWeight<dim>> list;
    weights_of_point(
      core.points, core.grid, core.transfer.box_shape(), c, p, list);
    Weights<dim> weights;
    const auto   add = [&](const unsigned int     node,
                         const double           share,
                         const NodeWeight<dim> &weight) {
      if (!unknowns.is_active(node))
        return;
      weights[node].value += share * weight.value;
      weights[node].gradient += share * weight.gradient;
    };
    for (const auto &weight : list)
      {
        bool hangs = false;
        for (const HangingNode &hanging : core.grid.hanging_nodes())
          if (hanging.node == weight.node)
            {
              hangs = true;
              for (const auto &[master, share] : hanging.masters)
                add(master, share, weight);
            }
        if (!hangs)
          add(weight.node, 1., weight);
      }
    return weights;
  }



  template <int dim>
  void
  expect_weights(Core<dim> &core)
  {
    core.scatter();
    Unknowns<dim> unknowns;
    unknowns.number(core.nodes, core.grid, 0.);
    ShapeFunctionCache<dim> kept;
    kept.compute(core.points, core.grid, core.transfer.box_shape(), unknowns);
    const auto             places = places_of_nodes(core.grid);
    std::set<unsigned int> hanging;
    for (const HangingNode &node : core.grid.hanging_nodes())
      hanging.insert(node.node);

    unsigned int n_inside = 0;
    unsigned int n_points = 0;
    for (unsigned int c = 0; c < kept.cells().size(); ++c)
      {
        const Batch       &cell  = kept.cells()[c];
        const auto         patch = kept.patch(c);
        const unsigned int at    = core.points.cell_of(cell.begin);
        n_points += cell.end - cell.begin;
        EXPECT_EQ(std::set<unsigned int>(patch.nodes,
                                         patch.nodes + patch.n_nodes)
                    .size(),
                  patch.n_nodes);
        for (unsigned int p = cell.begin; p < cell.end; ++p)
          {
            Weights<dim>   found;
            double         one = 0.;
            Tensor<1, dim> x;
            Tensor<2, dim> slope;
            for (unsigned int a = 0; a < patch.n_nodes; ++a)
              {
                const unsigned int node = patch.nodes[a];
                const auto        &w    = kept.of_point(c, p - cell.begin)[a];
                EXPECT_EQ(hanging.count(node), 0u);
                EXPECT_TRUE(unknowns.is_active(node));
                found[node] = {w.value, w.gradient};
                one += w.value;
                x += w.value * places[node];
                slope += outer_product(places[node], w.gradient);
              }
            expect_equal(found, expected_weights(core, at, p, unknowns), 2e-15);
            EXPECT_NEAR(one, 1., 4e-15);
            // Boxes are no longer than a cell: here they are in the mesh.
            const Tensor<1, dim> place  = core.get(core.points.position, p);
            bool                 inside = true;
            for (unsigned int d = 0; d < dim; ++d)
              inside = inside && place[d] > 0.5 && place[d] < 3.5;
            if (!inside)
              continue;
            ++n_inside;
            EXPECT_LT((x - place).norm(), 1e-13);
            for (unsigned int d = 0; d < dim; ++d)
              slope[d][d] -= 1.;
            EXPECT_LT(slope.norm(), 1e-13);
          }
      }
    EXPECT_GT(n_inside, 200u);
    EXPECT_EQ(n_points, core.points.size());
  }
} // namespace



TEST(ShapeFunctionCache, AreThoseOfTheTransfer)
{
  on_both_meshes<2>("", expect_weights<2>);
  on_both_meshes<3>("", expect_weights<3>);
}



// Nodes without unknowns have no weight, and the patch none of them.
TEST(ShapeFunctionCache, NothingForNodesThatCarryNothing)
{
  Core<2> core(cube<2>());
  fill_with_points(core, false);
  core.scatter();
  std::vector<double> masses;
  for (const unsigned int node : core.nodes.active_nodes())
    masses.push_back(core.nodes.mass(node));
  std::sort(masses.begin(), masses.end());
  const double least = masses[masses.size() / 2];

  Unknowns<2> unknowns;
  unknowns.number(core.nodes, core.grid, least);
  EXPECT_EQ(unknowns.active_nodes().size(),
            masses.size() - masses.size() / 2 - 1);
  ShapeFunctionCache<2> kept;
  kept.compute(core.points, core.grid, core.transfer.box_shape(), unknowns);
  for (unsigned int c = 0; c < kept.cells().size(); ++c)
    {
      const auto patch = kept.patch(c);
      for (unsigned int a = 0; a < patch.n_nodes; ++a)
        EXPECT_GT(core.nodes.mass(patch.nodes[a]), least);
    }
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/nodal_fields.h>

#include <algorithm>

#include "core_setup.h"

namespace
{
  using namespace talus;

  /// Nodes of the patches of @p cells in the order of their first occurrence.
  template <int dim>
  std::vector<unsigned int>
  nodes_of_patches(const Grid<dim>                 &grid,
                   const std::vector<unsigned int> &cells)
  {
    std::vector<unsigned int> result;
    for (const unsigned int c : cells)
      for (const unsigned int node : grid.cells()[c].patch)
        if (std::find(result.begin(), result.end(), node) == result.end())
          result.push_back(node);
    return result;
  }



  /// Activate nodes for random sets of cells, from few cells to all.
  template <int dim>
  void
  expect_order_of_patches(const std::string &mesh_text)
  {
    Core<dim> core(mesh_text, {}, MPI_COMM_SELF);
    for (const unsigned int n : {1, 3, 7, 12, 20})
      {
        std::vector<unsigned int> cells;
        for (unsigned int c = 0; c < core.grid.n_owned_cells(); ++c)
          {
            ASSERT_TRUE(core.grid.cells()[c].uniform);
            if ((c * 7919 + n) % 20 < n)
              cells.push_back(c);
          }
        core.nodes.activate(core.grid, cells);
        EXPECT_EQ(core.nodes.active_nodes(),
                  nodes_of_patches(core.grid, cells));
      }
  }
} // namespace



// A resumed run sums over the nodes in the same order.
TEST(NodalFields, ActiveNodesInTheOrderOfPatches)
{
  expect_order_of_patches<2>(mesh("0, 0", "9, 7"));
  expect_order_of_patches<3>(mesh("0, 0, 0", "6, 5, 4"));
}

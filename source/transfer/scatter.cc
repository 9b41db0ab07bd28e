// SPDX-License-Identifier: LGPL-2.1-or-later
// Points to grid.

#include <talus/transfer/block_walk.h>
#include <talus/transfer/convected_transfer.h>
#include <talus/transfer/reference.h>
#include <talus/transfer/scatter_kernel.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  // A block takes three steps. The contributions of the points (mass, momentum,
  // forces; NodalSum) are computed entry by entry for several points at once,
  // and transposed to rows, one per point. Then they are multiplied by the
  // weights and added to the nodes, group by group, a register of entries at a
  // time. Irregular_points are added last, node by node.
  //
  // Points add to nodes in the order of the points. The sum is sequential: it
  // needs no locks and is bit-identical in every run.
  template <int dim>
  void
  Transfer<dim>::scatter(const StepContext<dim> &context,
                         const Batch            &batch,
                         GroupMemory<dim>       *groups) const
  {
    const Points<dim> &points  = context.points;
    const Grid<dim>   &grid    = context.grid;
    const auto         columns = points.view();
    const auto         work    = context.workspace.view(batch.begin, batch.end);
    double *const      sums    = context.nodes.sum(0);
    Block<dim>         block;
    Contributions<dim> contributions;
    NodeWeights<dim>   room;
    BlockWalk<dim>     walk(points, batch, grid, box_shape_, groups, nullptr);
    while (walk.next(block))
      {
        prefetch_nodes(block, [&](const unsigned int node) {
          return context.nodes.sum(node);
        });
        fill(
          contributions, block, columns, work, context.loads.view(block.body));
        // The first sweep reads no column beyond the elastic energy.
        points.fetch_ahead(block.begin,
                           block.begin + block.size,
                           points.elastic_energy);
        for (unsigned int r = 0; r < block.n_groups; ++r)
          add_group<dim>(contributions, block.groups[r], sums);
        for (unsigned int i = 0; i < block.n_irregular_points; ++i)
          {
            const auto        &irregular_point = block.irregular_points[i];
            const unsigned int p = block.begin + irregular_point.k;
            if (box_shape_.rule == BoxRule::convected_domain)
              add_corners<dim>(contributions,
                               ConvectedDomain<dim>(points,
                                                    grid,
                                                    box_shape_,
                                                    irregular_point.cell,
                                                    p),
                               grid,
                               irregular_point.cell,
                               irregular_point.k,
                               sums);
            else
              scatter_by_definition(
                context,
                box_shape_,
                {irregular_point.cell, block.body, p, p + 1},
                room);
          }
      }
  }



  template void
  Transfer<2>::scatter(const StepContext<2> &,
                       const Batch &,
                       GroupMemory<2> *) const;
  template void
  Transfer<3>::scatter(const StepContext<3> &,
                       const Batch &,
                       GroupMemory<3> *) const;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
// Grid to points.

#include <talus/base/ordered_sum.h>
#include <talus/transfer/block_walk.h>
#include <talus/transfer/convected_transfer.h>
#include <talus/transfer/gather_kernel.h>
#include <talus/transfer/reference.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Compute the row of an irregular point from its weights by definition.
    /// The row has the layout of the kernel, with the gradient per cell size,
    /// so that move_points() treats all points alike.
    template <int dim>
    void
    interpolate_irregular_point(
      const StepContext<dim>                    &context,
      const BoxShape                            &shape,
      const Block<dim>                          &block,
      const typename Block<dim>::IrregularPoint &irregular_point,
      NodeWeights<dim>                          &room,
      InterpolatedMotion<dim>                   &motion)
    {
      const unsigned int cell = irregular_point.cell;
      const unsigned int p    = block.begin + irregular_point.k;
      double *const      row  = motion.row[irregular_point.k];
      if (shape.rule == BoxRule::convected_domain)
        {
          interpolate_corners<dim>(
            ConvectedDomain<dim>(context.points, context.grid, shape, cell, p),
            context.grid,
            cell,
            context.nodes.motion(0),
            row);
          return;
        }
      using Motion = NodalMotion<dim>;
      const auto there =
        interpolate_by_definition(context, shape, cell, p, room);
      for (unsigned int i = 0; i < dim; ++i)
        {
          row[Motion::velocity + i]  = there.velocity[i];
          row[Motion::increment + i] = there.increment[i];
          for (unsigned int d = 0; d < dim; ++d)
            row[InterpolatedMotion<dim>::place_of_gradient(i, d)] =
              there.gradient[i][d] * block.cell_size;
        }
    }



    /// Interpolate the motion of the nodes to all points of the block. Node
    /// addresses are computed once per group. Meanwhile the columns of the next
    /// batch are prefetched: the second sweep reads the common columns up to
    /// the initial position.
    template <int dim>
    void
    interpolate_to_block(const StepContext<dim>  &context,
                         const BoxShape          &shape,
                         const Block<dim>        &block,
                         NodeWeights<dim>        &room,
                         InterpolatedMotion<dim> &motion)
    {
      const double *const motions = context.nodes.motion(0);
      context.points.fetch_ahead(block.begin,
                                 block.begin + block.size,
                                 context.points.initial_position);
      for (unsigned int r = 0; r < block.n_groups; ++r)
        {
          const double *nodes[power(3, dim)];
          find_nodes<dim>(block.groups[r], motions, nodes);
          for_each_bit(block.groups[r].points, [&](const unsigned int k) {
            interpolate<dim>(block.groups[r], k, nodes, motion.row[k]);
          });
        }
      for (unsigned int i = 0; i < block.n_irregular_points; ++i)
        interpolate_irregular_point(
          context, shape, block, block.irregular_points[i], room, motion);
    }



    /// Append the points outside of their cell to @p points_out_of_cell.
    /// Position and cell are in registers already; a separate search would pass
    /// over all points once more. Nearly all points stay in their cell, hence
    /// the branch hint.
    template <typename Mask>
    TALUS_ALWAYS_INLINE void
    note_points_out_of_cell(const Mask                &inside,
                            const unsigned int         p,
                            const unsigned int         n,
                            std::vector<unsigned int> &points_out_of_cell)
    {
      if (__builtin_expect(all(inside), 1))
        return;
      for (unsigned int i = 0; i < n; ++i)
        if (!inside[i])
          points_out_of_cell.push_back(p + i);
    }
  } // namespace



  // Each block is processed in two parts with different layouts. Interpolation
  // groups point by point, with the entries of a node side by side in a
  // register. The update of the points groups entry by entry, with several
  // points side by side. MotionEntries transposes in between, within the
  // first-level cache. Positions move with the velocity of the grid, because
  // the noise in the velocities of the points would let points pass through one
  // another.
  //
  // OrderedSum makes the power independent of the width of the registers.
  template <int dim>
  double
  Transfer<dim>::gather(const StepContext<dim> &context,
                        const Batch            &batch,
                        const double            dt,
                        const VelocityUpdate   &velocity_update,
                        GroupMemory<dim>       *groups) const
  {
    StepWorkspace<dim>     &workspace = context.workspace;
    const auto              columns   = context.points.view();
    const auto              work      = workspace.view(batch.begin, batch.end);
    OrderedSum              power;
    Block<dim>              block;
    InterpolatedMotion<dim> motion;
    NodeWeights<dim>        room;
    BlockWalk<dim>          walk(
      context.points, batch, context.grid, box_shape_, nullptr, groups);
    while (walk.next(block))
      {
        prefetch_nodes(block, [&](const unsigned int node) {
          return context.nodes.motion(node);
        });
        interpolate_to_block(context, box_shape_, block, room, motion);
        const PointUpdate<dim> update = {columns,
                                         work,
                                         context.loads.view(block.body),
                                         velocity_update,
                                         1. / block.cell_size,
                                         dt};
        for_each_simd(
          0,
          block.size,
          [&](const unsigned int k, auto number) TALUS_INLINE_LAMBDA {
            using Number         = decltype(number);
            const unsigned int p = block.begin + k;
            power.add(k,
                      move_points(update,
                                  p,
                                  MotionEntries<dim, Number>(&motion.row[k])));
            Number lower[dim];
            for (unsigned int d = 0; d < dim; ++d)
              lower[d] = load<Number>(&block.cell_lower[d][k]);
            note_points_out_of_cell(
              is_inside<dim, Number>(columns, p, lower, block.cell_size),
              p,
              sizeof(Number) / sizeof(double),
              workspace.points_out_of_cell());
          });
      }
    return dt * power.total();
  }



  template double
  Transfer<2>::gather(const StepContext<2> &,
                      const Batch &,
                      double,
                      const VelocityUpdate &,
                      GroupMemory<2> *) const;
  template double
  Transfer<3>::gather(const StepContext<3> &,
                      const Batch &,
                      double,
                      const VelocityUpdate &,
                      GroupMemory<3> *) const;
} // namespace talus

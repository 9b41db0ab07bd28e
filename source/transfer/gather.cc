// Grid to points.

#include <talus/base/ordered_sum.h>
#include <talus/transfer/gather_kernel.h>
#include <talus/transfer/reference.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// The motion of the nodes, interpolated to all points of the block.
    template <int dim>
    void
    interpolate_to_block(const Block<dim>        &block,
                         const Points<dim>       &points,
                         const double            *motions,
                         InterpolatedMotion<dim> &motion)
    {
      for (unsigned int k = 0; k < block.size; ++k)
        points.fetch_ahead(block.begin + k, points.initial_position);
      for (unsigned int r = 0; r < block.n_runs; ++r)
        {
          const double *nodes[power(3, dim)];
          find_nodes<dim>(block.runs[r], motions, nodes);
          for_each_point(block.runs[r], [&](const unsigned int k) {
            interpolate<dim>(block.runs[r], k, nodes, motion.row[k]);
          });
        }
    }



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



  template <int dim>
  double
  Transfer<dim>::gather(const NodalFields<dim> &nodes,
                        const Grid<dim>        &grid,
                        const Loads<dim>       &loads,
                        Points<dim>            &points,
                        StepWorkspace<dim>     &workspace,
                        const Batch            &batch,
                        const double            dt) const
  {
    const auto              columns = points.view();
    const auto              work    = workspace.view(batch.begin, batch.end);
    OrderedSum              power;
    Block<dim>              block;
    InterpolatedMotion<dim> motion;
    BlockWalk<dim>          walk(points, batch, grid, box_shape_);
    while (walk.next(block))
      {
        prefetch_nodes(block, [&](const unsigned int node) {
          return nodes.motion(node);
        });
        interpolate_to_block(block, points, nodes.motion(0), motion);
        const auto loads_here = loads.view(block.body);
        for_each_simd(
          0,
          block.size,
          [&](const unsigned int k, auto number) TALUS_INLINE_LAMBDA {
            using Number         = decltype(number);
            const unsigned int p = block.begin + k;
            power.add(k,
                      move_points<dim, Number>(columns,
                                               work,
                                               1. / block.cell_size,
                                               p,
                                               MotionEntries<dim, Number>(
                                                 &motion.row[k]),
                                               loads_here,
                                               flip_fraction_,
                                               dt));
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
    double power_elsewhere = 0;
    for (unsigned int s = batch.first_segment; s < batch.last_segment; ++s)
      if (const Segment &segment = points.segments()[s];
          !grid.cells()[segment.cell].uniform)
        power_elsewhere += gather_by_definition(nodes,
                                                grid,
                                                loads,
                                                box_shape_,
                                                segment,
                                                flip_fraction_,
                                                dt,
                                                points,
                                                workspace);
    return dt * (power.total() + power_elsewhere);
  }



  template double
  Transfer<2>::gather(const NodalFields<2> &,
                      const Grid<2> &,
                      const Loads<2> &,
                      Points<2> &,
                      StepWorkspace<2> &,
                      const Batch &,
                      double) const;
  template double
  Transfer<3>::gather(const NodalFields<3> &,
                      const Grid<3> &,
                      const Loads<3> &,
                      Points<3> &,
                      StepWorkspace<3> &,
                      const Batch &,
                      double) const;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_rule_h
#define talus_transfer_box_rule_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/box_shape.h>

namespace talus
{
  /// Set the stretch of the points [begin, end) from their deformation gradient,
  /// after a step of @p dt. With the rule `fixed` the box does not use it, only the
  /// splitter does: it is exp(integral of D_dd dt), positive by construction.
  template <int dim>
  void
  update_stretch(Points<dim>              &points,
                 const StepWorkspace<dim> &workspace,
                 unsigned int              begin,
                 unsigned int              end,
                 BoxRule                   rule,
                 double                    dt);

  /// Set the stretch of the points [begin, end), and that at their creation,
  /// to that of a deformation gradient they start with.
  template <int dim>
  void
  initialize_stretch(Points<dim> &points,
                     unsigned int begin,
                     unsigned int end,
                     BoxRule      rule);

  /// Edge @p d of the box of point @p p, whole and not clipped, m: along axis d,
  /// stretch times reference length; or, of a convected domain, where F takes
  /// that of the undeformed box.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_of_box(const Points<dim> &points,
              BoxRule            rule,
              unsigned int       d,
              unsigned int       p);

  /// Number of axes of boxes that are clipped for the weights.
  template <int dim>
  unsigned long
  count_clipped_boxes(const Points<dim> &points,
                      const Grid<dim>   &grid,
                      const BoxShape    &shape);
} // namespace talus

#endif

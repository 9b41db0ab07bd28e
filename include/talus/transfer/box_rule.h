// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_rule_h
#define talus_transfer_box_rule_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/box_shape.h>

namespace talus
{
  /// Update the stretch of the points [begin, end) after a step. The stretch
  /// follows from the deformation gradient. With the rule `fixed` the weights
  /// ignore the stretch and only the splitter reads it: the stretch then is
  /// exp(integral of D_dd dt), always positive.
  ///
  /// @param points column `stretch` is updated [-]
  /// @param workspace velocity gradients of the step, 1/s; read by `fixed` only
  /// @param rule box rule of the run
  /// @param dt time step, s
  template <int dim>
  void
  update_stretch(Points<dim>              &points,
                 const StepWorkspace<dim> &workspace,
                 unsigned int              begin,
                 unsigned int              end,
                 BoxRule                   rule,
                 double                    dt);

  /// Set the stretch and the stretch at creation [-] of the points [begin, end)
  /// from their initial deformation gradient.
  template <int dim>
  void
  initialize_stretch(Points<dim> &points,
                     unsigned int begin,
                     unsigned int end,
                     BoxRule      rule);

  /// Return edge @p d of the box of point @p p, m, without clipping. A box
  /// parallel to the axes has the edge stretch times reference length along
  /// axis d; a convected domain has the edge F e_d times reference length.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_of_box(const Points<dim> &points,
              BoxRule            rule,
              unsigned int       d,
              unsigned int       p);

  /// Count the pairs of box and axis that are clipped for the weights, on this
  /// rank.
  template <int dim>
  unsigned long
  count_clipped_boxes(const Points<dim> &points,
                      const Grid<dim>   &grid,
                      const BoxShape    &shape);
} // namespace talus

#endif

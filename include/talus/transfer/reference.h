// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_reference_h
#define talus_transfer_reference_h

#include <talus/transfer/box_shape.h>
#include <talus/transfer/step_context.h>
#include <talus/transfer/velocity_update_kernel.h>
#include <talus/transfer/weights.h>

// The transfer as defined in doc/method.md, section 2: point by point and node
// by node, with weights by definition. Read this file first. scatter_kernel.h
// and gather_kernel.h compute the same result for many points at a time; the
// tests compare the kernels with the functions below. Points that reach into
// cells of another size use the functions below, too.

namespace talus
{
  /// Add mass, reference volume, momentum and force of the points of a segment
  /// to their nodes, @cite bardenhagen2004, eq. 19 ff.:
  ///   m_i = sum_p S_ip m_p,  (mv)_i = sum_p S_ip m_p v_p,
  ///   f_i = sum_p S_ip m_p b_p - sum_p V_p sigma'_p . grad S_ip,
  /// where sigma' is the stress with its mean averaged over the cell (B-bar).
  ///
  /// @param context nodes receive the sums; the workspace has the shifts of
  ///   the mean stress by B-bar, Pa
  /// @param room scratch space for the weights of a point
  template <int dim>
  void
  scatter_by_definition(const StepContext<dim> &context,
                        const BoxShape         &shape,
                        const Segment          &segment,
                        NodeWeights<dim>       &room);

  /// Motion of the nodes interpolated to a point.
  template <int dim>
  struct MotionByDefinition
  {
    dealii::Tensor<1, dim> velocity;  ///< sum_i S_ip v_i, m/s
    dealii::Tensor<1, dim> increment; ///< sum_i S_ip dv_i, m/s
    dealii::Tensor<2, dim> gradient;  ///< sum_i v_i (x) grad S_ip, 1/s
  };



  /// Interpolate the motion of the nodes, m/s, to point @p p in cell @p cell.
  /// @p room is scratch space for the weights of the point.
  template <int dim>
  MotionByDefinition<dim>
  interpolate_by_definition(const StepContext<dim> &context,
                            const BoxShape         &shape,
                            unsigned int            cell,
                            unsigned int            p,
                            NodeWeights<dim>       &room);

  /// Move the points of a segment by the motion of the nodes,
  ///   v_p <- update(v_p, sum_i S_ip v_i, sum_i S_ip dv_i),
  ///   x_p <- x_p + dt sum_i S_ip v_i,  L_p = sum_i v_i (x) grad S_ip.
  ///
  /// @param context workspace receives L_p, 1/s, and the points that left the
  ///   cell
  /// @param dt time step, s
  /// @param update update of the velocities
  /// @return power of the loads, sum_p m_p b_p . sum_i S_ip (v_i - dv_i/2), W
  template <int dim>
  double
  gather_by_definition(const StepContext<dim> &context,
                       const BoxShape         &shape,
                       const Segment          &segment,
                       double                  dt,
                       const VelocityUpdate   &update);
} // namespace talus

#endif

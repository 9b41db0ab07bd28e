// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_large_deformation_h
#define talus_transfer_large_deformation_h

#include <talus/points/points.h>
#include <talus/transfer/box_shape.h>

namespace talus
{
  /// Let the deformation gradients F of the points [begin, end) whose norm exceeds
  /// 1000 begin anew: F <- M F, where M is symmetric, has the axes of the left
  /// stretch and the determinant 1, and shortens the longest axis to 500.
  ///
  /// Each step rounds det F with an error of |F|^2 1e-16, so that soil that has
  /// flowed for long would lose the digits of its volume. Volume, boxes and what
  /// the splitter compares stay as they are: reference lengths and stretches at
  /// creation are scaled with F. Only for materials whose stress does not follow
  /// from F.
  template <int dim>
  void
  renew_large_deformations(Points<dim> &points,
                           unsigned int begin,
                           unsigned int end,
                           BoxRule      rule);
} // namespace talus

#endif

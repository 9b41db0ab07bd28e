// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_large_deformation_h
#define talus_transfer_large_deformation_h

#include <talus/points/points.h>
#include <talus/transfer/box_shape.h>

namespace talus
{
  /// Shorten the deformation gradient F of the points [begin, end) where |F|
  /// exceeds 1000: F <- M F, where M is symmetric, has the axes of the left
  /// stretch and determinant 1, and shortens the longest axis to 500.
  ///
  /// Each step rounds det F with an error of |F|^2 1e-16, so soil that flows
  /// for a long time would lose the digits of its volume. Volume, boxes and the
  /// quantities compared by the splitter are unchanged: reference lengths and
  /// stretches at creation are scaled together with F. Only for materials whose
  /// stress is not a function of F.
  template <int dim>
  void
  renew_large_deformations(Points<dim> &points,
                           unsigned int begin,
                           unsigned int end,
                           BoxRule      rule);
} // namespace talus

#endif

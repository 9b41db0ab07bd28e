// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_loads_kernel_h
#define talus_transfer_loads_kernel_h

#include <talus/base/simd.h>
#include <talus/transfer/loads_view.h>

namespace talus
{
  /// Acceleration of point(s) @p p by the loads along axis @p d, m/s^2.
  template <typename Number, int dim>
  TALUS_ALWAYS_INLINE Number
  acceleration(const LoadsView<dim> &loads,
               const unsigned int    p,
               const unsigned int    d)
  {
    const Number weight(loads.weight[d]);
    return loads.of_point[d] == nullptr
             ? weight
             : weight + load<Number>(loads.of_point[d] + p);
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_weights_kernel_h
#define talus_transfer_weights_kernel_h

#include <talus/points/points_kernel.h>
#include <talus/transfer/box_shape.h>

#include <array>

namespace talus
{
  /// Half length of the box of point(s) @p p along axis @p d in cell sizes [-],
  /// clipped to the limits of @p shape.
  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE Number
  half_length_in_cells(const Columns     &points,
                       const BoxShape    &shape,
                       const unsigned int d,
                       const unsigned int p,
                       const Number      &inverse_cell_size)
  {
    const Number half =
      0.5 * load<Number>(points.data(points.box_length, d) + p);
    return clamp(half * inverse_cell_size, shape.min_half, shape.max_half);
  }



  /// Mean over a box of the one-dimensional shape functions of four nodes, and
  /// of their derivatives. The nodes are at -1, 0, 1 and 2 in cell sizes,
  /// measured from the lower face of the cell.
  template <typename Number>
  struct AxisWeights
  {
    std::array<Number, 4> value;
    std::array<Number, 4> gradient; ///< per cell size
    /// Ends of the box relative to the lower face and to the upper face.
    Number lower_end, upper_end;
  };



  /// Compute the weights of the box [centre - half, centre + half], which must
  /// lie in [-1, 2], along one axis. Shape functions are hat functions. Only
  /// the outer two means are integrals; the inner two follow from sum w_i = 1
  /// and sum x_i w_i = centre, since hat functions interpolate 1 and x exactly.
  /// @cite bardenhagen2004, eq. 36 ff.
  template <typename Number>
  TALUS_ALWAYS_INLINE AxisWeights<Number>
                      axis_weights(const Number &centre, const Number &half)
  {
    AxisWeights<Number> w;
    const Number        zero(0.);
    w.lower_end = centre - half;
    w.upper_end = centre + half - 1.;
    // Parts of the box below and above the cell. A box at a wall may lie
    // completely beyond the face.
    const Number below_from = min(w.lower_end, zero);
    const Number below_to   = min(w.upper_end + 1., zero);
    const Number above_from = max(w.lower_end - 1., zero);
    const Number above_to   = max(w.upper_end, zero);
    const Number scale      = 0.5 / half;
    const Number a          = (below_from - below_to) * scale;
    const Number b          = (above_to - above_from) * scale;
    w.value[0]              = (0.5 * a) * (below_from + below_to);
    w.value[3]              = (0.5 * b) * (above_from + above_to);
    w.value[2]              = centre + w.value[0] - 2. * w.value[3];
    w.value[1]              = (1. - centre) + w.value[3] - 2. * w.value[0];
    w.gradient[0]           = a;
    w.gradient[3]           = b;
    w.gradient[2]           = (1. + a) - 2. * b;
    w.gradient[1]           = (b - 1.) - 2. * a;
    return w;
  }
} // namespace talus

#endif

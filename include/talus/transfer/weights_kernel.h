#ifndef talus_transfer_weights_kernel_h
#define talus_transfer_weights_kernel_h

#include <talus/points/points_kernel.h>
#include <talus/transfer/box_shape.h>

#include <array>

namespace talus
{
  /// Half of the length of the box along axis @p d divided by the cell size,
  /// clipped as the weights need it.
  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE Number
  half_length_in_cells(const Columns     &points,
                       const BoxShape    &shape,
                       const unsigned int d,
                       const unsigned int p,
                       const Number      &inverse_cell_size)
  {
    Number half =
      0.5 * load<Number>(points.data(points.reference_length, d) + p);
    if (shape.rule != BoxRule::fixed)
      half *= load<Number>(points.data(points.stretch, d) + p);
    return clamp(half * inverse_cell_size, shape.least_half, shape.most_half);
  }



  /// Mean over a box of the one-dimensional shape functions around a cell and of
  /// their derivatives. A box no longer than a cell touches two cells, so that
  /// three nodes that follow each other have a weight.
  template <typename Number>
  struct AxisWeights
  {
    /// Whether the first of them is the one at -1 in units of the cell, not the
    /// one at 0.
    decltype(Number() < Number()) begins_below;
    std::array<Number, 3>         value;
    std::array<Number, 3>         gradient; ///< per cell size
  };



  /// Weights of the box [centre - half, centre + half] along one axis, in units
  /// of the cell with origin at its lower face. The box must lie in [-1, 2] and
  /// be no longer than one. The shape functions are the hats of the nodes; their
  /// integrals over the two cells are taken one by one. @cite bardenhagen2004,
  /// eq. 36 ff.
  template <typename Number>
  TALUS_ALWAYS_INLINE AxisWeights<Number>
                      axis_weights(const Number &centre, const Number &half)
  {
    const Number zero(0.), one(1.);

    AxisWeights<Number> w;
    w.begins_below = centre < half;
    // The ends of the box, seen from the first node.
    const Number a     = centre - half + select(w.begins_below, one, zero);
    const Number b     = a + 2. * half;
    const Number scale = 0.5 / half;
    // Of the first cell from the ends of the box on; of the second up to them.
    const Number a_left = max(1. - a, zero), b_left = max(1. - b, zero);
    const Number a_right = max(a - 1., zero), b_right = max(b - 1., zero);

    w.value[0] = 0.5 * scale * (a_left * a_left - b_left * b_left);
    w.value[2] = 0.5 * scale * (b_right * b_right - a_right * a_right);
    w.value[1] = 1. - w.value[0] - w.value[2];

    const Number in_first  = scale * (a_left - b_left),
                 in_second = scale * (b_right - a_right);
    w.gradient[0]          = -in_first;
    w.gradient[1]          = in_first - in_second;
    w.gradient[2]          = in_second;
    return w;
  }
} // namespace talus

#endif

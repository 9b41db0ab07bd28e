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



  /// Mean over a box of the one-dimensional shape functions of three nodes that
  /// follow each other, and of their derivatives.
  template <typename Number>
  struct AxisWeights
  {
    std::array<Number, 3> value;
    std::array<Number, 3> gradient; ///< per cell size
  };



  /// Weights of the box [centre - half, centre + half], which must lie in [0, 2],
  /// along one axis, at the nodes 0, 1 and 2 in units of the cell. Shape
  /// functions are the hats of the nodes. Only the third mean is an integral; the
  /// others follow, since the hats interpolate 1 and x exactly: sum w_i = 1 and
  /// sum i w_i = centre. @cite bardenhagen2004, eq. 36 ff.
  template <typename Number>
  TALUS_ALWAYS_INLINE AxisWeights<Number>
                      axis_weights(const Number &centre, const Number &half)
  {
    // Of the ends of the box, how far they are in the second cell.
    const Number zero(0.);
    const Number a     = max(centre - half - 1., zero);
    const Number b     = max(centre + half - 1., zero);
    const Number slope = (b - a) * (0.5 / half);

    AxisWeights<Number> w;
    w.value[2]    = 0.5 * slope * (b + a);
    w.value[1]    = centre - 2. * w.value[2];
    w.value[0]    = (1. - centre) + w.value[2];
    w.gradient[2] = slope;
    w.gradient[1] = 1. - 2. * slope;
    w.gradient[0] = slope - 1.;
    return w;
  }
} // namespace talus

#endif

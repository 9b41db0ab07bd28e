#ifndef talus_transfer_weights_h
#define talus_transfer_weights_h

#include <talus/base/lanes.h>
#include <talus/grid/grid.h>
#include <talus/transfer/box_rule.h>

#include <vector>

namespace talus
{
  /// Mean over a box of the four one-dimensional shape functions around a cell
  /// and of their derivatives: nodes at -1, 0, 1, 2 in units of the cell.
  template <typename Number>
  struct AxisWeights
  {
    std::array<Number, 4> value;
    std::array<Number, 4> gradient; ///< per cell size
  };



  /// Weights of the box [centre - half, centre + half] along one axis, in units
  /// of the cell with origin at its lower face. The box must lie in [-1, 2].
  /// The shape functions are the hats of the nodes; their integrals over the
  /// three cells are taken one by one. @cite bardenhagen2004, eq. 36 ff.
  template <typename Number>
  inline AxisWeights<Number>
  axis_weights(const Number centre, const Number half)
  {
    const Number a = centre - half, b = centre + half, scale = 0.5 / half;
    const Number zero{}, one = broadcast<Number>(1.);

    // Ends of the parts of the box in the cell below, the cell, the one above.
    const Number a_below = min(a, zero), b_below = min(b, zero);
    const Number a_in = min(max(a, zero), one), b_in = min(max(b, zero), one);
    const Number a_above = max(a - 1., zero), b_above = max(b - 1., zero);

    AxisWeights<Number> w;
    w.value[0] = 0.5 * scale * (a_below * a_below - b_below * b_below);
    w.value[3] = 0.5 * scale * (b_above * b_above - a_above * a_above);
    w.value[2] = 0.5 * scale * (b_in * b_in - a_in * a_in) +
                 scale * (b_above - a_above) - w.value[3];
    w.value[1] = 1. - w.value[0] - w.value[2] - w.value[3];

    const Number in_below = scale * (b_below - a_below),
                 in_cell  = scale * (b_in - a_in),
                 in_above = scale * (b_above - a_above);
    w.gradient[0]         = -in_below;
    w.gradient[1]         = in_below - in_cell;
    w.gradient[2]         = in_cell - in_above;
    w.gradient[3]         = in_above;
    return w;
  }



  /// Weight of a point at one node.
  template <int dim>
  struct NodeWeight
  {
    unsigned int           node;
    double                 value;
    dealii::Tensor<1, dim> gradient; ///< 1/m
  };



  /// Weights by the definition: for every cell that the box overlaps, the mean
  /// of its shape functions over the overlap, times the overlap's share of the
  /// box. Any cells may touch cell @p c, hanging nodes included (whose share
  /// NodalFields::sum_over_ranks() passes on); a node may be listed several times.
  ///
  /// @param half half lengths of the box, m, at most half of the cell.
  template <int dim>
  void
  general_weights(const Grid<dim>              &grid,
                  unsigned int                  c,
                  const dealii::Point<dim>     &centre,
                  const dealii::Tensor<1, dim> &half,
                  std::vector<NodeWeight<dim>> &weights);

  /// The same for the box of point @p p in cell @p c.
  template <int dim>
  void
  weights_of_point(const Points<dim>            &points,
                   const Grid<dim>              &grid,
                   const BoxShape               &shape,
                   unsigned int                  c,
                   unsigned int                  p,
                   std::vector<NodeWeight<dim>> &weights);
} // namespace talus

#endif

#ifndef talus_transfer_weights_h
#define talus_transfer_weights_h

#include <talus/base/lanes.h>
#include <talus/grid/grid.h>
#include <talus/transfer/box_rule.h>

#include <vector>

namespace talus
{
  /// Mean over a box of the one-dimensional shape functions around a cell and of
  /// their derivatives. A box no longer than a cell touches two cells, so that
  /// three nodes that follow each other have a weight.
  template <typename Number>
  struct AxisWeights
  {
    /// The first of them among those at -1, 0, 1, 2 in units of the cell: the
    /// zeroth or the first.
    Number                first;
    std::array<Number, 3> value;
    std::array<Number, 3> gradient; ///< per cell size
  };



  /// Weights of the box [centre - half, centre + half] along one axis, in units
  /// of the cell with origin at its lower face. The box must lie in [-1, 2] and
  /// be no longer than one. The shape functions are the hats of the nodes; their
  /// integrals over the two cells are taken one by one. @cite bardenhagen2004,
  /// eq. 36 ff.
  template <typename Number>
  inline AxisWeights<Number>
  axis_weights(const Number centre, const Number half)
  {
    const Number zero{}, one = broadcast<Number>(1.);

    AxisWeights<Number> w;
    w.first = centre < half ? zero : one;
    // The ends of the box, seen from the first node.
    const Number a = centre - half - (w.first - 1.), b = a + 2. * half;
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

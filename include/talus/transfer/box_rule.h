#ifndef talus_transfer_box_rule_h
#define talus_transfer_box_rule_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>

namespace talus
{
  /// How the box of a point follows its deformation. A box stays parallel to
  /// the axes; its length along axis d is stretch_d times the reference length.
  enum class BoxRule
  {
    fixed,                ///< box keeps its reference length (uniform GIMP)
    deformation_gradient, ///< F_dd: blind to shear, vanishes at 90 degrees
    right_stretch,        ///< U_dd of F = R U (default)
    left_stretch          ///< V_dd of F = V R
  };

  /// The box of a point as the weights see it. @cite bardenhagen2004
  struct BoxShape
  {
    BoxRule rule = BoxRule::right_stretch;
    /// Half of the length is clipped to these, in units of the own cell: the
    /// lower one keeps the step stable, the upper one keeps the box within the
    /// touching cells.
    double least_half = 0.1;
    double most_half  = 0.5;
  };



  /// Half of the length of the box along axis @p d divided by the cell size,
  /// clipped as the weights need it.
  template <int dim, typename Number>
  inline Number
  half_length_in_cells(const Points<dim> &points,
                       const BoxShape    &shape,
                       const unsigned int d,
                       const unsigned int p,
                       const Number       inverse_cell_size)
  {
    Number half =
      0.5 * load<Number>(points.data(points.reference_length, d) + p);
    if (shape.rule != BoxRule::fixed)
      half *= load<Number>(points.data(points.stretch, d) + p);
    return clamp(half * inverse_cell_size, shape.least_half, shape.most_half);
  }



  /// Set the stretch of the points [begin, end), which have the workspace, from
  /// their deformation gradient, after a step of @p dt. With the rule `fixed` the box does not use it, only the
  /// splitter does: it is exp(integral of D_dd dt), positive by construction.
  template <int dim>
  void
  update_stretch(Points<dim> &points,
                 unsigned int begin,
                 unsigned int end,
                 BoxRule      rule,
                 double       dt);

  /// Set the stretch of the points [begin, end), and that at their creation,
  /// to that of a deformation gradient they start with.
  template <int dim>
  void
  initialize_stretch(Points<dim> &points,
                     unsigned int begin,
                     unsigned int end,
                     BoxRule      rule);

  /// Number of axes of boxes that are clipped for the weights.
  template <int dim>
  unsigned long
  count_clipped_boxes(const Points<dim> &points,
                      const Grid<dim>   &grid,
                      const BoxShape    &shape);
} // namespace talus

#endif

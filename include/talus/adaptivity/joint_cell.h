// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_joint_cell_h
#define talus_adaptivity_joint_cell_h

#include <talus/points/points.h>

#include <deal.II/base/tensor.h>

namespace talus
{
  /// Cell of the point into which two points p and q are merged.
  ///
  /// Let A be the tensor with the edges of the cell of a point as columns. The
  /// joint cell has the second moments of mass of both cells together,
  ///   A A^T = w_p A_p A_p^T + w_q A_q A_q^T + 12 w_p w_q d d^T,
  /// with the mass fractions w and d = x_q - x_p. The moments leave a rotation
  /// of the edges free: an edge leads from p to q, and in 3-D the rotation
  /// about this edge follows the edges of p. Two halves of a cell
  /// become the cell. A common factor gives the sum of both volumes; the factor
  /// measures how far the union is from a cell.
  template <int dim>
  class JointCell
  {
  public:
    /// Join the cells of points @p p and @p q.
    JointCell(const Points<dim> &points, unsigned int p, unsigned int q);

    /// Return the joint edges as columns, m; meaningless unless misfit() is
    /// small.
    dealii::Tensor<2, dim>
    edges() const;

    /// Column of edges() along which the two points lie side by side.
    unsigned int
    edge_of_pair() const
    {
      return edge_of_pair_;
    }

    /// Axis of space along which the two points lie side by side.
    unsigned int
    axis() const
    {
      return axis_;
    }

    /// Relative error of the volume by second moments against the sum of both
    /// volumes, absolute value [-]. Zero if the union of the cells is a cell;
    /// larger if the cells overlap, leave a gap, are shifted or turned against
    /// each other.
    double
    misfit() const
    {
      return misfit_;
    }

    /// Mass of point p over the mass of both points [-].
    double
    mass_share() const
    {
      return mass_share_;
    }

  private:
    dealii::Tensor<2, dim> edges_;  ///< edges of point p, m
    dealii::Tensor<1, dim> offset_; ///< from p to q or back, m
    dealii::Tensor<2, dim> moment_; ///< A A^T scaled to the joint volume, m^2
    unsigned int           edge_of_pair_ = 0;
    unsigned int           axis_         = 0;
    double                 misfit_;
    double                 mass_share_;
  };
} // namespace talus

#endif

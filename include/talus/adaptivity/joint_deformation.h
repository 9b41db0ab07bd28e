// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_joint_deformation_h
#define talus_adaptivity_joint_deformation_h

#include <talus/base/small_matrix.h>
#include <talus/points/points.h>

namespace talus
{
  /// Deformation gradient of the point into which two points are merged: the
  /// mean weighted by mass, scaled so that the determinant gives the sum of
  /// both volumes.
  template <int dim>
  class JointDeformation
  {
  public:
    /// Join the deformations of points @p p and @p q.
    JointDeformation(const Points<dim> &points, unsigned int p, unsigned int q);

    /// Joint deformation gradient [-]; meaningless unless misfit() is small.
    const Matrix<dim, double> &
    gradient() const
    {
      return gradient_;
    }

    /// Relative change of volume by which the mean was scaled, absolute value
    /// [-]. Grows with the difference of the two deformations, rotations
    /// included. Infinite if the determinant of the mean is not positive.
    double
    misfit() const
    {
      return misfit_;
    }

    /// Current volume of point p over the current volume of both points [-].
    double
    volume_share() const
    {
      return volume_share_;
    }

  private:
    Matrix<dim, double> gradient_;
    double              misfit_;
    double              volume_share_;
  };
} // namespace talus

#endif

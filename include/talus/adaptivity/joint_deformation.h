// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_joint_deformation_h
#define talus_adaptivity_joint_deformation_h

#include <talus/base/small_matrix.h>
#include <talus/points/points.h>

namespace talus
{
  /// The deformation gradient of two points as one: the mean by mass, scaled so
  /// that its determinant gives the volume of both.
  template <int dim>
  class JointDeformation
  {
  public:
    JointDeformation(const Points<dim> &points, unsigned int p, unsigned int q);

    /// [-]; meaningless unless misfit() is small.
    const Matrix<dim, double> &
    gradient() const
    {
      return gradient_;
    }

    /// By how much of its volume the mean was scaled, absolute value [-]:
    /// the more the deformations differ, in their rotations too. Infinite if
    /// the mean is turned inside out.
    double
    misfit() const
    {
      return misfit_;
    }

    /// Share of point @p p in the volume now [-].
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

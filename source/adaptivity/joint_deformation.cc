// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/joint_deformation.h>
#include <talus/points/points_kernel.h>

#include <cmath>
#include <limits>

namespace talus
{
  // The determinant of a mean differs from the mean of the determinants. Only
  // the determinants give the volume of soil, and no volume must be created.
  // Different rotations shrink the mean, so the scaling also tells whether the
  // mean is meaningful.
  template <int dim>
  JointDeformation<dim>::JointDeformation(const Points<dim> &points,
                                          const unsigned int p,
                                          const unsigned int q)
  {
    const unsigned int column = points.deformation_gradient;
    const auto         F_p    = load_matrix<dim, double>(points, column, p);
    const auto         F_q    = load_matrix<dim, double>(points, column, q);
    const double       m_p    = points.data(points.mass)[p],
                 m_q          = points.data(points.mass)[q];
    const double *const V0    = points.data(points.reference_volume);
    const double V_p = V0[p] * determinant(F_p), V_q = V0[q] * determinant(F_q);
    volume_share_ = V_p / (V_p + V_q);

    const double share = m_p / (m_p + m_q);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        gradient_[i][j] = share * F_p[i][j] + (1. - share) * F_q[i][j];
    const double ratio = determinant(gradient_) * (V0[p] + V0[q]) / (V_p + V_q);
    misfit_            = (ratio > 0 ? std::abs(ratio - 1.)
                                    : std::numeric_limits<double>::infinity());
    if (ratio > 0)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          gradient_[i][j] *= std::pow(ratio, -1. / dim);
  }



  template class JointDeformation<2>;
  template class JointDeformation<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/joint_box.h>
#include <talus/base/small_matrix.h>
#include <talus/transfer/box_rule.h>

#include <array>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the vector from point @p p to point @p q, m, along the axes of
    /// space. Sets the lengths @p l_p and @p l_q of the two boxes, m.
    template <int dim>
    Tensor<1, dim>
    offset_along_axes(const Points<dim>       &points,
                      const unsigned int       p,
                      const unsigned int       q,
                      std::array<double, dim> &l_p,
                      std::array<double, dim> &l_q)
    {
      Tensor<1, dim> offset;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *x       = points.data(points.position, d);
          const double *L       = points.data(points.reference_length, d);
          const double *stretch = points.data(points.stretch, d);
          offset[d]             = x[q] - x[p];
          l_p[d]                = stretch[p] * L[p];
          l_q[d]                = stretch[q] * L[q];
        }
      return offset;
    }



    /// Return the vector from point @p p to point @p q, m, in the frame of the
    /// mean edges of two convected domains. Sets the lengths @p l_p and @p l_q
    /// of the edges, m.
    template <int dim>
    Tensor<1, dim>
    offset_along_edges(const Points<dim>       &points,
                       const unsigned int       p,
                       const unsigned int       q,
                       std::array<double, dim> &l_p,
                       std::array<double, dim> &l_q)
    {
      Matrix<dim, double> directions; // unit vectors of the frame, as columns
      for (unsigned int d = 0; d < dim; ++d)
        {
          const BoxRule        rule = BoxRule::convected_domain;
          const Tensor<1, dim> a    = edge_of_box(points, rule, d, p),
                               b    = edge_of_box(points, rule, d, q);
          l_p[d]                    = a.norm();
          l_q[d]                    = b.norm();
          for (unsigned int i = 0; i < dim; ++i)
            directions[i][d] = (a[i] + b[i]) / (a + b).norm();
        }
      const Matrix<dim, double> to_frame = inverse(directions);
      const Tensor<1, dim>      x = load_vector(points, points.position, q) -
                               load_vector(points, points.position, p);
      Tensor<1, dim> offset;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < dim; ++i)
          offset[d] += to_frame[d][i] * x[i];
      return offset;
    }
  } // namespace



  // Second moments instead of the bounding box: the bounding box of two boxes
  // shifted slightly against each other is too large, by an amount that depends
  // on the box that sticks out. With second moments the nodes see, to second
  // order, the mass at its old place, and no box needs an exact position to be
  // merged. The scaling keeps the volume covered by the boxes.
  template <int dim>
  JointBox<dim>::JointBox(const Points<dim> &points,
                          const BoxRule      rule,
                          const unsigned int p,
                          const unsigned int q)
  {
    const double m_p = points.data(points.mass)[p],
                 m_q = points.data(points.mass)[q];
    mass_share_      = m_p / (m_p + m_q);

    std::array<double, dim> l_p, l_q;
    Tensor<1, dim>          offset;
    if (rule == BoxRule::convected_domain)
      offset = offset_along_edges<dim>(points, p, q, l_p, l_q);
    else
      offset = offset_along_axes<dim>(points, p, q, l_p, l_q);

    const double moment   = 12. * mass_share_ * (1. - mass_share_);
    double       volume_p = 1., volume_q = 1., square = 1., farthest = -1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        length_[d] = mass_share_ * l_p[d] * l_p[d] +
                     (1. - mass_share_) * l_q[d] * l_q[d] +
                     moment * offset[d] * offset[d];
        square *= length_[d];
        volume_p *= l_p[d];
        volume_q *= l_q[d];
        const double distance = std::abs(offset[d]) / (l_p[d] + l_q[d]);
        if (distance > farthest)
          {
            farthest = distance;
            axis_    = d;
          }
      }
    const double ratio = std::sqrt(square) / (volume_p + volume_q);
    misfit_            = std::abs(ratio - 1.);
    const double scale =
      (dim == 2 ? 1. / std::sqrt(ratio) : 1. / std::cbrt(ratio));
    for (unsigned int d = 0; d < dim; ++d)
      length_[d] = scale * std::sqrt(length_[d]);
  }



  template class JointBox<2>;
  template class JointBox<3>;
} // namespace talus

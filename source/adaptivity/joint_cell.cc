// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/joint_cell.h>
#include <talus/transfer/box_rule.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<2, dim>
    edges_of(const Points<dim> &points, const unsigned int p)
    {
      Tensor<2, dim> A;
      for (unsigned int k = 0; k < dim; ++k)
        {
          const Tensor<1, dim> edge = edge_of_cell(points, k, p);
          for (unsigned int i = 0; i < dim; ++i)
            A[i][k] = edge[i];
        }
      return A;
    }



    /// Return edges of the lattice with the edges @p B that are near the edges
    /// @p A. Neighbours may have reduced their edges at different times.
    template <int dim>
    Tensor<2, dim>
    matched(const Tensor<2, dim> &B, const Tensor<2, dim> &A)
    {
      Tensor<2, dim> M = invert(B) * A;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          M[i][j] = std::round(M[i][j]);
      return std::abs(determinant(M) - 1.) < 0.5 ? B * M : B;
    }



    /// Return the square root of a symmetric positive definite tensor.
    template <int dim>
    Tensor<2, dim>
    root(const Tensor<2, dim> &square)
    {
      Tensor<2, dim> V;
      for (const auto &[value, direction] :
           eigenvectors(symmetrize(square),
                        SymmetricTensorEigenvectorMethod::jacobi))
        V += std::sqrt(value) * outer_product(direction, direction);
      return V;
    }



    template <int dim>
    unsigned int
    largest_component(const Tensor<1, dim> &v)
    {
      unsigned int largest = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(v[d]) > std::abs(v[largest]))
          largest = d;
      return largest;
    }
  } // namespace



  // Second moments instead of the union: with second moments the nodes see, to
  // second order, the mass at its old place, and no cell needs an exact
  // position to be merged. The scaling keeps the volume covered by the cells.
  template <int dim>
  JointCell<dim>::JointCell(const Points<dim> &points,
                            const unsigned int p,
                            const unsigned int q)
    : misfit_(std::numeric_limits<double>::infinity())
  {
    const Tensor<2, dim> A   = edges_of(points, p);
    const Tensor<2, dim> B   = matched(edges_of(points, q), A);
    const double         m_p = points.data(points.mass)[p],
                 m_q         = points.data(points.mass)[q];
    const double w           = m_p / (m_p + m_q);
    mass_share_              = w;

    offset_ = load_vector(points, points.position, q) -
              load_vector(points, points.position, p);
    mean_ = w * A + (1. - w) * B;
    if (!(determinant(mean_) > 0))
      return;
    moment_ = w * A * transpose(A) + (1. - w) * B * transpose(B) +
              12. * w * (1. - w) * outer_product(offset_, offset_);
    const double ratio =
      std::sqrt(determinant(moment_)) / (determinant(A) + determinant(B));
    misfit_ = std::abs(ratio - 1.);

    edge_of_pair_                  = largest_component(invert(mean_) * offset_);
    Tensor<1, dim> offset_in_boxes = offset_;
    for (unsigned int d = 0; d < dim; ++d)
      {
        mean_[d][edge_of_pair_] *= 2.;
        offset_in_boxes[d] /= std::sqrt(moment_[d][d]);
      }
    axis_ = largest_component(offset_in_boxes);
    moment_ *= std::pow(ratio, -2. / dim);
  }



  // The edges are V R, with V the root of the moments and a rotation R. First R
  // is the rotation of the mean edges; the smallest further rotation, from the
  // unit vector a to u, then turns the edge of the pair into the offset. In a
  // film one point thick the edge along the film must stay along the film, or
  // later splits would leave gaps.
  template <int dim>
  Tensor<2, dim>
  JointCell<dim>::edges() const
  {
    const Tensor<2, dim> V = root(moment_);
    const Tensor<2, dim> R = project_onto_orthogonal_tensors(mean_);
    const Tensor<1, dim> a = transpose(R)[edge_of_pair_];
    Tensor<1, dim>       u = invert(V) * offset_;
    u /= (a * u < 0 ? -1. : 1.) * u.norm();
    Tensor<2, dim> turn =
      2. * outer_product(u, a) - outer_product(a + u, a + u) / (1. + a * u);
    for (unsigned int d = 0; d < dim; ++d)
      turn[d][d] += 1.;
    return V * turn * R;
  }



  template class JointCell<2>;
  template class JointCell<3>;
} // namespace talus

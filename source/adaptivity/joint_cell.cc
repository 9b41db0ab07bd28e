// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/joint_cell.h>
#include <talus/transfer/box_rule.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
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
    : edges_(load_edges(points, p))
    , offset_(load_vector(points, points.position, q) -
              load_vector(points, points.position, p))
  {
    const Tensor<2, dim> A = edges_, B = matched(load_edges(points, q), A);
    const double *const  m = points.data(points.mass);
    const double         w = mass_share_ = m[p] / (m[p] + m[q]);
    moment_ = w * A * transpose(A) + (1. - w) * B * transpose(B) +
              12. * w * (1. - w) * outer_product(offset_, offset_);
    const double ratio =
      std::sqrt(determinant(moment_)) / (determinant(A) + determinant(B));
    misfit_ = std::abs(ratio - 1.);

    const Tensor<1, dim> offset_in_edges = invert(A) * offset_;
    edge_of_pair_                        = largest_component(offset_in_edges);
    Tensor<1, dim> offset_in_boxes       = offset_;
    for (unsigned int d = 0; d < dim; ++d)
      offset_in_boxes[d] /= std::sqrt(moment_[d][d]);
    if (offset_in_edges[edge_of_pair_] < 0)
      offset_ *= -1.;
    axis_ = largest_component(offset_in_boxes);
    moment_ *= std::pow(ratio, -2. / dim);
  }



  // A A^T = M holds if the edges are orthonormal with the metric M^-1. The
  // first edge has the direction from p to q, the other edges follow from the
  // edges of p by Gram and Schmidt. In a film one point thick the edge along
  // the film must stay along the film, or later splits would leave gaps.
  template <int dim>
  Tensor<2, dim>
  JointCell<dim>::edges() const
  {
    const Tensor<2, dim> metric = invert(moment_);
    Tensor<2, dim>       edge   = transpose(edges_);
    edge[edge_of_pair_]         = offset_;
    for (unsigned int n = 0; n < dim; ++n)
      {
        Tensor<1, dim> a = edge[(edge_of_pair_ + n) % dim];
        for (unsigned int m = 0; m < n; ++m)
          {
            const Tensor<1, dim> b = edge[(edge_of_pair_ + m) % dim];
            a -= (a * (metric * b)) * b;
          }
        edge[(edge_of_pair_ + n) % dim] = a / std::sqrt(a * (metric * a));
      }
    return transpose(edge);
  }



  template class JointCell<2>;
  template class JointCell<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "elastic_block.h"

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>

#include <cmath>
#include <limits>

namespace talus::cases
{
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  ElasticBlock<dim>::ElasticBlock(const Data &data)
    : data_(data)
    , weight_(1.)
  {
    const dealii::FE_Q<dim>   fe(1);
    const dealii::QGauss<dim> gauss(2);
    unsigned int              n_nodes = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        size_[d] = data_.length[d] / data_.n_cells[d];
        weight_ *= size_[d] / 2.;
        n_nodes *= data_.n_cells[d] + 1;
      }
    for (unsigned int q = 0; q < gauss.size(); ++q)
      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          gradient_[q][v][d] = fe.shape_grad(v, gauss.point(q))[d] / size_[d];
    mass_.assign(n_nodes, 0.);
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (const unsigned int node : nodes_of_cell(c))
        mass_[node] += data_.density * weight_;
    const unsigned int axis = data_.held_face / 2, side = data_.held_face % 2;
    for (unsigned int node = 0; node < n_nodes; ++node)
      if (std::abs(place_of_node(node)[axis] - side * data_.length[axis]) <
          1e-9 * data_.length[axis])
        mass_[node] = std::numeric_limits<double>::infinity();
  }



  template <int dim>
  unsigned int
  ElasticBlock<dim>::n_cells() const
  {
    unsigned int n = 1;
    for (const unsigned int along_axis : data_.n_cells)
      n *= along_axis;
    return n;
  }



  template <int dim>
  Tensor<1, dim>
  ElasticBlock<dim>::place_of_node(unsigned int node) const
  {
    Tensor<1, dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      {
        x[d] = node % (data_.n_cells[d] + 1) * size_[d];
        node /= data_.n_cells[d] + 1;
      }
    return x;
  }



  template <int dim>
  std::array<unsigned int, ElasticBlock<dim>::n_vertices>
  ElasticBlock<dim>::nodes_of_cell(unsigned int cell) const
  {
    std::array<unsigned int, n_vertices> nodes{};
    unsigned int                         stride = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        for (unsigned int v = 0; v < n_vertices; ++v)
          nodes[v] += (cell % data_.n_cells[d] + ((v >> d) & 1)) * stride;
        cell /= data_.n_cells[d];
        stride *= data_.n_cells[d] + 1;
      }
    return nodes;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  ElasticBlock<dim>::internal_forces(const std::vector<Tensor<1, dim>> &u) const
  {
    const double mu     = data_.E / (2. * (1. + data_.nu));
    const double lambda = 2. * mu * data_.nu / (1. - 2. * data_.nu);
    std::vector<Tensor<1, dim>> force(u.size());
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const auto nodes = nodes_of_cell(c);
        for (const auto &gradient : gradient_)
          {
            Tensor<2, dim> F;
            for (unsigned int d = 0; d < dim; ++d)
              F[d][d] = 1.;
            for (unsigned int v = 0; v < n_vertices; ++v)
              F += outer_product(u[nodes[v]], gradient[v]);
            const Tensor<2, dim> inverse_T = transpose(invert(F));
            const Tensor<2, dim> P =
              mu * F + (lambda * std::log(determinant(F)) - mu) * inverse_T;
            for (unsigned int v = 0; v < n_vertices; ++v)
              force[nodes[v]] -= weight_ * (P * gradient[v]);
          }
      }
    return force;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  ElasticBlock<dim>::displacements(const Point<dim> &place,
                                   const double      dt,
                                   const double      end)
  {
    unsigned int node = 0;
    for (unsigned int n = 0; n < mass_.size(); ++n)
      if ((place_of_node(n) - place).norm() <
          (place_of_node(node) - place).norm())
        node = n;
    std::vector<Tensor<1, dim>> u(mass_.size()), v(mass_.size()),
      found{u[node]};
    for (unsigned int step = 1; step * dt < end + 0.5 * dt; ++step)
      {
        // From rest: the velocity at the first half step is half an increment.
        const double interval = (step == 1 ? 0.5 : 1.) * dt;
        const auto   force    = internal_forces(u);
        for (unsigned int n = 0; n < u.size(); ++n)
          if (std::isfinite(mass_[n]))
            {
              v[n] += interval * (force[n] / mass_[n] + data_.gravity);
              u[n] += dt * v[n];
            }
        found.push_back(u[node]);
      }
    return found;
  }



  template class ElasticBlock<2>;
  template class ElasticBlock<3>;
} // namespace talus::cases

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_elastic_block_h
#define talus_tests_cases_elastic_block_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <vector>

namespace talus::cases
{
  /// A hyperelastic box (in 2-D in plane strain) under sudden gravity, by total
  /// Lagrangian finite elements: the reference for what material points do at
  /// large rotation and stretch. Nothing of it is talus' own.
  ///
  /// Compressible neo-Hooke, P = mu (F - F^-T) + lambda ln J F^-T; linear
  /// quadrilaterals (hexahedra) with two Gauss points per axis; lumped mass;
  /// leapfrog.
  template <int dim>
  class ElasticBlock
  {
  public:
    static constexpr unsigned int n_vertices = 1 << dim;

    struct Data
    {
      std::array<double, dim>       length;  ///< m, lower corner at the origin
      std::array<unsigned int, dim> n_cells; ///< along each axis
      double                        density; ///< kg/m^3
      double                        E;       ///< Young's modulus, Pa
      double                        nu;      ///< Poisson's ratio
      dealii::Tensor<1, dim>        gravity; ///< m/s^2, from t = 0 on
      unsigned int                  held_face; ///< deal.II's number
    };

    explicit ElasticBlock(const Data &data);

    /// Displacement of the node at @p place (of the undeformed body) at times
    /// 0, dt, 2 dt, ..., @p end.
    std::vector<dealii::Tensor<1, dim>>
    displacements(const dealii::Point<dim> &place, double dt, double end);

  private:
    dealii::Tensor<1, dim>
    place_of_node(unsigned int node) const;
    std::array<unsigned int, n_vertices>
    nodes_of_cell(unsigned int cell) const;
    unsigned int
    n_cells() const;
    /// Minus the integral of P grad N, per node, N.
    std::vector<dealii::Tensor<1, dim>>
    internal_forces(const std::vector<dealii::Tensor<1, dim>> &u) const;

    Data                    data_;
    std::array<double, dim> size_; ///< of a cell, m
    std::vector<double>     mass_; ///< infinite where held
    /// Gradients of the shape functions at the Gauss points of a cell, all
    /// cells being equal, 1/m, and the weight of each Gauss point, m^dim.
    std::array<std::array<dealii::Tensor<1, dim>, n_vertices>, n_vertices>
           gradient_;
    double weight_;
  };
} // namespace talus::cases

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/ghost_stabilization.h>

#include "equilibrium_setup.h"

namespace
{
  constexpr double h = 0.5, penalty = 0.02, shear_modulus = 3e5;

  /// Soil on cells of half a metre, as far as x = @p end from @p begin and 1 m
  /// along the other axes.
  template <int dim>
  struct Overhang : Statics<dim>
  {
    Overhang(const double begin, const double end)
      : Statics<dim>(dim == 2 ? mesh("0, 0", "3, 2", "0.5")
                              : mesh("0, 0, 0", "3, 2, 1", "0.5"),
                     {{"block", "linear elastic"}},
                     "")
    {
      std::array<unsigned int, dim> n;
      n.fill(4);
      n[0] = std::ceil((end - begin) / 0.25 - 1e-9);
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        upper[d] = 1.;
      lower[0] = begin;
      upper[0] = end;
      this->fill(lower, upper, n);
      this->load(Tensor<1, dim>());
      parts.emplace(*this, this->constants.mass_cutoff);
      ghost.find_faces(this->grid, parts->unknowns, penalty, shear_modulus);
    }

    std::vector<double>
    forces(const std::vector<double> &u) const
    {
      auto result = parts->unknowns.field();
      ghost.add_forces(u, result);
      return result;
    }

    /// The displacement @p u of a place, at the nodes.
    template <typename Displacement>
    std::vector<double>
    field(const Displacement &u) const
    {
      const auto places = places_of_nodes(this->grid);
      auto       result = parts->unknowns.field();
      for (const unsigned int node : parts->unknowns.active_nodes())
        {
          const Tensor<1, dim> at = u(places[node]);
          for (unsigned int d = 0; d < dim; ++d)
            result[dim * node + d] = at[d];
        }
      return result;
    }

    std::optional<StepParts<dim>> parts;
    GhostStabilization<dim>       ghost;
  };



  /// A tenth of a cell hangs over: the faces between the cells before and
  /// behind x = 1.5, two in the plane and four in space, and those between the
  /// cells behind it.
  constexpr double overhanging = 1.55;
  constexpr unsigned int
  n_normal_to_x(const int dim)
  {
    return dim == 2 ? 2 : 4;
  }



  template <int dim>
  void
  expect_faces()
  {
    for (const auto &[begin, end] :
         {std::pair(0., 1.5), {0., 2.}, {0.5, 1.}, {0., 3.}})
      EXPECT_EQ(Overhang<dim>(begin, end).ghost.n_faces(), 0u) << end;
    EXPECT_EQ(Overhang<dim>(0., overhanging).ghost.n_faces(),
              n_normal_to_x(dim) + (dim == 2 ? 1u : 4u));
    // Most of a cell is more than little.
    EXPECT_EQ(Overhang<dim>(0., 1.9).ghost.n_faces(), 0u);
  }



  template <int dim>
  void
  expect_nothing_for_linear()
  {
    Overhang<dim> body(0., overhanging);
    const auto    a = body.vector(-1., 1.);
    const auto    A = body.tensor(-1., 1.);
    const auto    linear =
      body.field([&](const Point<dim> &x) { return a + A * x; });
    EXPECT_LT(largest(body.forces(linear)),
              1e-13 * penalty * shear_modulus * std::pow(h, dim - 2));
  }



  /// 1/2 gamma G h times the integral of the squared jump, which is 2 h for
  /// u = x^2 at the faces normal to x, and 2 h y for u = x^2 y.
  template <int dim>
  void
  expect_energy()
  {
    Overhang<dim> body(0., overhanging);
    const auto    energy = [&](const std::vector<double> &u) {
      return 0.5 * dot(u, body.forces(u));
    };
    const auto along = [](const unsigned int d, const double value) {
      Tensor<1, dim> u;
      u[d] = value;
      return u;
    };
    const double area = n_normal_to_x(dim) * std::pow(h, dim - 1);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double unit = 0.5 * penalty * shear_modulus * h * 4. * h * h;
        EXPECT_NEAR(energy(body.field([&](const Point<dim> &x) {
                      return along(d, x[0] * x[0]);
                    })),
                    unit * area,
                    1e-13 * unit);
        EXPECT_NEAR(energy(body.field([&](const Point<dim> &x) {
                      return along(d, x[0] * x[0] * x[1]);
                    })),
                    unit * area / 3.,
                    1e-13 * unit);
      }
    for (unsigned int i = 0; i < 10; ++i)
      {
        const auto u = body.parts->random_field(body, 1.);
        const auto v = body.parts->random_field(body, 1.);
        EXPECT_GT(energy(u), 0.);
        EXPECT_NEAR(dot(v, body.forces(u)),
                    dot(u, body.forces(v)),
                    1e-13 * energy(u));
      }
  }



  template <int dim>
  void
  expect_matrix()
  {
    Overhang<dim>        body(0., overhanging);
    StiffnessMatrix<dim> matrix;
    body.parts->make_full(matrix);
    body.ghost.add_to_matrix(matrix);
    matrix.finish(0.);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const auto u      = body.parts->random_field(body, 1.);
        const auto forces = body.forces(u);
        EXPECT_GT(largest(forces), 1.);
        EXPECT_LT(
          largest(plus(forces, -1., body.parts->multiply(matrix.matrix(), u))),
          1e-13 * largest(forces));
      }
  }
} // namespace



TEST(GhostStabilization, FacesWhereABodyEndsJustInsideACell)
{
  expect_faces<2>();
  expect_faces<3>();
}



TEST(GhostStabilization, NothingForLinearDisplacements)
{
  expect_nothing_for_linear<2>();
  expect_nothing_for_linear<3>();
}



TEST(GhostStabilization, ForcesOfTheEnergy)
{
  expect_energy<2>();
  expect_energy<3>();
}



TEST(GhostStabilization, MatrixIsTheirDerivative)
{
  expect_matrix<2>();
  expect_matrix<3>();
}

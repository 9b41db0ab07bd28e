// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/internal_forces.h>

#include "equilibrium_setup.h"
#include "transfer_setup.h"

namespace
{
  const std::string clay_constants =
    "set Young's modulus = 250e3\nset Poisson's ratio = 0.4\n";
  const std::string weak = "set Undrained shear strength = 900\n";



  /// Points of three bodies in all states that their laws can be in, without
  /// load, on a uniform mesh and on one with hanging nodes; with and without
  /// B-bar.
  template <int dim, typename Action>
  void
  on_all_states(const Action &action)
  {
    for (const bool hanging_nodes : {false, true})
      for (const bool mean : {true, false})
        {
          SCOPED_TRACE(
            text(dim, "-D, hanging nodes ", hanging_nodes, ", mean ", mean));
          Statics<dim> statics(cube<dim>(),
                               {{"block", "linear elastic"},
                                {"clay", "von Mises"},
                                {"mud", "Bingham"}},
                               material("block", clay_constants) +
                                 material("clay", clay_constants + weak) +
                                 material("mud", clay_constants + weak));
          fill_with_points(statics, hanging_nodes);
          statics.transfer.use_bbar({mean, false, mean});
          statics.loads.varies = false;
          statics.load(Tensor<1, dim>());
          auto &points = statics.points;
          statics.workspace.reinit(0, points.size());
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              std::fill_n(statics.workspace.velocity_gradient(i, j),
                          points.size(),
                          0.);
          statics.materials.update_stress(points,
                                          statics.workspace,
                                          points.all(),
                                          0.);
          action(statics);
        }
  }



  /// sum f.u = sum V P:H, and the forces at rest are the explicit scheme's.
  template <int dim>
  void
  expect_work(Statics<dim> &statics)
  {
    StepParts<dim> parts(statics);
    auto           problem = statics.problem();
    auto          &points  = statics.points;
    const auto     u       = parts.random_field(statics, 0.01);
    auto           forces  = parts.unknowns.field();
    parts.internal_forces.evaluate(problem, parts.weights, u, forces);

    double                          work = 0., scale = 0.;
    std::vector<StressTangent<dim>> answers(points.size());
    statics.materials.for_each_material_range(
      points,
      points.all(),
      [&](const auto &model, const unsigned int begin, const unsigned int end) {
        model.linearize(points, statics.workspace, begin, end, &answers[begin]);
      });
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            const double part = statics.volume(p) *
                                answers[p].stress[dim * i + j] *
                                statics.velocity_gradient(p)[i][j];
            work += part;
            scale += std::abs(part);
          }
    EXPECT_GT(scale, 1.);
    EXPECT_NEAR(dot(forces, u), work, 1e-13 * scale);
  }



  template <int dim>
  void
  expect_explicit_forces(Statics<dim> &statics)
  {
    StepParts<dim> parts(statics);
    auto           problem = statics.problem();
    auto           forces  = parts.unknowns.field();
    parts.internal_forces.evaluate(problem,
                                   parts.weights,
                                   parts.unknowns.field(),
                                   forces);
    const double scale = largest(forces);
    EXPECT_GT(scale, 10.);
    for (const unsigned int node : parts.unknowns.active_nodes())
      for (unsigned int d = 0; d < dim; ++d)
        EXPECT_NEAR(forces[dim * node + d],
                    -statics.force(node)[d],
                    1e-13 * scale);
  }



  /// The matrix against central differences of the forces, along some
  /// directions. The matrix is symmetric.
  template <int dim>
  void
  expect_tangent(Statics<dim> &statics)
  {
    StepParts<dim> parts(statics);
    auto           problem = statics.problem();
    const auto     u       = parts.random_field(statics, 0.01);
    const auto     forces  = [&](const std::vector<double> &at) {
      auto result = parts.unknowns.field();
      parts.internal_forces.evaluate(problem, parts.weights, at, result);
      return result;
    };
    forces(u);
    StiffnessMatrix<dim> matrix;
    parts.make_full(matrix);
    parts.internal_forces.add_tangent(parts.weights, matrix);
    matrix.finish(0.);

    const double eps = 1e-7;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const auto v  = parts.random_field(statics, 1.);
        const auto w  = parts.random_field(statics, 1.);
        const auto Kv = parts.multiply(matrix.matrix(), v);
        const auto difference =
          plus(forces(plus(u, eps, v)), -1., forces(plus(u, -eps, v)));
        EXPECT_LT(largest(plus(Kv, -0.5 / eps, difference)),
                  1e-7 * largest(Kv));
        const double asymmetry =
          std::abs(dot(w, Kv) - dot(v, parts.multiply(matrix.matrix(), w)));
        const double scale = std::sqrt(dot(w, w) * dot(Kv, Kv));
        EXPECT_LT(asymmetry, 1e-13 * scale);
      }
  }



  /// An elastic body in the interior without stress.
  template <int dim>
  void
  on_bodies_at_rest(const MaterialName                        &name,
                    const std::function<void(Statics<dim> &)> &action)
  {
    for (const bool hanging_nodes : {false, true})
      for (const bool mean : {true, false})
        {
          SCOPED_TRACE(text(dim, "-D, ", name.law, hanging_nodes, mean));
          Statics<dim> statics(cube<dim>(),
                               {name},
                               material(name.name, clay_constants));
          if (hanging_nodes)
            refine_corner(statics);
          for (unsigned int i = 0; i < 300; ++i)
            statics.add(statics.place(0.51), statics.vector(0.05, 0.9));
          statics.transfer.use_bbar({mean});
          statics.load(Tensor<1, dim>());
          action(statics);
        }
  }



  /// Forces of the displacements u = a + A x, over E V/h.
  template <int dim>
  double
  force_of(Statics<dim>         &statics,
           const Tensor<1, dim> &a,
           const Tensor<2, dim> &A)
  {
    StepParts<dim> parts(statics);
    auto           problem = statics.problem();
    const auto     places  = places_of_nodes(statics.grid);
    auto           u = parts.unknowns.field(), forces = u;
    for (const unsigned int node : parts.unknowns.active_nodes())
      {
        const Tensor<1, dim> at = a + A * places[node];
        for (unsigned int d = 0; d < dim; ++d)
          u[dim * node + d] = at[d];
      }
    parts.internal_forces.evaluate(problem, parts.weights, u, forces);
    return largest(forces) / 250e3;
  }



  template <int dim>
  void
  expect_no_force_of_rigid_motion()
  {
    Tensor<1, dim> a;
    Tensor<2, dim> spin, turn;
    for (unsigned int d = 0; d < dim; ++d)
      a[d] = 0.3 - 0.2 * d;
    spin[0][1]             = -0.02;
    spin[1][0]             = 0.02;
    turn[0][0]             = std::cos(0.4) - 1.;
    turn[1][1]             = std::cos(0.4) - 1.;
    turn[1][0]             = std::sin(0.4);
    turn[0][1]             = -std::sin(0.4);
    const auto no_gradient = Tensor<2, dim>();
    on_bodies_at_rest<dim>({"block", "linear elastic"}, [&](auto &statics) {
      EXPECT_LT(force_of(statics, a, no_gradient), 1e-13);
      EXPECT_LT(force_of(statics, a, spin), 1e-13);
      EXPECT_GT(force_of(statics, a, turn), 1e-2);
    });
  }
} // namespace



TEST(InternalForces, AreTheDerivativeOfTheWork)
{
  on_all_states<2>(expect_work<2>);
  on_all_states<3>(expect_work<3>);
}



TEST(InternalForces, AtRestAreThoseOfTheDynamics)
{
  on_all_states<2>(expect_explicit_forces<2>);
  on_all_states<3>(expect_explicit_forces<3>);
}



TEST(InternalForces, MatrixIsTheirDerivative)
{
  on_all_states<2>(expect_tangent<2>);
  on_all_states<3>(expect_tangent<3>);
}



TEST(InternalForces, RigidMotionMeetsNone)
{
  expect_no_force_of_rigid_motion<2>();
  expect_no_force_of_rigid_motion<3>();
}

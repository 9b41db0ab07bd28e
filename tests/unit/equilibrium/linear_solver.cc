// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/linear_solver.h>

#include "equilibrium_setup.h"

namespace
{
  using SystemMatrix = dealii::TrilinosWrappers::SparseMatrix;
  using Vector       = dealii::TrilinosWrappers::MPI::Vector;

  /// An elastic block, held below, under its weight; too many unknowns for the
  /// coarsest level of multigrid.
  template <int dim>
  struct HeldBlock : Statics<dim>
  {
    HeldBlock()
      : Statics<dim>(dim == 2 ? mesh("0, 0", "4, 4", "0.125")
                              : mesh("0, 0, 0", "4, 4, 4", "0.5"),
                     {{"block", "linear elastic"}},
                     material("block", stiff))
    {
      Point<dim>                    lower, upper;
      std::array<unsigned int, dim> n;
      n.fill(dim == 2 ? 48 : 12);
      for (unsigned int d = 0; d < dim; ++d)
        upper[d] = 3.;
      this->fill(lower, upper, n);
      Tensor<1, dim> gravity;
      gravity[0] = 2.;
      gravity[1] = -9.81;
      this->load(gravity);
      parts.emplace(*this, this->constants.mass_cutoff);
      auto                      &unknowns = parts->unknowns;
      std::vector<unsigned char> held(this->grid.n_owned_nodes(), 0);
      for (const unsigned int node : unknowns.active_nodes())
        held[node] = (this->grid.faces_of_node(node) & 4 ? 7 : 0);
      unknowns.constrain(held);
      assemble();
    }

    void
    assemble()
    {
      const auto &unknowns = parts->unknowns;
      auto        problem  = this->problem();
      auto        forces   = unknowns.field();
      parts->internal_forces.evaluate(problem,
                                      parts->weights,
                                      unknowns.field(),
                                      forces);
      parts->make_full(matrix);
      parts->internal_forces.add_tangent(parts->weights, matrix);
      matrix.finish(0.);
      rhs.reinit(unknowns.owned(), unknowns.communicator());
      unknowns.for_each_free_dof(
        [&](const unsigned int node, const unsigned int d) {
          rhs(unknowns.first(node) + d) = this->force(node)[d];
        });
      rhs.compress(dealii::VectorOperation::insert);
      // Translations only: enough for multigrid to work.
      modes.assign(dim, {});
      for (const unsigned int node : unknowns.active_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            modes[e].push_back(
              d == e && !unknowns.is_constrained(node, d) ? 1. : 0.);
    }

    LinearSolution
    solve(const std::string &entries, Vector &x)
    {
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Linear solver", entries));
      dealii::ParameterAcceptor::parse_all_parameters();
      x.reinit(rhs);
      return solve(matrix.matrix(), x);
    }

    LinearSolution
    solve(const SystemMatrix &a, Vector &x)
    {
      return solver.solve({a, factorization, modes, dim, true}, x, rhs);
    }

    // Before the parameters are parsed, which the base class does.
    LinearSolver                  solver;
    std::optional<StepParts<dim>> parts;
    StiffnessMatrix<dim>          matrix;
    LuFactorization               factorization{dim};
    Vector                        rhs;
    RigidModes                    modes;
  };



  template <int dim>
  void
  expect_same_solution()
  {
    HeldBlock<dim> block;
    Vector         direct;
    const auto     how = block.solve("set Type = direct", direct);
    EXPECT_EQ(how.failure, "");
    EXPECT_EQ(how.n_iterations, 0u);
    Vector residual(block.rhs);
    EXPECT_LT(block.matrix.matrix().residual(residual, direct, block.rhs),
              1e-11 * block.rhs.l2_norm());
    for (const std::string type : {"CG", "GMRES"})
      {
        Vector     x;
        const auto solution = block.solve("set Type = " + type, x);
        EXPECT_EQ(solution.failure, "");
        EXPECT_GT(solution.n_iterations, 1u);
        EXPECT_LT(solution.n_iterations, 100u);
        x -= direct;
        EXPECT_LT(x.linfty_norm(), 1e-8 * direct.linfty_norm()) << type;
      }
  }
} // namespace



TEST(LinearSolver, AllGiveTheSameSolution)
{
  expect_same_solution<2>();
  expect_same_solution<3>();
}



TEST(LinearSolver, FailuresAreSentences)
{
  HeldBlock<2> block;
  Vector       x;
  for (const std::string type : {"CG", "GMRES"})
    EXPECT_EQ(
      block.solve("set Largest number of iterations = 2\nset Type = " + type, x)
        .failure,
      type + " did not solve the linear system in 2 iterations");
  // One unknown that nothing depends on.
  SystemMatrix singular;
  singular.copy_from(block.matrix.matrix());
  singular.clear_row(block.rhs.size() - 1);
  EXPECT_EQ(block.solve("set Type = direct", x).failure, "");
  EXPECT_EQ(block.solve(singular, x).failure, "the matrix is singular");
}



/// The first matrix has large pivots on the diagonal, the second has pivots of
/// 1e-14 there, with which the solution would be wrong.
TEST(LuFactorization, FindsNewPivotsWhereTheOldArePoor)
{
  const dealii::IndexSet owned = dealii::complete_index_set(2);
  dealii::TrilinosWrappers::SparsityPattern pattern(owned, MPI_COMM_SELF);
  for (const unsigned int i : {0, 1})
    for (const unsigned int j : {0, 1})
      pattern.add(i, j);
  pattern.compress();
  SystemMatrix matrix;
  matrix.reinit(pattern);
  const auto set = [&](const double diagonal, const double other) {
    for (const unsigned int i : {0, 1})
      {
        matrix.set(i, i, diagonal);
        matrix.set(i, 1 - i, other);
      }
    matrix.compress(dealii::VectorOperation::insert);
  };
  Vector rhs(owned, MPI_COMM_SELF), x(rhs);
  rhs(0) = 1.;
  rhs(1) = 2.;
  // KLU and MUMPS.
  for (const unsigned int dim : {2, 3})
    {
      LuFactorization factorization(dim);
      set(2., 1.);
      ASSERT_TRUE(factorization.solve(matrix, x, rhs, false));
      EXPECT_NEAR(x(0), 0., 1e-15);
      EXPECT_NEAR(x(1), 1., 1e-15);
      set(1e-14, 1.);
      ASSERT_TRUE(factorization.solve(matrix, x, rhs, false));
      EXPECT_NEAR(x(0), 2., 1e-12);
      EXPECT_NEAR(x(1), 1., 1e-12);
      // Singular, and regular again.
      set(1., 1.);
      EXPECT_FALSE(factorization.solve(matrix, x, rhs, false));
      set(4., 2.);
      ASSERT_TRUE(factorization.solve(matrix, x, rhs, false));
      EXPECT_NEAR(x(1), 0.5, 1e-15);
    }
}



/// Held unknowns keep their diagonal entry only, and the other entries do not
/// depend on which unknowns are held.
TEST(StiffnessMatrix, HoldsUnknowns)
{
  HeldBlock<2> block;
  auto        &unknowns = block.parts->unknowns;
  const auto  &held     = block.matrix.matrix();
  SystemMatrix all;
  unknowns.constrain(std::vector<unsigned char>(block.grid.n_owned_nodes(), 0));
  StiffnessMatrix<2> free;
  block.parts->make_full(free);
  block.parts->internal_forces.add_tangent(block.parts->weights, free);
  free.finish(0.);
  all.copy_from(free.matrix());
  unsigned int n_held = 0;
  for (unsigned int k = 0; k < unknowns.active_nodes().size(); k += 7)
    for (const unsigned int b : unknowns.active_nodes())
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int e = 0; e < 2; ++e)
          {
            const unsigned int a       = unknowns.active_nodes()[k];
            const bool         is_held = (block.grid.faces_of_node(a) & 4) ||
                                 (block.grid.faces_of_node(b) & 4);
            const unsigned int i = unknowns.first(a) + d;
            const unsigned int j = unknowns.first(b) + e;
            n_held += is_held;
            EXPECT_EQ(held.el(i, j), is_held && i != j ? 0. : all.el(i, j));
          }
  EXPECT_GT(n_held, 0u);
}



TEST(LinearSolver, ChoosesBySize)
{
  HeldBlock<2> block;
  auto        &solver = block.solver;
  EXPECT_EQ(solver.choice(100000, 2, true), "direct");
  EXPECT_EQ(solver.choice(100001, 2, true), "CG");
  EXPECT_EQ(solver.choice(100001, 2, false), "GMRES");
  EXPECT_EQ(solver.choice(300000, 3, false), "direct");
  EXPECT_EQ(solver.choice(300001, 3, true), "CG");
}

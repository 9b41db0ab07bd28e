// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_linear_solver_h
#define talus_equilibrium_linear_solver_h

#include <deal.II/base/parameter_acceptor.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <string>
#include <vector>

namespace talus
{
  /// Displacements that strain nothing, at the unknowns of this rank: what the
  /// coarse levels of algebraic multigrid must be able to show.
  using RigidModes = std::vector<std::vector<double>>;



  /// How a linear system was solved, if it was.
  struct LinearSolution
  {
    unsigned int n_iterations = 0; ///< 0 for the direct solver
    std::string  failure; ///< why there is none, as the end of a sentence
  };



  /// Solves the linear systems of Newton's method by Trilinos.
  class LinearSolver : public dealii::ParameterAcceptor
  {
  public:
    LinearSolver();

    /// Solve matrix * x = rhs. @p symmetric: also positive definite. Collective.
    LinearSolution
    solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
          dealii::TrilinosWrappers::MPI::Vector        &x,
          const dealii::TrilinosWrappers::MPI::Vector  &rhs,
          const RigidModes                             &modes,
          unsigned int                                  dim,
          bool                                          symmetric) const;

    /// The name of what solve() takes for @p n_unknowns unknowns.
    std::string
    choice(unsigned long n_unknowns, unsigned int dim, bool symmetric) const;

  private:
    std::string  type_               = "auto";
    double       tolerance_          = 1e-10;
    unsigned int largest_iterations_ = 1000;
  };
} // namespace talus

#endif

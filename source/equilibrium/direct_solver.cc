// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/direct_solver.h>

namespace talus
{
  using namespace dealii;

  bool
  DirectSolver::solve(const TrilinosWrappers::SparseMatrix &matrix,
                      const unsigned int                    n_components,
                      const bool                            is_symmetric,
                      TrilinosWrappers::MPI::Vector        &x,
                      const TrilinosWrappers::MPI::Vector  &rhs)
  {
    const bool is_on_one_rank = (matrix.local_size() == matrix.m());
    return (is_on_one_rank && solve_without_pivoting(
                                matrix, n_components, is_symmetric, x, rhs)) ||
           lu_.solve(matrix, x, rhs);
  }



  /// The residual decides whether the factors are good enough: pivots may be
  /// small where soil is about to fail. A second solution, for the residual of
  /// the first, removes most of the round-off. Where soil moves nearly freely,
  /// displacements are large, and the residual cannot be smaller than their
  /// round-off times the matrix.
  bool
  DirectSolver::solve_without_pivoting(
    const TrilinosWrappers::SparseMatrix &matrix,
    const unsigned int                    n_components,
    const bool                            is_symmetric,
    TrilinosWrappers::MPI::Vector        &x,
    const TrilinosWrappers::MPI::Vector  &rhs)
  {
    if (!multifrontal_.is_analyzed())
      multifrontal_.analyze(matrix.trilinos_matrix(), n_components);
    if (!multifrontal_.factorize(matrix.trilinos_matrix(), is_symmetric))
      return false;
    constexpr double largest_residual = 1e-10, largest_backward_error = 1e-14;
    TrilinosWrappers::MPI::Vector residual(rhs);
    x = 0.;
    for (unsigned int trial = 0; trial < 2; ++trial)
      {
        multifrontal_.solve(residual.begin());
        x += residual;
        if (matrix.residual(residual, x, rhs) <=
            largest_residual * rhs.l2_norm())
          return true;
      }
    return residual.linfty_norm() <=
           largest_backward_error * matrix.linfty_norm() * x.linfty_norm();
  }
} // namespace talus

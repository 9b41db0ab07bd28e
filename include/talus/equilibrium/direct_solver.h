// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_direct_solver_h
#define talus_equilibrium_direct_solver_h

#include <talus/equilibrium/lu_factorization.h>
#include <talus/equilibrium/multifrontal_factorization.h>

namespace talus
{
  /// Direct solver of linear systems whose matrices have the same, symmetric
  /// pattern: MultifrontalFactorization on one rank, LuFactorization on several
  /// ranks and where pivots on the diagonal are too small.
  class DirectSolver
  {
  public:
    /// Forget the previous matrix. Call after each change of the pattern.
    void
    clear()
    {
      multifrontal_.clear();
      lu_.clear();
    }

    /// Solve @p matrix * @p x = @p rhs, with @p n_components unknowns per node.
    /// Returns false if the matrix is singular; @p x is then undefined.
    /// Collective.
    bool
    solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
          unsigned int                                  n_components,
          bool                                          is_symmetric,
          dealii::TrilinosWrappers::MPI::Vector        &x,
          const dealii::TrilinosWrappers::MPI::Vector  &rhs);

  private:
    bool
    solve_without_pivoting(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                           unsigned int                           n_components,
                           bool                                   is_symmetric,
                           dealii::TrilinosWrappers::MPI::Vector &x,
                           const dealii::TrilinosWrappers::MPI::Vector &rhs);

    MultifrontalFactorization multifrontal_;
    LuFactorization           lu_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_lu_factorization_h
#define talus_equilibrium_lu_factorization_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>

namespace talus
{
  /// Sparse LU factorization by Trilinos' Amesos: KLU @cite davis2010 in 2-D,
  /// MUMPS @cite amestoy2001 in 3-D. The matrices of Newton's method differ in
  /// their values only: the ordering of the unknowns is computed once per
  /// pattern, and KLU tries the pivots of the previous matrix first.
  class LuFactorization
  {
  public:
    /// @p dim of the space.
    explicit LuFactorization(unsigned int dim);
    ~LuFactorization();

    /// Forget the previous matrix. Call after each change of the pattern.
    void
    clear();

    /// Factorize @p matrix and solve matrix * @p x = @p rhs. MUMPS factorises a
    /// matrix that @p is_symmetric in half of the time and memory. Returns
    /// false if the matrix is singular; @p x is then undefined. Collective.
    bool
    solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
          dealii::TrilinosWrappers::MPI::Vector        &x,
          const dealii::TrilinosWrappers::MPI::Vector  &rhs,
          bool                                          is_symmetric);

  private:
    class Amesos;
    bool
    solve_with_pivots(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                      dealii::TrilinosWrappers::MPI::Vector        &x,
                      const dealii::TrilinosWrappers::MPI::Vector  &rhs,
                      bool                                          old_pivots);

    std::unique_ptr<Amesos> amesos_;
    bool                    with_mumps_;
  };
} // namespace talus

#endif

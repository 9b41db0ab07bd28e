// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_linear_solver_h
#define talus_equilibrium_linear_solver_h

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <string>
#include <vector>

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

    /// Solve for another @p rhs with the factors of the last solve(), which
    /// must have succeeded. Collective.
    bool
    solve_again(dealii::TrilinosWrappers::MPI::Vector       &x,
                const dealii::TrilinosWrappers::MPI::Vector &rhs);

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



  /// Rigid motions, which cause no strain, at the unknowns of this rank. The
  /// coarse levels of algebraic multigrid must be able to represent them.
  using RigidModes = std::vector<std::vector<double>>;



  /// Outcome of the solution of a linear system.
  struct LinearSolution
  {
    unsigned int n_iterations = 0; ///< 0 for the direct solver
    std::string  failure; ///< reason, as the end of a sentence; empty: solved
  };



  /// Matrix of a linear system, with properties that the solver uses.
  struct LinearSystem
  {
    const dealii::TrilinosWrappers::SparseMatrix &matrix; ///< N/m
    LuFactorization  &factorization; ///< factors of previous matrices
    const RigidModes &modes;         ///< for multigrid
    unsigned int      dim;           ///< number of unknowns per node
    bool symmetric; ///< whether the matrix is symmetric, positive definite
    bool is_factorized = false; ///< whether the matrix is that of the last call
  };



  /// Solves the linear systems of Newton's method by Trilinos.
  class LinearSolver : public dealii::ParameterAcceptor
  {
  public:
    LinearSolver();

    /// Solve the system for @p x, m, with the right-hand side @p rhs, N.
    /// Collective.
    LinearSolution
    solve(const LinearSystem                          &system,
          dealii::TrilinosWrappers::MPI::Vector       &x,
          const dealii::TrilinosWrappers::MPI::Vector &rhs) const;

    /// Name of the method that solve() uses for @p n_unknowns unknowns.
    std::string
    choice(unsigned long n_unknowns, unsigned int dim, bool symmetric) const;

  private:
    std::string  type_               = "auto";
    double       tolerance_          = 1e-10;
    unsigned int largest_iterations_ = 1000;
  };
} // namespace talus

#endif

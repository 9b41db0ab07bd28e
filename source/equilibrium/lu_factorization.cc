// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/lu_factorization.h>

#include <Amesos_BaseSolver.h>
#include <Amesos_Klu.h>
#include <Epetra_LinearProblem.h>
#include <Teuchos_ParameterList.hpp>

namespace talus
{
  using namespace dealii;

  /// Linear system in the form of Amesos, and the factors.
  class LuFactorization::Amesos
  {
  public:
    Amesos(const TrilinosWrappers::SparseMatrix &matrix)
      // Epetra's class of a linear problem takes no constant matrices.
      : problem(const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()),
                nullptr,
                nullptr)
      , solver(problem)
    {}

    Epetra_LinearProblem problem;
    Amesos_Klu           solver;
    bool                 has_ordering = false;
    bool                 has_pivots   = false;
  };



  LuFactorization::LuFactorization()  = default;
  LuFactorization::~LuFactorization() = default;



  void
  LuFactorization::clear()
  {
    amesos_.reset();
  }



  /// The search for pivots takes half of the time. The pivots of the previous
  /// matrix save the search, but may be poor for the present matrix: the
  /// residual decides.
  bool
  LuFactorization::solve(const TrilinosWrappers::SparseMatrix &matrix,
                         TrilinosWrappers::MPI::Vector        &x,
                         const TrilinosWrappers::MPI::Vector  &rhs)
  {
    if (!amesos_ || amesos_->problem.GetOperator() != &matrix.trilinos_matrix())
      amesos_ = std::make_unique<Amesos>(matrix);
    if (amesos_->has_pivots && solve_with_pivots(matrix, x, rhs, true))
      return true;
    return solve_with_pivots(matrix, x, rhs, false);
  }



  /// KLU's own test, which compares the smallest pivot with the largest, is
  /// switched off: nodes with very little soil have small pivots in well-posed
  /// problems, too.
  bool
  LuFactorization::solve_with_pivots(
    const TrilinosWrappers::SparseMatrix &matrix,
    TrilinosWrappers::MPI::Vector        &x,
    const TrilinosWrappers::MPI::Vector  &rhs,
    const bool                            old_pivots)
  {
    Teuchos::ParameterList list;
    list.set("Refactorize", old_pivots);
    list.set("RcondThreshold", 0.);
    amesos_->solver.SetParameters(list);
    amesos_->problem.SetLHS(&x.trilinos_vector());
    // Epetra's class of a linear problem takes no constant vectors.
    amesos_->problem.SetRHS(
      const_cast<Epetra_MultiVector *>(&rhs.trilinos_vector()));
    amesos_->has_ordering =
      amesos_->has_ordering || amesos_->solver.SymbolicFactorization() == 0;
    amesos_->has_pivots =
      (amesos_->has_ordering && amesos_->solver.NumericFactorization() == 0);
    if (!amesos_->has_pivots || amesos_->solver.Solve() != 0)
      return false;
    constexpr double              largest_residual = 1e-10;
    TrilinosWrappers::MPI::Vector residual(rhs);
    return !old_pivots || matrix.residual(residual, x, rhs) <=
                            largest_residual * rhs.l2_norm();
  }
} // namespace talus

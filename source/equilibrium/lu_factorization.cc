// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/lu_factorization.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Teuchos_ParameterList.hpp>
#include <metis.h>

#include <vector>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Whether MUMPS factorises the matrices of @p dim dimensions: in 3-D
    /// factors fill far more, and MUMPS does most of its work in BLAS.
    bool
    takes_mumps(const unsigned int dim)
    {
      return dim == 3 && ::Amesos().Query("Amesos_Mumps");
    }



    /// Return the place of each row in a nested dissection of the graph of
    /// @p matrix, a matrix of one rank, from 1 @cite karypis1998. Empty if
    /// METIS fails.
    std::vector<int>
    nested_dissection(const Epetra_CrsMatrix &matrix)
    {
      idx_t              n = matrix.NumMyRows();
      std::vector<idx_t> begin(1, 0), neighbors, order(n), place(n);
      for (idx_t row = 0; row < n; ++row)
        {
          int     n_entries, *columns;
          double *values;
          matrix.ExtractMyRowView(row, n_entries, values, columns);
          for (int e = 0; e < n_entries; ++e)
            if (columns[e] != row)
              neighbors.push_back(columns[e]);
          begin.push_back(neighbors.size());
        }
      if (METIS_NodeND(&n,
                       begin.data(),
                       neighbors.data(),
                       nullptr,
                       nullptr,
                       order.data(),
                       place.data()) != METIS_OK)
        return {};
      for (idx_t &p : place)
        ++p;
      return {place.begin(), place.end()};
    }
  } // namespace



  /// Linear system in the form of Amesos, and the factors.
  class LuFactorization::Amesos
  {
  public:
    Amesos(const TrilinosWrappers::SparseMatrix &matrix,
           const bool                            with_mumps,
           const bool                            is_symmetric)
      // Epetra's class of a linear problem takes no constant matrices.
      : problem(const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()),
                nullptr,
                nullptr)
      , solver(::Amesos().Create(with_mumps ? "Amesos_Mumps" : "Amesos_Klu",
                                 problem))
      , symmetric(is_symmetric)
    {
      if (!with_mumps)
        return;
      if (symmetric)
        parameters.set("MatrixProperty", "symmetric");
      Teuchos::ParameterList &mumps = parameters.sublist("mumps");
      // Memory beyond the estimate, for pivots that are delayed [%].
      mumps.set("ICNTL(14)", 60);
      if (matrix.trilinos_matrix().Comm().NumProc() > 1)
        return;
      order = nested_dissection(matrix.trilinos_matrix());
      if (order.empty())
        return;
      mumps.set("ICNTL(7)", 1);
      mumps.set("PermIn", order.data());
    }

    Epetra_LinearProblem               problem;
    std::unique_ptr<Amesos_BaseSolver> solver;
    std::vector<int>                   order; ///< of the rows, for MUMPS
    Teuchos::ParameterList             parameters;
    bool                               symmetric;
    bool                               has_ordering = false;
    bool                               has_pivots   = false;
  };



  LuFactorization::LuFactorization(const unsigned int dim)
    : with_mumps_(takes_mumps(dim))
  {}



  LuFactorization::~LuFactorization() = default;



  void
  LuFactorization::clear()
  {
    amesos_.reset();
  }



  /// In KLU the search for pivots takes half of the time. The pivots of the previous
  /// matrix save the search, but may be poor for the present matrix: the
  /// residual decides.
  bool
  LuFactorization::solve(const TrilinosWrappers::SparseMatrix &matrix,
                         TrilinosWrappers::MPI::Vector        &x,
                         const TrilinosWrappers::MPI::Vector  &rhs,
                         const bool                            is_symmetric)
  {
    if (!amesos_ || amesos_->symmetric != is_symmetric ||
        amesos_->problem.GetOperator() != &matrix.trilinos_matrix())
      amesos_ = std::make_unique<Amesos>(matrix, with_mumps_, is_symmetric);
    if (amesos_->has_pivots && !with_mumps_ &&
        solve_with_pivots(matrix, x, rhs, true))
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
    Teuchos::ParameterList &list = amesos_->parameters;
    list.set("Refactorize", old_pivots);
    list.set("RcondThreshold", 0.);
    amesos_->solver->SetParameters(list);
    amesos_->problem.SetLHS(&x.trilinos_vector());
    // Epetra's class of a linear problem takes no constant vectors.
    amesos_->problem.SetRHS(
      const_cast<Epetra_MultiVector *>(&rhs.trilinos_vector()));
    amesos_->has_ordering =
      amesos_->has_ordering || amesos_->solver->SymbolicFactorization() == 0;
    amesos_->has_pivots =
      (amesos_->has_ordering && amesos_->solver->NumericFactorization() == 0);
    if (!amesos_->has_pivots || amesos_->solver->Solve() != 0)
      return false;
    constexpr double              largest_residual = 1e-10;
    TrilinosWrappers::MPI::Vector residual(rhs);
    return !old_pivots || matrix.residual(residual, x, rhs) <=
                            largest_residual * rhs.l2_norm();
  }
} // namespace talus

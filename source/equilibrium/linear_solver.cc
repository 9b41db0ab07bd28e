// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Teuchos_ParameterList.hpp>
#include <metis.h>
#include <ml_MultiLevelPreconditioner.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
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



    /// Collects what is written to std::cerr during the life of the object.
    class ErrorStream
    {
    public:
      ErrorStream()
        : previous_(std::cerr.rdbuf(collected_.rdbuf()))
      {}

      ~ErrorStream()
      {
        std::cerr.rdbuf(previous_);
      }

      std::string
      words() const
      {
        return collected_.str();
      }

    private:
      std::ostringstream collected_;
      std::streambuf    *previous_;
    };



    /// Throw ExcUser if MUMPS failed for another reason than a singular matrix,
    /// on any rank: no memory for the factors. The interface tells the reason
    /// only by @p words. Collective.
    void
    check_for_lack_of_memory(const std::string &words,
                             const MPI_Comm     communicator)
    {
      const std::string key = "INFOG(1) = ";
      const auto        at  = words.find(key);
      const int         reason =
        Utilities::MPI::min(at == std::string::npos
                              ? 0
                              : std::atoi(&words[at + key.size()]),
                            communicator);
      AssertThrow(reason == 0 || reason == -6 || reason == -10,
                  ExcUser(text("The factors of the matrix of the static stage "
                               "need more memory than there is (MUMPS ends "
                               "with INFOG(1) = ",
                               reason,
                               "). Choose larger cells, or 'Linear solver/Type "
                               "= GMRES'.")));
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
    std::vector<int>                   order; ///< places of the rows
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



  /// In KLU the search for pivots takes half of the time. The pivots of the
  /// previous matrix save the search, but may be poor for the present matrix:
  /// the residual decides.
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



  bool
  LuFactorization::solve_again(TrilinosWrappers::MPI::Vector       &x,
                               const TrilinosWrappers::MPI::Vector &rhs)
  {
    amesos_->problem.SetLHS(&x.trilinos_vector());
    // Epetra's class of a linear problem takes no constant vectors.
    amesos_->problem.SetRHS(
      const_cast<Epetra_MultiVector *>(&rhs.trilinos_vector()));
    return amesos_->solver->Solve() == 0;
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
    std::string words;
    {
      // A singular matrix is no error here, but MUMPS' interface prints one.
      const ErrorStream stream;
      amesos_->has_ordering =
        amesos_->has_ordering || amesos_->solver->SymbolicFactorization() == 0;
      amesos_->has_pivots =
        amesos_->has_ordering && amesos_->solver->NumericFactorization() == 0;
      words = stream.words();
    }
    if (!amesos_->has_pivots)
      check_for_lack_of_memory(words, matrix.get_mpi_communicator());
    if (!amesos_->has_pivots || amesos_->solver->Solve() != 0)
      return false;
    constexpr double              largest_residual = 1e-10;
    TrilinosWrappers::MPI::Vector residual(rhs);
    return !old_pivots || matrix.residual(residual, x, rhs) <=
                            largest_residual * rhs.l2_norm();
  }



  LinearSolver::LinearSolver()
    : ParameterAcceptor("/Linear solver")
  {
    add_parameter(
      "Type",
      type_,
      "Solver of the linear systems of the static stages: 'direct' "
      "(Trilinos' Amesos), 'CG' or 'GMRES' with algebraic multigrid "
      "(Trilinos' ML). CG requires symmetric matrices. 'auto': direct up to "
      "100 000 unknowns in 2-D and 300 000 in 3-D, otherwise CG, and GMRES "
      "where friction makes the matrix unsymmetric.",
      this->prm,
      Patterns::Selection("auto|direct|CG|GMRES"));
    add_parameter("Tolerance",
                  tolerance_,
                  "Largest residual of CG and GMRES over the right-hand side "
                  "[-].",
                  this->prm,
                  Patterns::Double(1e-15, 1.));
    add_parameter("Largest number of iterations",
                  largest_iterations_,
                  "Largest number of iterations of CG and GMRES [-].",
                  this->prm,
                  Patterns::Integer(1));
  }



  /// A direct solver handles nearly incompressible soil and nodes with very
  /// little stiffness, and is faster than multigrid while the fill-in of the
  /// factors is small. Fill-in grows much faster with the number of unknowns in
  /// 3-D than in 2-D, hence two limits. Beyond the limits, the iterations of
  /// multigrid hardly grow with the mesh (doc/performance.md, "Multigrid"). CG
  /// requires a symmetric matrix, and friction at contacts may make it
  /// unsymmetric.
  std::string
  LinearSolver::choice(const unsigned long n_unknowns,
                       const unsigned int  dim,
                       const bool          symmetric) const
  {
    if (type_ != "auto")
      return type_;
    if (n_unknowns <= (dim == 2 ? 100000 : 300000))
      return "direct";
    return symmetric ? "CG" : "GMRES";
  }



  namespace
  {
    /// Smoothed aggregation for @p dim unknowns per node with all rigid motions
    /// @cite vanek1996. @p modes must live until ML has copied the values.
    Teuchos::ParameterList
    multigrid_parameters(const unsigned int   dim,
                         std::vector<double> &modes,
                         const unsigned int   n_modes)
    {
      Teuchos::ParameterList list;
      // All levels need the near null space of the elastic operator, the rigid
      // motions. With translations only (ML's default for several equations per
      // node), rotations would be left to the smoother, and iterations would
      // grow with the mesh.
      ML_Epetra::SetDefaults("SA", list);
      list.set("ML output", 0);
      list.set("PDE equations", static_cast<int>(dim));
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", static_cast<int>(n_modes));
      list.set("null space: vectors", modes.data());
      list.set("aggregation: type", "Uncoupled");
      list.set("aggregation: threshold", 0.);
      // Chebyshev is a polynomial of the matrix. Unlike Gauss-Seidel, it does
      // not depend on the distribution of rows to ranks, and it is symmetric,
      // as CG requires of a preconditioner.
      list.set("smoother: type", "Chebyshev");
      list.set("smoother: sweeps", 3);
      // The coarsest level has at most 500 rows and is cheap to factorise.
      list.set("coarse: type", "Amesos-KLU");
      list.set("coarse: max size", 500);
      return list;
    }
  } // namespace



  /// An unsolved system is a result, not an error: the soil may be about to
  /// fail, and the load step is then cut. Hence exceptions of deal.II are
  /// caught here.
  LinearSolution
  LinearSolver::solve(const LinearSystem                  &system,
                      TrilinosWrappers::MPI::Vector       &x,
                      const TrilinosWrappers::MPI::Vector &rhs) const
  {
    const auto       &matrix = system.matrix;
    const std::string type   = choice(matrix.m(), system.dim, system.symmetric);
    x                        = 0.;
    if (type == "direct")
      return {0,
              (system.is_factorized
                 ? system.factorization.solve_again(x, rhs)
                 : system.factorization.solve(matrix, x, rhs, system.symmetric))
                ? ""
                : "the matrix is singular"};

    // ML expects all modes in one array, one after the other.
    std::vector<double> all_modes;
    for (const auto &mode : system.modes)
      all_modes.insert(all_modes.end(), mode.begin(), mode.end());
    TrilinosWrappers::PreconditionAMG multigrid;
    multigrid.initialize(
      matrix, multigrid_parameters(system.dim, all_modes, system.modes.size()));
    SolverControl control(largest_iterations_, tolerance_ * rhs.l2_norm());
    try
      {
        if (type == "CG")
          TrilinosWrappers::SolverCG(control).solve(matrix, x, rhs, multigrid);
        else
          // Restart after 100 vectors, more than well-conditioned systems
          // need (doc/performance.md, "Multigrid").
          TrilinosWrappers::SolverGMRES(
            control, TrilinosWrappers::SolverGMRES::AdditionalData(false, 100))
            .solve(matrix, x, rhs, multigrid);
      }
    catch (const ExceptionBase &)
      {
        return {largest_iterations_,
                text(type,
                     " did not solve the linear system in ",
                     largest_iterations_,
                     " iterations")};
      }
    return {control.last_step(), ""};
  }
} // namespace talus

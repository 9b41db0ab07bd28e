// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/linear_solver.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace talus
{
  using namespace dealii;

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
              system.factorization.solve(matrix, x, rhs, system.symmetric)
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

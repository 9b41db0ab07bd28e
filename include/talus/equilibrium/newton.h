// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_newton_h
#define talus_equilibrium_newton_h

#include <talus/equilibrium/static_equations.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Report on one iteration of Newton's method.
  struct NewtonIteration
  {
    unsigned int number;   ///< zero-based index
    double       residual; ///< before the correction, over reference force [-]
    unsigned int
           n_linear_iterations; ///< for the correction; 0 for the direct solver
    double seconds;             ///< wall time of the correction, s
    double length;              ///< fraction of the correction taken [-]
  };



  /// Place on the path of decreasing strength, and the next step along it.
  struct StrengthPath
  {
    double factor       = 1.; ///< divisor of all strengths [-]
    double displacement = 0.; ///< length of the path so far, m
    /// Whether the next step is given by the change of the factor; otherwise by
    /// its length.
    bool   by_factor = true;
    double change    = 0.; ///< growth of the factor in the next step [-]
    double length    = 0.; ///< length of the next step along the direction, m
    /// Displacements at the nodes in the last step, over their norm; empty if
    /// nothing has moved.
    std::vector<double> direction;
  };



  /// Newton's method with the consistent tangent @cite simo1998, for the
  /// displacements of one load step at which stress and loads balance
  /// (StaticEquations).
  template <int dim>
  class Newton
  {
  public:
    /// Outcome of solve().
    struct Outcome
    {
      bool        converged = false;
      std::string failure;            ///< a sentence; empty if converged
      bool        is_stopped = false; ///< stopped by the observer
      double      residual   = 0.;    ///< relative residual if converged [-]
    };

    /// Receives each iteration; returns whether to continue, the same on all
    /// ranks.
    using Observer = std::function<bool(const NewtonIteration &)>;

    Newton(const LinearSolver &linear_solver)
      : linear_solver_(linear_solver)
    {}

    /// Set up the unknowns for the current state of the soil. Collective.
    void
    begin(StaticProblem<dim> &problem, const StaticOptions &options);

    /// Solve for the displacements of a load step that removes the fraction
    /// @p share of the imbalance. If the solution fails or @p observe stops it,
    /// points and contact are unchanged. Collective.
    Outcome
    solve(StaticProblem<dim> &problem, double share, const Observer &observe);

    /// Solve for the displacements of the next step along the @p path of
    /// decreasing strength. In a step of given length the factor is an unknown
    /// @cite riks1979: at the limit no factor needs to be guessed. If the
    /// solution fails, path and contact stay as they were. Collective.
    Outcome
    follow(StaticProblem<dim> &problem,
           StrengthPath       &path,
           const Observer     &observe);

    /// Apply the solution to stress and internal variables of the points.
    void
    commit(StaticProblem<dim> &problem)
    {
      equations_.commit(problem, u_);
    }

    /// Failure mechanism at the points, dim components each, divided by the
    /// largest component of all points. The mechanism is the displacement of
    /// the last load step. If Newton's method failed, the mechanism is the last
    /// correction, which shows the free motion of a nearly singular matrix.
    /// Points must be unchanged since begin(). Collective.
    std::vector<double>
    mechanism(const Points<dim> &points) const;

    const StaticEquations<dim> &
    equations() const
    {
      return equations_;
    }

    /// Contact of the points; change it only before begin().
    StaticContact<dim> &
    contact()
    {
      return equations_.contact();
    }

    unsigned long
    n_unknowns() const
    {
      return equations_.unknowns().n_global();
    }

    /// Name of the method for the linear systems.
    std::string
    linear_solver() const
    {
      return linear_solver_.choice(n_unknowns(),
                                   dim,
                                   equations_.is_symmetric());
    }

  private:
    /// Solve for displacements and contact states together.
    Outcome
    solve_with_contact(StaticProblem<dim> &problem, const Observer &observe);
    /// Solve for displacements with fixed contact states, up to the tolerance
    /// of the relative residual; the tolerance may be raised to
    /// @p largest_tolerance [-].
    Outcome
    newton_loop(StaticProblem<dim> &problem,
                double              largest_tolerance,
                const Observer     &observe);
    /// Take one Newton step. Returns the reason of a failure, as the end of a
    /// sentence.
    std::string
    newton_update(StaticProblem<dim> &problem, NewtonIteration &iteration);
    void
    set_factor(StaticProblem<dim> &problem, double factor);
    /// Solve for displacements, factor and contact states together.
    Outcome
    solve_for_factor(StaticProblem<dim> &problem,
                     StrengthPath       &path,
                     const Observer     &observe);
    /// Solve for displacements and factor with fixed contact states.
    Outcome
    path_loop(StaticProblem<dim> &problem,
              StrengthPath       &path,
              const Observer     &observe);
    std::string
    path_update(StrengthPath              &path,
                const std::vector<double> &by_factor,
                double                     along);
    double
    line_search(StaticProblem<dim>        &problem,
                const std::vector<double> &direction);
    Outcome
    failure(const std::string &reason) const;

    const LinearSolver  &linear_solver_;
    StaticOptions        options_;
    StaticEquations<dim> equations_;
    double               extent_ = 0; ///< diagonal of the mesh, m

    // Fields at the nodes
    std::vector<double> residual_;        ///< N
    std::vector<double> u_;               ///< m
    std::vector<double> last_correction_; ///< m
    std::vector<double> mechanism_;       ///< m, from the last solve()
    /// Whether the last correction was so large that soil moves freely.
    bool         moves_freely_ = false;
    unsigned int n_updates_    = 0; ///< changes of u_ in newton_loop()
  };
} // namespace talus

#endif

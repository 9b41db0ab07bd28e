// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_newton_h
#define talus_equilibrium_newton_h

#include <talus/equilibrium/static_equations.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// One iteration of Newton's method, as seen before its correction.
  struct NewtonIteration
  {
    unsigned int number;
    double       residual; ///< over the reference force, at free unknowns
    unsigned int
           n_linear_iterations; ///< to the correction; 0 where there is none
    double seconds;             ///< of wall time for that
    double length;              ///< share of the correction taken
  };



  /// The displacements of one load step, for which stress and loads balance
  /// (StaticEquations), by Newton's method with the consistent tangent
  /// @cite simo1998.
  template <int dim>
  class Newton
  {
  public:
    struct Parameters
    {
      StrainMeasure measure            = StrainMeasure::small;
      double        tolerance          = 1e-8; ///< of the residual
      unsigned int  largest_iterations = 30;
      double        ghost_penalty      = 0.01; ///< gamma
      bool          is_well_balanced   = true; ///< with small strain
    };

    /// How solve() ended.
    struct Outcome
    {
      bool        converged = false;
      std::string failure;            ///< the sentence, if not
      bool        is_stopped = false; ///< by the observer
    };

    /// Returns whether to go on, the same on all ranks.
    using Observer = std::function<bool(const NewtonIteration &)>;

    Newton(const LinearSolver &linear_solver)
      : linear_solver_(linear_solver)
    {}

    /// Set up the unknowns of the soil as it is now. Collective.
    void
    begin(StaticProblem<dim> &problem, const Parameters &parameters);

    /// Find the displacements. Where that fails, or @p observe stops it, the
    /// soil is as before. Collective.
    Outcome
    solve(StaticProblem<dim> &problem, double share, const Observer &observe);

    /// Make what was found the state of the points; with large strain they move.
    void
    commit(StaticProblem<dim> &problem)
    {
      equations_.commit(problem, u_);
    }

    /// How the soil moves where it fails, at the points, dim numbers each,
    /// divided by the largest of all: the displacement of the last load step
    /// or, where Newton's method failed, its last correction, which shows what a
    /// nearly singular matrix lets move. Points must be as in begin().
    /// Collective.
    std::vector<double>
    mechanism(const Points<dim> &points) const;

    /// See StaticEquations.
    void
    forget_well_balanced_load()
    {
      equations_.forget_well_balanced_load();
    }

    const StaticEquations<dim> &
    equations() const
    {
      return equations_;
    }

    /// To be changed before begin() only: it belongs to the points.
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

    /// What solves the linear systems.
    std::string
    linear_solver() const
    {
      return linear_solver_.choice(n_unknowns(),
                                   dim,
                                   equations_.is_symmetric());
    }

  private:
    /// With the state of the seabed's nodes that belongs to it.
    Outcome
    solve_with_contact(StaticProblem<dim> &problem, const Observer &observe);
    /// With the state that they have.
    Outcome
    newton_loop(StaticProblem<dim> &problem, const Observer &observe);
    /// Returns why there is no next iterate, as the end of a sentence.
    std::string
    newton_update(StaticProblem<dim> &problem, NewtonIteration &iteration);
    double
    line_search(StaticProblem<dim>        &problem,
                const std::vector<double> &direction);
    Outcome
    failure(const std::string &reason) const;

    const LinearSolver  &linear_solver_;
    Parameters           parameters_;
    StaticEquations<dim> equations_;
    double               extent_ = 0; ///< of the mesh, m

    // Fields at the nodes
    std::vector<double> residual_;        ///< N
    std::vector<double> u_;               ///< m
    std::vector<double> last_correction_; ///< m
    std::vector<double> mechanism_;       ///< m, of the last solve()
    /// Whether the last correction was so large that the soil moves freely.
    bool moves_freely_ = false;
  };
} // namespace talus

#endif

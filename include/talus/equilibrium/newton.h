// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_newton_h
#define talus_equilibrium_newton_h

#include <talus/equilibrium/ghost_stabilization.h>
#include <talus/equilibrium/internal_forces.h>
#include <talus/equilibrium/linear_solver.h>
#include <talus/equilibrium/static_contact.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

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



  /// The displacements of one load step, for which stress and loads balance, by
  /// Newton's method with the consistent tangent @cite simo1998. The residual is
  ///   r = f_ext - (1 - share) (f_ext + c - f_int(0)) + friction - f_int(u)
  ///       - ghost,
  /// where f_ext + c - f_int(0) is what the points have out of balance now, c
  /// the force of the seabed on them so far: the step takes the share of it.
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
    };

    /// How solve() ended.
    struct Outcome
    {
      bool        converged = false;
      std::string failure; ///< the sentence, if not
    };

    using Observer = std::function<void(const NewtonIteration &)>;

    Newton(const LinearSolver &linear_solver)
      : linear_solver_(linear_solver)
    {}

    /// Set up the unknowns of the soil as it is now. Collective.
    void
    begin(StaticProblem<dim> &problem, const Parameters &parameters);

    /// Force out of balance, as the dynamics would meet it: Euclidean norm over
    /// the free unknowns, of the reference force. Collective.
    double
    imbalance() const;

    /// The largest such force of a node, N, and where, in words. Collective.
    std::pair<double, std::string>
    largest_imbalance() const;

    /// Find the displacements. Where that fails the soil is as before.
    /// Collective.
    Outcome
    solve(StaticProblem<dim> &problem, double share, const Observer &observe);

    /// Make what was found the state of the points; with large strain they move.
    void
    commit(StaticProblem<dim> &problem);

    /// How the soil moves where it fails, at the points, dim numbers each,
    /// divided by the largest of all: the displacement of the last load step
    /// or, where Newton's method failed, its last correction, which shows what a
    /// nearly singular matrix lets move. Points must be as in begin().
    /// Collective.
    std::vector<double>
    mechanism(const Points<dim> &points) const;

    const StaticContact<dim> &
    contact() const
    {
      return contact_;
    }

    /// To be called before begin(), with the points that it belongs to.
    void
    set_contact(const StaticContact<dim> &contact)
    {
      contact_ = contact;
    }

    unsigned long
    n_unknowns() const
    {
      return unknowns_.n_global();
    }

    /// What solves the linear systems.
    std::string
    linear_solver() const
    {
      return linear_solver_.choice(n_unknowns(), dim, is_symmetric());
    }

  private:
    bool
    is_symmetric() const
    {
      return parameters_.measure == StrainMeasure::small;
    }

    void
    assemble_matrix();
    RigidModes
    free_rigid_modes() const;
    std::vector<double>
    out_of_balance() const;
    void
    make_pattern();
    void
    make_rigid_modes(const Grid<dim> &grid);
    bool
    evaluate(StaticProblem<dim> &problem, const std::vector<double> &u);
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
    std::vector<double>
    at_points(const Points<dim>         &points,
              const std::vector<double> &field) const;
    Outcome
    failure(const std::string &reason) const;
    std::string
    where_largest(const std::vector<double> &force, double &largest) const;

    const LinearSolver     &linear_solver_;
    Parameters              parameters_;
    Unknowns<dim>           unknowns_;
    ShapeFunctionCache<dim> weights_;
    InternalForces<dim>     internal_forces_{StrainMeasure::small};
    GhostStabilization<dim> ghost_;
    StaticContact<dim>      contact_;

    dealii::TrilinosWrappers::SparseMatrix matrix_;
    RigidModes                             modes_;
    std::vector<dealii::Point<dim>>        places_;
    double                                 extent_ = 0; ///< of the mesh, m

    // Fields at the nodes
    std::vector<double> unbalanced_;      ///< f_ext - f_int(0), N
    std::vector<double> internal_;        ///< f_int(0), N
    std::vector<double> of_facets_;       ///< force of obstacles at u = 0, N
    std::vector<double> target_;          ///< what f_int + ghost are to be, N
    std::vector<double> residual_;        ///< N
    std::vector<double> u_;               ///< m
    std::vector<double> last_correction_; ///< m
    std::vector<double> mechanism_;       ///< m, of the last solve()
    double              reference_ = 0;   ///< N
    /// Whether the last correction was so large that the soil moves freely.
    bool moves_freely_ = false;
  };
} // namespace talus

#endif

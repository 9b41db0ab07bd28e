// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_equations_h
#define talus_equilibrium_static_equations_h

#include <talus/equilibrium/ghost_stabilization.h>
#include <talus/equilibrium/internal_forces.h>
#include <talus/equilibrium/linear_solver.h>
#include <talus/equilibrium/static_contact.h>
#include <talus/equilibrium/stiffness_matrix.h>
#include <talus/equilibrium/well_balanced_load.h>

#include <deal.II/lac/trilinos_vector.h>

#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Discrete equations of one load step: residual and tangent at given
  /// displacements of the nodes. The residual is
  ///   r = f_ext - (1 - share) (f_ext + c(0) - f_int(0)) + c(u) - f_int(u)
  ///       - ghost,
  /// where c is the force of contact on the soil, f_ext + c(0) - f_int(0) the
  /// imbalance at the start of the step, and `share` the fraction of the
  /// imbalance removed in the step. With a well-balanced
  /// load, f_ext is the load minus its error E. Fields have dim components for
  /// each node of Unknowns.
  template <int dim>
  class StaticEquations
  {
  public:
    /// Set up the equations for the current state of the soil. Collective.
    void
    begin(StaticProblem<dim> &problem, const StaticOptions &options);

    /// Return whether the loads of this load step are well-balanced.
    bool
    has_well_balanced_load() const
    {
      return is_well_balanced_ && !well_balanced_.forces().empty();
    }

    const WellBalancedLoad<dim> &
    well_balanced_load() const
    {
      return well_balanced_;
    }

    /// Euclidean norm of the error E subtracted from the loads, over the norm
    /// of the loads [-]. Collective.
    double
    well_balanced_share() const;

    /// Set the fraction @p share of the imbalance to be removed in the step
    /// [-].
    void
    set_load_fraction(double share);

    /// Hold the unknowns that walls and contact hold in their current state.
    void
    constrain(const StaticProblem<dim> &problem);

    /// Compute the residual. Collective.
    /// @param problem Soil, loads and boundaries.
    /// @param u Displacements, m; solve_tangent() uses the tangent at @p u.
    /// @param residual Residual, N.
    void
    compute_residual(StaticProblem<dim>        &problem,
                     const std::vector<double> &u,
                     std::vector<double>       &residual);

    /// Result of solve_tangent().
    struct Correction
    {
      std::vector<double> field;        ///< displacements, m
      double              largest;      ///< component over all ranks, m
      unsigned int        n_iterations; ///< by the linear solver
      std::string         failure;      ///< end of a sentence; empty: solved
    };

    /// Solve K du = @p residual for the displacements du, or again, with the
    /// matrix of the previous call, if @p keeps_matrix. Collective.
    Correction
    solve_tangent(const LinearSolver        &linear_solver,
                  const std::vector<double> &residual,
                  bool                       keeps_matrix = false);

    /// Update the contact after a solution with the displacements @p u, m, and
    /// the @p residual, N; see StaticContact::update(). May correct @p u.
    /// Returns the number of changes. Collective.
    unsigned int
    update_contact(const StaticProblem<dim>  &problem,
                   const std::vector<double> &residual,
                   std::vector<double>       &u,
                   double                     tolerance);

    /// See StaticContact::stick_again(). Collective.
    unsigned int
    stick_again(const std::vector<double> &direction)
    {
      return contact_.stick_again(unknowns_, direction);
    }

    /// Apply the displacements @p u, m, to stress and internal variables of the
    /// points.
    void
    commit(StaticProblem<dim> &problem, const std::vector<double> &u);

    /// Norm of the unbalanced force at u = 0 over the reference force [-]. The
    /// unbalanced force is the nodal force of the explicit scheme, minus the
    /// error of a well-balanced load; Euclidean norm over the free unknowns.
    /// Collective.
    double
    imbalance() const;

    /// Largest component of @p force, N, at the free unknowns of all ranks, and
    /// the place of the node in words. Collective.
    std::pair<double, std::string>
    largest(const std::vector<double> &force) const;

    /// largest() of the unbalanced force. Collective.
    std::pair<double, std::string>
    largest_imbalance() const
    {
      return largest(unbalanced_);
    }

    /// Interpolate a nodal field to the points by the weights of the load step.
    /// Points must be unchanged since begin(). Returns dim components for each
    /// point on this rank.
    std::vector<double>
    at_points(const Points<dim>         &points,
              const std::vector<double> &field) const;

    /// Reference force: the larger norm of loads and internal forces, N.
    double
    reference_force() const
    {
      return reference_;
    }

    const Unknowns<dim> &
    unknowns() const
    {
      return unknowns_;
    }

    const StaticContact<dim> &
    contact() const
    {
      return contact_;
    }

    /// Contact of the points; change it only before begin().
    StaticContact<dim> &
    contact()
    {
      return contact_;
    }

    bool
    is_symmetric() const
    {
      return contact_.is_symmetric() && tangents_are_symmetric_;
    }

  private:
    void
    make_pattern();
    void
    find_forces(StaticProblem<dim> &problem);
    void
    assemble_matrix();
    RigidModes
    free_rigid_modes() const;

    Unknowns<dim>           unknowns_;
    ShapeFunctionCache<dim> weights_;
    InternalForces<dim>     internal_forces_;
    GhostStabilization<dim> ghost_;
    StaticContact<dim>      contact_;
    WellBalancedLoad<dim>   well_balanced_;
    bool                    is_well_balanced_       = false;
    bool                    tangents_are_symmetric_ = true;

    StiffnessMatrix<dim>            matrix_;
    LuFactorization                 factorization_{dim};
    std::vector<dealii::Point<dim>> places_; ///< places of the owned nodes, m
    dealii::Point<dim>              centre_; ///< centre of rigid rotations, m

    // Fields at the nodes
    std::vector<double> contact_at_start_; ///< c(0), N
    std::vector<double> unbalanced_;       ///< f_ext - E + c(0) - f_int(0), N
    std::vector<double> internal_;         ///< f_int(0), N
    std::vector<double> target_; ///< value required of f_int + ghost - c, N
    double              reference_ = 0; ///< N
    double              loads_     = 0; ///< Euclidean norm of the loads, N
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_equations_h
#define talus_equilibrium_static_equations_h

#include <talus/equilibrium/ghost_stabilization.h>
#include <talus/equilibrium/internal_forces.h>
#include <talus/equilibrium/linear_solver.h>
#include <talus/equilibrium/static_contact.h>
#include <talus/equilibrium/well_balanced_load.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// The discrete equations of one load step: residual and tangent at given
  /// displacements of the nodes. The residual is
  ///   r = f_ext - (1 - share) (f_ext + c - f_int(0)) + friction - f_int(u)
  ///       - ghost,
  /// where f_ext + c - f_int(0) is what the points have out of balance now, c
  /// the force of the seabed on them so far: the step takes the share of it.
  /// With a well-balanced load f_ext is the load less its error E.
  /// Fields have dim numbers for each node of Unknowns.
  template <int dim>
  class StaticEquations
  {
  public:
    /// Set up the unknowns of the soil as it is now; with small strain the load
    /// may be well-balanced (WellBalancedLoad). Collective.
    void
    begin(StaticProblem<dim> &problem,
          StrainMeasure       measure,
          double              ghost_penalty,
          bool                is_well_balanced = false);

    /// Compute the well-balanced load anew at the next begin(): points or mesh
    /// have changed.
    void
    forget_well_balanced_load()
    {
      well_balanced_.clear();
    }

    /// Whether the loads of this load step are well-balanced.
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

    /// Euclidean norm of what a well-balanced load subtracts from the loads, over
    /// that of the loads [-]. Collective.
    double
    well_balanced_share() const;

    /// The share of what is out of balance that the step takes.
    void
    take_share(double share);

    /// Hold what contact and walls hold now.
    void
    constrain(const StaticProblem<dim> &problem);

    /// Set the residual, N, at the displacements @p u, m, whose tangent
    /// solve_tangent() then takes. Returns false, with the residual as it was,
    /// if a point of any rank would be turned inside out. Collective.
    bool
    find_residual(StaticProblem<dim>        &problem,
                  const std::vector<double> &u,
                  std::vector<double>       &residual);

    /// What solve_tangent() found.
    struct Correction
    {
      std::vector<double> field;        ///< m
      double              largest;      ///< component over all ranks, m
      unsigned int        n_iterations; ///< of the linear solver
      std::string         failure;      ///< the end of a sentence, if it failed
    };

    /// Solve K du = @p residual. Collective.
    Correction
    solve_tangent(const LinearSolver        &linear_solver,
                  const std::vector<double> &residual);

    /// Look at the contact where the equations are solved, see
    /// StaticContact::update_active_set(), which may take back displacements.
    /// Returns how much of it changed. Collective.
    unsigned int
    update_contact(StaticProblem<dim>        &problem,
                   const std::vector<double> &residual,
                   std::vector<double>       &u);

    /// See StaticContact::stick_again(). Collective.
    unsigned int
    stick_again(const std::vector<double> &direction)
    {
      return contact_.stick_again(unknowns_, direction);
    }

    /// Make the displacements @p u part of the state of the points; with large
    /// strain they move.
    void
    commit(StaticProblem<dim> &problem, const std::vector<double> &u);

    /// Force out of balance at u = 0, as the dynamics would meet it but for what
    /// a well-balanced load subtracts: Euclidean norm over the free unknowns, of the reference force. Collective.
    double
    imbalance() const;

    /// The largest such force of a node, N, and where, in words. Collective.
    std::pair<double, std::string>
    largest_imbalance() const;

    /// Set the @p largest component of @p force, N, at a free unknown over all
    /// ranks. Returns the place of its node in words. Collective.
    std::string
    where_largest(const std::vector<double> &force, double &largest) const;

    /// A field interpolated to the points by the weights of the load step: dim
    /// numbers for each point of this rank. Points must be as in begin().
    std::vector<double>
    at_points(const Points<dim>         &points,
              const std::vector<double> &field) const;

    /// Of loads or stress, N.
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

    /// To be changed before begin() only: it belongs to the points.
    StaticContact<dim> &
    contact()
    {
      return contact_;
    }

    bool
    is_symmetric() const
    {
      return measure_ == StrainMeasure::small &&
             contact_.facets().is_symmetric();
    }

  private:
    void
    make_pattern();
    void
    make_rigid_modes(const Grid<dim> &grid);
    void
    find_forces(StaticProblem<dim> &problem);
    std::vector<double>
    out_of_balance() const;
    void
    assemble_matrix();
    RigidModes
    free_rigid_modes() const;

    StrainMeasure           measure_ = StrainMeasure::small;
    Unknowns<dim>           unknowns_;
    ShapeFunctionCache<dim> weights_;
    InternalForces<dim>     internal_forces_{StrainMeasure::small};
    GhostStabilization<dim> ghost_;
    StaticContact<dim>      contact_;
    WellBalancedLoad<dim>   well_balanced_;
    bool                    is_well_balanced_ = false;

    dealii::TrilinosWrappers::SparseMatrix matrix_;
    RigidModes                             modes_;
    std::vector<dealii::Point<dim>>        places_;

    // Fields at the nodes
    std::vector<double> unbalanced_;    ///< f_ext - E - f_int(0), N
    std::vector<double> internal_;      ///< f_int(0), N
    std::vector<double> of_facets_;     ///< force of obstacles at u = 0, N
    std::vector<double> target_;        ///< what f_int + ghost are to be, N
    double              reference_ = 0; ///< N
    double              loads_     = 0; ///< Euclidean norm, N
  };
} // namespace talus

#endif

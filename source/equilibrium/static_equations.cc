// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/static_equations.h>
#include <talus/grid/node_places.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Largest shear modulus of the bodies, Pa.
    template <int dim>
    double
    largest_shear_modulus(const StaticProblem<dim> &problem)
    {
      double result = 0;
      for (const Segment &segment : problem.state.points.segments())
        result = std::max(result,
                          problem.materials.of_body(segment.body)
                            .largest_shear_modulus(problem.state.points,
                                                   segment.begin,
                                                   segment.end));
      return Utilities::MPI::max(result, problem.state.grid.communicator());
    }
  } // namespace



  /// Set up everything that is constant within a load step: unknowns, weights,
  /// faces of the stabilization, pattern of the matrix, and the forces at
  /// u = 0. The order matters: the nodal sums select the nodes with
  /// unknowns; weights, faces and contact refer to the unknowns; the pattern
  /// needs all three. A pattern for each load step is cheap compared with the
  /// matrices of its iterations. Collective.
  template <int dim>
  void
  StaticEquations<dim>::begin(StaticProblem<dim>  &problem,
                              const StaticOptions &options)
  {
    is_well_balanced_       = options.is_well_balanced;
    tangents_are_symmetric_ = problem.materials.has_symmetric_tangents();
    places_                 = places_of_owned_nodes(problem.state.grid);
    sum_forces(problem);
    unknowns_.number(problem.state.nodes,
                     problem.state.grid,
                     problem.state.constants.mass_cutoff);
    weights_.compute(problem.state.points,
                     problem.state.grid,
                     problem.transfer.box_shape(),
                     unknowns_);
    const double modulus = largest_shear_modulus(problem);
    ghost_.find_faces(problem.state.grid,
                      unknowns_,
                      options.ghost_penalty,
                      modulus);
    contact_.begin(problem, unknowns_, modulus);
    constrain(problem);
    make_pattern();
    if (is_well_balanced_)
      well_balanced_.update(problem, weights_, contact_, unknowns_);
    find_forces(problem);
  }



  /// Compute internal forces, forces of contact and imbalance at u = 0.
  template <int dim>
  void
  StaticEquations<dim>::find_forces(StaticProblem<dim> &problem)
  {
    const std::vector<double> no_displacements = unknowns_.field();
    internal_ = unbalanced_ = contact_at_start_ = no_displacements;
    contact_.add_forces(1., no_displacements, contact_at_start_);
    unknowns_.add_to_owners(contact_at_start_);
    internal_forces_.evaluate(problem, weights_, no_displacements, internal_);
    unknowns_.add_to_owners(internal_);
    double external = 0, internal = 0;
    for (const unsigned int node : unknowns_.active_nodes())
      {
        const Tensor<1, dim> force = problem.state.nodes.force(node);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = dim * node + d;
            unbalanced_[i]       = force[d];
            // Include held components: the seabed bears most of the weight of
            // the soil, and the forces at free nodes alone may be close to
            // zero.
            internal += internal_[i] * internal_[i];
            external += std::pow(unbalanced_[i] + internal_[i], 2);
            if (has_well_balanced_load())
              unbalanced_[i] -= well_balanced_.forces()[i];
          }
      }
    const MPI_Comm communicator = problem.state.grid.communicator();
    internal                    = Utilities::MPI::sum(internal, communicator);
    external                    = Utilities::MPI::sum(external, communicator);
    loads_                      = std::sqrt(external);
    // The force of contact is known, hence a load.
    for (std::size_t i = 0; i < unbalanced_.size(); ++i)
      unbalanced_[i] += contact_at_start_[i];
    // Take the larger of loads and stress: soil without weight may have a
    // stress, and soil not yet stressed has loads.
    reference_ = std::sqrt(std::max(internal, external));
  }



  template <int dim>
  double
  StaticEquations<dim>::well_balanced_share() const
  {
    double square = 0;
    if (has_well_balanced_load())
      for (const unsigned int node : unknowns_.active_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          square += std::pow(well_balanced_.forces()[dim * node + d], 2);
    const double norm =
      std::sqrt(Utilities::MPI::sum(square, unknowns_.communicator()));
    return loads_ > 0. ? norm / loads_ : 0.;
  }



  /// Couple all unknowns that the points of a cell touch. The pattern serves
  /// all matrices of the step. Collective.
  template <int dim>
  void
  StaticEquations<dim>::make_pattern()
  {
    factorization_.clear();
    matrix_.begin_pattern(unknowns_);
    for (unsigned int c = 0; c < weights_.cells().size(); ++c)
      matrix_.couple(weights_.nodes(c));
    ghost_.couple(matrix_);
    contact_.couple(matrix_);
    matrix_.finish_pattern();
  }



  /// The norm leaves out held components.
  template <int dim>
  double
  StaticEquations<dim>::imbalance() const
  {
    const double norm = unknowns_.norm(unbalanced_);
    return norm == 0. ? 0. : norm / reference_;
  }



  /// The place is reported by the first of the ranks with the largest
  /// component.
  template <int dim>
  std::pair<double, std::string>
  StaticEquations<dim>::largest(const std::vector<double> &force) const
  {
    double     own = 0;
    Point<dim> place;
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        // Treat a value that is not a number as the largest.
        if (!(std::abs(force[dim * node + d]) <= own) && !std::isnan(own))
          {
            own   = std::abs(force[dim * node + d]);
            place = places_[node];
          }
      });
    const MPI_Comm     communicator = unknowns_.communicator();
    const double       largest      = Utilities::MPI::max(own, communicator);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int owner =
      // If the largest value is not a number, it equals no value on any rank;
      // then rank 0 answers, so that the broadcast has a root.
      Utilities::MPI::min(own == largest ? rank : n_ranks, communicator);
    return {largest,
            Utilities::MPI::broadcast(communicator,
                                      text('(', place, ") m"),
                                      owner == n_ranks ? 0 : owner)};
  }



  /// The target of f(u) + K_g u - c(u) is
  ///   f(0) - c(0) + s (f_ext + c(0) - f(0)),
  /// with the fraction s of the load step and the force c of seabed and
  /// obstacles: inserted into the residual of doc/method.md, section 12. With
  /// s = 1 the target is f_ext for any c(0).
  template <int dim>
  void
  StaticEquations<dim>::set_load_fraction(const double share)
  {
    target_ = internal_;
    for (std::size_t i = 0; i < target_.size(); ++i)
      target_[i] += share * unbalanced_[i] - contact_at_start_[i];
  }



  template <int dim>
  void
  StaticEquations<dim>::constrain(const StaticProblem<dim> &problem)
  {
    unknowns_.constrain(contact_.held(problem, unknowns_));
  }



  template <int dim>
  unsigned int
  StaticEquations<dim>::update_contact(const StaticProblem<dim>  &problem,
                                       const std::vector<double> &residual,
                                       std::vector<double>       &u,
                                       const double               tolerance)
  {
    const unsigned int n_changed =
      contact_.update(problem, unknowns_, residual, u, tolerance);
    if (n_changed > 0)
      unknowns_.copy_to_ghosts(u);
    return n_changed;
  }



  /// Compute
  ///   r = target + c(u) - f(u) - K_g u
  /// at all nodes; at held nodes -r is the change of c.
  template <int dim>
  void
  StaticEquations<dim>::compute_residual(StaticProblem<dim>        &problem,
                                         const std::vector<double> &u,
                                         std::vector<double>       &residual)
  {
    std::vector<double> forces = unknowns_.field();
    internal_forces_.evaluate(problem, weights_, u, forces);
    ghost_.add_forces(u, forces);
    contact_.add_forces(-1., u, forces);
    unknowns_.add_to_owners(forces);
    residual = target_;
    for (std::size_t i = 0; i < residual.size(); ++i)
      residual[i] -= forces[i];
  }



  /// Assemble the tangent at the displacements of the last residual.
  /// Collective.
  template <int dim>
  void
  StaticEquations<dim>::assemble_matrix()
  {
    matrix_.clear();
    internal_forces_.add_tangent(weights_, matrix_);
    ghost_.add_to_matrix(matrix_);
    contact_.add_to_matrix(matrix_);
    matrix_.finish(1e-13);
  }



  /// Compute translations and rotations about the axes, in the order of the
  /// unknowns of this rank, as ML expects. The centre of rotation is a corner
  /// of the mesh, the same on all ranks: different centres would give different
  /// modes. Held components, which change with the contact, are zero: otherwise
  /// multigrid would try to represent on its coarse levels motions that walls
  /// prevent.
  template <int dim>
  RigidModes
  StaticEquations<dim>::free_rigid_modes() const
  {
    RigidModes modes(dim == 2 ? 3 : 6);
    for (const unsigned int node : unknowns_.active_nodes())
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Tensor<1, dim> x       = places_[node] - centre_;
          const double         is_free = !unknowns_.is_constrained(node, d);
          for (unsigned int e = 0; e < dim; ++e)
            modes[e].push_back(d == e ? is_free : 0.);
          // Rotation in the plane of axes a and b.
          unsigned int mode = dim;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = a + 1; b < dim; ++b)
              modes[mode++].push_back(is_free * (d == a   ? -x[b]
                                                 : d == b ? x[a]
                                                          : 0.));
        }
    return modes;
  }



  /// Held components have no correction. A value that is not a number remains
  /// the largest.
  template <int dim>
  typename StaticEquations<dim>::Correction
  StaticEquations<dim>::solve_tangent(const LinearSolver        &linear_solver,
                                      const std::vector<double> &residual,
                                      const bool                 keeps_matrix)
  {
    if (!keeps_matrix)
      assemble_matrix();
    TrilinosWrappers::MPI::Vector rhs(unknowns_.owned(),
                                      unknowns_.communicator());
    TrilinosWrappers::MPI::Vector solution(rhs);
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        rhs(unknowns_.first(node) + d) = residual[dim * node + d];
      });
    rhs.compress(VectorOperation::insert);
    const RigidModes     modes   = free_rigid_modes();
    const LinearSolution outcome = linear_solver.solve({matrix_.matrix(),
                                                        factorization_,
                                                        modes,
                                                        dim,
                                                        is_symmetric(),
                                                        keeps_matrix},
                                                       solution,
                                                       rhs);
    Correction           result{unknowns_.field(),
                      0.,
                      outcome.n_iterations,
                      outcome.failure};
    if (!outcome.failure.empty())
      return result;
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        const double x               = solution(unknowns_.first(node) + d);
        result.field[dim * node + d] = x;
        if (!(std::abs(x) <= result.largest) && !std::isnan(result.largest))
          result.largest = std::abs(x);
      });
    result.largest =
      Utilities::MPI::max(result.largest, unknowns_.communicator());
    unknowns_.copy_to_ghosts(result.field);
    return result;
  }



  template <int dim>
  std::vector<double>
  StaticEquations<dim>::at_points(const Points<dim>         &points,
                                  const std::vector<double> &field) const
  {
    std::vector<double> result(dim * std::size_t(points.size()), 0.);
    weights_.for_each_weight(
      [&](const unsigned int p, const unsigned int node, const double weight) {
        for (unsigned int d = 0; d < dim; ++d)
          result[dim * p + d] += weight * field[dim * node + d];
      });
    return result;
  }



  /// Apply the laws once more to the strain of the whole load step, from the
  /// state at its start. Trials of the iterations leave no trace in the state,
  /// so the result does not depend on the path to u. Only stress and internal
  /// variables change: the dynamics starts with the same points, boxes and
  /// nodes.
  template <int dim>
  void
  StaticEquations<dim>::commit(StaticProblem<dim>        &problem,
                               const std::vector<double> &u)
  {
    contact_.commit(problem, u);
    Points<dim> &points = problem.state.points;
    // Set the gradients of u, as the last evaluation may be at different
    // displacements.
    internal_forces_.set_gradients(problem, weights_, u);
    problem.materials.for_each_material_range(
      points,
      points.all(),
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        model.commit_load_step(points, problem.state.workspace, begin, end);
        model.pore_water().commit_load_step(points,
                                            problem.state.workspace,
                                            begin,
                                            end);
      });
  }



  template class StaticEquations<2>;
  template class StaticEquations<3>;
} // namespace talus

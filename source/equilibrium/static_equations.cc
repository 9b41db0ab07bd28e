// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/static_equations.h>
#include <talus/grid/node_places.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

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



  /// All that does not change within a load step: unknowns, weights, faces of
  /// the stabilization, pattern of the matrix, rigid modes, and the forces at u
  /// = 0. The order matters: the nodal sums tell which nodes have enough mass
  /// for unknowns; weights, faces and contact know their nodes by these; the
  /// pattern needs all three. A pattern per load step costs little against the
  /// matrices of its iterations, and with large strain points touch other nodes
  /// in each. Collective.
  template <int dim>
  void
  StaticEquations<dim>::begin(StaticProblem<dim> &problem,
                              const StrainMeasure measure,
                              const double        ghost_penalty,
                              const bool          is_well_balanced)
  {
    measure_          = measure;
    is_well_balanced_ = is_well_balanced && measure == StrainMeasure::small;
    internal_forces_  = InternalForces<dim>(measure);
    places_           = places_of_owned_nodes(problem.state.grid);
    sum_forces(problem);
    unknowns_.number(problem.state.nodes,
                     problem.state.grid,
                     problem.state.constants.mass_cutoff);
    weights_.compute(problem.state.points,
                     problem.state.grid,
                     problem.transfer.box_shape(),
                     unknowns_);
    const double modulus = largest_shear_modulus(problem);
    ghost_.find_faces(problem.state.grid, unknowns_, ghost_penalty, modulus);
    contact_.begin(problem, unknowns_, modulus);
    constrain(problem);
    make_pattern();
    make_rigid_modes(problem.state.grid);
    if (is_well_balanced_ && !well_balanced_.is_computed())
      well_balanced_.compute(problem, weights_, contact_.facets(), unknowns_);
    find_forces(problem);
  }



  /// Internal forces, those of obstacles and what is out of balance, at u = 0.
  template <int dim>
  void
  StaticEquations<dim>::find_forces(StaticProblem<dim> &problem)
  {
    const std::vector<double> no_displacements = unknowns_.field();
    internal_                                  = unknowns_.field();
    unbalanced_                                = unknowns_.field();
    of_facets_.clear();
    if (!problem.contact.obstacles().empty())
      {
        of_facets_ = unknowns_.field();
        contact_.facets().add_forces(1., no_displacements, of_facets_);
        unknowns_.add_to_owners(of_facets_);
      }
    // Without displacements no point can be turned inside out.
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
            // Held components count here, too: most of the weight of soil on a
            // seabed is borne there, and free nodes alone may have next to
            // nothing to compare with.
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
    // The larger of loads and stress: soil without weight may have a stress,
    // and soil that is not yet stressed has loads.
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



  /// All unknowns that the points of a cell touch are coupled. Held ones keep
  /// their places: nodes of the seabed begin to stick or slip within a load
  /// step, and the pattern serves all its matrices. Rows of other ranks' nodes
  /// are sent to them by compress(). Collective.
  template <int dim>
  void
  StaticEquations<dim>::make_pattern()
  {
    // Trilinos' own pattern: deal.II's function that makes a matrix from a
    // DynamicSparsityPattern is no inline one, and clang has another name for it
    // than GCC, which compiled deal.II.
    TrilinosWrappers::SparsityPattern    pattern(unknowns_.owned(),
                                              unknowns_.owned(),
                                              unknowns_.relevant(),
                                              unknowns_.communicator());
    std::vector<types::global_dof_index> indices;
    for (unsigned int c = 0; c < weights_.cells().size(); ++c)
      {
        const auto patch = weights_.patch(c);
        indices.clear();
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            indices.push_back(unknowns_.first(patch.nodes[a]) + d);
        unknowns_.constraints().add_entries_local_to_global(indices,
                                                            pattern,
                                                            true);
      }
    ghost_.add_to_pattern(unknowns_, pattern);
    contact_.facets().add_to_pattern(unknowns_, pattern);
    pattern.compress();
    matrix_.reinit(pattern);
  }



  /// Translations and rotations about the axes, seen from the lower corner.
  /// In the order of this rank's unknowns, as ML wants them. The origin is the
  /// corner of the mesh, on all ranks the same: rotations about different
  /// points would be different modes.
  template <int dim>
  void
  StaticEquations<dim>::make_rigid_modes(const Grid<dim> &grid)
  {
    modes_.assign(dim == 2 ? 3 : 6, {});
    for (const unsigned int node : unknowns_.active_nodes())
      {
        const Tensor<1, dim> x = places_[node] - grid.domain().lower;
        for (unsigned int d = 0; d < dim; ++d)
          {
            for (unsigned int e = 0; e < dim; ++e)
              modes_[e].push_back(d == e ? 1. : 0.);
            // In the plane of axes a and b.
            unsigned int mode = dim;
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = a + 1; b < dim; ++b)
                modes_[mode++].push_back(d == a ? -x[b] : d == b ? x[a] : 0.);
          }
      }
  }



  /// Slipping nodes are free, and their friction is known: it is a load as any
  /// other, and so is what obstacles bear.
  template <int dim>
  std::vector<double>
  StaticEquations<dim>::out_of_balance() const
  {
    std::vector<double> force = unbalanced_;
    for (std::size_t i = 0; i < of_facets_.size(); ++i)
      force[i] += of_facets_[i];
    contact_.add_friction(force);
    return force;
  }



  /// What held components bear is left out by the norm.
  template <int dim>
  double
  StaticEquations<dim>::imbalance() const
  {
    const double norm = unknowns_.norm(out_of_balance());
    return norm == 0. ? 0. : norm / reference_;
  }



  /// Largest component, N, at a free unknown over all ranks, and the place of
  /// its node in words. Of several ranks with the same value the first one
  /// tells the place. Collective.
  template <int dim>
  std::string
  StaticEquations<dim>::where_largest(const std::vector<double> &force,
                                      double                    &largest) const
  {
    double     own = 0;
    Point<dim> place;
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        // Not a number counts as large.
        if (!(std::abs(force[dim * node + d]) <= own) && !std::isnan(own))
          {
            own   = std::abs(force[dim * node + d]);
            place = places_[node];
          }
      });
    const MPI_Comm communicator = unknowns_.communicator();
    largest                     = Utilities::MPI::max(own, communicator);
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int owner =
      // No rank compares equal to what is not a number; then rank 0 answers, so
      // that the broadcast has a root in any case.
      Utilities::MPI::min(own == largest ? rank : n_ranks, communicator);
    return Utilities::MPI::broadcast(communicator,
                                     text('(', place, ") m"),
                                     owner == n_ranks ? 0 : owner);
  }



  template <int dim>
  std::pair<double, std::string>
  StaticEquations<dim>::largest_imbalance() const
  {
    std::pair<double, std::string> result;
    result.second = where_largest(out_of_balance(), result.first);
    return result;
  }



  /// The target of f(u) + K_g u is f(0) + s (f_ext - f(0)) - (1 - s) c, with
  /// share s of the load step and the force c that seabed and obstacles bore
  /// before: put into the residual of doc/method.md, section 12. With s = 1 it
  /// is f_ext, whatever was borne before.
  template <int dim>
  void
  StaticEquations<dim>::take_share(const double share)
  {
    target_ = internal_;
    for (std::size_t i = 0; i < target_.size(); ++i)
      target_[i] += share * unbalanced_[i];
    contact_.add_contact_force(-(1. - share), target_);
    for (std::size_t i = 0; i < of_facets_.size(); ++i)
      target_[i] -= (1. - share) * of_facets_[i];
  }



  template <int dim>
  void
  StaticEquations<dim>::constrain(const StaticProblem<dim> &problem)
  {
    unknowns_.constrain(contact_.constrained(problem, unknowns_));
  }



  /// Held nodes bear what is left of the residual.
  template <int dim>
  unsigned int
  StaticEquations<dim>::update_contact(StaticProblem<dim>        &problem,
                                       const std::vector<double> &residual,
                                       std::vector<double>       &u)
  {
    std::vector<double> reaction = residual;
    for (double &force : reaction)
      force = -force;
    const unsigned int n_changed =
      contact_.update_active_set(problem, unknowns_, reaction, u);
    if (n_changed > 0)
      unknowns_.copy_to_ghosts(u);
    return n_changed;
  }



  /// Set the residual at the displacements @p u. Returns false if a point of any
  /// rank would be turned inside out.
  /// Collective: all ranks take the same way, since a rank that went on alone
  /// would wait for messages for ever.
  ///   r = target + friction - f(u) - K_g u + forces of obstacles(u)
  /// at all nodes; at held ones -r is the reaction.
  template <int dim>
  bool
  StaticEquations<dim>::find_residual(StaticProblem<dim>        &problem,
                                      const std::vector<double> &u,
                                      std::vector<double>       &residual)
  {
    std::vector<double> forces = unknowns_.field();
    const bool sound = internal_forces_.evaluate(problem, weights_, u, forces);
    if (!Utilities::MPI::logical_or(!sound, unknowns_.communicator()))
      {
        ghost_.add_forces(u, forces);
        contact_.facets().add_forces(-1., u, forces);
        unknowns_.add_to_owners(forces);
        residual = target_;
        contact_.add_friction(residual);
        for (std::size_t i = 0; i < residual.size(); ++i)
          residual[i] -= forces[i];
        return true;
      }
    return false;
  }



  /// The tangent of the step at the present displacements. Collective.
  template <int dim>
  void
  StaticEquations<dim>::assemble_matrix()
  {
    matrix_ = 0.;
    internal_forces_.add_tangent(weights_, unknowns_, matrix_);
    ghost_.add_to_matrix(unknowns_, matrix_);
    contact_.facets().add_to_matrix(unknowns_, matrix_);
    matrix_.compress(VectorOperation::add);
    // Where soil can move freely the solution is to be large, not infinite.
    for (const auto i : unknowns_.owned())
      matrix_.add(i, i, 1e-13 * matrix_.diag_element(i));
    matrix_.compress(VectorOperation::add);
  }



  /// The rigid modes, as the solver may use them. Those of the step know nothing
  /// of what is held, which changes while the contact is sought.
  template <int dim>
  RigidModes
  StaticEquations<dim>::free_rigid_modes() const
  {
    // At held components the modes are zero as the displacements are: multigrid
    // would else try to represent on its coarse levels what the walls forbid.
    RigidModes free_modes = modes_;
    for (auto &mode : free_modes)
      {
        unsigned int i = 0;
        for (const unsigned int node : unknowns_.active_nodes())
          for (unsigned int d = 0; d < dim; ++d, ++i)
            if (unknowns_.is_constrained(node, d))
              mode[i] = 0.;
      }
    return free_modes;
  }



  /// Held components have no correction. What is not a number stays the largest
  /// one.
  template <int dim>
  typename StaticEquations<dim>::Correction
  StaticEquations<dim>::solve_tangent(const LinearSolver        &linear_solver,
                                      const std::vector<double> &residual)
  {
    assemble_matrix();
    TrilinosWrappers::MPI::Vector rhs(unknowns_.owned(),
                                      unknowns_.communicator());
    TrilinosWrappers::MPI::Vector solution(rhs);
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        rhs(unknowns_.first(node) + d) = residual[dim * node + d];
      });
    rhs.compress(VectorOperation::insert);
    const LinearSolution outcome = linear_solver.solve(
      matrix_, solution, rhs, free_rigid_modes(), dim, is_symmetric());
    Correction result{unknowns_.field(),
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



  /// A nodal field with dim components, interpolated to the points by the
  /// weights of the load step: dim numbers for each point of this rank.
  template <int dim>
  std::vector<double>
  StaticEquations<dim>::at_points(const Points<dim>         &points,
                                  const std::vector<double> &field) const
  {
    std::vector<double> result(dim * std::size_t(points.size()), 0.);
    for (unsigned int c = 0; c < weights_.cells().size(); ++c)
      {
        const Batch &cell  = weights_.cells()[c];
        const auto   patch = weights_.patch(c);
        for (unsigned int p = cell.begin; p < cell.end; ++p)
          {
            const auto *weight = weights_.of_point(c, p - cell.begin);
            for (unsigned int a = 0; a < patch.n_nodes; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                result[dim * p + d] +=
                  weight[a].value * field[dim * patch.nodes[a] + d];
          }
      }
    return result;
  }



  /// The laws go once more through the strain of the whole load step, from the
  /// state at its beginning: trials of the iterations have left no trace in it,
  /// so the result does not depend on the way by which u was found. With small
  /// strain stress and internal variables change, points and boxes do not: the
  /// nodes that are balanced are those on which the dynamics begins.
  template <int dim>
  void
  StaticEquations<dim>::commit(StaticProblem<dim>        &problem,
                               const std::vector<double> &u)
  {
    contact_.facets().commit(problem, u, measure_);
    Points<dim> &points = problem.state.points;
    // Whatever displacements were evaluated last.
    internal_forces_.set_gradients(problem, weights_, u);
    problem.materials.for_each_material_range(
      points,
      points.all(),
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        model.commit_load_step(
          points, problem.state.workspace, begin, end, measure_);
      });
    if (measure_ == StrainMeasure::small)
      return;
    const std::vector<double> moved = at_points(points, u);
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points.data(points.position, d)[p] += moved[dim * p + d];
    // The gradient is that of the whole step, so dt = 1.
    update_stretch(points,
                   problem.state.workspace,
                   0,
                   points.size(),
                   problem.transfer.box_shape().rule,
                   /*dt=*/1.);
  }



  template class StaticEquations<2>;
  template class StaticEquations<3>;
} // namespace talus

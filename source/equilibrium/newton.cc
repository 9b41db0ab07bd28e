// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/newton.h>
#include <talus/grid/node_places.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <chrono>
#include <cmath>

namespace talus
{
  using namespace dealii;

  /// Slipping nodes are free, and their friction is known: it is a load as any
  /// other, and so is what obstacles bear.
  template <int dim>
  std::vector<double>
  Newton<dim>::out_of_balance() const
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
  Newton<dim>::imbalance() const
  {
    const double norm = unknowns_.norm(out_of_balance());
    return norm == 0. ? 0. : norm / reference_;
  }



  /// Largest component, N, at a free unknown over all ranks, and the place of
  /// its node in words. Of several ranks with the same value the first one
  /// tells the place. Collective.
  template <int dim>
  std::string
  Newton<dim>::where_largest(const std::vector<double> &force,
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
  Newton<dim>::largest_imbalance() const
  {
    std::pair<double, std::string> result;
    result.second = where_largest(out_of_balance(), result.first);
    return result;
  }



  /// Set the residual at the displacements @p u. Returns false if a point of any
  /// rank would be turned inside out.
  /// Collective: all ranks take the same way, since a rank that went on alone
  /// would wait for messages for ever.
  ///   r = target + friction - f(u) - K_g u + forces of obstacles(u)
  /// at all nodes; at held ones -r is the reaction.
  template <int dim>
  bool
  Newton<dim>::evaluate(StaticProblem<dim>        &problem,
                        const std::vector<double> &u)
  {
    std::vector<double> forces = unknowns_.field();
    const bool sound = internal_forces_.evaluate(problem, weights_, u, forces);
    if (!Utilities::MPI::logical_or(!sound, unknowns_.communicator()))
      {
        ghost_.add_forces(u, forces);
        contact_.facets().add_forces(-1., u, forces);
        unknowns_.add_to_owners(forces);
        residual_ = target_;
        contact_.add_friction(residual_);
        for (std::size_t i = 0; i < residual_.size(); ++i)
          residual_[i] -= forces[i];
        return true;
      }
    return false;
  }



  /// A sentence with the largest residual force and its place: where the soil
  /// fails, this is where to look. Collective.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::failure(const std::string &reason) const
  {
    double            largest;
    const std::string place = where_largest(residual_, largest);
    return {false,
            text(reason,
                 "; the largest residual force of a node is ",
                 largest,
                 " N, at ",
                 place)};
  }



  /// The target of f(u) + K_g u is f(0) + s (f_ext - f(0)) - (1 - s) c, with
  /// share s of the load step and the force c that seabed and obstacles bore
  /// before: put
  /// into the residual of doc/method.md, section 12. With s = 1 it is f_ext,
  /// whatever was borne before.
  ///
  /// Only displacements and contact change here. Contact is restored where the
  /// step fails, so that a shorter one starts from the same state.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::solve(StaticProblem<dim> &problem,
                     const double        share,
                     const Observer     &observe)
  {
    target_ = internal_;
    for (std::size_t i = 0; i < target_.size(); ++i)
      target_[i] += share * unbalanced_[i];
    contact_.add_contact_force(-(1. - share), target_);
    for (std::size_t i = 0; i < of_facets_.size(); ++i)
      target_[i] -= (1. - share) * of_facets_[i];
    u_                               = unknowns_.field();
    const StaticContact<dim> before  = contact_;
    const Outcome            outcome = solve_with_contact(problem, observe);
    if (!outcome.converged)
      contact_ = before;
    return outcome;
  }



  /// Newton's method with the states of the seabed's nodes (stick, slip, open)
  /// held fixed, then a look at the nodes, until none changes: within a loop
  /// the problem is smooth, so that convergence is quadratic, and the matrix of
  /// small strain stays symmetric, which it would not with friction as a
  /// function of the normal force. The next loop starts from the displacements
  /// of the last one. The number of rounds is limited since a set of states may
  /// come back.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::solve_with_contact(StaticProblem<dim> &problem,
                                  const Observer     &observe)
  {
    // A node of the seabed may change its mind some times.
    for (unsigned int trial = 0; trial < 50; ++trial)
      {
        unknowns_.constrain(contact_.constrained(problem, unknowns_));
        const Outcome outcome = newton_loop(problem, observe);
        if (!outcome.converged)
          {
            // Soil that is held by slipping nodes only has a singular matrix.
            // Friction that would push it on turns around as soon as it moves:
            // those nodes can bear it.
            if (moves_freely_ &&
                contact_.stick_again(unknowns_, last_correction_) > 0)
              continue;
            mechanism_ = last_correction_;
            return outcome;
          }
        // Converged: held nodes bear what is left of the residual.
        mechanism_                   = u_;
        std::vector<double> reaction = residual_;
        for (double &force : reaction)
          force = -force;
        if (contact_.update_active_set(problem, unknowns_, reaction, u_) == 0)
          return outcome;
        unknowns_.copy_to_ghosts(u_);
      }
    return failure(
      "The contact with seabed and obstacles does not come to rest");
  }



  /// Ends with a residual below the tolerance, after the largest number of
  /// iterations, or where the residual is no number. The last two are failures
  /// of this load step, not of the run. norm is that of all ranks, so all of
  /// them leave together. The residual is over the force of the loads
  /// (reference_), and not over that of the first iteration: a load step that
  /// begins nearly in balance could not reduce its residual by eight orders.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::newton_loop(StaticProblem<dim> &problem, const Observer &observe)
  {
    if (!evaluate(problem, u_))
      return failure("A point would be turned inside out");
    for (unsigned int i = 0;; ++i)
      {
        // Soil without any force on it is in balance: 0/0 would not be.
        const double    norm = unknowns_.norm(residual_);
        NewtonIteration iteration{
          i, norm == 0. ? 0. : norm / reference_, 0, 0., 0.};
        const bool converged = (iteration.residual <= parameters_.tolerance);
        if (converged || i == parameters_.largest_iterations ||
            !std::isfinite(norm))
          {
            observe(iteration);
            return converged ? Outcome{true, ""}
                             : failure(text("Newton's method has not converged "
                                            "in ",
                                            i,
                                            " iterations: the residual is ",
                                            iteration.residual,
                                            " of the forces, where ",
                                            parameters_.tolerance,
                                            " was asked for"));
          }
        const std::string error = newton_update(problem, iteration);
        observe(iteration);
        if (!error.empty())
          return failure(
            text("Newton's method has no next iterate, since ", error));
      }
  }



  /// The tangent of the step at the present displacements. Collective.
  template <int dim>
  void
  Newton<dim>::assemble_matrix()
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
  Newton<dim>::free_rigid_modes() const
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



  /// The full Newton step, with a matrix made anew in each iteration: the
  /// tangent comes with the stress anyway, and a modified Newton method would
  /// lose the quadratic convergence. Three things may go wrong: the linear
  /// solver gives up; the correction is larger than ten times the mesh, so that
  /// the matrix was singular but for round-off and soil is a mechanism; or no
  /// point along the correction is sound. Collective.
  template <int dim>
  std::string
  Newton<dim>::newton_update(StaticProblem<dim> &problem,
                             NewtonIteration    &iteration)
  {
    const auto start = std::chrono::steady_clock::now();
    moves_freely_    = false;
    assemble_matrix();
    TrilinosWrappers::MPI::Vector rhs(unknowns_.owned(),
                                      unknowns_.communicator());
    TrilinosWrappers::MPI::Vector solution(rhs);
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        rhs(unknowns_.first(node) + d) = residual_[dim * node + d];
      });
    rhs.compress(VectorOperation::insert);
    const LinearSolution answer = linear_solver_.solve(
      matrix_, solution, rhs, free_rigid_modes(), dim, is_symmetric());
    iteration.n_linear_iterations = answer.n_iterations;
    if (!answer.failure.empty())
      return answer.failure;

    std::vector<double> direction = unknowns_.field();
    double              largest   = 0;
    unknowns_.for_each_free_dof(
      [&](const unsigned int node, const unsigned int d) {
        // Held components stay zero in direction: they have no correction.
        const double x            = solution(unknowns_.first(node) + d);
        direction[dim * node + d] = x;
        if (!(std::abs(x) <= largest) && !std::isnan(largest))
          largest = std::abs(x);
      });
    largest = Utilities::MPI::max(largest, unknowns_.communicator());
    unknowns_.copy_to_ghosts(direction);
    if (std::isfinite(largest))
      // Of a nearly singular matrix the correction is nearly the vector that it
      // maps to zero: the mechanism of failure, up to its size.
      last_correction_ = direction;
    // So written that it holds for what is not a number, too.
    moves_freely_ = !(largest < 10. * extent_);
    if (moves_freely_)
      return "the matrix is singular or nearly so: part of the soil can move "
             "freely";
    iteration.length = line_search(problem, direction);
    iteration.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
        .count();
    return iteration.length > 0. ? "" : "points would be turned inside out";
  }



  /// Go along @p direction until the work of the residual on it is small, and
  /// set displacements and residual. Returns how far, in units of the
  /// direction; 0 if no point along it is sound.
  /// For elastic soil the work of the residual on the direction is minus the
  /// derivative of the energy along it, and zero at its minimum. Plastic soil
  /// has no energy, but the work still says whether the step went too far. It
  /// is accepted when it fell by a fifth, or when the norm did: so loose that
  /// full steps are taken near the solution, where convergence is quadratic.
  /// Else the step goes to the root of the line through both values of the
  /// work, but to no less than a tenth and no more than a half. After six
  /// trials any sound step is taken, and the limit on iterations decides. Each
  /// trial costs one evaluation of all stresses. Collective.
  template <int dim>
  double
  Newton<dim>::line_search(StaticProblem<dim>        &problem,
                           const std::vector<double> &direction)
  {
    const double        work_before = unknowns_.product(direction, residual_);
    const double        norm_before = unknowns_.norm(residual_);
    std::vector<double> u           = u_;
    double              length      = 1.;
    for (unsigned int trial = 0; trial < 12; ++trial)
      {
        for (std::size_t i = 0; i < u.size(); ++i)
          u[i] = u_[i] + length * direction[i];
        if (!evaluate(problem, u))
          {
            // A point would be turned inside out, so there is no work to
            // interpolate.
            length *= 0.5;
            continue;
          }
        const double work = unknowns_.product(direction, residual_);
        if (std::abs(work) <= 0.8 * std::abs(work_before) ||
            unknowns_.norm(residual_) < norm_before || trial >= 6)
          {
            u_ = u;
            return length;
          }
        const double factor = work_before / (work_before - work);
        length *= std::clamp(std::isfinite(factor) ? factor : 0.1, 0.1, 0.5);
      }
    return 0.;
  }



  /// A nodal field with dim components, interpolated to the points by the
  /// weights of the load step: dim numbers for each point of this rank.
  template <int dim>
  std::vector<double>
  Newton<dim>::at_points(const Points<dim>         &points,
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



  /// The size of a mechanism means nothing, and of a nearly singular matrix
  /// depends on round-off: so it is divided by the largest component over all
  /// ranks.
  template <int dim>
  std::vector<double>
  Newton<dim>::mechanism(const Points<dim> &points) const
  {
    std::vector<double> result  = at_points(points, mechanism_);
    double              largest = 0;
    for (const double component : result)
      largest = std::max(largest, std::abs(component));
    largest = Utilities::MPI::max(largest, unknowns_.communicator());
    for (double &component : result)
      component /= (largest > 0. ? largest : 1.);
    return result;
  }



  /// The laws go once more through the strain of the whole load step, from the
  /// state at its beginning: trials of the iterations have left no trace in it,
  /// so the result does not depend on the way by which u was found. With small
  /// strain stress and internal variables change, points and boxes do not: the
  /// nodes that are balanced are those on which the dynamics begins.
  template <int dim>
  void
  Newton<dim>::commit(StaticProblem<dim> &problem)
  {
    contact_.facets().commit(problem, u_, parameters_.measure);
    Points<dim> &points = problem.state.points;
    // Whatever displacements were evaluated last.
    internal_forces_.set_gradients(problem, weights_, u_);
    problem.materials.for_each_material_range(
      points,
      points.all(),
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        model.commit_load_step(
          points, problem.state.workspace, begin, end, parameters_.measure);
      });
    if (parameters_.measure == StrainMeasure::small)
      return;
    const std::vector<double> u = at_points(points, u_);
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points.data(points.position, d)[p] += u[dim * p + d];
    // The gradient is that of the whole step, so dt = 1.
    update_stretch(points,
                   problem.state.workspace,
                   0,
                   points.size(),
                   problem.transfer.box_shape().rule,
                   /*dt=*/1.);
  }



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
  Newton<dim>::begin(StaticProblem<dim> &problem, const Parameters &parameters)
  {
    parameters_      = parameters;
    internal_forces_ = InternalForces<dim>(parameters.measure);
    places_          = places_of_owned_nodes(problem.state.grid);
    extent_          = problem.state.grid.domain().lower.distance(
      problem.state.grid.domain().upper);
    sum_forces(problem);
    unknowns_.number(problem.state.nodes,
                     problem.state.grid,
                     problem.state.mass_cutoff);
    weights_.compute(problem.state.points,
                     problem.state.grid,
                     problem.transfer.box_shape(),
                     unknowns_);
    const double modulus = largest_shear_modulus(problem);
    ghost_.find_faces(problem.state.grid,
                      unknowns_,
                      parameters.ghost_penalty,
                      modulus);
    contact_.begin(problem, unknowns_, modulus);
    unknowns_.constrain(contact_.constrained(problem, unknowns_));
    make_pattern();
    make_rigid_modes(problem.state.grid);

    u_ = last_correction_ = unknowns_.field();
    mechanism_.resize(u_.size(), 0.);
    internal_   = unknowns_.field();
    unbalanced_ = unknowns_.field();
    of_facets_.clear();
    if (!problem.contact.obstacles().empty())
      {
        of_facets_ = unknowns_.field();
        contact_.facets().add_forces(1., u_, of_facets_);
        unknowns_.add_to_owners(of_facets_);
      }
    // Without displacements no point can be turned inside out.
    internal_forces_.evaluate(problem, weights_, u_, internal_);
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
          }
      }
    // The larger of loads and stress: soil without weight may have a stress,
    // and soil that is not yet stressed has loads.
    reference_ = std::sqrt(std::max(
      Utilities::MPI::sum(internal, problem.state.grid.communicator()),
      Utilities::MPI::sum(external, problem.state.grid.communicator())));
  }



  /// All unknowns that the points of a cell touch are coupled. Held ones keep
  /// their places: nodes of the seabed begin to stick or slip within a load
  /// step, and the pattern serves all its matrices. Rows of other ranks' nodes
  /// are sent to them by compress(). Collective.
  template <int dim>
  void
  Newton<dim>::make_pattern()
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
  Newton<dim>::make_rigid_modes(const Grid<dim> &grid)
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



  template class Newton<2>;
  template class Newton<3>;
} // namespace talus

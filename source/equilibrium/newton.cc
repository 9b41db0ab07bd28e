#include <talus/base/errors.h>
#include <talus/equilibrium/newton.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  double
  Newton<dim>::imbalance() const
  {
    std::vector<double> force = unbalanced_;
    contact_.add_friction(force);
    const double norm = unknowns_.norm(force);
    return norm == 0. ? 0. : norm / reference_;
  }



  template <int dim>
  std::string
  Newton<dim>::where_largest(const std::vector<double> &force,
                             double                    &largest) const
  {
    double     own = 0;
    Point<dim> place;
    unknowns_.for_free([&](const unsigned int node, const unsigned int d) {
      // Not a number counts as large.
      if (!(std::abs(force[dim * node + d]) <= own))
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
      Utilities::MPI::min(own == largest ? rank : n_ranks, communicator);
    return Utilities::MPI::broadcast(communicator,
                                     text('(', place, ") m"),
                                     owner == n_ranks ? 0 : owner);
  }



  template <int dim>
  std::pair<double, std::string>
  Newton<dim>::largest_imbalance() const
  {
    std::vector<double> force = unbalanced_;
    contact_.add_friction(force);
    std::pair<double, std::string> result;
    result.second = where_largest(force, result.first);
    return result;
  }



  /// Set the residual at the displacements @p u. Returns false if a point of any
  /// rank would be turned inside out.
  template <int dim>
  bool
  Newton<dim>::evaluate(Soil<dim> &soil, const std::vector<double> &u)
  {
    std::vector<double> forces = unknowns_.field();
    const bool sound = internal_forces_.evaluate(soil, weights_, u, forces);
    if (!Utilities::MPI::logical_or(!sound, unknowns_.communicator()))
      {
        ghost_.add_forces(u, forces);
        unknowns_.add_to_owners(forces);
        residual_ = target_;
        contact_.add_friction(residual_);
        for (std::size_t i = 0; i < residual_.size(); ++i)
          residual_[i] -= forces[i];
        return true;
      }
    return false;
  }



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



  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::solve(Soil<dim>      &soil,
                     const double    share,
                     const Observer &observe)
  {
    target_ = internal_;
    for (std::size_t i = 0; i < target_.size(); ++i)
      target_[i] += share * unbalanced_[i];
    contact_.add_contact_force(-(1. - share), target_);
    u_                               = unknowns_.field();
    const StaticContact<dim> before  = contact_;
    const Outcome            outcome = seek(soil, observe);
    if (!outcome.converged)
      contact_ = before;
    return outcome;
  }



  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::seek(Soil<dim> &soil, const Observer &observe)
  {
    // A node of the seabed may change its mind some times.
    for (unsigned int trial = 0; trial < 50; ++trial)
      {
        unknowns_.hold(contact_.held(soil, unknowns_));
        const Outcome outcome = iterate(soil, observe);
        if (!outcome.converged)
          {
            if (moves_freely_ &&
                contact_.resist(unknowns_, last_correction_) > 0)
              continue;
            mechanism_ = last_correction_;
            return outcome;
          }
        mechanism_                   = u_;
        std::vector<double> reaction = residual_;
        for (double &force : reaction)
          force = -force;
        if (contact_.revise(soil, unknowns_, reaction, u_) == 0)
          return outcome;
        unknowns_.copy_to_ghosts(u_);
      }
    return failure("The contact with the seabed does not come to rest");
  }



  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::iterate(Soil<dim> &soil, const Observer &observe)
  {
    if (!evaluate(soil, u_))
      return failure("A point would be turned inside out");
    for (unsigned int i = 0;; ++i)
      {
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
        const std::string complaint = correct(soil, iteration);
        observe(iteration);
        if (!complaint.empty())
          return failure(
            text("Newton's method has no next iterate, since ", complaint));
      }
  }



  template <int dim>
  std::string
  Newton<dim>::correct(Soil<dim> &soil, NewtonIteration &iteration)
  {
    const auto start = std::chrono::steady_clock::now();
    moves_freely_    = false;
    matrix_          = 0.;
    internal_forces_.add_tangent(weights_, unknowns_, matrix_);
    ghost_.add_to_matrix(unknowns_, matrix_);
    matrix_.compress(VectorOperation::add);
    // Where soil can move freely the solution is to be large, not infinite.
    for (const auto i : unknowns_.owned())
      matrix_.add(i, i, 1e-13 * matrix_.diag_element(i));
    matrix_.compress(VectorOperation::add);

    TrilinosWrappers::MPI::Vector rhs(unknowns_.owned(),
                                      unknowns_.communicator());
    TrilinosWrappers::MPI::Vector solution(rhs);
    unknowns_.for_free([&](const unsigned int node, const unsigned int d) {
      rhs(unknowns_.first(node) + d) = residual_[dim * node + d];
    });
    rhs.compress(VectorOperation::insert);
    RigidModes free_modes = modes_;
    for (auto &mode : free_modes)
      {
        unsigned int i = 0;
        for (const unsigned int node : unknowns_.active_nodes())
          for (unsigned int d = 0; d < dim; ++d, ++i)
            if (unknowns_.is_held(node, d))
              mode[i] = 0.;
      }
    const LinearSolution answer = linear_solver_.solve(
      matrix_, solution, rhs, free_modes, dim, is_symmetric());
    iteration.n_linear_iterations = answer.n_iterations;
    if (!answer.failure.empty())
      return answer.failure;

    std::vector<double> direction = unknowns_.field();
    double              largest   = 0;
    unknowns_.for_free([&](const unsigned int node, const unsigned int d) {
      const double x            = solution(unknowns_.first(node) + d);
      direction[dim * node + d] = x;
      largest = (std::abs(x) <= largest ? largest : std::abs(x));
    });
    largest = Utilities::MPI::max(largest, unknowns_.communicator());
    unknowns_.copy_to_ghosts(direction);
    if (std::isfinite(largest))
      last_correction_ = direction;
    moves_freely_ = !(largest < 10. * extent_);
    if (moves_freely_)
      return "the matrix is singular or nearly so: part of the soil can move "
             "freely";
    iteration.length = search_along(soil, direction);
    iteration.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
        .count();
    return iteration.length > 0. ? "" : "points would be turned inside out";
  }



  /// Go along @p direction until the work of the residual on it is small, and
  /// set displacements and residual. Returns how far, in units of the
  /// direction; 0 if no point along it is sound.
  template <int dim>
  double
  Newton<dim>::search_along(Soil<dim>                 &soil,
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
        if (!evaluate(soil, u))
          {
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



  template <int dim>
  void
  Newton<dim>::accept(Soil<dim> &soil)
  {
    Points<dim> &points = soil.points;
    internal_forces_.set_gradients(soil, weights_, u_);
    soil.materials.for_runs(points,
                            points.all(),
                            [&](const MaterialModel<dim> &model,
                                const unsigned int        begin,
                                const unsigned int        end) {
                              model.commit_load_step(points,
                                                     soil.workspace,
                                                     begin,
                                                     end,
                                                     parameters_.measure);
                            });
    if (parameters_.measure == StrainMeasure::small)
      return;
    const std::vector<double> u = at_points(points, u_);
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points.data(points.position, d)[p] += u[dim * p + d];
    update_stretch(points,
                   soil.workspace,
                   0,
                   points.size(),
                   soil.transfer.box_shape().rule,
                   /*dt=*/1.);
  }



  template class Newton<2>;
  template class Newton<3>;
} // namespace talus

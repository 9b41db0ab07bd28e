// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/newton.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return why Newton's method will not converge, as the end of a sentence;
    /// empty as long as convergence is possible. @p residuals of all iterations
    /// are relative to the reference force [-]. The limits were found by
    /// completing all loops of the verification cases (doc/performance.md,
    /// "Factor of safety"): no loop converged after reaching a limit.
    std::string
    divergence(const std::vector<double> &residuals)
    {
      constexpr double       largest_residual = 1.;
      constexpr double       largest_growth   = 10.;
      constexpr unsigned int patience         = 6;
      const double           now              = residuals.back();
      if (now > largest_residual && now > largest_growth * residuals.front())
        return text(std::setprecision(6),
                    "the residual has grown to ",
                    now,
                    " times the forces");
      if (residuals.size() < patience)
        return "";
      const auto [lower, upper] =
        std::minmax_element(residuals.end() - patience, residuals.end());
      return *lower > 0.9 * *upper ? text(std::setprecision(6),
                                          "the residual stays at ",
                                          now,
                                          " times the forces")
                                   : "";
    }
  } // namespace



  template <int dim>
  void
  Newton<dim>::begin(StaticProblem<dim> &problem, const StaticOptions &options)
  {
    options_ = options;
    extent_  = problem.state.grid.domain().lower.distance(
      problem.state.grid.domain().upper);
    equations_.begin(problem, options);
    u_ = last_correction_ = residual_ = equations_.unknowns().field();
    mechanism_.resize(u_.size(), 0.);
  }



  /// Build a sentence with @p reason, the largest residual force and its place:
  /// where the soil fails. Collective.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::failure(const std::string &reason) const
  {
    const auto [largest, place] = equations_.largest(residual_);
    return {false,
            text(std::setprecision(6),
                 reason,
                 "; the largest residual force of a node is ",
                 largest,
                 " N, at ",
                 place),
            false};
  }



  /// Only displacements and contact change here. A failed step restores the
  /// contact, so that a shorter step starts from the same state.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::solve(StaticProblem<dim> &problem,
                     const double        share,
                     const Observer     &observe)
  {
    equations_.set_load_fraction(share);
    u_                               = equations_.unknowns().field();
    const StaticContact<dim> before  = contact();
    const Outcome            outcome = solve_with_contact(problem, observe);
    if (!outcome.converged)
      equations_.contact() = before;
    return outcome;
  }



  /// Apply Newton's method with fixed contact states (stick, slip, open) of the
  /// nodes on the seabed, then update the states, until no state changes. With
  /// fixed states the problem is smooth, so convergence is quadratic; and the
  /// matrix stays symmetric, while friction as a function of
  /// the normal force would make it unsymmetric. Each loop starts from the
  /// displacements of the previous loop. Loops before the last need not be
  /// exact. The number of loops is limited, as a set of states may recur.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::solve_with_contact(StaticProblem<dim> &problem,
                                  const Observer     &observe)
  {
    // Sticking lasts for one matrix only (StaticContact), so the same singular
    // matrices could recur.
    constexpr unsigned int max_singular = 3;
    unsigned int           n_singular   = 0;
    double                 tolerance    = options_.contact_tolerance;
    // The state of a node may change several times.
    for (unsigned int trial = 0; trial < options_.largest_contact_loops;
         ++trial)
      {
        equations_.constrain(problem);
        const Outcome outcome = newton_loop(problem, tolerance, observe);
        if (!outcome.converged)
          {
            if (outcome.is_stopped)
              return outcome;
            // Soil held only by slipping nodes has a singular matrix. Friction
            // that would push the soil on reverses as soon as the soil moves:
            // the nodes can then stick.
            n_singular =
              (moves_freely_ && n_updates_ == 0 ? n_singular + 1 : 0);
            if (moves_freely_ && n_singular < max_singular &&
                equations_.stick_again(last_correction_) > 0)
              continue;
            mechanism_ = last_correction_;
            return outcome;
          }
        mechanism_ = u_;
        if (equations_.update_contact(
              problem, residual_, u_, options_.facet_tolerance) > 0)
          continue;
        if (outcome.residual <= options_.tolerance)
          return outcome;
        tolerance = 0.;
      }
    return failure(
      "The contact with seabed and obstacles does not come to rest");
  }



  /// Iterate until the residual is below the tolerance, the largest number of
  /// iterations is reached, or the residual is not a number. The last two fail
  /// the load step, not the run. All ranks leave the loop together, as the norm
  /// is over all ranks. The residual is relative to
  /// StaticEquations::reference_force() and not to the first residual: a load
  /// step that starts nearly in balance could not reduce its residual by eight
  /// orders of magnitude. Where @p largest_tolerance is larger than the
  /// tolerance, a residual of a hundredth of the first is enough.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::newton_loop(StaticProblem<dim> &problem,
                           const double        largest_tolerance,
                           const Observer     &observe)
  {
    double tolerance = options_.tolerance;
    moves_freely_    = false;
    n_updates_       = 0;
    equations_.compute_residual(problem, u_, residual_);
    const Outcome       stopped{false, "The search was stopped", true};
    std::vector<double> residuals;
    for (unsigned int i = 0;; ++i)
      {
        // Soil without any force is in balance; 0/0 would fail the test.
        const double    norm = equations_.unknowns().norm(residual_);
        NewtonIteration iteration{
          i, norm == 0. ? 0. : norm / equations_.reference_force(), 0, 0., 0.};
        if (i == 0)
          tolerance =
            std::max(tolerance,
                     std::min(largest_tolerance, 0.01 * iteration.residual));
        const bool converged = (iteration.residual <= tolerance);
        if (converged || i == options_.largest_iterations ||
            !std::isfinite(norm))
          {
            if (!observe(iteration))
              return stopped;
            return converged ? Outcome{true, "", false, iteration.residual}
                             : failure(text(std::setprecision(6),
                                            "Newton's method has not converged "
                                            "in ",
                                            i,
                                            " iterations: the residual is ",
                                            iteration.residual,
                                            " of the forces, but at most ",
                                            tolerance,
                                            " is allowed"));
          }
        residuals.push_back(iteration.residual);
        std::string error = divergence(residuals);
        if (error.empty())
          error = newton_update(problem, iteration);
        if (!observe(iteration))
          return stopped;
        if (!error.empty())
          return failure(text("Newton's method diverges: ", error));
      }
  }



  /// Divide the strengths of soil and beds by @p factor.
  template <int dim>
  void
  Newton<dim>::set_factor(StaticProblem<dim> &problem, const double factor)
  {
    problem.divide_strength(factor);
    contact().renew_limits(problem);
  }



  /// The next direction is that of the step just found.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::follow(StaticProblem<dim> &problem,
                      StrengthPath       &path,
                      const Observer     &observe)
  {
    const StrengthPath       before         = path;
    const StaticContact<dim> contact_before = contact();
    Outcome                  outcome;
    if (path.by_factor)
      {
        path.factor += path.change;
        set_factor(problem, path.factor);
        outcome = solve(problem, 1., observe);
      }
    else
      outcome = solve_for_factor(problem, path, observe);
    if (!outcome.converged)
      {
        path                 = before;
        equations_.contact() = contact_before;
        set_factor(problem, path.factor);
        return outcome;
      }
    if (const double norm = equations_.unknowns().norm(u_); norm > 0.)
      {
        path.displacement += norm;
        path.length    = norm;
        path.direction = u_;
        for (double &component : path.direction)
          component /= norm;
      }
    return outcome;
  }



  /// As in solve_with_contact(), contact states are fixed within a loop and
  /// updated between the loops.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::solve_for_factor(StaticProblem<dim> &problem,
                                StrengthPath       &path,
                                const Observer     &observe)
  {
    equations_.set_load_fraction(1.);
    u_ = path.direction;
    for (double &component : u_)
      component *= path.length;
    for (unsigned int trial = 0; trial < options_.largest_contact_loops;
         ++trial)
      {
        equations_.constrain(problem);
        const Outcome outcome = path_loop(problem, path, observe);
        if (!outcome.converged)
          return outcome;
        mechanism_ = u_;
        if (equations_.update_contact(
              problem, residual_, u_, options_.facet_tolerance) == 0)
          return outcome;
      }
    return failure(
      "The contact with seabed and obstacles does not come to rest");
  }



  /// The residual is linear in the factor but for yield, so a difference over a
  /// millionth gives its derivative. It is computed first: the tangent is that
  /// of the last residual.
  template <int dim>
  typename Newton<dim>::Outcome
  Newton<dim>::path_loop(StaticProblem<dim> &problem,
                         StrengthPath       &path,
                         const Observer     &observe)
  {
    const Unknowns<dim> &unknowns = equations_.unknowns();
    constexpr double     step     = 1e-6;
    std::vector<double>  residuals, by_factor;
    for (unsigned int i = 0;; ++i)
      {
        const double factor = path.factor;
        set_factor(problem, (1. + step) * factor);
        equations_.compute_residual(problem, u_, by_factor);
        set_factor(problem, factor);
        equations_.compute_residual(problem, u_, residual_);
        for (std::size_t k = 0; k < by_factor.size(); ++k)
          by_factor[k] = (by_factor[k] - residual_[k]) / (step * factor);
        const double residual =
          unknowns.norm(residual_) / equations_.reference_force();
        if (!observe({i, residual, 0, 0., 1.}))
          return {false, "The search was stopped", true};
        const double along = unknowns.product(path.direction, u_);
        if (residual <= options_.tolerance &&
            std::abs(along - path.length) <= 1e-6 * path.length)
          return {true, "", false, residual};
        residuals.push_back(residual);
        std::string error = divergence(residuals);
        if (i == options_.largest_iterations || !std::isfinite(residual))
          error = "no convergence";
        if (error.empty())
          error = path_update(path, by_factor, along);
        if (!error.empty())
          return failure(text("Newton's method diverges: ", error));
      }
  }



  /// Take a step by two right-hand sides: the displacements balance the
  /// residual and follow the factor, and the change of the factor gives the
  /// step its length, of which @p along is there. At most 3 % at once: the
  /// tangent of a state with few yielded points would overshoot. Where soil is
  /// elastic the factor has no influence, and grows until points yield.
  template <int dim>
  std::string
  Newton<dim>::path_update(StrengthPath              &path,
                           const std::vector<double> &by_factor,
                           const double               along)
  {
    const Unknowns<dim> &unknowns = equations_.unknowns();
    const auto balance = equations_.solve_tangent(linear_solver_, residual_);
    if (!balance.failure.empty())
      return balance.failure;
    if (!(balance.largest < 10. * extent_))
      return "the matrix is nearly singular: soil can move freely";
    const auto follow =
      equations_.solve_tangent(linear_solver_, by_factor, true);
    if (!follow.failure.empty())
      return follow.failure;
    last_correction_     = follow.field;
    const double slope   = unknowns.product(path.direction, follow.field);
    const double missing = path.length - along;
    double       change =
      (missing - unknowns.product(path.direction, balance.field)) / slope;
    if (!(std::abs(slope) * 0.1 * path.factor > 1e-3 * std::abs(missing)))
      change = 0.01 * path.factor;
    change = std::clamp(change, -0.03 * path.factor, 0.03 * path.factor);
    for (std::size_t k = 0; k < u_.size(); ++k)
      u_[k] += balance.field[k] + change * follow.field[k];
    path.factor += change;
    return "";
  }



  /// Take a full Newton step with a new matrix: the tangent comes with the
  /// stress anyway, and a modified Newton method would lose the quadratic
  /// convergence. There are two failures: the linear solver gives up, or the
  /// correction exceeds ten times the extent of the mesh, so the matrix is
  /// singular up to round-off and soil moves as a mechanism. Collective.
  template <int dim>
  std::string
  Newton<dim>::newton_update(StaticProblem<dim> &problem,
                             NewtonIteration    &iteration)
  {
    const auto start      = std::chrono::steady_clock::now();
    const auto correction = equations_.solve_tangent(linear_solver_, residual_);
    iteration.n_linear_iterations = correction.n_iterations;
    if (!correction.failure.empty())
      return correction.failure;
    if (std::isfinite(correction.largest))
      // The correction from a nearly singular matrix is close to its null
      // vector: the mechanism of failure, up to a factor.
      last_correction_ = correction.field;
    // Written to be true also if the correction is not a number.
    moves_freely_ = !(correction.largest < 10. * extent_);
    if (moves_freely_)
      return "the matrix is nearly singular: soil can move freely";
    iteration.length = line_search(problem, correction.field);
    iteration.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
        .count();
    ++n_updates_;
    return "";
  }



  /// Move along @p direction until the work of the residual on the direction is
  /// small, and set displacements and residual. Returns the length of the step
  /// as a fraction of the direction.
  ///
  /// For elastic soil, the work of the residual on the direction is minus the
  /// derivative of the energy along it, and zero at the minimum. Plastic soil
  /// has no energy, but the work still tells whether the step is too long. A
  /// step is accepted if the work fell by a fifth or the norm of the residual
  /// fell. The test is so loose that full steps are taken near the solution,
  /// where convergence is quadratic. Otherwise the length is reduced to the
  /// root of the line through both values of the work, by a factor between 0.1
  /// and 0.5. After six trials any step is taken, and the limit on
  /// iterations decides. Each trial costs one evaluation of all stresses.
  /// Collective.
  template <int dim>
  double
  Newton<dim>::line_search(StaticProblem<dim>        &problem,
                           const std::vector<double> &direction)
  {
    const Unknowns<dim> &unknowns    = equations_.unknowns();
    const double         work_before = unknowns.product(direction, residual_);
    const double         norm_before = unknowns.norm(residual_);
    std::vector<double>  u           = u_;
    double               length      = 1.;
    for (unsigned int trial = 0;; ++trial)
      {
        for (std::size_t i = 0; i < u.size(); ++i)
          u[i] = u_[i] + length * direction[i];
        equations_.compute_residual(problem, u, residual_);
        const double work = unknowns.product(direction, residual_);
        if (std::abs(work) <= 0.8 * std::abs(work_before) ||
            unknowns.norm(residual_) < norm_before || trial >= 6)
          {
            u_ = u;
            return length;
          }
        const double factor = work_before / (work_before - work);
        length *= std::clamp(std::isfinite(factor) ? factor : 0.1, 0.1, 0.5);
      }
  }



  /// The size of a mechanism has no meaning, and with a nearly singular matrix
  /// depends on round-off. Hence the division by the largest component on all
  /// ranks.
  template <int dim>
  std::vector<double>
  Newton<dim>::mechanism(const Points<dim> &points) const
  {
    std::vector<double> result  = equations_.at_points(points, mechanism_);
    double              largest = 0;
    for (const double component : result)
      largest = std::max(largest, std::abs(component));
    largest =
      Utilities::MPI::max(largest, equations_.unknowns().communicator());
    for (double &component : result)
      component /= (largest > 0. ? largest : 1.);
    return result;
  }



  template class Newton<2>;
  template class Newton<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/equilibrium.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Equilibrium<dim>::Equilibrium()
    : ParameterAcceptor("/Equilibrium")
    , newton_(linear_solver_)
  {
    add_parameter("Load steps",
                  parameters_.n_load_steps,
                  "Number of equal steps in which the load is applied [-]; a "
                  "step is halved if Newton's method fails, and later steps "
                  "grow again.",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter("Smallest load step",
                  parameters_.smallest_step,
                  "Smallest fraction of the load in a halved step [-]; if it "
                  "fails, the search ends. The steps that 'Load steps' "
                  "requires are always tried.",
                  this->prm,
                  smallest_load_steps());
    add_parameter(
      "Allowed imbalance",
      parameters_.allowed_imbalance,
      "Largest unbalanced force of soil in balance, over the force of the "
      "loads or of the stress, whichever is larger (Euclidean norms over "
      "the nodes) [-].",
      this->prm,
      Patterns::Double(1e-14));
    add_parameter("Largest number of settling steps",
                  largest_settling_,
                  "Largest number of steps without further load [-]; if the "
                  "soil is not in balance afterwards, the search ends.",
                  this->prm,
                  Patterns::Integer(1));
    add_parameters_of_newton();
  }



  template <int dim>
  void
  Equilibrium<dim>::add_parameters_of_newton()
  {
    add_parameter("Newton tolerance",
                  parameters_.tolerance,
                  "Largest residual of Newton's method over the force of the "
                  "loads [-].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Newton iterations",
                  parameters_.largest_iterations,
                  "Largest number of iterations of Newton's method in a load "
                  "step.",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter("Ghost penalty",
                  parameters_.ghost_penalty,
                  "Stiffness that ties nodes with very little soil to their "
                  "neighbours, over the shear modulus [-].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Well-balanced load",
                  parameters_.is_well_balanced,
                  "Subtract from the weight its error in partly filled cells: "
                  "the nodal force left by a pressure proportional to the "
                  "depth. Otherwise the soil at the mudline has to bear shear "
                  "stresses of half the weight of a cell, for cells of any "
                  "size.");
  }



  template <int dim>
  void
  Equilibrium<dim>::check(const Materials<dim>           &materials,
                          const std::vector<std::string> &names_of_bodies)
  {
    // A hyperelastic stress is a function of F alone, and F does not change at
    // small strain: the body could never take up a load.
    for (unsigned int b = 0; b < names_of_bodies.size(); ++b)
      AssertThrow(!materials.of_body(b).is_hyperelastic(),
                  ExcUser(text("Static stages change stresses, but do not "
                               "move the soil, and the stress of the body '",
                               names_of_bodies[b],
                               "' follows from its deformation. Choose a law "
                               "in rate form ('linear elastic', 'von Mises'), "
                               "or list only 'dynamics' in 'Stages', with "
                               "'Gravity/Ramp time' and 'Damping/Local "
                               "damping'.")));
  }



  template <int dim>
  void
  Equilibrium<dim>::begin(const StaticOptions &options)
  {
    options_   = options;
    load_      = 0;
    step_      = 1. / options.n_load_steps;
    imbalance_ = 0;
    n_steps_ = n_settling_ = 0;
    is_found_ = is_stopped_ = false;
    imbalances_.clear();
    failure_.clear();
  }



  /// A load step depends on previous steps only through the points: it starts
  /// from the unbalanced forces of the explicit scheme, summed by the kernels
  /// of the explicit scheme and without stabilization. Errors of a step
  /// (tolerance of Newton's method, force of the ghost penalty) are thus part
  /// of the imbalance in the next step, and the final balance is the balance
  /// from which the dynamics starts. At full load, further steps ("settling")
  /// remove the rest, which falls from step to step; see doc/method.md, section
  /// 12.
  ///
  /// Balance is tested before a step is taken, so points in balance do not
  /// change any more. The result is the same on all ranks, as imbalance_ is a
  /// sum over all ranks.
  template <int dim>
  bool
  Equilibrium<dim>::advance(StaticProblem<dim> &problem,
                            const Observer     &observe)
  {
    newton_.begin(problem,
                  options_of_step(!problem.contact.obstacles().empty()));
    imbalance_ = newton_.equations().imbalance();
    if (load_ >= 1. && imbalance_ <= options_.allowed_imbalance)
      {
        is_found_ = true;
        return true;
      }
    // Give up. The place of the largest force tells the user where the soil
    // flows.
    if (!is_settling())
      {
        const auto [largest, place] = newton_.equations().largest_imbalance();
        failure_                    = text(std::setprecision(6),
                        "After ",
                        counted(n_settling_, "step"),
                        " without further load the unbalanced force "
                                           "is ",
                        imbalance_,
                        " of the force of the loads, but at most ",
                        options_.allowed_imbalance,
                        " is allowed; the largest force of a node is ",
                        largest,
                        " N, at ",
                        place);
        return false;
      }
    return take_step(problem, observe);
  }



  /// Nodes with very little soil follow their own forces more slowly the
  /// stiffer the stabilization is compared with their own stiffness. Hence the
  /// penalty decreases at full load. The lower bound of 1e-3 keeps nodes
  /// without stiffness from making the matrix singular. Nodes inside obstacles
  /// have very little soil, but the full pressure: held by their springs and
  /// the penalty, they follow only if the penalty is close to zero, hence the
  /// lower bound of 1e-9.
  template <int dim>
  StaticOptions
  Equilibrium<dim>::options_of_step(const bool has_obstacles) const
  {
    StaticOptions options = options_;
    options.ghost_penalty *=
      (has_obstacles ? std::max(1e-9, std::pow(0.1, n_settling_))
                     : std::max(1e-3, std::pow(0.5, n_settling_)));
    return options;
  }



  /// A stiff stabilization would let the factor creep up with the length.
  template <int dim>
  bool
  Equilibrium<dim>::follow(StaticProblem<dim> &problem,
                           StrengthPath       &path,
                           const Observer     &observe)
  {
    StaticOptions options = options_;
    options.ghost_penalty *= 1e-4;
    newton_.begin(problem, options);
    const auto outcome =
      newton_.follow(problem, path, [&](const NewtonIteration &iteration) {
        return observe({n_steps_ + 1, 1., iteration});
      });
    failure_    = outcome.failure;
    is_stopped_ = outcome.is_stopped;
    if (outcome.converged)
      {
        newton_.commit(problem);
        ++n_steps_;
      }
    return outcome.converged;
  }



  /// Return whether the imbalance fell by 10 % in the last @p n_steps settling
  /// steps, or fewer steps were taken.
  template <int dim>
  bool
  Equilibrium<dim>::is_falling(const unsigned int n_steps) const
  {
    const std::size_t n = imbalances_.size();
    return n <= n_steps ||
           imbalances_.back() < 0.9 * imbalances_[n - 1 - n_steps];
  }



  /// Return whether the soil seems to come to rest at full load. Failing soil
  /// flows on and on: no settling steps are left, or the imbalance did not fall
  /// in the last 20 steps.
  template <int dim>
  bool
  Equilibrium<dim>::is_settling()
  {
    constexpr unsigned int patience = 20;
    if (load_ < 1.)
      return true;
    imbalances_.push_back(imbalance_);
    return n_settling_ < largest_settling_ && is_falling(patience);
  }



  /// Return whether the soil flows, as a settling step with the whole imbalance
  /// has failed: if the previous step did not lower the imbalance.
  template <int dim>
  bool
  Equilibrium<dim>::flows_on() const
  {
    return load_ >= 1. && !is_falling(1);
  }



  /// Take one step, of the largest length that succeeds; the first trial is
  /// never too small. The load is not stored as a force, but as a fraction of
  /// the current imbalance: at the load load_, a step of length step_ removes
  /// step_/(1 - load_) of the imbalance. Loads and stress may therefore have
  /// changed with the points, and no errors add up from step to step.
  ///
  /// A failed step changes nothing (Newton::solve() restores the contact,
  /// points change only in commit()), so it can be repeated with half the
  /// fraction. The next step is at most 1.5 times as long as the last
  /// successful step, and never longer than required by the parameter.
  template <int dim>
  bool
  Equilibrium<dim>::take_step(StaticProblem<dim> &problem,
                              const Observer     &observe)
  {
    // The slack of 1e-4 prevents a last, tiny step due to round-off in load_.
    // In settling steps rest is zero, and each step removes all of the
    // imbalance.
    const double rest = 1. - load_;
    const bool   all  = !(rest > 1.0001 * step_);
    for (double cut = 1.; cut == 1. || cut * step_ >= options_.smallest_step;
         cut *= 0.5)
      {
        // Fraction of the current imbalance; the last step removes all of it.
        const double share = cut * (all ? 1. : step_ / rest);
        const double after = (all && cut == 1. ? 1. : load_ + share * rest);
        const auto   outcome =
          newton_.solve(problem, share, [&](const NewtonIteration &iteration) {
            return observe({n_steps_ + 1, after, iteration});
          });
        if (!outcome.converged)
          {
            failure_    = outcome.failure;
            is_stopped_ = outcome.is_stopped;
            if (is_stopped_ || flows_on())
              return false;
            continue;
          }
        newton_.commit(problem);
        // Count by the load before the step: the step that completes the load
        // does not settle.
        n_settling_ += (load_ >= 1.);
        load_ = after;
        step_ = std::min(1.5 * cut * step_, 1. / options_.n_load_steps);
        ++n_steps_;
        return true;
      }
    return false;
  }



  template class Equilibrium<2>;
  template class Equilibrium<3>;
} // namespace talus

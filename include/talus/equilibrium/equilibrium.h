// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_equilibrium_h
#define talus_equilibrium_equilibrium_h

#include <talus/equilibrium/newton.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Progress of the search for equilibrium, reported at each iteration.
  struct EquilibriumProgress
  {
    unsigned int    load_step; ///< one-based index of the load step
    double          load;      ///< fraction of the load after the step [-]
    NewtonIteration iteration;
  };



  /// Allowed values of parameters 'Smallest load step'. A smaller fraction of a
  /// load would be comparable with the residual left by Newton's method, and 0
  /// would let a failing step be halved without end.
  inline dealii::Patterns::Double
  smallest_load_steps()
  {
    return dealii::Patterns::Double(1e-6, 1.);
  }



  /// Static equilibrium of the soil with its weight and all other loads,
  /// without integration in time. The load is applied in steps, each solved by
  /// Newton's method and halved if Newton's method fails. Further steps without
  /// load then remove the effect of the stabilization.
  template <int dim>
  class Equilibrium : public dealii::ParameterAcceptor
  {
  public:
    /// Receives the progress; returns whether to continue, the same on all
    /// ranks.
    using Observer = std::function<bool(const EquilibriumProgress &)>;

    Equilibrium();

    /// Throw ExcUser if the stress of a body follows from its deformation.
    static void
    check(const Materials<dim>           &materials,
          const std::vector<std::string> &names_of_bodies);

    /// Options of the search as given by the parameters.
    const StaticOptions &
    options() const
    {
      return parameters_;
    }

    /// Start a new search from zero load, whatever came before.
    void
    begin(const StaticOptions &options);

    /// Take one load step. Returns false if the step fails at the smallest
    /// length or if balance is not reached in the largest number of steps;
    /// failure() then gives the reason. Also returns false if @p observe stops
    /// the search; see is_stopped(). Collective.
    bool
    advance(StaticProblem<dim> &problem, const Observer &observe);

    /// Take the next step along the @p path of decreasing strength; see
    /// Newton::follow(). Returns whether the step was found; otherwise
    /// failure() gives the reason, and nothing has changed. Collective.
    bool
    follow(StaticProblem<dim> &problem,
           StrengthPath       &path,
           const Observer     &observe);

    /// Return whether all load is applied and the imbalance is within
    /// tolerance.
    bool
    is_balanced() const
    {
      return is_found_;
    }

    /// Return whether the observer stopped the search.
    bool
    is_stopped() const
    {
      return is_stopped_;
    }

    const std::string &
    failure() const
    {
      return failure_;
    }

    /// Fraction of the load applied so far [-].
    double
    load() const
    {
      return load_;
    }

    unsigned int
    n_steps() const
    {
      return n_steps_;
    }

    /// Contact with seabed and obstacles; change it only between load steps,
    /// together with the points.
    StaticContact<dim> &
    contact()
    {
      return newton_.contact();
    }

    /// Norm of the unbalanced force over the reference force [-]; see
    /// StaticEquations::imbalance().
    double
    imbalance() const
    {
      return imbalance_;
    }

    const Newton<dim> &
    newton() const
    {
      return newton_;
    }

  private:
    void
    add_parameters_of_newton();
    StaticOptions
    options_of_step(bool has_obstacles) const;
    bool
    is_falling(unsigned int n_steps) const;
    bool
    is_settling();
    bool
    flows_on() const;
    bool
    take_step(StaticProblem<dim> &problem, const Observer &observe);

    // Parameters
    unsigned int  largest_settling_ = 100;
    StaticOptions parameters_;
    LinearSolver  linear_solver_;

    Newton<dim>         newton_;
    double              load_ = 0;
    double              step_ = 1;
    StaticOptions       options_; ///< options of the current search
    unsigned int        n_steps_    = 0;
    unsigned int        n_settling_ = 0; ///< steps taken at full load
    double              imbalance_  = 0;
    bool                is_found_   = false;
    bool                is_stopped_ = false;
    std::string         failure_;
    std::vector<double> imbalances_; ///< history at full load [-]
  };
} // namespace talus

#endif

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
  /// What the search for equilibrium says of each iteration.
  struct EquilibriumProgress
  {
    unsigned int    load_step; ///< from 1
    double          load;      ///< share of the load after the step
    NewtonIteration iteration;
  };



  /// What a search may ask for other than the parameters of the equilibrium.
  struct EquilibriumLimits
  {
    unsigned int n_load_steps;      ///< in which the load comes on
    double       smallest_step;     ///< share of it below which no step is cut
    double       allowed_imbalance; ///< with which the soil counts as balanced
    /// Whether the load may be well-balanced (WellBalancedLoad).
    bool is_well_balanced = true;
  };



  /// Values of the parameters 'Smallest load step': a smaller share of a load is
  /// next to the residual that Newton's method leaves, and 0 would let a step
  /// that fails be halved without end.
  inline dealii::Patterns::Double
  smallest_load_steps()
  {
    return dealii::Patterns::Double(1e-6, 1.);
  }



  /// Brings soil into balance with its weight and all other loads without going
  /// through time: the load comes on in steps, each solved by Newton's method
  /// and cut where that fails; further steps without load then let go of the
  /// stabilization.
  template <int dim>
  class Equilibrium : public dealii::ParameterAcceptor
  {
  public:
    /// Returns whether to go on, the same on all ranks.
    using Observer = std::function<bool(const EquilibriumProgress &)>;

    Equilibrium();

    StrainMeasure
    measure() const
    {
      return measure_ == "small" ? StrainMeasure::small : StrainMeasure::large;
    }

    /// Throw ExcUser if a law of the bodies cannot take the strain measure.
    void
    check(const Materials<dim>           &materials,
          const std::vector<std::string> &names_of_bodies) const;

    /// Those of the parameters.
    EquilibriumLimits
    limits(StrainMeasure measure) const;

    /// No load is on yet, whatever was before. Soil that stands still takes
    /// small strain.
    void
    begin(StrainMeasure measure)
    {
      begin(measure, limits(measure));
    }

    void
    begin(StrainMeasure measure, const EquilibriumLimits &limits);

    /// Take one load step. Afterwards, with large strain, points may be in other
    /// cells. Returns false if no step, however small, succeeds or the balance
    /// is not found in the largest number of steps: then failure() says why. So
    /// it does if @p observe stops the search: then is_stopped(). Collective.
    bool
    advance(StaticProblem<dim> &problem, const Observer &observe);

    /// Return stresses to the yield surface, to be called after begin() if the
    /// strength is less than it was: nothing moves, but what was in balance is
    /// so no more. Collective.
    void
    return_stress(StaticProblem<dim> &problem);

    /// Whether all load is on and what is out of balance is within tolerance.
    bool
    is_found() const
    {
      return is_found_;
    }

    /// Whether the observer stopped the search.
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

    /// Share of the load that is on.
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

    /// Compute the well-balanced load anew: points or mesh have changed.
    void
    forget_well_balanced_load()
    {
      newton_.forget_well_balanced_load();
    }

    /// Contact with seabed and obstacles after the last load step.
    const StaticContact<dim> &
    contact() const
    {
      return newton_.equations().contact();
    }

    /// To be changed between load steps, together with the points.
    StaticContact<dim> &
    contact()
    {
      return newton_.contact();
    }

    /// Force out of balance, of the reference force; see Newton.
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
    typename Newton<dim>::Parameters
    parameters_of_step(bool has_obstacles) const;
    bool
    is_settling();
    bool
    take_step(StaticProblem<dim> &problem, const Observer &observe);

    // Parameters
    std::string                      measure_           = "small";
    unsigned int                     n_load_steps_      = 1;
    double                           smallest_step_     = 1e-3;
    unsigned int                     largest_settling_  = 100;
    double                           allowed_imbalance_ = 0.;
    typename Newton<dim>::Parameters newton_parameters_;
    bool                             is_well_balanced_ = true;
    LinearSolver                     linear_solver_;

    Newton<dim>         newton_;
    double              load_ = 0;
    double              step_ = 1;
    EquilibriumLimits   limits_{};
    unsigned int        n_steps_    = 0;
    unsigned int        n_settling_ = 0; ///< steps without load so far
    double              imbalance_  = 0;
    bool                is_found_   = false;
    bool                is_stopped_ = false;
    std::string         failure_;
    std::vector<double> imbalances_; ///< since all load is on
  };
} // namespace talus

#endif

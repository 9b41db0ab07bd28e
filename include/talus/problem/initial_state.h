// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_initial_state_h
#define talus_problem_initial_state_h

#include <talus/base/expression.h>
#include <talus/materials/material_model.h>
#include <talus/transfer/box_rule.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Displacement, velocity and stress of a body at the start, given by
  /// expressions in the places X of the points before the displacement.
  template <int dim>
  class InitialState : public dealii::ParameterAcceptor
  {
  public:
    /// @p section of the body, for example "/Bodies/slide".
    explicit InitialState(const std::string &section);

    /// Throw ExcUser if a stress is prescribed twice, or prescribed although
    /// the stress of @p law follows from the deformation.
    void
    check(const MaterialModel<dim> &law) const;

    bool
    is_displaced() const
    {
      return !displacement_.empty();
    }

    /// Return whether the body starts with the stress of ground at rest under
    /// its weight.
    bool
    has_stress_at_rest() const
    {
      return !K0_.empty();
    }

    /// Return whether the body starts with that or another stress.
    bool
    has_stress() const
    {
      return has_stress_at_rest() || !stress_.empty();
    }

    /// Coefficient of earth pressure at rest [-], if has_stress_at_rest().
    double
    K0() const
    {
      return K0_.front();
    }

    /// Move the points [begin, end) by the displacement at t = 0, and set
    /// edges, boxes and stress. The gradient of
    /// the displacement is taken by differences of sixth order, with errors of
    /// about 1e-12. Throws ExcUser if a point is turned inside out.
    void
    deform(Points<dim>              &points,
           unsigned int              begin,
           unsigned int              end,
           const MaterialModel<dim> &law,
           BoxRule                   rule,
           const Constants          &constants) const;

    /// Set the velocity of the points of body @p index at time @p t, s.
    void
    set_velocity(Points<dim>     &points,
                 unsigned int     index,
                 double           t,
                 const Constants &constants) const;

  private:
    std::string
    path(const std::string &entry) const;
    void
    displace(Points<dim>        &points,
             StepWorkspace<dim> &workspace,
             unsigned int        begin,
             unsigned int        end,
             const Constants    &constants) const;
    void
    set_stress(Points<dim>     &points,
               unsigned int     begin,
               unsigned int     end,
               const Constants &constants) const;

    std::string section_;
    std::string displacement_ = "";
    std::string velocity_     = "";
    std::string stress_       = "";
    // Single number, or empty without a user value.
    std::vector<double> K0_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_wall_conditions_h
#define talus_boundaries_wall_conditions_h

#include <talus/base/expression.h>
#include <talus/boundaries/boundary_condition.h>

#include <array>
#include <string>

namespace talus
{
  /// Vector prescribed by the user on a face of the mesh, as a function of
  /// place and time; some components may be free.
  template <int dim>
  class FaceExpression
  {
  public:
    /// Throws ExcUser if the expressions are invalid.
    /// @param name name of the parameter, for messages
    /// @param expressions separated by semicolons, one per component
    /// @param constants named numbers for the expressions
    /// @param may_be_free whether a component may be the word 'free'
    FaceExpression(const std::string &name,
                   const std::string &expressions,
                   const Constants   &constants,
                   bool               may_be_free);

    /// Whether a component is prescribed.
    bool
    prescribes(const unsigned int component) const
    {
      return is_prescribed_[component];
    }

    /// Return component @p component at @p x, m, time @p t, s. Throws ExcPoint
    /// if the value is not finite.
    double
    value(const dealii::Point<dim> &x,
          const double              t,
          const unsigned int        component)
    {
      return expression_.finite_value(x, t, component);
    }

  private:
    std::array<bool, dim> is_prescribed_;
    Expression<dim>       expression_;
  };



  /// Wall without friction: no motion along the normal, in either direction.
  template <int dim>
  class RollerCondition : public BoundaryCondition<dim>
  {
  public:
    using BoundaryCondition<dim>::BoundaryCondition;

    bool
    constrains(const unsigned int d) const override
    {
      return d == this->face() / 2;
    }

    void
    constrain(const dealii::Point<dim> &x,
              double                    t,
              unsigned int              owner,
              VelocityConstraints<dim> &constraints) override;
  };



  /// Fixed face: no motion.
  template <int dim>
  class FixedCondition : public BoundaryCondition<dim>
  {
  public:
    using BoundaryCondition<dim>::BoundaryCondition;

    bool
    constrains(const unsigned int /*d*/) const override
    {
      return true;
    }

    void
    constrain(const dealii::Point<dim> &x,
              double                    t,
              unsigned int              owner,
              VelocityConstraints<dim> &constraints) override;
  };



  /// Velocity by expression, for some or all components. A component already
  /// prescribed by an earlier condition is replaced only if the component is
  /// normal to the face.
  template <int dim>
  class VelocityCondition : public BoundaryCondition<dim>
  {
  public:
    explicit VelocityCondition(const FaceDescription<dim> &description);

    bool
    depends_on_place() const override
    {
      return true;
    }

    bool
    constrains(const unsigned int d) const override
    {
      return expression_.prescribes(d);
    }

    void
    constrain(const dealii::Point<dim> &x,
              double                    t,
              unsigned int              owner,
              VelocityConstraints<dim> &constraints) override;

  private:
    FaceExpression<dim> expression_; ///< m/s
  };



  /// Traction (force per area in contact) by expression.
  template <int dim>
  class TractionCondition : public BoundaryCondition<dim>
  {
  public:
    explicit TractionCondition(const FaceDescription<dim> &description);

    bool
    depends_on_place() const override
    {
      return true;
    }

    bool
    has_traction() const override
    {
      return true;
    }

    dealii::Tensor<1, dim>
    traction(const dealii::Point<dim> &x, double t) override;

  private:
    FaceExpression<dim> expression_; ///< Pa
  };
} // namespace talus

#endif

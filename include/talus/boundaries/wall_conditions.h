// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_wall_conditions_h
#define talus_boundaries_wall_conditions_h

#include <talus/boundaries/boundary_condition.h>
#include <talus/boundaries/face_expression.h>

namespace talus
{
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_obstacle_h
#define talus_contact_obstacle_h

#include <talus/base/expression.h>
#include <talus/base/state_list.h>
#include <talus/boundaries/bed.h>
#include <talus/contact/rigid_body.h>
#include <talus/geometry/shape.h>
#include <talus/geometry/shape_parameters.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <memory>
#include <string>

namespace talus
{
  /// Rigid body that soil cannot enter: a seabed, a pipeline, a wall. The
  /// surface passes shear to the soil by Coulomb friction, limited by a maximum
  /// shear stress. An obstacle may move as a whole: with a prescribed velocity,
  /// without rotation, or with a mass, by the forces that act. All functions
  /// except shape() refer to the current position.
  template <int dim>
  class Obstacle : public dealii::ParameterAcceptor
  {
  public:
    explicit Obstacle(const std::string &name);

    /// Make shape and expressions; call after parsing. @p surfaces: named
    /// surfaces for shapes. Throws ExcUser if a parameter is invalid.
    void
    prepare(const Constants          &constants,
            const SurfaceSource<dim> *surfaces = nullptr);

    /// Velocity at the middle of a step, m/s, from the time there, s.
    using VelocityOfTime =
      std::function<dealii::Tensor<1, dim>(const double time)>;

    /// Let a function prescribe the velocity in place of the parameter. Each
    /// step calls the function once, on every rank, which must all get the same
    /// velocity. Before the first step the obstacle is at rest. Call before
    /// prepare().
    void
    prescribe_velocity(const VelocityOfTime &velocity)
    {
      prescribed_velocity_ = velocity;
    }

    const std::string &
    name() const
    {
      return name_;
    }

    /// Return the shape, at the start of the run.
    const Shape<dim> &
    shape() const
    {
      return *shape_;
    }

    /// Distance of @p x from the surface, m; negative inside.
    double
    signed_distance(const dealii::Point<dim> &x) const
    {
      return shape_->signed_distance(at_start(x));
    }

    /// Whether the obstacle, including its surface, contains @p x.
    bool
    contains(const dealii::Point<dim> &x) const
    {
      return shape_->contains(at_start(x));
    }

    /// Unit normal out of the obstacle at the place of the surface nearest to
    /// @p x.
    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const
    {
      return rotated(shape_->normal(at_start(x)), angle_);
    }

    /// Return signed_distance(), m, and normal() at @p x.
    std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const dealii::Point<dim> &x) const
    {
      auto result   = shape_->distance_and_normal(at_start(x));
      result.second = rotated(result.second, angle_);
      return result;
    }

    /// Whether the surface may be nearer to @p x than @p radius, m.
    bool
    may_cut_ball(const dealii::Point<dim> &x, const double radius) const
    {
      return shape_->may_cut_ball(at_start(x), radius);
    }

    Box<dim>
    bounding_box() const;

    /// Return a sentence for the log on the position of the obstacle; empty for
    /// shapes whose parameters say it.
    std::string
    fact() const;

    /// Return a sentence for the log if the shape is a substitute for the shape
    /// that the user asked for; empty otherwise.
    std::string
    remark() const;

    /// Maximum shear stress that the surface passes to the soil at @p x, Pa;
    /// infinite without limit.
    double
    maximum_shear_stress(const dealii::Point<dim> &x) const;

    /// Law of friction along the surface.
    const Bed<dim> &
    bed() const
    {
      return bed_;
    }

    Bed<dim> &
    bed()
    {
      return bed_;
    }

    bool
    moves() const
    {
      return velocity_ != nullptr || prescribed_velocity_ || body_.exists();
    }

    /// Motion by forces; RigidBody::exists() is false without a mass.
    const RigidBody<dim> &
    body() const
    {
      return body_;
    }

    RigidBody<dim> &
    body()
    {
      return body_;
    }

    /// Velocity of the reference point at time @p t, s, in m/s; zero if the
    /// obstacle is at rest. A body with a mass has one velocity per step. If a
    /// function prescribes the velocity: in the last step that has begun,
    /// whatever @p t is.
    dealii::Tensor<1, dim>
    velocity(double t) const;

    /// Velocity of the place @p x of the obstacle at time @p t, s, in m/s.
    dealii::Tensor<1, dim>
    velocity_at(const dealii::Point<dim> &x, double t) const
    {
      return body_.exists() ? body_.velocity_at(x - reference_point())
                            : velocity(t);
    }

    /// Move an obstacle with a prescribed velocity from time @p t, s, by a step
    /// @p dt, s, with the velocity at the middle of the step.
    void
    advance(double t, double dt);

    /// Move a body with a mass by a step @p dt, s, with its velocity.
    void
    advance_body(double dt);

    /// Displacement since the start of the run, m.
    const dealii::Tensor<1, dim> &
    displacement() const
    {
      return displacement_;
    }

    /// Angle of rotation since the start of the run, rad, counterclockwise; 0
    /// in 3-D.
    double
    angle() const
    {
      return angle_;
    }

    /// Point about which moments are taken, m; moves with the obstacle. Centre
    /// of mass of a body with a mass.
    dealii::Point<dim>
    reference_point() const
    {
      return reference_point_ + displacement_;
    }

    void
    list_state(StateList &list);

  private:
    void
    prepare_reference_point();
    void
    check_motion() const;

    /// Place of the obstacle at the start of the run which is now at @p x, m.
    dealii::Point<dim>
    at_start(const dealii::Point<dim> &x) const
    {
      if (angle_ == 0.)
        return x - displacement_;
      return reference_point_ + rotated(x - reference_point(), -angle_);
    }

    std::string
    path(const std::string &entry) const
    {
      return "'Obstacles/" + name_ + "/" + entry + "'";
    }

    std::string          name_;
    ShapeParameters<dim> shape_parameters_;
    Bed<dim>             bed_;
    RigidBody<dim>       body_;

    // Parameters
    std::string velocity_text_        = "";
    std::string reference_point_text_ = "";

    std::unique_ptr<Shape<dim>>      shape_;
    std::unique_ptr<Expression<dim>> velocity_;        ///< m/s; null: at rest
    dealii::Point<dim>               reference_point_; ///< at the start, m
    dealii::Tensor<1, dim>           displacement_;
    VelocityOfTime                   prescribed_velocity_; ///< may be empty
    dealii::Tensor<1, dim>           velocity_of_step_;    ///< m/s, prescribed
    double                           angle_ = 0;           ///< rad
  };
} // namespace talus

#endif

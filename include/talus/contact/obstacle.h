// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_obstacle_h
#define talus_contact_obstacle_h

#include <talus/base/expression.h>
#include <talus/base/shear_stress_cap.h>
#include <talus/base/state.h>
#include <talus/boundaries/interface_friction.h>
#include <talus/geometry/shape.h>
#include <talus/geometry/shape_parameters.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>

namespace talus
{
  /// A rigid body that soil cannot enter: a seabed, a pipeline, a wall. Its
  /// surface passes shear to the soil by Coulomb friction, capped by a largest
  /// shear stress. It may move, as a whole and without turning.
  template <int dim>
  class Obstacle : public dealii::ParameterAcceptor
  {
  public:
    explicit Obstacle(const std::string &name);

    /// To be called after parsing; @p surfaces are those that shapes may name.
    /// Throws ExcUser if parameters cannot be understood.
    void
    prepare(const Constants          &constants,
            const SurfaceSource<dim> *surfaces = nullptr);

    const std::string &
    name() const
    {
      return name_;
    }

    /// At the start of the run.
    const Shape<dim> &
    shape() const
    {
      return *shape_;
    }

    /// Distance of @p x from the surface where it is now, m; negative inside.
    double
    signed_distance(const dealii::Point<dim> &x) const
    {
      return shape_->signed_distance(x - displacement_);
    }

    /// Unit vector out of the obstacle, of the place of the surface that is
    /// nearest to @p x.
    dealii::Tensor<1, dim>
    normal(const dealii::Point<dim> &x) const
    {
      return shape_->normal(x - displacement_);
    }

    /// Both at once.
    std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const dealii::Point<dim> &x) const
    {
      return shape_->distance_and_normal(x - displacement_);
    }

    /// Whether the surface may be nearer to @p x than @p radius, m.
    bool
    may_cut_ball(const dealii::Point<dim> &x, const double radius) const
    {
      return shape_->may_cut_ball(x - displacement_, radius);
    }

    Box<dim>
    bounding_box() const;

    /// Sentence for the log on where the obstacle lies; empty for shapes whose
    /// parameters say it.
    std::string
    fact() const;

    /// Sentence for the log on what the shape only stands for; empty if it is
    /// what the user asked for.
    std::string
    remark() const;

    /// Whether friction has a limit besides the coefficient.
    bool
    limits_shear_stress() const
    {
      return !maximum_shear_stress_text_.empty();
    }

    /// Largest shear stress that the surface passes to the soil at @p x, Pa;
    /// infinite if there is no limit.
    double
    maximum_shear_stress(const dealii::Point<dim> &x) const;

    /// Whether set_depth() must be called before that.
    bool
    depends_on_depth() const
    {
      return limits_shear_stress() && maximum_shear_stress_->depends_on_depth();
    }

    void
    set_depth(const typename ShearStressCap<dim>::Depth &depth)
    {
      if (limits_shear_stress())
        maximum_shear_stress_->set_depth(depth);
    }

    /// Return the law of friction along the surface.
    const InterfaceFriction &
    friction() const
    {
      return friction_;
    }

    InterfaceFriction &
    friction()
    {
      return friction_;
    }

    bool
    moves() const
    {
      return velocity_ != nullptr;
    }

    /// Of this time, s; m/s.
    dealii::Tensor<1, dim>
    velocity(double t) const;

    /// Move on by a step of @p dt with the velocity at its middle.
    void
    advance(double t, double dt);

    /// From where it was at the start, m.
    const dealii::Tensor<1, dim> &
    displacement() const
    {
      return displacement_;
    }

    /// The point that moments are about; it moves with the obstacle.
    dealii::Point<dim>
    reference_point() const;

    void
    list_state(StateList &list);

  private:
    void
    prepare_reference_point();

    std::string
    path(const std::string &entry) const
    {
      return "'Obstacles/" + name_ + "/" + entry + "'";
    }

    std::string          name_;
    ShapeParameters<dim> shape_parameters_;
    InterfaceFriction    friction_;

    // Parameters
    std::string maximum_shear_stress_text_ = "";
    std::string velocity_text_             = "";
    std::string reference_point_text_      = "";

    std::unique_ptr<Shape<dim>> shape_;
    std::unique_ptr<ShearStressCap<dim>>
                                     maximum_shear_stress_; ///< Pa, if limited
    std::unique_ptr<Expression<dim>> velocity_;        ///< m/s, if it moves
    dealii::Point<dim>               reference_point_; ///< at the start, m
    dealii::Tensor<1, dim>           displacement_;
  };
} // namespace talus

#endif

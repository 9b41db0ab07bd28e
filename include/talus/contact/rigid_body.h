// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_rigid_body_h
#define talus_contact_rigid_body_h

#include <talus/base/expression.h>
#include <talus/base/state_list.h>
#include <talus/contact/spring.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Return the vector @p v turned by @p angle, rad, counterclockwise. In 3-D
  /// nothing turns.
  template <int dim>
  dealii::Tensor<1, dim>
  rotated(const dealii::Tensor<1, dim> &v, const double angle)
  {
    if (dim == 3 || angle == 0.)
      return v;
    dealii::Tensor<1, dim> result;
    result[0] = std::cos(angle) * v[0] - std::sin(angle) * v[1];
    result[1] = std::sin(angle) * v[0] + std::cos(angle) * v[1];
    return result;
  }



  /// Motion of an obstacle with a mass by forces: the soil, an external force,
  /// and springs. Parameters are in the section of the obstacle.
  ///
  /// The body has three axes: x, y and the rotation about z in 2-D; x, y and z
  /// in 3-D, where the body does not rotate. Vectors of three entries have an
  /// entry for each axis: m/s or rad/s, N s or N m s. The velocity belongs to
  /// the middle of a step, as the velocities of the soil do.
  template <int dim>
  class RigidBody : public dealii::ParameterAcceptor
  {
  public:
    static constexpr unsigned int n_axes = 3;
    using Vector                         = dealii::Tensor<1, n_axes>;

    /// @p name of the obstacle.
    explicit RigidBody(const std::string &name);

    /// Read axes, springs and force; call after parsing. Throws ExcUser.
    /// @param reference_point centre of mass at the start, m
    void
    prepare(const Constants          &constants,
            const dealii::Point<dim> &reference_point);

    /// Whether the obstacle has a mass.
    bool
    exists() const
    {
      return mass_ > 0;
    }

    bool
    is_free(const unsigned int axis) const
    {
      return is_free_[axis];
    }

    bool
    rotates() const
    {
      return dim == 2 && is_free_[2];
    }

    /// Name of an axis in parameters and messages.
    static std::string
    name_of_axis(unsigned int axis);

    /// Velocity, m/s and rad/s, of the last step or, in a step, of the contact
    /// iteration.
    const Vector &
    velocity() const
    {
      return velocity_;
    }

    /// Velocity of the place of the body at @p arm, m, from the centre of mass,
    /// m/s.
    dealii::Tensor<1, dim>
    velocity_at(const dealii::Tensor<1, dim> &arm) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = velocity_[d];
      if constexpr (dim == 2)
        {
          result[0] -= velocity_[2] * arm[1];
          result[1] += velocity_[2] * arm[0];
        }
      return result;
    }

    /// Return the entries by axis of the impulse @p impulse, N s, at @p arm, m,
    /// from the centre of mass. Also maps a direction to the direction in the
    /// space of the axes.
    static Vector
    by_axis(const dealii::Tensor<1, dim> &arm,
            const dealii::Tensor<1, dim> &impulse)
    {
      Vector result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = impulse[d];
      if constexpr (dim == 2)
        result[2] = arm[0] * impulse[1] - arm[1] * impulse[0];
      return result;
    }

    /// Begin a step of @p dt, s, at time @p t, s: evaluate the force.
    void
    begin_step(double t, double dt);

    /// Impulse of the soil with which the body has a velocity after the step,
    /// by axis.
    struct Demand
    {
      Vector impulse; ///< N s
      Vector scale;   ///< sum of the absolute terms of the impulse, N s
      Vector slope;   ///< derivative of the impulse by the velocity, kg
    };

    /// Return the demand of velocity(). Held axes have no demand.
    Demand
    demand() const;

    /// Mass, kg, or moment of inertia, kg m^2, by axis.
    double
    inertia(const unsigned int axis) const
    {
      return dim == 2 && axis == 2 ? moment_of_inertia_ : mass_;
    }

    /// Set the velocity of the contact iteration in the present step.
    void
    set_velocity(const Vector &velocity)
    {
      velocity_ = velocity;
    }

    /// Energies of a step, J.
    struct Works
    {
      double kinetic    = 0; ///< kinetic energy after the step
      double stored     = 0; ///< elastic energy of the springs after the step
      double dissipated = 0; ///< lost by springs that yield and by dashpots
      double of_force   = 0; ///< work of the external force
      double of_soil    = 0; ///< work of the soil on the body

      Works &
      operator+=(const Works &other);
    };

    /// End the step begun by begin_step(): compute the velocity from the
    /// @p impulse of the soil, N s, and move the springs.
    Works
    end_step(const Vector &impulse);

    /// Force of springs and dashpots on the body in the last step, N and N m.
    Vector
    spring_force() const;

    /// Plastic elongation of the springs, m and rad.
    Vector
    spring_slip() const;

    void
    list_state(StateList &list);

  private:
    std::string
    path(const std::string &entry) const
    {
      return "'Obstacles/" + name_ + "/" + entry + "'";
    }

    void
    check_that_mass_is_given() const;
    void
    prepare_axes();
    std::array<double, n_axes>
    numbers_by_axis(const std::string         &entry,
                    const std::vector<double> &numbers,
                    double                     default_value) const;
    void
    prepare_springs();

    std::string name_;

    // Parameters
    double                   mass_              = 0;
    double                   moment_of_inertia_ = 0;
    std::vector<std::string> free_axes_;
    std::string              force_text_ = "";
    std::vector<double>      stiffness_, damping_, yield_force_;

    std::array<bool, n_axes>         is_free_{};
    std::array<Spring, n_axes>       springs_;
    std::unique_ptr<Expression<dim>> force_;           ///< N, N m; null: none
    dealii::Point<dim>               reference_point_; ///< at the start, m

    Vector velocity_;

    // Data of one step
    double time_step_ = 0; ///< s
    Vector before_;        ///< velocity before the step
    Vector driven_;        ///< impulse of the external force, N s
  };
} // namespace talus

#endif

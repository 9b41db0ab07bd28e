// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_loading_h
#define talus_problem_loading_h

#include <talus/base/expression.h>
#include <talus/materials/materials.h>
#include <talus/problem/ground_motion.h>
#include <talus/transfer/loads.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Gravity, turned by the slope angle, motion of the ground, and a body force
  /// by expression.
  template <int dim>
  class Loading
  {
  public:
    /// Paths of tables start in @p folder.
    explicit Loading(const std::filesystem::path &folder);

    /// Compute gravity for each of @p n_bodies bodies, in a run to @p end_time,
    /// s. Call after parsing. Throws ExcUser.
    void
    prepare(const Materials<dim> &materials,
            unsigned int          n_bodies,
            const Constants      &constants,
            double                end_time);

    /// Set the accelerations at time @p t, s, of a static stage or of the
    /// slide. Call before loads().
    void
    update(const Points<dim> &points, double t, bool is_static = false);

    const Loads<dim> &
    loads() const
    {
      return loads_;
    }

    /// Acceleration of full gravity, m/s^2; x points down the slope, y away
    /// from the slope.
    dealii::Tensor<1, dim>
    gravity() const;

    /// Ratio of gravity at time @p t, s, to full gravity [-].
    double
    share_of_gravity(double t) const;

    /// Time after which accelerations are constant, s; infinity with a body
    /// force by expression.
    double
    time_of_last_change() const
    {
      return expression_
               ? std::numeric_limits<double>::infinity()
               : std::max(gravity_.ramp_time, ground_motion_.last_time());
    }

    /// Return a remark if no load ever acts on the soil; empty otherwise.
    std::string
    note() const;

    void
    list_state(StateList &list) const
    {
      ground_motion_.list_state(list);
    }

  private:
    struct Gravity : public dealii::ParameterAcceptor
    {
      Gravity();
      double magnitude   = 9.81;
      double slope_angle = 0.;
      double ramp_time   = 0.;

      std::vector<double> horizontal_coefficient;
    };

    struct BodyForce : public dealii::ParameterAcceptor
    {
      BodyForce();
      std::string expression  = "";
      std::string coordinates = "spatial";
    };

    double
    slope_angle() const; // radians
    dealii::Tensor<1, dim>
    pseudo_static_acceleration() const; // of the whole mass, m/s^2

    Gravity                          gravity_;
    BodyForce                        body_force_;
    GroundMotion<dim>                ground_motion_;
    std::unique_ptr<Expression<dim>> expression_;
    Loads<dim>                       loads_;
    /// Full weight divided by mass, for each body, m/s^2.
    std::vector<dealii::Tensor<1, dim>> full_;
  };
} // namespace talus

#endif

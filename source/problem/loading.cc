// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/loading.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Loading<dim>::Gravity::Gravity()
    : ParameterAcceptor("/Gravity")
  {
    add_parameter("Magnitude",
                  magnitude,
                  "Acceleration of gravity [m/s^2].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Slope angle",
                  slope_angle,
                  "Angle by which the mesh is turned against the horizontal "
                  "[degrees]: gravity points along (sin, -cos), and x points "
                  "down the slope.",
                  this->prm,
                  Patterns::Double(-90., 90.));
    add_parameter("Ramp time",
                  ramp_time,
                  "Time over which gravity grows from 0 to the full "
                  "magnitude, smoothly by half a cosine [s]; 0 for full "
                  "gravity from the start.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Horizontal coefficient",
                  horizontal_coefficient,
                  "Pseudo-static horizontal acceleration k_h of the whole mass "
                  "over gravity [-], as of an earthquake: a number along x, or "
                  "in 3-D two along x and z. Acts in the static stages, not in "
                  "the slide. Empty: none.");
  }



  /// "material" is for forces at the initial place of the soil, for instance of
  /// manufactured solutions.
  template <int dim>
  Loading<dim>::BodyForce::BodyForce()
    : ParameterAcceptor("/Body force")
  {
    add_parameter("Expression",
                  expression,
                  "Components of a force per unit mass as expressions in x, y, "
                  "(z,) t, separated by semicolons [m/s^2]; empty for none.");
    add_parameter("Coordinates",
                  coordinates,
                  "Meaning of x, y, z: 'spatial' (present place of the "
                  "point) or 'material' (place at the start, without initial "
                  "displacement).",
                  this->prm,
                  Patterns::Selection("spatial|material"));
  }



  template <int dim>
  Loading<dim>::Loading(const std::filesystem::path &folder)
    : ground_motion_(folder)
  {}



  /// Return the slope angle in radians.
  template <int dim>
  double
  Loading<dim>::slope_angle() const
  {
    return gravity_.slope_angle * numbers::PI / 180.;
  }



  /// Full gravity in the axes of the mesh, m/s^2: x points down the slope.
  template <int dim>
  Tensor<1, dim>
  Loading<dim>::gravity() const
  {
    const double   angle = slope_angle();
    Tensor<1, dim> g;
    g[0] = gravity_.magnitude * std::sin(angle);
    g[1] = -gravity_.magnitude * std::cos(angle);
    return g;
  }



  /// Half a cosine begins and ends without a jump in the rate, and excites less
  /// waves than a linear ramp. Multiplied by the gravity factor of the ground
  /// motion.
  template <int dim>
  double
  Loading<dim>::share_of_gravity(const double t) const
  {
    const double ramp =
      t < gravity_.ramp_time
        ? 0.5 * (1. - std::cos(numbers::PI * t / gravity_.ramp_time))
        : 1.;
    return ramp * ground_motion_.gravity_factor(t);
  }



  /// full_ is the acceleration of the whole mass of a body under the submerged
  /// weight: buoyancy reduces weight, not inertia. full_ is constant in a run;
  /// each step only scales the accelerations.
  template <int dim>
  void
  Loading<dim>::prepare(const Materials<dim> &materials,
                        const unsigned int    n_bodies,
                        const Constants      &constants,
                        const double          end_time)
  {
    ground_motion_.prepare(end_time);
    AssertThrow(gravity_.horizontal_coefficient.size() < dim,
                ExcUser(text("'Gravity/Horizontal coefficient' has ",
                             gravity_.horizontal_coefficient.size(),
                             " numbers, where at most ",
                             dim - 1,
                             " were expected. Remove the others.")));
    full_.clear();
    for (unsigned int b = 0; b < n_bodies; ++b)
      full_.push_back(materials.of_body(b).submerged_density() /
                      materials.of_body(b).density() * gravity());
    loads_.acceleration_of_body = full_;
    loads_.varies               = !body_force_.expression.empty();
    if (loads_.varies)
      expression_ = std::make_unique<Expression<dim>>("'Body force/Expression'",
                                                      body_force_.expression,
                                                      dim,
                                                      constants);
  }



  template <int dim>
  Tensor<1, dim>
  Loading<dim>::pseudo_static_acceleration() const
  {
    std::vector<double> k = gravity_.horizontal_coefficient;
    k.resize(2);
    const double   angle = slope_angle();
    Tensor<1, dim> acceleration;
    acceleration[0] = gravity_.magnitude * k[0] * std::cos(angle);
    acceleration[1] = gravity_.magnitude * k[0] * std::sin(angle);
    if (dim == 3)
      acceleration[dim - 1] = gravity_.magnitude * k[1];
    return acceleration;
  }



  /// Accelerations at time @p t for all points. A vector per body suffices if
  /// they do not vary in space; only a body force needs a row per point.
  template <int dim>
  void
  Loading<dim>::update(const Points<dim> &points,
                       const double       t,
                       const bool         is_static)
  {
    // The inertia of the whole mass resists, not of the submerged mass.
    Tensor<1, dim> ground = ground_motion_.acceleration(t, slope_angle());
    if (is_static)
      ground -= pseudo_static_acceleration();
    const double share = share_of_gravity(t);
    for (unsigned int b = 0; b < full_.size(); ++b)
      loads_.acceleration_of_body[b] = share * full_[b] - ground;
    if (!loads_.varies)
      return;
    const unsigned int coordinates = body_force_.coordinates == "material"
                                       ? points.initial_position
                                       : points.position;
    // Kernels load whole registers, beyond the last point.
    for (auto &row : loads_.acceleration_of_point)
      row.resize(points.size() + Points<dim>::n_spare);
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const Point<dim> x = load_place(points, coordinates, p);
        for (unsigned int d = 0; d < dim; ++d)
          loads_.acceleration_of_point[d][p] =
            expression_->finite_value(x, t, d);
      }
  }



  template <int dim>
  std::string
  Loading<dim>::note() const
  {
    if (gravity_.magnitude > 0. || expression_ || ground_motion_.has_table())
      return "";
    return "'Gravity/Magnitude' is 0, and there is neither a body force nor a "
           "motion of the ground: the soil has no weight, and only initial "
           "velocities and stresses, faces of the mesh and obstacles move the "
           "soil.";
  }



  template class Loading<2>;
  template class Loading<3>;
} // namespace talus

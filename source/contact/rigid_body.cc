// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/rigid_body.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  RigidBody<dim>::RigidBody(const std::string &name)
    : ParameterAcceptor("/Obstacles/" + name)
    , name_(name)
  {
    const auto        numbers = Patterns::List(Patterns::Double(0.), 0, n_axes);
    const std::string axes =
      dim == 2 ? "x, y and, if the obstacle rotates, rotation" : "x, y, z";
    add_parameter(
      "Mass",
      mass_,
      "Mass of the obstacle, in 2-D per metre [kg], with the added "
      "mass of water around it: the obstacle moves by the forces of "
      "the soil, 'Force' and springs. 0: the obstacle is at rest or "
      "moves with 'Velocity'.",
      this->prm,
      Patterns::Double(0.));
    add_parameter(
      "Free axes",
      free_axes_,
      "Axes along which an obstacle with a mass can move, separated "
      "by commas: x, y, z, and in 2-D rotation, about 'Reference "
      "point'. All other axes are held. Empty: x, y (, z).");
    add_parameter("Moment of inertia",
                  moment_of_inertia_,
                  "Moment of inertia of an obstacle with the free axis "
                  "rotation, about 'Reference point', per metre [kg m^2].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter(
      "Force",
      force_text_,
      "External force on an obstacle with a mass, as its weight in "
      "water: components as expressions in t, separated by "
      "semicolons [N], in 2-D per metre; with the free axis "
      "rotation followed by the moment [N m]. x, y (, z) are those "
      "of the reference point at the start. Gravity does not act on "
      "obstacles. Empty: none.");
    add_parameter("Spring stiffness",
                  stiffness_,
                  "Stiffness of the springs that hold an obstacle with a mass, "
                  "by axis: " +
                    axes +
                    " [N/m, N m/rad]. The springs are free of force at the "
                    "start. Empty: no springs.",
                  this->prm,
                  numbers);
    add_parameter("Spring damping",
                  damping_,
                  "Coefficients of dashpots beside the springs, by axis as in "
                  "'Spring stiffness' [N s/m, N m s/rad]. Empty: none.",
                  this->prm,
                  numbers);
    add_parameter("Spring yield force",
                  yield_force_,
                  "Forces at which the springs yield, by axis as in 'Spring "
                  "stiffness' [N, N m]; 0: never. Empty: none yields.",
                  this->prm,
                  numbers);
  }



  template <int dim>
  std::string
  RigidBody<dim>::name_of_axis(const unsigned int axis)
  {
    return axis == 0 ? "x" : axis == 1 ? "y" : dim == 2 ? "rotation" : "z";
  }



  template <int dim>
  void
  RigidBody<dim>::prepare(const Constants  &constants,
                          const Point<dim> &reference_point)
  {
    reference_point_ = reference_point;
    check_that_mass_is_given();
    if (!exists())
      return;
    prepare_axes();
    prepare_springs();
    force_.reset();
    if (!force_text_.empty())
      force_ = std::make_unique<Expression<dim>>(path("Force"),
                                                 force_text_,
                                                 dim + rotates(),
                                                 constants);
    begin_step(0., 0.); // throws here rather than in the first step
  }



  template <int dim>
  void
  RigidBody<dim>::check_that_mass_is_given() const
  {
    const auto needs_mass = [this](const std::string &entry,
                                   const bool         is_given) {
      AssertThrow(exists() || !is_given,
                  ExcUser(text(path(entry),
                               " is given, but ",
                               path("Mass"),
                               " is 0: only an obstacle with a mass moves by "
                               "forces. Give the mass in kg (in 2-D per "
                               "metre), or remove the entry.")));
    };
    needs_mass("Free axes", !free_axes_.empty());
    needs_mass("Moment of inertia", moment_of_inertia_ > 0);
    needs_mass("Force", !force_text_.empty());
    needs_mass("Spring stiffness", !stiffness_.empty());
    needs_mass("Spring damping", !damping_.empty());
    needs_mass("Spring yield force", !yield_force_.empty());
  }



  template <int dim>
  void
  RigidBody<dim>::prepare_axes()
  {
    is_free_.fill(free_axes_.empty());
    if (dim == 2 && free_axes_.empty())
      is_free_[2] = false;
    for (const std::string &name : free_axes_)
      {
        unsigned int axis = 0;
        while (axis < n_axes && name_of_axis(axis) != name)
          ++axis;
        AssertThrow(axis < n_axes,
                    ExcUser(text(path("Free axes"),
                                 " has the axis '",
                                 name,
                                 "'; expected some of x, y, ",
                                 name_of_axis(2),
                                 ", separated by commas.",
                                 dim == 3 ? " In 3-D obstacles do not rotate."
                                          : "")));
        is_free_[axis] = true;
      }
    AssertThrow(dim == 3 || rotates() == (moment_of_inertia_ > 0),
                ExcUser(text(path("Moment of inertia"),
                             " is ",
                             moment_of_inertia_,
                             " kg m^2, but the axis rotation is ",
                             rotates() ? "" : "not ",
                             "listed in ",
                             path("Free axes"),
                             ". An obstacle that rotates needs both; give "
                             "both or neither.")));
    AssertThrow(dim == 2 || moment_of_inertia_ == 0,
                ExcUser(text(path("Moment of inertia"),
                             " is given, but in 3-D obstacles do not rotate. "
                             "Remove the entry.")));
  }



  /// Return @p numbers of the entry @p entry by axis. Axes without a number get
  /// @p default_value.
  template <int dim>
  std::array<double, RigidBody<dim>::n_axes>
  RigidBody<dim>::numbers_by_axis(const std::string         &entry,
                                  const std::vector<double> &numbers,
                                  const double default_value) const
  {
    std::array<double, n_axes> result;
    result.fill(default_value);
    const unsigned int n_expected = dim + rotates();
    AssertThrow(numbers.empty() || numbers.size() == n_expected,
                ExcUser(text(path(entry),
                             " has ",
                             numbers.size(),
                             " numbers; expected ",
                             n_expected,
                             ", separated by commas, for the axes x, y",
                             n_expected == 3 ? ", " + name_of_axis(2) : "",
                             ". Give 0 for an axis without.")));
    for (unsigned int axis = 0; axis < numbers.size(); ++axis)
      {
        AssertThrow(is_free_[axis] || numbers[axis] == 0,
                    ExcUser(text(path(entry),
                                 " is ",
                                 numbers[axis],
                                 " for the axis ",
                                 name_of_axis(axis),
                                 ", which ",
                                 path("Free axes"),
                                 " does not list: the obstacle is held there. "
                                 "List the axis, or give 0.")));
        if (numbers[axis] > 0)
          result[axis] = numbers[axis];
      }
    return result;
  }



  template <int dim>
  void
  RigidBody<dim>::prepare_springs()
  {
    const auto stiffness = numbers_by_axis("Spring stiffness", stiffness_, 0.);
    const auto damping   = numbers_by_axis("Spring damping", damping_, 0.);
    const auto yield     = numbers_by_axis("Spring yield force",
                                       yield_force_,
                                       std::numeric_limits<double>::infinity());
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      {
        AssertThrow(std::isinf(yield[axis]) || stiffness[axis] > 0,
                    ExcUser(text(path("Spring yield force"),
                                 " is ",
                                 yield[axis],
                                 " for the axis ",
                                 name_of_axis(axis),
                                 ", where ",
                                 path("Spring stiffness"),
                                 " is 0: no spring can yield. Give the "
                                 "stiffness, or 0 for the yield force.")));
        springs_[axis] = Spring(stiffness[axis], damping[axis], yield[axis]);
      }
  }



  template <int dim>
  void
  RigidBody<dim>::begin_step(const double t, const double dt)
  {
    time_step_                      = dt;
    before_                         = velocity_;
    driven_                         = Vector();
    const unsigned int n_components = dim + rotates();
    if (force_)
      for (unsigned int axis = 0; axis < n_components; ++axis)
        driven_[axis] = dt * force_->finite_value(reference_point_, t, axis);
  }



  template <int dim>
  typename RigidBody<dim>::Demand
  RigidBody<dim>::demand() const
  {
    Demand result;
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      if (is_free_[axis])
        {
          const double before = before_[axis], after = velocity_[axis];
          const Spring::Resistance resistance =
            springs_[axis].resistance(before, after, time_step_);
          const double m = inertia(axis);
          result.impulse[axis] =
            m * (after - before) + resistance.impulse - driven_[axis];
          result.scale[axis] = m * (std::abs(after) + std::abs(before)) +
                               std::abs(resistance.impulse) +
                               std::abs(driven_[axis]);
          result.slope[axis] = m + resistance.slope;
        }
    return result;
  }



  template <int dim>
  typename RigidBody<dim>::Works &
  RigidBody<dim>::Works::operator+=(const Works &other)
  {
    kinetic += other.kinetic;
    stored += other.stored;
    dissipated += other.dissipated;
    of_force += other.of_force;
    of_soil += other.of_soil;
    return *this;
  }



  template <int dim>
  typename RigidBody<dim>::Works
  RigidBody<dim>::end_step(const Vector &impulse)
  {
    Works works;
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      if (is_free_[axis])
        {
          Spring      &spring = springs_[axis];
          const double v      = spring.velocity_after(inertia(axis),
                                                 before_[axis],
                                                 impulse[axis] + driven_[axis],
                                                 time_step_);
          const double mean   = 0.5 * (before_[axis] + v);
          works.dissipated += spring.advance(before_[axis], v, time_step_);
          works.stored += spring.stored_energy();
          works.kinetic += 0.5 * inertia(axis) * v * v;
          works.of_force += driven_[axis] * mean;
          works.of_soil += impulse[axis] * mean;
          velocity_[axis] = v;
          AssertThrow(std::abs(v) <= 1e6,
                      ExcPoint(text("The velocity of the obstacle '",
                                    name_,
                                    "' along the axis ",
                                    name_of_axis(axis),
                                    " is ",
                                    v,
                                    " m/s (or rad/s); expected at most 1e6. "
                                    "Check the units of ",
                                    path("Mass"),
                                    " and ",
                                    path("Force"),
                                    ".")));
        }
    return works;
  }



  template <int dim>
  typename RigidBody<dim>::Vector
  RigidBody<dim>::spring_force() const
  {
    Vector result;
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      result[axis] = springs_[axis].force();
    return result;
  }



  template <int dim>
  typename RigidBody<dim>::Vector
  RigidBody<dim>::spring_slip() const
  {
    Vector result;
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      result[axis] = springs_[axis].slip();
    return result;
  }



  template <int dim>
  void
  RigidBody<dim>::list_state(StateList &list)
  {
    if (!exists())
      return;
    const std::string name = "obstacle " + name_;
    list.add_components(
      "velocity of " + name, "", velocity_, n_axes, Reduction::equal);
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      springs_[axis].list_state(name + " " + name_of_axis(axis), list);
  }



  template class RigidBody<2>;
  template class RigidBody<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacle.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Obstacle<dim>::Obstacle(const std::string &name)
    : ParameterAcceptor("/Obstacles/" + name)
    , name_(name)
    , shape_parameters_("/Obstacles/" + name)
    , bed_("/Obstacles/" + name,
           "",
           "Maximum shear stress that the surface passes to the soil [Pa]: a "
           "number, or an expression in x, y (, z), the place at the start, "
           "the names of surfaces, and, for an obstacle at rest, in depth, the "
           "depth of the place "
           "below the mudline at the start [m], 0 without soil above. Empty: "
           "no limit.")
    , body_(name)
  {
    add_parameter("Velocity",
                  velocity_text_,
                  "Components of the velocity of the obstacle, expressions in "
                  "t separated by semicolons [m/s]. The obstacle does not "
                  "rotate: x, y (, z) are those of the reference point at the "
                  "start. Empty: at rest, unless 'Mass' is given.");
    add_parameter(
      "Reference point",
      reference_point_text_,
      "Point about which moments are taken, as x,y or x,y,z, with "
      "`Coordinates` = map as easting, northing, height [m]; the "
      "point moves with the obstacle. Centre of mass of an obstacle "
      "with a mass. Empty: the centre of the obstacle, 0 along axes "
      "without two ends.",
      this->prm,
      Patterns::List(Patterns::Double(), 0, dim));
  }



  namespace
  {
    /// Centre of a box, m; 0 along an axis without two ends.
    template <int dim>
    Point<dim>
    middle(const Box<dim> &box)
    {
      Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        if (const double x = 0.5 * (box.lower[d] + box.upper[d]);
            std::isfinite(x))
          result[d] = x;
      return result;
    }
  } // namespace



  // Expressions are parsed here, after all parameters are known: constants may
  // be defined anywhere in the file.
  template <int dim>
  void
  Obstacle<dim>::prepare(const Constants          &constants,
                         const SurfaceSource<dim> *surfaces)
  {
    shape_parameters_.use_surfaces(surfaces);
    // Prisms and cylinders without ends continue beyond the mesh.
    Box<dim> everywhere;
    for (unsigned int d = 0; d < dim; ++d)
      {
        everywhere.upper[d] = std::numeric_limits<double>::infinity();
        everywhere.lower[d] = -everywhere.upper[d];
      }
    shape_ = shape_parameters_.make(everywhere);
    bed_.prepare(constants, surfaces);
    velocity_.reset();
    if (!velocity_text_.empty())
      velocity_ = std::make_unique<Expression<dim>>(path("Velocity"),
                                                    velocity_text_,
                                                    dim,
                                                    constants);
    prepare_reference_point();
    body_.prepare(constants, reference_point_);
    check_motion();
    velocity(0.); // throws here rather than in the first step
  }



  namespace
  {
    template <int dim>
    bool
    is_bounded(const Box<dim> &box)
    {
      bool result = true;
      for (unsigned int d = 0; d < dim; ++d)
        result = result && std::isfinite(box.length(d));
      return result;
    }
  } // namespace



  /// Check the motion against the other parameters. Throws ExcUser.
  template <int dim>
  void
  Obstacle<dim>::check_motion() const
  {
    const std::string motion = path(body_.exists() ? "Mass" : "Velocity");
    AssertThrow(!prescribed_velocity_ ||
                  (velocity_text_.empty() && !body_.exists()),
                ExcUser(text(motion,
                             " is given, but the program that leads the run "
                             "prescribes the velocity by a function, too. "
                             "Remove one of the two.")));
    AssertThrow(!body_.exists() || velocity_ == nullptr,
                ExcUser(text(path("Mass"),
                             " and ",
                             path("Velocity"),
                             " = ",
                             velocity_text_,
                             " are given: an obstacle moves either by the "
                             "forces that act or with a prescribed velocity. "
                             "Remove one of the entries.")));
    AssertThrow(!body_.rotates() || is_bounded(shape_->bounding_box()),
                ExcUser(text(path("Free axes"),
                             " lists rotation, but the shape has no ends, so "
                             "that the surface far away would move without "
                             "bound. Use a shape with ends, or remove "
                             "rotation.")));
    AssertThrow(!moves() || !bed_.depends_on_depth(),
                ExcUser(text(path("Maximum shear stress"),
                             " = ",
                             bed_.maximum_shear_stress_text(),
                             " depends on `depth`, the depth at the start, but "
                             "the obstacle moves (",
                             motion,
                             "). Give a stress without `depth`.")));
    AssertThrow(!bed_.softens() || bed_.limits_shear_stress(),
                ExcUser(text(path("Slip to remould"),
                             " is given, but ",
                             path("Maximum shear stress"),
                             " is empty, so that slip has nothing to take "
                             "away. Give the stress of the intact surface in "
                             "Pa, or remove the slip.")));
    AssertThrow(!bed_.softens() || !moves(),
                ExcUser(text(path("Slip to remould"),
                             " is given, but the obstacle moves (",
                             motion,
                             "). Slip is kept by place, and only surfaces at "
                             "rest can soften. Remove one of the entries.")));
  }



  template <int dim>
  void
  Obstacle<dim>::prepare_reference_point()
  {
    reference_point_ = middle(shape_->bounding_box());
    if (!reference_point_text_.empty())
      {
        const auto numbers =
          Utilities::split_string_list(reference_point_text_, ',');
        AssertThrow(numbers.size() == dim,
                    ExcUser(text(path("Reference point"),
                                 " = ",
                                 reference_point_text_,
                                 " has ",
                                 numbers.size(),
                                 " numbers; expected ",
                                 dim,
                                 " numbers, separated by commas.")));
        for (unsigned int d = 0; d < dim; ++d)
          reference_point_[d] = Utilities::string_to_double(numbers[d]);
        reference_point_ =
          shape_parameters_.coordinates().in_space(reference_point_);
      }
  }



  template <int dim>
  std::string
  Obstacle<dim>::fact() const
  {
    const std::string place = shape_parameters_.place_in_words();
    const std::string fact =
      place.empty() ? "" : "The obstacle '" + name_ + "' " + place;
    return fact +
           (!prescribed_velocity_
              ? ""
              : text(fact.empty() ? "" : " ",
                     "The velocity of the obstacle '",
                     name_,
                     "' is prescribed by the program that leads the run, "
                     "not by a parameter."));
  }



  template <int dim>
  std::string
  Obstacle<dim>::remark() const
  {
    const std::string remark = shape_parameters_.remark();
    return remark.empty() ? "" : "The obstacle '" + name_ + "' " + remark;
  }



  namespace
  {
    /// Bounding box of @p box turned by @p angle, rad, about @p centre, m.
    template <int dim>
    Box<dim>
    box_around_turned(const Box<dim>   &box,
                      const Point<dim> &centre,
                      const double      angle)
    {
      std::vector<Point<dim>> places = {centre};
      for (unsigned int v = 0; v < (1u << dim); ++v)
        {
          Point<dim> corner;
          for (unsigned int d = 0; d < dim; ++d)
            corner[d] = (v & (1u << d)) ? box.upper[d] : box.lower[d];
          places.push_back(centre + rotated<dim>(corner - centre, angle));
        }
      return talus::bounding_box(places);
    }
  } // namespace



  template <int dim>
  Box<dim>
  Obstacle<dim>::bounding_box() const
  {
    Box<dim> box = shape_->bounding_box();
    if (angle_ != 0.)
      box = box_around_turned(box, reference_point_, angle_);
    box.lower += displacement_;
    box.upper += displacement_;
    return box;
  }



  // Evaluated in the frame of the obstacle: a rough section of a pipe moves
  // with the pipe.
  template <int dim>
  double
  Obstacle<dim>::maximum_shear_stress(const Point<dim> &x) const
  {
    return bed_.maximum_shear_stress(at_start(x));
  }



  template <int dim>
  Tensor<1, dim>
  Obstacle<dim>::velocity(const double t) const
  {
    if (prescribed_velocity_)
      return velocity_of_step_;
    if (body_.exists())
      return body_.velocity_at(Tensor<1, dim>());
    Tensor<1, dim> v;
    if (velocity_)
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = velocity_->finite_value(reference_point_, t, d);
    AssertThrow(v.norm_square() <= 1e12,
                ExcUser(text(path("Velocity"),
                             " = ",
                             velocity_text_,
                             " is ",
                             v.norm(),
                             " m/s at t = ",
                             t,
                             " s; expected at most 1e6 m/s. Correct the "
                             "expression.")));
    return v;
  }



  // Velocities of the soil also belong to the middle of the step. A function
  // that prescribes the velocity may integrate an equation of motion: hence one
  // call per step.
  template <int dim>
  void
  Obstacle<dim>::advance(const double t, const double dt)
  {
    if (prescribed_velocity_)
      {
        velocity_of_step_ = prescribed_velocity_(t + 0.5 * dt);
        // NaN is no number at all.
        AssertThrow(velocity_of_step_.norm_square() <= 1e12,
                    ExcUser(text("The velocity of the obstacle '",
                                 name_,
                                 "', prescribed by the program that leads the "
                                 "run, is (",
                                 velocity_of_step_,
                                 ") m/s at t = ",
                                 t + 0.5 * dt,
                                 " s; expected at most 1e6 m/s. Correct the "
                                 "function.")));
      }
    if (velocity_ || prescribed_velocity_)
      displacement_ += dt * velocity(t + 0.5 * dt);
  }



  template <int dim>
  void
  Obstacle<dim>::advance_body(const double dt)
  {
    for (unsigned int d = 0; d < dim; ++d)
      displacement_[d] += dt * body_.velocity()[d];
    if (body_.rotates())
      angle_ += dt * body_.velocity()[2];
  }



  template <int dim>
  void
  Obstacle<dim>::list_state(StateList &list)
  {
    list.add_components("displacement of obstacle " + name_,
                        "m",
                        displacement_,
                        dim,
                        Reduction::equal);
    if (body_.rotates())
      list.add("angle of obstacle " + name_, "rad", angle_, Reduction::equal);
    body_.list_state(list);
  }



  template class Obstacle<2>;
  template class Obstacle<3>;
} // namespace talus

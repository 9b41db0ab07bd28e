// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/kinematics_kernel.h>
#include <talus/problem/initial_state.h>

#include <array>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Minimum ratio of deformed to initial volume; the maximum is the inverse.
    /// A displacement beyond is a mistake, with a vanishing time step or
    /// vanishing soil.
    constexpr double min_volume_ratio = 0.01;

    /// Return the derivative of component @p i along @p axis at t = 0, by
    /// central differences over three steps of @p delta on each side.
    template <int dim>
    double
    derivative(Expression<dim>   &expression,
               const Point<dim>  &X,
               const unsigned int i,
               const unsigned int axis,
               const double       delta)
    {
      // Exact for polynomials of sixth degree; with steps of a hundredth of a
      // point the error is 1e-12 (doc/method.md, section 2).
      constexpr std::array<double, 3> weights = {{0.75, -0.15, 1. / 60.}};
      double                          sum     = 0;
      for (unsigned int k = 0; k < 3; ++k)
        {
          Point<dim> before = X, after = X;
          before[axis] -= (k + 1) * delta;
          after[axis] += (k + 1) * delta;
          sum += weights[k] * (expression.finite_value(after, 0., i) -
                               expression.finite_value(before, 0., i));
        }
      return sum / delta;
    }
  } // namespace



  /// The entries stand in the section of the body, @p section.
  template <int dim>
  InitialState<dim>::InitialState(const std::string &section)
    : ParameterAcceptor(section)
    , section_(section)
  {
    add_parameter("Initial displacement",
                  displacement_,
                  "Expressions in x, y, (z,) t for the components of the "
                  "displacement at t = 0, separated by semicolons [m]; empty "
                  "for none. x, y, z are the place before the displacement, "
                  "in all initial fields. Deformation gradient and boxes are "
                  "set accordingly, and with hyperelastic laws the stress.");
    add_parameter("Initial velocity",
                  velocity_,
                  "Expressions in x, y, (z,) t for the components of the "
                  "velocity, separated by semicolons [m/s]; empty for rest. "
                  "t is the time of the velocity, see 'Initial velocity "
                  "time'.");
    add_parameter(
      "Initial stress",
      stress_,
      "Expressions in x, y, (z,) t for the Cauchy stress, tension "
      "positive [Pa]: in 2-D xx; yy; zz; xy, in 3-D xx; yy; zz; xy; "
      "xz; yz. Empty for none. Only for laws in rate form.");
    add_parameter("K0",
                  K0_,
                  "Coefficient of earth pressure at rest [-]: start with the "
                  "stress of ground at rest under the weight of all soil "
                  "above, along y. Stresses along the layer are K0 times the "
                  "stress across the layer; on a slope the shear stress of "
                  "an infinite slope is added. Layers follow the ground: the "
                  "bottom of the mesh, or a seabed that is an obstacle. "
                  "Empty: no such stress. Only for laws in rate form.",
                  this->prm,
                  Patterns::List(Patterns::Double(0.), 0, 1));
  }



  /// Return the name of an entry in the parameter file, for messages.
  template <int dim>
  std::string
  InitialState<dim>::path(const std::string &entry) const
  {
    return "'" + section_.substr(1) + "/" + entry + "'";
  }



  /// Refuse entries that contradict each other, or the law. With a hyperelastic
  /// law the first step would overwrite any stress.
  template <int dim>
  void
  InitialState<dim>::check(const MaterialModel<dim> &law) const
  {
    AssertThrow(stress_.empty() || K0_.empty(),
                ExcUser(text(path("Initial stress"),
                             " and ",
                             path("K0"),
                             " are given, but a body starts with one stress. "
                             "Remove one of the two.")));
    AssertThrow(
      (stress_.empty() && K0_.empty()) || !law.is_hyperelastic(),
      ExcUser(text(path(K0_.empty() ? "Initial stress" : "K0"),
                   " is given, but the stress of the body's material follows "
                   "from the deformation alone. Remove the entry, prescribe "
                   "'Initial displacement', or choose a law in rate form "
                   "('linear elastic', 'von Mises').")));
  }



  /// Move points to X + u and set the velocity gradient in @p workspace to
  /// du/dX: the deformation is a step of one second. Central differences,
  /// because the user gives only u, and derivatives by hand would be a source
  /// of errors.
  template <int dim>
  void
  InitialState<dim>::displace(Points<dim>        &points,
                              StepWorkspace<dim> &workspace,
                              const unsigned int  begin,
                              const unsigned int  end,
                              const Constants    &constants) const
  {
    Expression<dim> u(path("Initial displacement"),
                      displacement_,
                      dim,
                      constants);
    for (unsigned int p = begin; p < end; ++p)
      {
        // The undeformed place: positions are about to change.
        const Point<dim>    X = load_place(points, points.initial_position, p);
        Matrix<dim, double> F = identity<dim, double>();
        // The step of the differences is relative to the size of the point
        // along the axis.
        for (unsigned int i = 0; i < dim; ++i)
          {
            points.data(points.position, i)[p] =
              X[i] + u.finite_value(X, 0., i);
            for (unsigned int j = 0; j < dim; ++j)
              {
                const double du = derivative(
                  u, X, i, j, 0.01 * points.data(points.box_length, j)[p]);
                workspace.velocity_gradient(i, j)[p - begin] = du;
                F[i][j] += du;
              }
          }
        // Nonpositive volumes would fail in the first step with a less helpful
        // message.
        AssertThrow(determinant(F) > 0,
                    ExcUser(text(path("Initial displacement"),
                                 " = '",
                                 displacement_,
                                 "' turns the body inside out at (",
                                 X,
                                 ") m: the determinant of its deformation "
                                 "gradient is ",
                                 determinant(F),
                                 " there. Make the displacement smaller.")));
        AssertThrow(determinant(F) >= min_volume_ratio &&
                      determinant(F) <= 1. / min_volume_ratio,
                    ExcUser(text(path("Initial displacement"),
                                 " = '",
                                 displacement_,
                                 "' brings the soil at (",
                                 X,
                                 ") m to ",
                                 determinant(F),
                                 " times its volume, where something between ",
                                 min_volume_ratio,
                                 " and ",
                                 1. / min_volume_ratio,
                                 " was expected. Make the displacement "
                                 "smaller.")));
      }
  }



  /// Stress is a function of the undeformed place, like all initial fields.
  template <int dim>
  void
  InitialState<dim>::set_stress(Points<dim>       &points,
                                const unsigned int begin,
                                const unsigned int end,
                                const Constants   &constants) const
  {
    Expression<dim> sigma(path("Initial stress"),
                          stress_,
                          n_stress_components<dim>,
                          constants);
    for (unsigned int p = begin; p < end; ++p)
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        points.data(points.stress, c)[p] =
          sigma.finite_value(load_place(points, points.initial_position, p),
                             0.,
                             c);
  }



  /// Stress first, then displacement, then the deformation: for hyperelastic
  /// laws by the law's own update, which sets the stress. Rate laws keep the
  /// given stress.
  template <int dim>
  void
  InitialState<dim>::deform(Points<dim>              &points,
                            const unsigned int        begin,
                            const unsigned int        end,
                            const MaterialModel<dim> &law,
                            const BoxRule             rule,
                            const Constants          &constants) const
  {
    if (!stress_.empty())
      set_stress(points, begin, end, constants);
    if (displacement_.empty())
      return;
    StepWorkspace<dim> workspace;
    workspace.reinit(begin, end);
    displace(points, workspace, begin, end, constants);
    if (law.is_hyperelastic())
      law.update_stress(points, workspace, begin, end, /*dt=*/1.);
    else
      for (unsigned int p = begin; p < end; ++p)
        advance_edges<dim, double>(points.view(),
                                   workspace.view(begin, end),
                                   p,
                                   /*dt=*/1.);
    begin_stretch(points, begin, end, rule);
  }



  /// By body, not by range: points may be sorted when the time of the velocity
  /// is known, and the points of a body are no longer contiguous.
  template <int dim>
  void
  InitialState<dim>::set_velocity(Points<dim>       &points,
                                  const unsigned int index,
                                  const double       t,
                                  const Constants   &constants) const
  {
    if (velocity_.empty())
      return;
    Expression<dim> v(path("Initial velocity"), velocity_, dim, constants);
    for (unsigned int p = 0; p < points.size(); ++p)
      if (points.data(points.body)[p] == index)
        for (unsigned int d = 0; d < dim; ++d)
          points.data(points.velocity, d)[p] =
            v.finite_value(load_place(points, points.initial_position, p),
                           t,
                           d);
  }



  template class InitialState<2>;
  template class InitialState<3>;
} // namespace talus

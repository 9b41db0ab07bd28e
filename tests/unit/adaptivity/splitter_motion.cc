// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/edge_reduction.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  // ------------------------------------------------------------ rigid motion

  /// Rules and the parameters that choose them.
  const std::array<std::pair<BoxRule, std::string>, 4> rules{
    {{BoxRule::fixed, in_section("Transfer", "set Box rule = fixed")},
     {BoxRule::second_moments, ""},
     {BoxRule::left_stretch,
      in_section("Splitting", "set Shear = counted\nset Directions = all")},
     {BoxRule::convected_domain,
      in_section("Transfer", "set Box rule = convected domain")}}};



  template <int dim>
  Tensor<2, dim>
  rotation(const double angle)
  {
    Tensor<2, dim> R;
    for (unsigned int d = 0; d < dim; ++d)
      R[d][d] = 1.;
    R[0][0] = R[1][1] = std::cos(angle);
    R[0][1]           = -std::sin(angle);
    R[1][0]           = std::sin(angle);
    return R;
  }



  /// 50 points within 1.8 m of the centre of a mesh of 4 m.
  template <int dim>
  struct RigidBody : Core<dim>
  {
    // Lengths above the minimum, a threshold that round-off does not reach.
    RigidBody(const std::string &parameters, const bool is_deformed)
      : Core<dim>(cube<dim>() + parameters +
                  in_section("Splitting",
                             "set Threshold = 1.000001"
                             "\nset Minimum length = 0.1"))
      , rule(this->transfer.box_shape().rule)
    {
      for (unsigned int d = 0; d < dim; ++d)
        middle[d] = 2.;
      for (unsigned int i = 0; i < 50; ++i)
        {
          start.push_back(this->vector(-1., 1.));
          Tensor<1, dim> length = this->vector(0.3, 0.5);
          // The rule is about squares and cubes.
          if (rule == BoxRule::left_stretch)
            for (unsigned int d = 1; d < dim; ++d)
              length[d] = length[0];
          this->add(middle + start[i], length);
          F.push_back(rotation<dim>(0.));
          if (is_deformed)
            F[i] += this->tensor(-0.2, 0.2);
          this->set_deformation(i, F[i]);
        }
      auto &points = this->points;
      this->workspace.reinit(0, points.size());
      begin_stretch(points, 0, points.size(), rule);
      this->sort();
    }

    /// One step of a turn about the axis z, and of a motion along x.
    void
    step(const double t)
    {
      const double         rate = 2. * dealii::numbers::PI;
      const Tensor<2, dim> R    = rotation<dim>(rate * t);
      Tensor<1, dim>       shift;
      shift[0]     = 0.8 * std::sin(20. * t);
      auto &points = this->points;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const unsigned int i = points.data(points.id)[p];
          this->set_deformation(p, R * F[i]);
          this->set(points.position, p, middle + shift + R * start[i]);
        }
      update_box_lengths(points, 0, points.size(), rule);
      this->sort();
    }

    BoxRule                     rule;
    Point<dim>                  middle;
    std::vector<Tensor<1, dim>> start;
    std::vector<Tensor<2, dim>> F;
  };



  template <int dim>
  void
  expect_no_split(const std::string &parameters, const bool is_deformed)
  {
    RigidBody<dim>     body(parameters, is_deformed);
    const unsigned int n_steps = 720;
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        body.step(double(step) / n_steps);
        const auto before = body.edges(0);
        reduce_edges(body.points, 0, body.points.size(), false);
        ASSERT_EQ(body.edges(0), before) << step;
        ASSERT_FALSE(body.split()) << step;
      }
    EXPECT_EQ(body.points.size(), 50u);
  }



  TEST(SplitInvariance, RigidMotionSplitsNothing)
  {
    for (const auto &[rule, parameters] : rules)
      {
        SCOPED_TRACE(parameters);
        expect_no_split<2>(parameters, false);
        // A deformed body that turns keeps the stretch of its edges, but not
        // the stretch along the axes.
        if (rule != BoxRule::left_stretch)
          {
            expect_no_split<3>(parameters, false);
            expect_no_split<2>(parameters, true);
            expect_no_split<3>(parameters, true);
          }
      }
  }



  // -------------------------------------------------------------- conservation

  template <int dim>
  struct Totals
  {
    explicit Totals(const Core<dim> &core)
    {
      const auto &points = core.points;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double         m = points.data(points.mass)[p];
          const Tensor<1, dim> v = core.get(points.velocity, p);
          mass += m;
          volume += core.volume(p);
          kinetic += 0.5 * m * v.norm_square();
          elastic += points.data(points.elastic_energy)[p];
          momentum += m * v;
          moment += m * core.get(points.position, p);
          speed += m * v.norm();
        }
    }

    double         mass = 0, volume = 0, kinetic = 0, elastic = 0, speed = 0;
    Tensor<1, dim> momentum, moment;
  };



  /// Hundreds of splits of points in random states; sums that are counted here
  /// agree with the check.
  template <int dim>
  void
  expect_conservation(const std::string &directions)
  {
    // Without a bound there would be a million points.
    Core<dim> core(cube<dim>() + splitting_along(directions) +
                   in_section("Splitting", "set Maximum generation = 3"));
    auto     &points = core.points;
    for (unsigned int i = 0; i < 60; ++i)
      core.randomize(core.add(core.place(0.7), core.vector(0.2, 0.9)));
    begin_stretch(points, 0, points.size(), core.transfer.box_shape().rule);
    const Totals<dim> before(core);
    for (unsigned int step = 0; step < 200; ++step)
      {
        // Stretch since the creation, without a change of the volume.
        for (unsigned int p = 0; p < points.size(); ++p)
          for (unsigned int d = 0; d < dim; ++d)
            points.data(points.length_at_creation, d)[p] /=
              core.number(0.99, 1.04);
        core.sort();
        core.split();
      }
    const Totals<dim> after(core);
    EXPECT_GT(core.splitter.statistics().n_splits, 300u);
    EXPECT_GT(core.splitter.statistics().conservation_error, 0.);
    EXPECT_LE(core.splitter.statistics().conservation_error, 1e-12);
    EXPECT_NEAR(after.mass / before.mass, 1., 1e-12);
    EXPECT_NEAR(after.volume / before.volume, 1., 1e-12);
    EXPECT_NEAR(after.kinetic / before.kinetic, 1., 1e-12);
    EXPECT_NEAR(after.elastic / before.elastic, 1., 1e-12);
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.speed);
    EXPECT_LT((after.moment - before.moment).norm(),
              1e-12 * before.moment.norm());
    std::map<double, unsigned int> ids;
    for (unsigned int p = 0; p < points.size(); ++p)
      ++ids[points.data(points.id)[p]];
    EXPECT_EQ(ids.size(), points.size());
  }



  TEST(SplitInvariance, Conservation)
  {
    expect_conservation<2>("all");
    expect_conservation<2>("stretched");
    expect_conservation<3>("stretched");
  }



  /// The check must see what is lost.
  TEST(SplitInvariance, LossesAreSeen)
  {
    const auto error = [](const auto &spoil) {
      Core<2> core(cube<2>());
      core.randomize(core.add({1.5, 1.5}, Point<2>(0.5, 0.5)));
      ConservationCheck<2> check;
      check.add(core.points, 0, +1.);
      spoil(core.points);
      check.add(core.points, 0, -1.);
      return check.relative_error();
    };
    EXPECT_EQ(error([](Points<2> &) {}), 0.);
    // The kinetic energy does not change with the sign of the velocity.
    EXPECT_GT(error([](Points<2> &points) {
                for (unsigned int d = 0; d < 2; ++d)
                  points.data(points.velocity, d)[0] *= -1.;
              }),
              0.1);
    for (const unsigned int column : {Points<2>().mass,
                                      Points<2>().velocity + 1,
                                      Points<2>().position,
                                      Points<2>().elastic_energy})
      EXPECT_GT(error([column](Points<2> &points) {
                  points.data(column)[0] += 1e-9;
                }),
                1e-12)
        << column;
  }
} // namespace

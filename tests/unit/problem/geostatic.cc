// SPDX-License-Identifier: LGPL-2.1-or-later
// Weight above each point, and the K0 stress of level and inclined layers.

#include <talus/problem/geostatic.h>

#include "obstacles_setup.h"
#include "ranks_setup.h"
#include "suites.h"

namespace geostatic_test
{
  TALUS_ALSO_ON_RANKS(GeostaticStress, 2, 3);

  /// Add boxes of @p length, m, that tile [lower, upper], every one on the rank
  /// of the cell with the centre.
  template <int dim>
  void
  tile(Core<dim>            &core,
       const Point<dim>     &lower,
       const Point<dim>     &upper,
       const Tensor<1, dim> &length,
       const unsigned int    body = 0)
  {
    for (double x = lower[0] + 0.5 * length[0]; x < upper[0]; x += length[0])
      for (double y = lower[1] + 0.5 * length[1]; y < upper[1]; y += length[1])
        for (double z = dim == 2 ? 0. : lower[dim - 1] + 0.5 * length[dim - 1];
             z < (dim == 2 ? 1. : upper[dim - 1]);
             z += dim == 2 ? 1. : length[dim - 1])
          {
            Point<dim> at;
            at[0]       = x;
            at[dim - 1] = z;
            at[1]       = y;
            if (core.grid.find_cell(at) < core.grid.n_owned_cells())
              core.add(at, length, body);
          }
  }



  /// Two layers: 2 m of 600 kg/m^3 in boxes of 0.5 m, and on top 1 m of
  /// 900 kg/m^3 in boxes of 0.2 m, over half of the width only.
  template <int dim>
  void
  expect_layers()
  {
    Core<dim>      core(slab<dim>());
    Tensor<1, dim> coarse, fine;
    Point<dim>     upper(core.grid.domain().upper), lower, middle = upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        coarse[d] = 0.5;
        fine[d]   = 0.2;
      }
    upper[1]  = 2.;
    lower[1]  = 2.;
    middle[0] = 3.;
    middle[1] = 3.;
    tile<dim>(core, Point<dim>(), upper, coarse, 0);
    tile<dim>(core, lower, middle, fine, 1);
    const std::vector<double> mass =
      overburden(core.points, {600., 900.}, core.grid.communicator());
    for (unsigned int p = 0; p < core.points.size(); ++p)
      {
        const Tensor<1, dim> x = core.get(core.points.position, p);
        const double         expected =
          core.points.data(core.points.body)[p] == 1.
                    ? 900. * (3. - x[1])
                    : 600. * (2. - x[1]) + (x[0] < 3. ? 900. : 0.);
        EXPECT_NEAR(mass[p], expected, 1e-9) << x;
      }
    EXPECT_GT(MPI::sum(core.points.size(), core.grid.communicator()), 100u);
  }
} // namespace geostatic_test



TEST(GeostaticStress, WeightOfLayersAbove)
{
  geostatic_test::expect_layers<2>();
  geostatic_test::expect_layers<3>();
}



// A box 0.5 m wide covers a fifth of a box 1 m wide, whose other half is free.
TEST(GeostaticStress, WeightIsTheMeanOverTheWidth)
{
  using namespace geostatic_test;
  Core<2> core(cube<2>(), {}, MPI_COMM_SELF);
  core.add(Point<2>(1.5, 0.5), Point<2>(1., 1.));
  core.add(Point<2>(0.95, 2.), Point<2>(0.5, 0.4));
  const auto mass = overburden(core.points, {1000.}, MPI_COMM_SELF);
  EXPECT_NEAR(mass[0], 1000. * (0.5 + 0.4 * 0.2), 1e-10);
  EXPECT_NEAR(mass[1], 1000. * 0.2, 1e-10);
}



namespace geostatic_test
{
  /// Two bodies, 1 m each, with K0 = 0.5 in the lower one, over the bottom of
  /// the mesh or an obstacle.
  struct Layers : Core<2>, WithObstacles<2>
  {
    Layers(const std::initializer_list<Section> &ground,
           const std::string                    &lower_entries = "",
           const double                          strength      = 1e6)
      : Core<2>(mesh("0, 0", "4, 4"), {}, MPI_COMM_SELF)
      , WithObstacles<2>(ground)
      , materials({{"clay", "von Mises"}, {"sand", "linear elastic"}})
    {
      for (const std::string name : {"lower", "upper"})
        bodies.push_back(std::make_unique<Body<2>>(name));
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        in_section("Materials",
                   in_section("clay",
                              text("set Density = 1700\n"
                                   "set Submerged density = 700\n"
                                   "set Undrained shear strength = ",
                                   strength)) +
                     in_section("sand", "set Density = 2000")) +
        in_section("Bodies",
                   in_section("lower", "set K0 = 0.5\n" + lower_entries)));
      ParameterAcceptor::parse_all_parameters();
      materials.assign({"lower", "upper"}, {"clay", "sand"});
      materials.add_columns(points);
      for (unsigned int body = 0; body < 2; ++body)
        tile<2>(*this,
                Point<2>(0., 1. + body),
                Point<2>(4., 2. + body),
                Point<2>(0.5, 0.25),
                body);
      materials.of_body(0).initialize(points, 0, points.size());
    }

    std::vector<Remark>
    set_stress(const Vector &gravity)
    {
      set_geostatic_stress(points,
                           bodies,
                           materials,
                           gravity,
                           Ground<2>(grid.domain(), &obstacles),
                           MPI_COMM_SELF);
      return notes_on_stress_at_rest(points, bodies, materials, MPI_COMM_SELF);
    }

    /// Call action(p, M) with the mass per area above point @p p, kg/m^2.
    template <typename Action>
    void
    for_each_point(const Action &action) const
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double y = points.data(points.position, 1)[p];
          action(p,
                 points.data(points.body)[p] == 0. ? 700. * (2. - y) + 2000.
                                                   : 2000. * (3. - y));
        }
    }

    Materials<2>                          materials;
    std::vector<std::unique_ptr<Body<2>>> bodies;
  };
} // namespace geostatic_test



// In axes along the slope: s_yy = g_y M, s_xx = s_zz = K0 s_yy, s_xy = g_x M.
// The body without K0 has no stress.
TEST(GeostaticStress, InfiniteSlopeOnTheBottom)
{
  using namespace geostatic_test;
  Layers layers({});
  EXPECT_TRUE(layers.set_stress(Point<2>(2., -9.)).empty());
  layers.for_each_point([&](const unsigned int p, const double M) {
    const bool   has_K0 = layers.points.data(layers.points.body)[p] == 0.;
    const double s      = has_K0 ? -9. * M : 0.;
    const std::array<double, 4> expected = {
      {0.5 * s, s, 0.5 * s, has_K0 ? 2. * M : 0.}};
    for (unsigned int c = 0; c < 4; ++c)
      EXPECT_NEAR(layers.points.data(layers.points.stress, c)[p],
                  expected[c],
                  1e-9);
  });
}



// Layers along an inclined bed with the normal n and the tangent t, under
// vertical gravity: s_nn = -g n_y M n_y, s_tt = K0 s_nn, s_tn = -g t_y M n_y.
TEST(GeostaticStress, LayersFollowAnInclinedBed)
{
  using namespace geostatic_test;
  const Tensor<1, 2> n({20. / 101., 99. / 101.}), t({n[1], -n[0]});
  Layers layers({{"bed", "Shape = half-plane|Point = 0, 0.9|Normal = 20, 99"}});
  layers.set_stress(Point<2>(0., -10.));
  layers.for_each_point([&](const unsigned int p, const double M) {
    if (layers.points.data(layers.points.body)[p] != 0.)
      return;
    const Tensor<2, 2> sigma = layers.stress(p);
    const double       s_nn  = -10. * n[1] * M * n[1];
    EXPECT_NEAR(n * (sigma * n), s_nn, 1e-6);
    EXPECT_NEAR(t * (sigma * t), 0.5 * s_nn, 1e-6);
    EXPECT_NEAR(t * (sigma * n), -10. * t[1] * M * n[1], 1e-6);
    EXPECT_NEAR(layers.points.data(layers.points.stress, 2)[p],
                0.5 * s_nn,
                1e-6);
  });
}



// In level ground sqrt(s:s/2) = (1 - K0)|s_yy|/sqrt(3); the deepest points,
// under 2612.5 kg/m^2, bear the most.
TEST(GeostaticStress, StressAboveTheStrengthIsTold)
{
  using namespace geostatic_test;
  const double largest = 0.5 * 10. * 2612.5 / std::sqrt(3.);
  Layers       strong({}, "", 1.01 * largest);
  EXPECT_TRUE(strong.set_stress(Point<2>(0., -10.)).empty());
  dealii::ParameterAcceptor::clear();
  Layers     weak({}, "", largest / 1.01);
  const auto notes = weak.set_stress(Point<2>(0., -10.));
  ASSERT_EQ(notes.size(), 1u);
  const std::string note = notes[0].text();
  EXPECT_TRUE(contains(note, "Body 'lower': the K0 stress is more than"))
    << note;
  EXPECT_TRUE(contains(note, "bears at 8 points")) << note;
  EXPECT_TRUE(contains(note, "up to 1.01 times the strength")) << note;
}



TEST(GeostaticStress, NeedsGravityAndSoilInPlace)
{
  using namespace geostatic_test;
  {
    Layers layers({});
    EXPECT_TRUE(contains(message_of<ExcUser>(
                           [&]() { layers.set_stress(Tensor<1, 2>()); }),
                         "there is no gravity at t = 0"));
  }
  Layers layers({}, "set Initial displacement = 0.1*x; 0");
  EXPECT_TRUE(contains(message_of<ExcUser>(
                         [&]() { layers.set_stress(Point<2>(0., -10.)); }),
                       "the weight above a point is taken without "
                       "displacement"));
}

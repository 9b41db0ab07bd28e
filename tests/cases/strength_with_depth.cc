// SPDX-License-Identifier: LGPL-2.1-or-later
// Undrained shear strength that grows with the depth below the mudline.

#include "static_case.h"

#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string slide_file     = "landslide-inclined.prm";
  const std::string infinite_slope = "verification/infinite-slope.prm";
  const Overrides   coarse         = {"Grid/Cell size=0.8", "End time=0.5"};
  const std::string clay           = "Materials/clay/";
  const std::string s_u            = clay + "Undrained shear strength=";



  /// The same run with a strength that is a number, and one that is the same
  /// number at each point.
  void
  expect_same(const std::string &name, const Overrides &overrides)
  {
    const Overrides all = coarse + overrides;
    const Table     number =
      run<2>(slide_file, name + "-number", all + Overrides{s_u + "2500"});
    for (const Overrides &points :
         {Overrides{s_u + "2500 + 0*depth"},
          Overrides{s_u + "2500 + 0*depth", clay + "Stiffness ratio=100"}})
      {
        const Table table = run<2>(slide_file, name + "-points", all + points);
        ASSERT_EQ(table.n_rows(), number.n_rows());
        for (const std::string column : {"front x [m]",
                                         "kinetic energy [J]",
                                         "elastic energy [J]",
                                         "plastic work [J]"})
          EXPECT_NEAR(table[column].back(),
                      number[column].back(),
                      1e-9 * std::abs(number[column].back()))
            << column;
      }
  }
} // namespace



TEST(StrengthWithDepth, NumberAtEachPoint)
{
  expect_same("strength-von-mises",
              {clay + "Hardening modulus=-400",
               clay + "Residual undrained shear strength=500"});
  expect_same("strength-bingham",
              {clay + "Law=Bingham",
               clay + "Viscosity=20",
               clay + "Remoulded strength ratio=0.3",
               clay + "Plastic shear strain to remould=4"});
  expect_same("strength-herschel-bulkley",
              {clay + "Law=Herschel-Bulkley", clay + "Consistency=300"});
}



// By two bodies with one mudline, of a material with depth and one without; it
// stays with the soil as that moves.
TEST(StrengthWithDepth, MovesWithTheSoil)
{
  // The upper surface of the slide is a line between two of its corners.
  const auto mudline = [](const double x) {
    return 4.22620475826401 + (x - 9.06282479921281) /
                                (40.2835666374081 - 9.06282479921281) *
                                (1.4947437805524 - 4.22620475826401);
  };
  Case<2> run(slide_file,
              coarse + Overrides{s_u + "2000 + 1500*depth + 10*x",
                                 "Trigger/Strength fraction=0.5",
                                 "Splitting/Enabled=false"});
  run->run();
  const auto        &points = run.points();
  const unsigned int column = points.find("undrained shear strength");
  unsigned int       n      = 0;
  double             moved  = 0.;
  for (unsigned int p = 0; p < points.size(); ++p)
    if (const auto X = load_place(points, points.initial_position, p);
        X[0] > 9.1 && X[0] < 40.2)
      {
        ++n;
        EXPECT_NEAR(points.data(column)[p],
                    2000. + 1500. * (mudline(X[0]) - X[1]) + 10. * X[0],
                    1e-6);
        moved =
          std::max(moved, X.distance(load_place(points, points.position, p)));
      }
  EXPECT_GT(n, 200u);
  EXPECT_GT(moved, 0.1);
}



// Least of s_u/(gamma z sin) over the depth z, by an expression, by a table,
// and with a stiffness that follows.
TEST(StrengthWithDepth, FactorOfSafetyOfInfiniteSlopes)
{
  const double      gamma = 1e4 * std::sin(20. * M_PI / 180.); // N/m^3
  const std::string table =
    (std::filesystem::path(TALUS_RESULTS_DIR) / "strength.csv").string();
  std::filesystem::create_directories(TALUS_RESULTS_DIR);
  std::ofstream(table) << "depth [m],undrained shear strength [Pa]\n"
                          "0,25e3\n2.5,15e3\n5,65e3\n";
  const struct
  {
    std::string strength;
    double      exact;
    std::string ratio;
  } soils[] = {{"2000 + 1500*depth", (2000. + 1500. * 5.) / (5. * gamma), ""},
               {"2000 + 5000*depth",
                (2000. + 5000. * 5.) / (5. * gamma),
                "400"},
               // Weakest in the middle.
               {"15e3 + if(depth < 2.5, 4e3, -20e3)*(2.5 - depth)",
                15e3 / (2.5 * gamma),
                ""},
               {"table " + table, 15e3 / (2.5 * gamma), "500"}};
  for (const auto &soil : soils)
    {
      const StaticCase<2> at(infinite_slope,
                             "strength-with-depth",
                             {"Grid/Cell size=0.025",
                              "Grid/Upper corner=0.05, 5.1",
                              "Bodies/layer/Upper corner=0.05, 5",
                              s_u + soil.strength,
                              clay + "Stiffness ratio=" + soil.ratio});
      EXPECT_NEAR(at.factor_of_safety(), soil.exact, 0.01 * soil.exact)
        << soil.strength;
    }
}



// A random field of infinite length is one factor of the strength, hence of the
// factor of safety; a short field weakens some place of every depth.
TEST(StrengthWithDepth, RandomFieldInStatics)
{
  const auto factor_of_safety = [](const Overrides &field) {
    return StaticCase<2>(infinite_slope,
                         "random-strength",
                         Overrides{"Grid/Cell size=0.025",
                                   "Grid/Upper corner=0.05, 5.1",
                                   "Bodies/layer/Upper corner=0.05, 5",
                                   clay + "Stiffness ratio=400"} +
                           field)
      .factor_of_safety();
  };
  const double    alone = factor_of_safety({});
  const Overrides field = {clay + "Strength field/Coefficient of variation=0.3",
                           clay + "Strength field/Correlation lengths=1e30",
                           clay + "Strength field/Seed=5"};
  const StaticCase<2> at(infinite_slope, "random-strength-field", field);
  const auto         &points = at.points();
  const double       *s = points.data(points.find("undrained shear strength"));
  for (unsigned int p = 1; p < points.size(); ++p)
    EXPECT_DOUBLE_EQ(s[p], s[0]);
  const double factor = s[0] / 25651.51;
  EXPECT_GT(std::abs(factor - 1.), 0.05);
  EXPECT_NEAR(factor_of_safety(field), factor * alone, 0.01 * factor * alone);
}



// Two layers are two bodies, or one body with two strengths: cells that they
// share have one mean stress in either case.
TEST(StrengthWithDepth, LayersAsBodiesOrAsStrength)
{
  const std::string outline = "Vertices=0,0; 48.66,0; 40,5; 8.66,5";
  for (const double ratio : {0.5, 1., 2.})
    {
      const std::string lower = text(2500. * ratio);
      const Table       one =
        run<2>("landslide-quick.prm",
               "strength-one-body",
               coarse + Overrides{s_u + "if(y > 2.4, 2500, " + lower + ")"});
      const Table two =
        run<2>("landslide-quick.prm",
               "strength-two-bodies",
               coarse +
                 Overrides{"Bodies/Names=slide, base",
                           "Bodies/slide/Shape=layer",
                           "Bodies/slide/Upper surface=6",
                           "Bodies/slide/Lower surface=2.4",
                           "Bodies/base/Shape=layer",
                           "Bodies/base/Filling=centres",
                           "Bodies/base/" + outline,
                           "Bodies/base/Upper surface=2.4",
                           "Bodies/base/Lower surface=-1",
                           "Bodies/base/Material=base",
                           "Materials/Names=clay, base",
                           "Materials/base/Law=von Mises",
                           "Materials/base/Density=600",
                           "Materials/base/Young's modulus=250e3",
                           "Materials/base/Poisson's ratio=0.49",
                           s_u + "2500",
                           "Materials/base/Undrained shear strength=" + lower});
      ASSERT_EQ(one.n_rows(), two.n_rows());
      for (const std::string column : {"points",
                                       "front x [m]",
                                       "kinetic energy [J]",
                                       "elastic energy [J]",
                                       "plastic work [J]"})
        EXPECT_NEAR(one[column].back(),
                    two[column].back(),
                    1e-8 * std::abs(one[column].back()))
          << column << ", " << ratio;
    }
}



TEST(StrengthWithDepth, WhatCannotBeIsSaid)
{
  const auto error = [](const Overrides &overrides) {
    try
      {
        const Case<2> run(slide_file, coarse + overrides);
      }
    catch (const ExcUser &error)
      {
        dealii::ParameterAcceptor::clear();
        dealii::ParameterAcceptor::prm.clear();
        std::ostringstream reason;
        error.print_info(reason);
        return reason.str();
      }
    return std::string();
  };
  EXPECT_NE(error({s_u + "500 - 1000*depth"})
              .find("below the mudline. Soil needs a positive"),
            std::string::npos);
  EXPECT_NE(error({s_u + "500*deep"}).find("an expression in x, y, depth, pi"),
            std::string::npos);
  EXPECT_NE(error({s_u + "-5"}).find("is -5 Pa"), std::string::npos);
  EXPECT_NE(error({s_u + "500*depth + 1", "Constants=depth=3"})
              .find("'Constants' gives a value to 'depth'"),
            std::string::npos);
  EXPECT_NE(error({s_u + "table none.csv"}).find("cannot be read"),
            std::string::npos);
  EXPECT_NE(error({s_u + "2000 + 9e3*depth",
                   clay + "Law=Bingham",
                   clay + "Remoulded strength ratio=0.2",
                   clay + "Plastic shear strain to remould=0.5"})
              .find("soften faster than it can unload"),
            std::string::npos);
}

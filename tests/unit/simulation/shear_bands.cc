// SPDX-License-Identifier: LGPL-2.1-or-later
// Extent of the yielded soil, and the table bands.csv.

#include <talus/simulation/shear_bands.h>

#include <fstream>
#include <sstream>

#include "../observers_setup.h"
#include "../whole_problem.h"

namespace shear_bands_test
{
  using namespace talus;

  /// No parameters of the test.
  struct Nothing
  {};

  /// A body of 2 m in cells of 0.5 m, in which the soil up to x = @p end, m,
  /// has flowed.
  struct Soil : WholeProblem<Nothing>
  {
    explicit Soil(const std::string &softening)
      : WholeProblem<Nothing>("",
                              in_section("Materials",
                                         in_section("clay", softening)))
    {}

    void
    flow(const double end, const double work)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        if (points.data(points.position)[p] < end)
          points.data(points.plastic_work)[p] = work;
    }

    /// Set @p name to @p value up to x = @p end, m.
    void
    set(const std::string &name, const double end, const double value)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        if (points.data(points.position)[p] < end)
          points.data(points.find(name))[p] = value;
    }
  };

  const std::string by_displacement =
    "set Softening displacement = 0.1\n"
    "set Residual undrained shear strength = 1000\n";
  // 5000 Pa less 4000 Pa: sqrt(3) 4000/20e3.
  const std::string by_strain =
    "set Hardening modulus = -20e3\n"
    "set Residual undrained shear strength = 1000\n";



  TEST(ShearBands, ExtentByColumnsOfCells)
  {
    for (const std::string &softening : {by_displacement, by_strain})
      {
        Soil         soil(softening);
        const double residual =
          softening == by_strain ? std::sqrt(3.) * 4000. / 20e3 : 1.;
        const std::string variable =
          softening == by_strain ? "plastic strain" : "softening";
        auto extent = yielded_extent(soil, soil.problem, 0);
        EXPECT_DOUBLE_EQ(extent.all, 2.);
        EXPECT_EQ(extent.yielded, 0.);
        EXPECT_EQ(extent.residual, 0.);
        EXPECT_EQ(note_on_softening(soil, soil.problem), "");

        soil.flow(3.2, 7.);
        soil.set(variable, 3.2, 0.94 * residual);
        soil.set(variable, 2.4, 0.96 * residual);
        extent = yielded_extent(soil, soil.problem, 0);
        EXPECT_DOUBLE_EQ(extent.all, 2.);
        EXPECT_DOUBLE_EQ(extent.yielded, 1.5);
        EXPECT_DOUBLE_EQ(extent.residual, 0.5);
        EXPECT_EQ(note_on_softening(soil, soil.problem)
                    .rfind(" Softening: 1.5 of 2 m of 'slide' yielded,", 0),
                  0u);
      }
  }



  class ShearBandsTable : public ObserversTest
  {};

  TEST_F(ShearBandsTable, RowsAndGrowth)
  {
    Soil          soil(by_displacement);
    ShearBands<2> bands(soil.problem);
    EXPECT_TRUE(bands.is_enabled({folder}));
    bands.begin({folder}, soil);
    bands.observe(soil);
    soil.flow(2.4, 7.);
    soil.time = 2.;
    bands.observe(soil);
    soil.flow(3.7, 7.);
    soil.set("softening", 2.4, 1.);
    soil.time = 4.;
    bands.observe(soil);
    const auto rows = lines("bands.csv");
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0],
              "time [s],yielded length of slide [m],"
              "residual length of slide [m],"
              "growth of the yielded length of slide [m/s],"
              "plastic work of slide [J]");
    EXPECT_EQ(rows[1], "0,0,0,0,0");
    // Columns of four points.
    double n = 0.;
    for (unsigned int p = 0; p < soil.points.size(); ++p)
      n += soil.points.data(soil.points.position)[p] < 2.4;
    EXPECT_EQ(rows[2], text("2,0.5,0,0.25,", 7. * n));
    EXPECT_EQ(rows[3].substr(0, 12), "4,2,0.5,0.75");
  }



  TEST_F(ShearBandsTable, OnlyOfSofteningSoil)
  {
    Soil          soil("");
    ShearBands<2> bands(soil.problem);
    EXPECT_FALSE(bands.is_enabled({folder}));
    StateList list;
    bands.list_state(list);
    EXPECT_TRUE(list.numbers().empty());
  }
} // namespace shear_bands_test

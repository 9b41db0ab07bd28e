// SPDX-License-Identifier: LGPL-2.1-or-later
// Factors of safety by strength reduction.

#include "static_case.h"

#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <tuple>

using namespace talus;
using namespace talus::cases;


// The lowest cell bears the shear stress at its middle, at the depth H - h/2.
TEST(InfiniteSlope, FactorOfSafety)
{
  Verification     gates("Infinite slope of 20 degrees: factor of safety",
                     "prm/verification/infinite-slope.prm",
                     "s_u/(gamma H sin) = 1.5");
  constexpr double H = 5., exact = 1.5; // m, -
  for (const double h : {0.1, 0.05, 0.025})
    {
      const StaticCase<2> slope(
        "verification/infinite-slope.prm",
        text("infinite-slope-", h),
        {text("Grid/Cell size=", h),
         text("Grid/Upper corner=", 2 * h, ", 5.1"),
         text("Bodies/layer/Upper corner=", 2 * h, ", 5"),
         "Strength reduction/Tolerance=1e-4"});
      const double F = slope.factor_of_safety();
      if (h < 0.1)
        gates.near(text("factor of safety, h = ", h, " m"), F, exact, 0.01);
      gates.near(text("its error over h/(2 H), h = ", h, " m"),
                 (F / exact - 1.) / (0.5 * h / H),
                 1.,
                 0.05);
      // The log tells the factor for shear at the base.
      std::ifstream     log(slope.folder() / "log.txt");
      const std::string text_of_log{std::istreambuf_iterator<char>(log), {}};
      const std::string words = "the factor of safety is only ";
      const auto        place = text_of_log.find(words);
      ASSERT_NE(place, std::string::npos) << text_of_log;
      gates.near(text("bound in the log, h = ", h, " m"),
                 std::stod(text_of_log.substr(place + words.size())),
                 exact,
                 0.001);
    }
}



// The same with so little strength that it cannot stand: s_u is divided by f.
TEST(InfiniteSlope, FactorOfSafetyBelowOne)
{
  Verification     gates("Infinite slope of 20 degrees that cannot stand",
                     "prm/verification/infinite-slope.prm",
                     "s_u/(gamma H sin) = 1.5/f");
  constexpr double h = 0.05; // m
  for (const double exact : {0.99, 0.4})
    {
      const StaticCase<2> slope(
        "verification/infinite-slope.prm",
        text("infinite-slope-", exact),
        {text("Grid/Cell size=", h),
         text("Grid/Upper corner=", 2 * h, ", 5.1"),
         text("Bodies/layer/Upper corner=", 2 * h, ", 5"),
         text("Materials/clay/Undrained shear strength=",
              25651.51 * exact / 1.5)});
      gates.near(text("factor of safety, f = ", 1.5 / exact, ", small strain"),
                 slope.factor_of_safety(),
                 exact,
                 0.01);
      EXPECT_TRUE(
        (*slope).static_stages().strength_reduction().is_less_than_one());
    }
}



// Soil without cohesion whose flow is not normal to the yield surface shears
// along lines of no extension, so that the slope fails at
// cos(psi) sin(phi_F) = tan(20 degrees) (1 - sin(phi_F) sin(psi)) with
// tan(phi_F) = tan(phi)/F, unless the ground was pressed sideways at the start:
// then, and with psi = phi, at F = tan(phi)/tan(20 degrees).
TEST(InfiniteSlope, FrictionAndDilatancy)
{
  Verification gates("Infinite slope of 20 degrees with friction, 30 degrees",
                     "prm/verification/infinite-slope-friction.prm",
                     "limit equilibrium 1.58626; lines of no extension");
  unsigned int number = 0;
  const auto   factor = [](const std::string &name, const Overrides &settings) {
    return StaticCase<2>("verification/infinite-slope-friction.prm",
                         "infinite-slope-friction-" + name,
                         settings)
      .factor_of_safety();
  };
  const auto expect =
    [&](const std::string &name, const double reference, Overrides settings) {
      gates.near("factor of safety, " + name,
                 factor(std::to_string(number++), settings),
                 reference,
                 0.001);
    };
  expect("psi = 0, K0 = 0.5", 1.4774563920, {});
  expect("psi = 10 degrees, K0 = 0.5",
         1.5589376051,
         {"Materials/sand/Dilatancy angle=10"});
  expect("psi = 30 degrees, K0 = 0.5",
         1.5862568277,
         {"Materials/sand/Dilatancy angle=30"});
  // The factor has a maximum, which long steps of the path pass below.
  const double pressed =
    factor("pressed",
           {"Bodies/layer/K0=2", "Bodies/layer/Points per cell and axis=1"});
  gates.at_most("factor of safety, psi = 0, K0 = 2, limit equilibrium",
                pressed,
                1.5862568277);
  gates.holds("factor of safety, psi = 0, K0 = 2",
              text(pressed),
              "more than with K0 = 0.5",
              pressed > 1.001 * 1.4774563920);
  expect("psi = 0, Davis, K0 = 2",
         1.4774563920,
         {"Bodies/layer/K0=2", "Strength reduction/Non-associated flow=Davis"});
  expect("slope 10 degrees, psi = 0, K0 = 0.5",
         3.2230129526,
         {"Gravity/Slope angle=10"});
  // The lowest cell has the stress of its middle, at the vertical depth z.
  const double z = 4.975 / std::cos(M_PI / 12.); // m
  expect("slope 15 degrees, phi' = 25 degrees, c'/(gamma z) = 1/12, K0 = 0.5",
         2.0205062442,
         {"Gravity/Slope angle=15",
          text("Gravity/Magnitude=", 60. / z),
          "Materials/sand/Friction angle=25",
          "Materials/sand/Cohesion=5e3"});
}



// Earthquakes move the whole mass, under water the weight is of less.
TEST(InfiniteSlope, HorizontalCoefficient)
{
  constexpr double k = 0.1, share = 0.4, h = 0.05; // -, -, m
  Verification     gates("Infinite slope of 20 degrees under water, k_h = 0.1",
                     "prm/verification/infinite-slope.prm",
                     "s_u/(H g (rho' sin + k_h rho cos))");
  const StaticCase<2> slope("verification/infinite-slope.prm",
                            "infinite-slope-horizontal",
                            {text("Grid/Cell size=", h),
                             text("Grid/Upper corner=", 2 * h, ", 5.1"),
                             text("Bodies/layer/Upper corner=", 2 * h, ", 5"),
                             text("Materials/clay/Submerged density=",
                                  1000. * share),
                             text("Gravity/Horizontal coefficient=", k),
                             "Strength reduction/Tolerance=1e-4"});
  const double        tangent = std::tan(20. * M_PI / 180.);
  gates.near("factor of safety",
             slope.factor_of_safety(),
             1.5 * tangent / (share * tangent + k),
             0.01);
}



// A weak layer of 3 m on a stronger one: the weak one fails where it ends.
TEST(InfiniteSlope, TwoLayersBelowOne)
{
  constexpr double h = 0.05, depth = 3., exact = 0.9; // m, m, -
  const double     strength =
    exact * 1000. * 10. * depth * std::sin(20. * M_PI / 180.); // Pa
  Verification        gates("Infinite slope of two layers that cannot stand",
                     "prm/verification/infinite-slope.prm, "
                            "a weak body of 3 m on a stronger one of 2 m",
                     "least s_u/(gamma z sin) of the ends of the layers");
  const StaticCase<2> slope("verification/infinite-slope.prm",
                            "infinite-slope-two-layers",
                            {text("Grid/Cell size=", h),
                             text("Grid/Upper corner=", 2 * h, ", 5.1"),
                             "Bodies/Names=layer,top",
                             text("Bodies/layer/Upper corner=", 2 * h, ", 2"),
                             "Bodies/top/Shape=box",
                             "Bodies/top/Lower corner=0, 2",
                             text("Bodies/top/Upper corner=", 2 * h, ", 5"),
                             "Bodies/top/Material=weak",
                             "Materials/Names=clay,weak",
                             "Materials/weak/Law=von Mises",
                             "Materials/weak/Density=1000",
                             "Materials/weak/Young's modulus=1e7",
                             "Materials/weak/Poisson's ratio=0.49",
                             text("Materials/weak/Undrained shear strength=",
                                  strength)});
  gates.near("factor of safety", slope.factor_of_safety(), exact, 0.01);
  EXPECT_TRUE((*slope).static_stages().strength_reduction().is_less_than_one());
}



namespace
{
  /// q F/s_u at failure, with cells of @p h.
  double
  bearing_factor(const double h)
  {
    const StaticCase<2> footing("verification/strip-footing.prm",
                                text("strip-footing-", h),
                                {text("Grid/Cell size=", h),
                                 text("Constants=q = 20e3; h = ", h)});
    return 2. * footing.factor_of_safety();
  }



  void
  hold_footing(Verification &gates, const std::vector<double> &cell_sizes)
  {
    double last = INFINITY;
    for (const double h : cell_sizes)
      {
        const double factor = bearing_factor(h);
        gates.near(text("q F/s_u at failure, h = ", h, " m"),
                   factor,
                   2. + M_PI,
                   0.05);
        EXPECT_LT(factor, last);
        last = factor;
      }
  }



  const std::string footing     = "Strip footing, smooth, on weightless clay",
                    footing_run = "prm/verification/strip-footing.prm",
                    prandtl     = "Prandtl: q = (2 + pi) s_u";
} // namespace



TEST(StripFooting, BearingCapacity)
{
  Verification gates(footing, footing_run, prandtl);
  hold_footing(gates, {0.25, 0.125});
}



TEST(StripFootingFine, BearingCapacity)
{
  Verification gates(footing, footing_run + " Grid/Cell size=0.0625", prandtl);
  hold_footing(gates, {0.125, 0.0625});
}



TEST(TaylorSlope, FactorOfSafety)
{
  Verification gates(
    "Undrained slope 2:1 on a foundation as deep as it is high",
    "prm/verification/taylor-slope.prm",
    "Taylor's chart, s_u/(gamma H) = 0.25, D = 2");
  for (const double h : {2., 1.})
    {
      const StaticCase<2> slope("verification/taylor-slope.prm",
                                text("taylor-slope-", h),
                                {text("Grid/Cell size=", h),
                                 "Strength reduction/Tolerance=1e-3"});
      gates.near(text("factor of safety, cells of H/", 10. / h),
                 slope.factor_of_safety(),
                 1.47,
                 0.01);
    }
}



// With Davis' strength and psi = 0 the factor of the bound, 1.36822, becomes
// F = 1.36822 cos(phi_F). On cells of H/10 and H/20 the factor is 8 % and 5 %
// too large: the slip surface is shallow.
TEST(FrictionalSlope, FactorOfSafety)
{
  Verification gates("Slope 2:1, phi' = 20 degrees, c'/(gamma H) = 0.05",
                     "prm/verification/taylor-slope.prm, smaller, with sand",
                     "logarithmic spiral (upper bound), cells of H/40");
  for (const auto &[flow, psi, factor] :
       {std::tuple{"as given", 20., 1.36822}, {"Davis", 0., 1.31892}})
    gates.near(
      text("factor of safety, psi = ", psi, " degrees, flow ", flow),
      StaticCase<2>(
        "verification/taylor-slope.prm",
        text("frictional-slope-", psi),
        {"Materials/Names=clay, sand",
         "Materials/sand/Law=Mohr-Coulomb",
         "Materials/sand/Density=1000",
         "Materials/sand/Young's modulus=50e6",
         "Materials/sand/Poisson's ratio=0.3",
         "Materials/sand/Cohesion=5e3",
         "Materials/sand/Friction angle=20",
         "Bodies/soil/Material=sand",
         "Bodies/soil/Vertices=-10,-4; 40,-4; 40,10; 20,10; 0,0; -10,0",
         "Grid/Cell size=0.25",
         "Grid/Lower corner=-10, -4",
         "Grid/Upper corner=40, 12",
         text("Materials/sand/Dilatancy angle=", psi),
         text("Strength reduction/Non-associated flow=", flow)})
        .factor_of_safety(),
      factor,
      0.03);
}



// Two rows of cells between smooth walls: the factor of plane strain.
TEST(TaylorSlope, ThreeDimensions)
{
  Verification gates("Undrained slope 2:1 in 3-D, between smooth walls",
                     "prm/verification/taylor-slope-3d.prm",
                     "the factor in 2-D, cells of H/5");
  const double plane = StaticCase<2>("verification/taylor-slope.prm",
                                     "taylor-slope-2d",
                                     {"Grid/Cell size=2"})
                         .factor_of_safety();
  gates.near("factor of safety",
             StaticCase<3>("verification/taylor-slope-3d.prm",
                           "taylor-slope-3d",
                           {})
               .factor_of_safety(),
             plane,
             0.01);
}



namespace
{
  /// The slope of the paper on coarse cells, without dynamics.
  double
  paper_slope(const std::string &name, const Overrides &overrides)
  {
    const StaticCase<2> slope(
      "landslide-trigger.prm",
      "paper-slope-" + name,
      Overrides{"Stages=equilibrium, strength reduction",
                "Grid/Cell size=0.8"} +
        overrides);
    return slope.factor_of_safety();
  }
} // namespace



// How the search goes there must not matter.
TEST(PaperSlopeSafety, OneFactorWhateverTheSearch)
{
  Verification gates("Slope of the paper before the trigger: factor of safety, "
                     "h = 0.8 m",
                     "prm/landslide-trigger.prm Stages = equilibrium, strength "
                     "reduction",
                     "the factor with the parameters of the file");
  const double F = paper_slope("small", {});
  for (const unsigned int n : {5, 2000})
    gates.near(text("the load in ", n, " steps"),
               paper_slope(text("steps-", n),
                           {text("Equilibrium/Load steps=", n)}),
               F,
               0.005);
  for (const double first : {1.15, 2.})
    gates.near(text("first factor ", first),
               paper_slope(text("first-", first),
                           {text("Strength reduction/First factor=", first)}),
               F,
               0.005);
}



// Boxes that are clipped for the weights, as they are with many points in a
// cell, reach into cells where they leave hardly any soil at the nodes. These
// settle, too.
TEST(PaperSlopeSafety, ClippedBoxesSettle)
{
  for (const auto &[n_points, min_half] : {std::pair(6, 0.1), {8, 0.25}})
    {
      const StaticCase<2> slope(
        "landslide-trigger.prm",
        text("clipped-boxes-", n_points),
        {"Stages=equilibrium",
         "Grid/Cell size=0.8",
         text("Bodies/slide/Points per cell and axis=", n_points),
         text("Transfer/Minimum half-size=", min_half)});
      EXPECT_TRUE((*slope).static_stages().equilibrium().is_balanced());
      EXPECT_LE((*slope).static_stages().equilibrium().imbalance(), 1e-6);
      EXPECT_LE((*slope).static_stages().equilibrium().n_steps(), 30u);
    }
}



namespace
{
  const std::string
    cut        = "Vertical cut in clay: factor of safety",
    cut_run    = "prm/verification/vertical-cut.prm, Stages = equilibrium, "
                 "strength reduction, Gravity/Magnitude = 2",
    cut_source = "limit analysis: 3.776 <= N_c <= 3.83";



  /// gamma H/s_u at failure, with cells of H / @p cells.
  double
  stability_number(const unsigned int cells)
  {
    const StaticCase<2> found("verification/vertical-cut.prm",
                              text("vertical-cut-", cells),
                              {"Stages=equilibrium, strength reduction",
                               "Gravity/Ramp time=0",
                               "Gravity/Magnitude=2",
                               "Damping/Local damping=0",
                               text("Grid/Cell size=", 5. / cells)});
    return 2. * found.factor_of_safety();
  }



  std::string
  name_of(const unsigned int cells)
  {
    return text("gamma H F/s_u, cells of H/", cells);
  }
} // namespace



// With errors of first order in h, F(h) = F + C h, cells of half the size halve
// the error: 2 F(h/2) - F(h).
TEST(VerticalCutSafety, CoarseCells)
{
  Verification      gates(cut, cut_run, cut_source);
  const std::string cause =
    "the slip surface is smeared over some cells, as with finite elements: the "
    "excess is about as large as with bisection of the load by dynamics, and "
    "falls by about a half on cells of half the size";
  const double coarse = stability_number(8), fine = stability_number(16);
  gates.falls_short(name_of(8), coarse, 1.03 * 3.78, {4.10, cause}, "3.78");
  gates.falls_short(name_of(16), fine, 1.03 * 3.78, {3.95, cause}, "3.78");
  gates.near(
    "gamma H F/s_u, extrapolated to h = 0 from these two (first order)",
    2. * fine - coarse,
    3.78,
    0.01);
  EXPECT_LT(fine, coarse);
  EXPECT_GT(fine, 3.776);
}



TEST(VerticalCutSafetyFine, Cells)
{
  Verification gates(cut, cut_run, cut_source);
  const double number = stability_number(32);
  gates.near(name_of(32), number, 3.78, 0.03);
  EXPECT_LT(number, stability_number(16));
}



namespace
{
  const std::string clay_slope     = "Slope of soft clay between two flats",
                    clay_slope_run = "prm/verification/clay-slope.prm",
                    clay_slope_source =
                      "infinite slope: at least s_u/(gamma' T tan) = 3.21";

  /// The slope with cells of @p h m, down to its factor of safety.
  StaticCase<2>
  clay_slope_case(const std::string &name,
                  const double       h,
                  const Overrides   &overrides = {})
  {
    return StaticCase<2>("verification/clay-slope.prm",
                         text("clay-slope-", name, '-', h),
                         Overrides{text("Grid/Cell size=", h)} + overrides);
  }



  double
  clay_slope_factor(const std::string &name,
                    const double       h,
                    const Overrides   &overrides = {})
  {
    return clay_slope_case(name, h, overrides).factor_of_safety();
  }



  /// The layer ends in a tip on its bed.
  const Overrides tapered = {
    "Surfaces/firm/Expression=mudline - 15*min(1, max(0, (260 - x)/40))",
    "Bodies/sediment/Upper corner=260, 0"};

  /// The layer ends at a vertical face as high as it is thick.
  const Overrides cliff = {"Bodies/sediment/Upper corner=250, 0"};

  /// The mudline falls by 3 degrees, then by 6.
  const Overrides steeper = {
    "Surfaces/mudline/Expression=1.3 - 0.0524*min(max(x, 0), 100) - "
    "0.1051*min(max(x - 100, 0), 100)",
    "Materials/clay/Submerged density=800"};
} // namespace



TEST(ClaySlope, FactorOfSafety)
{
  Verification gates(clay_slope, clay_slope_run, clay_slope_source);
  const double F = clay_slope_factor("flats", 5.);
  gates.at_least("factor of safety, cells of T/3", F, 3.21, ">= 3.21");
  gates.at_most("factor of safety, cells of T/3", F, 3.7, ">= 3.21");
}



TEST(ClaySlopeFine, FactorOfSafety)
{
  Verification gates(clay_slope, clay_slope_run, clay_slope_source);
  const double coarse = clay_slope_factor("flats", 5.);
  const double fine   = clay_slope_factor("flats", 2.5);
  gates.at_least("factor of safety, cells of T/6", fine, 3.21, ">= 3.21");
  gates.near("factor of safety with cells of T/3 against T/6",
             coarse,
             fine,
             0.03);
}



TEST(ClaySlopeFine, FactorOfSafetyOfATip)
{
  Verification gates(clay_slope + ", tapered at its end",
                     clay_slope_run + " with the bed at mudline - 15 "
                                      "min(1, max(0, (260 - x)/40))",
                     clay_slope_source);
  gates.near("factor of safety with cells of T/3 against T/6",
             clay_slope_factor("tapered", 5., tapered),
             clay_slope_factor("tapered", 2.5, tapered),
             0.03);
}



// At the free face of a cliff nothing bears the reference pressure.
TEST(ClaySlopeFine, FactorOfSafetyOfACliff)
{
  Verification gates(clay_slope + ", with a cliff at its end",
                     clay_slope_run + " Bodies/sediment/Upper corner=250, 0",
                     "the factor without well-balanced load");
  for (const double h : {5., 2.5})
    gates.near(text("factor of safety, cells of T/", 15. / h),
               clay_slope_factor("cliff", h, cliff),
               clay_slope_factor(
                 "cliff-weight",
                 h,
                 cliff + Overrides{"Equilibrium/Well-balanced load=false"}),
               0.02);
}



TEST(ClaySlopeFine, FactorOfSafetyOfThreeToSixDegrees)
{
  Verification gates(clay_slope + ", 3 and 6 degrees",
                     clay_slope_run + " with slopes of 3 and 6 degrees",
                     "infinite slope of 6 degrees: at least 1.86");
  for (const double h : {5., 2.5})
    gates.at_least(text("factor of safety, cells of T/", 15. / h),
                   clay_slope_factor("steeper", h, steeper),
                   1.86,
                   ">= 1.86");
}



namespace
{
  /// Largest shear stress above the depth h/2 in the middle of the slope, over
  /// the submerged weight of a cell per area.
  double
  largest_shear_stress(const StaticCase<2> &slope, const double h)
  {
    const auto &points = slope.points();
    double      result = 0.;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double x = points.data(points.position, 0)[p];
        const double depth =
          1.3 - 0.075 * x - points.data(points.position, 1)[p];
        if (x < 10. || x > 190. || depth > 0.5 * h)
          continue;
        const auto   sigma = load_stress<2, double>(points, p);
        const double mean  = (sigma[0] + sigma[1] + sigma[2]) / 3.;
        double       sum   = 0.;
        for (unsigned int c = 0; c < 4; ++c)
          sum += c < 3 ? 0.5 * (sigma[c] - mean) * (sigma[c] - mean)
                       : sigma[c] * sigma[c];
        result = std::max(result, std::sqrt(sum));
      }
    return result / (650. * 9.81 * h);
  }
} // namespace



// Elastic soil, since it does not fail: its shear stress near the mudline is
// that of the slope, 0.04 of the weight of a cell at the depth h/2.
TEST(ClaySlope, ShearStressInCutCells)
{
  Verification    gates("Slope of elastic soil between two flats",
                     clay_slope_run + " with a strength of 1 GPa",
                     "gamma' d tan");
  const Overrides elastic = {"Stages=equilibrium",
                             "Materials/clay/Undrained shear strength=1e9",
                             "Materials/clay/Stiffness ratio=0.01",
                             "Bodies/sediment/K0=1"};
  for (const double h : {5., 2.5})
    gates.at_most(
      text(
        "largest shear stress above the depth h/2 over gamma' h, cells of T/",
        15. / h),
      largest_shear_stress(clay_slope_case("elastic", h, elastic), h),
      0.1,
      "0.04");
}



// What the load is corrected by takes no part of what drives the slope.
TEST(ClaySlope, CorrectionDoesNotDrive)
{
  Verification gates(clay_slope,
                     clay_slope_run + " Stages=equilibrium",
                     "forces of quadrature have no sum");
  const auto  slope = clay_slope_case("correction", 5., {"Stages=equilibrium"});
  const auto &equations =
    (*slope).static_stages().equilibrium().newton().equations();
  const auto &load = equations.well_balanced_load();
  double      sum = 0., drive = 0.;
  for (const unsigned int node : equations.unknowns().active_nodes())
    sum += load.forces()[2 * node];
  const auto &points = slope.points();
  for (unsigned int p = 0; p < points.size(); ++p)
    if (const double x = points.data(points.position, 0)[p]; x > 0. && x < 200.)
      drive += 650. * 9.81 * 0.075 * points.data(points.reference_volume)[p];
  gates.at_most("sum of the corrections along x over what drives the slope",
                std::abs(sum) / drive,
                1e-3);
}



// With a weak crust on coarse cells.
TEST(SlopeStability, FactorOfSafety)
{
  Verification gates("40 m of clay on firm ground, slope of a bathymetry",
                     "prm/slope-stability.prm",
                     "the factor with cells of half the size");
  const auto   factor = [](const double h, const Overrides &overrides) {
    return StaticCase<2>("slope-stability.prm",
                         text("slope-stability-", h),
                         Overrides{text("Grid/Cell size=", h)} + overrides)
      .factor_of_safety();
  };
  const Overrides weaker = {
    "Grid/Lower corner=400, -530",
    "Materials/clay/Undrained shear strength=4e3 + 1500*depth"};
  gates.near("factor of safety with cells of 8 m against 4 m",
             factor(8., {}),
             factor(4., {}),
             0.035);
  gates.near(
    "factor of safety, s_u = 4 + 1.5 d kPa, cells of 5 m against 2.5 m",
    factor(5., weaker),
    1.53,
    0.033);
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces over rasters and by expressions, and what lies between them.

#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/expression_surface.h>
#include <talus/geometry/height_field.h>
#include <talus/geometry/intersection.h>
#include <talus/geometry/region.h>
#include <talus/geometry/side_of_surface.h>
#include <talus/geometry/terrain.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/parameter_acceptor.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <sstream>

using namespace talus;
using dealii::FunctionParser;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double a = 0.125, b = -0.375, c = -1200.;
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();

  /// 9 columns of 20 m and 7 rows of 10 m, of a map with large numbers.
  Raster
  raster_of(const std::function<double(double, double)> &height)
  {
    Raster raster;
    raster.n_columns = 9;
    raster.n_rows    = 7;
    raster.dx        = 20.;
    raster.dy        = 10.;
    raster.west      = 612000.;
    raster.south     = 7123000.;
    for (unsigned int r = 0; r < raster.n_rows; ++r)
      for (unsigned int i = 0; i < raster.n_columns; ++i)
        raster.values.push_back(height(raster.x(i), raster.y(r)));
    return raster;
  }



  double
  plane(const double x, const double y)
  {
    return a * (x - 612000.) + b * (y - 7123000.) + c;
  }



  Raster
  random_raster()
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> some(-10., 10.);
    return raster_of([&](double, double) { return some(random); });
  }



  template <int dim>
  std::shared_ptr<const Surface<dim>>
  terrain(const Raster                &raster,
          const Point<3>              &origin = Point<3>(612000., 7123000., 0.),
          const std::vector<Point<2>> &section = {})
  {
    return std::make_shared<Terrain<dim>>(std::make_shared<const HeightField>(
                                            raster),
                                          "map.asc",
                                          PlanOnMap<dim>(origin, section));
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  side(const std::shared_ptr<const Surface<dim>> &surface,
       const typename SideOfSurface<dim>::Side    which)
  {
    return std::make_unique<SideOfSurface<dim>>(surface, which);
  }



  std::string
  error(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const ExcUser &error)
      {
        std::istringstream words(error.what());
        std::string        result;
        for (std::string word; words >> word;)
          result += word + ' ';
        return result;
      }
    return "";
  }
} // namespace



// Up to the outer edges of the raster, and beside cells without data.
TEST(HeightField, PlanesAreExact)
{
  Raster raster    = raster_of(plane);
  raster.values[0] = raster.values[30] = raster.values[31] = missing;
  const HeightField heights(raster);
  unsigned int      n_known = 0;
  for (double x = 612000.; x <= 612180.; x += 2.5)
    for (double y = 7123000.; y <= 7123070.; y += 1.25)
      if (const auto value = heights.at(Point<2>(x, y)))
        {
          ++n_known;
          ASSERT_NEAR(value->height, plane(x, y), 1e-12 * std::abs(c));
          ASSERT_NEAR(value->slope[0], a, 1e-12);
          ASSERT_NEAR(value->slope[1], b, 1e-12);
        }
  EXPECT_GT(n_known, 2000u);
  EXPECT_FALSE(heights.at(Point<2>(612001., 7123069.))); // a value missing
  EXPECT_FALSE(heights.at(Point<2>(611999.9, 7123030.)));
  EXPECT_FALSE(heights.at(Point<2>(612100., 7123070.1)));
}



// Shifted by half a cell the plane would be off by a dx/2.
TEST(HeightField, ValuesBelongToTheCentres)
{
  const Raster      raster = random_raster();
  const HeightField heights(raster);
  for (unsigned int r = 0; r < raster.n_rows; ++r)
    for (unsigned int i = 0; i < raster.n_columns; ++i)
      EXPECT_NEAR(heights.at(Point<2>(raster.x(i), raster.y(r)))->height,
                  raster.value(i, r),
                  1e-8);
}



// No kinks, and the slope is that of the height, also where a value is missing.
TEST(HeightField, SlopesAreContinuous)
{
  Raster raster     = random_raster();
  raster.values[31] = missing;
  raster.west = raster.south = 0.; // differences want all digits
  const HeightField heights(raster);
  const double      e = 1e-6;
  std::mt19937      random(1);
  for (unsigned int i = 0; i < 1000; ++i)
    {
      std::uniform_real_distribution<double> share(0.02, 0.98);
      Point<2> x(180. * share(random), 70. * share(random));
      // Every other one on a line between cells, one axis or the other.
      const unsigned int axis = i % 4 / 2;
      if (i % 2)
        x[axis] = axis == 0 ? raster.x(i % 7 + 1) : raster.y(i % 5 + 1);
      Point<2> before = x, after = x;
      before[axis] -= e;
      after[axis] += e;
      const auto left = heights.at(before), right = heights.at(after);
      if (!left || !right)
        continue;
      EXPECT_LT((left->slope - right->slope).norm(), 1e-5);
      EXPECT_NEAR((right->height - left->height) / (2. * e),
                  0.5 * (left->slope + right->slope)[axis],
                  1e-7);
    }
}



TEST(HeightField, BoundsHold)
{
  const HeightField heights(random_raster());
  const auto       &bounds = heights.bounds();
  double            lowest = 1e9, highest = -1e9, slope = 0.;
  for (double x = 612000.; x < 612180.; x += 1.7)
    for (double y = 7123000.; y < 7123070.; y += 0.9)
      {
        const auto value = heights.at(Point<2>(x, y));
        slope            = std::max(slope, value->slope.norm());
        if (x < 612010. || x > 612170. || y < 7123005. || y > 7123065.)
          continue; // straight beyond the outermost centres
        lowest  = std::min(lowest, value->height);
        highest = std::max(highest, value->height);
      }
  EXPECT_LE(bounds.lowest, lowest);
  EXPECT_GE(bounds.highest, highest);
  EXPECT_GE(bounds.slope, slope);
  // Of use, too.
  EXPECT_LT(bounds.slope, 2.5 * slope);
  EXPECT_LT(bounds.highest - bounds.lowest, 1.5 * (highest - lowest));
}



// x is east, y up, z south: right-handed.
TEST(Terrain, AxesOfTheMesh)
{
  const auto surface =
    terrain<3>(raster_of(plane), Point<3>(612050., 7123060., -1180.));
  const auto value = surface->at(Point<3>(20., 99., 50.));
  EXPECT_NEAR(value.height, plane(612070., 7123010.) + 1180., 1e-9);
  EXPECT_NEAR(value.slope[0], a, 1e-12);
  EXPECT_EQ(value.slope[1], 0.);
  EXPECT_NEAR(value.slope[2], -b, 1e-12);
}



TEST(Terrain, SectionAlongALine)
{
  const double e = 612000., n = 7123000.;
  const auto   surface = terrain<2>(raster_of(plane),
                                  Point<3>(0., 0., c),
                                  {Point<2>(e + 20., n + 10.),
                                     Point<2>(e + 50., n + 50.), // 50 m on
                                     Point<2>(e + 110., n + 50.)});
  const auto   expect  = [&](const double s, const double x, const double y) {
    EXPECT_NEAR(surface->at(Point<2>(s, 7.)).height, a * x + b * y, 1e-9) << s;
  };
  expect(0., 20., 10.);
  expect(-10., 14., 2.); // before its beginning
  expect(25., 35., 30.);
  expect(50., 50., 50.);
  expect(60., 60., 50.);
  expect(130., 130., 50.); // beyond its end
  EXPECT_NEAR(surface->at(Point<2>(10., 0.)).slope[0],
              0.6 * a + 0.8 * b,
              1e-12);
  EXPECT_NEAR(surface->at(Point<2>(70., 0.)).slope[0], a, 1e-12);
}



TEST(Terrain, PlacesWithoutValueAreNamed)
{
  Raster raster             = raster_of(plane);
  raster.values[31]         = missing;
  const auto        surface = terrain<3>(raster);
  const std::string outside =
    error([&] { surface->at(Point<3>(-1., 0., -5.)); });
  EXPECT_NE(outside.find(
              "'map.asc' has no value at (-1 0 -5) m of the mesh, "
              "which is easting 611999 m, northing 7123005 m. It "
              "was read from 612000 m to 612180 m and from 7123000 m "
              "to 7123070 m"),
            std::string::npos)
    << outside;
  EXPECT_NE(error([&] { surface->at(Point<3>(91., 0., -34.)); }), "");
  EXPECT_FALSE(surface->is_known_at(Point<3>(91., 0., -34.)));
}



// Distances of planes are Euclidean.
TEST(SideOfSurface, DistancesOfPlanes)
{
  const auto         surface = terrain<3>(raster_of(plane));
  const auto         below   = side<3>(surface, SideOfSurface<3>::Side::below);
  const auto         above   = side<3>(surface, SideOfSurface<3>::Side::above);
  Tensor<1, 3>       n({-a, 1., b});
  const Point<3>     foot(70., c, 0.);
  const HalfSpace<3> half(Point<3>(0., c, 0.), n);
  for (const Point<3> x :
       {Point<3>(70., c, -30.), Point<3>(150., c + 30., -65.)})
    {
      EXPECT_NEAR(below->signed_distance(x), half.signed_distance(x), 1e-10);
      EXPECT_NEAR(above->signed_distance(x), -half.signed_distance(x), 1e-10);
      EXPECT_LT((below->normal(x) - half.normal(x)).norm(), 1e-12);
      EXPECT_LT((above->normal(x) + half.normal(x)).norm(), 1e-12);
    }
}



namespace
{
  class Layers : public testing::Test
  {
  protected:
    template <int dim>
    std::shared_ptr<const Surface<dim>>
    expression(
      const std::string                                         &text,
      const std::vector<typename ExpressionSurface<dim>::Named> &others = {})
    {
      return std::make_shared<ExpressionSurface<dim>>("'Upper surface'",
                                                      text,
                                                      constants,
                                                      others);
    }

    // What is left of other tests goes before there is something new to lose.
    struct Cleared
    {
      Cleared()
      {
        dealii::ParameterAcceptor::clear();
      }
    };

    const Cleared   cleared;
    const Constants constants;
  };
} // namespace



TEST_F(Layers, ExpressionsOfOtherSurfaces)
{
  const auto mudline = terrain<3>(random_raster());
  const auto slip    = expression<3>("0.1*x - 0.2*z^2/100 - 20");
  const auto lower   = expression<3>("max(mudline - (5 + 0.01*x), slip)",
                                   {{"mudline", mudline}, {"slip", slip}});
  for (const Point<3> x : {Point<3>(30., 0., -20.), Point<3>(150., 0., -61.)})
    {
      const double m     = mudline->at(x).height - 5. - 0.01 * x[0];
      const double s     = 0.1 * x[0] - 0.002 * x[2] * x[2] - 20.;
      const auto   value = lower->at(x);
      EXPECT_NEAR(value.height, std::max(m, s), 1e-12);
      const auto expected =
        m > s ? mudline->at(x).slope - 0.01 * Point<3>(1., 0., 0.)
              : Tensor<1, 3>({0.1, 0., -0.004 * x[2]});
      EXPECT_LT((value.slope - expected).norm(), 1e-8);
      EXPECT_NEAR(lower->height(x), value.height, 1e-12);
      const auto shape = side<3>(lower, SideOfSurface<3>::Side::below);
      for (const double dy : {-1e-6, 1e-6})
        EXPECT_EQ(shape->contains(Point<3>(x[0], value.height + dy, x[2])),
                  dy < 0);
    }
  // Any number of surfaces, whose slopes add.
  const auto sum = expression<3>(
    "a + b + c + d + e",
    {{"a", slip}, {"b", slip}, {"c", slip}, {"d", slip}, {"e", slip}});
  const Point<3> place(30., 0., -20.);
  EXPECT_NEAR(sum->at(place).height, 5. * slip->height(place), 1e-12);
  EXPECT_LT((sum->at(place).slope - 5. * slip->at(place).slope).norm(), 1e-8);
  EXPECT_NE(error([&] {
              expression<2>("mudlin - 5");
            }).find("'Upper surface' = 'mudlin - 5' cannot be understood"),
            std::string::npos);
}



// Operators and functions are those of deal.II's FunctionParser.
TEST_F(Layers, OperatorsOfExpressions)
{
  for (const std::string text : {"-x^2",
                                 "2^x^2",
                                 "2^-x + x^-2^2",
                                 "3*x^3 - ((x - 5)/4)^2/2^0.5",
                                 "if (x > 1, x, 2) + (x > 1 & x < 2 | 0)",
                                 "sqrt (x) + erfc(x) + int(x) + pow(x, 2.5)",
                                 "log(x) + cot(x) + csc(x) + sec(x)",
                                 "ceil(x) + floor(x)"})
    {
      FunctionParser<1> expected(1);
      expected.initialize("x", text, std::map<std::string, double>());
      const auto surface = expression<2>(text);
      for (const double x : {0.3, 1.7, 2.5})
        {
          const double value = expected.value(Point<1>(x));
          EXPECT_NEAR(surface->at(Point<2>(x, 0.)).height,
                      value,
                      1e-14 * std::max(1., std::abs(value)))
            << text;
        }
    }
}



// Between parallel planes the volume is exact; the outline comes first, so that
// nobody asks for the surfaces beyond it.
TEST_F(Layers, VolumeBetweenPlanes)
{
  const auto mudline =
    terrain<3>(raster_of(plane), Point<3>(612000., 7123000., c));
  const auto lower = expression<3>("mudline - 4", {{"mudline", mudline}});
  Intersection<3>::Parts parts;
  parts.push_back(std::make_unique<BoxRegion<3>>(
    Box<3>{Point<3>(40., -1e3, -50.), Point<3>(100., 1e3, -20.)}));
  parts.push_back(side<3>(mudline, SideOfSurface<3>::Side::below));
  parts.push_back(side<3>(lower, SideOfSurface<3>::Side::above));
  const Intersection<3> layer(std::move(parts));
  const Region<3>       region(layer);
  double                volume = 0.;
  for (double x = 0.; x < 180.; x += 20.)
    for (double y = -50.; y < 50.; y += 20.)
      for (double z = -80.; z < 0.; z += 20.)
        volume += region
                    .part_inside(
                      {Point<3>(x, y, z), Point<3>(x + 20., y + 20., z + 20.)})
                    .volume;
  EXPECT_NEAR(volume, 60. * 30. * 4., 1e-6);
  EXPECT_TRUE(
    region.contains(Point<3>(50., 0.125 * 50 - 0.375 * 30. - 2., -30.)));
  EXPECT_FALSE(
    region.contains(Point<3>(50., 0.125 * 50 - 0.375 * 30. - 5., -30.)));
}



namespace
{
  /// Plane at y = 0 that counts the bounds of its change.
  struct CountingPlane : Surface<2>
  {
    Value
    at(const Point<2> & /*x*/) const override
    {
      return {0., {}};
    }

    bool
    is_known_at(const Point<2> & /*x*/) const override
    {
      return true;
    }

    double
    largest_change(const Point<2> & /*x*/, double /*distance*/) const override
    {
      ++n_bounds;
      return 0.;
    }

    mutable unsigned int n_bounds = 0;
  };
} // namespace



// Bounds are expensive for expressions: the lower surface is asked only where
// the upper surface leaves the answer open.
TEST(SideOfSurface, LayersAskForFewBounds)
{
  const auto upper = std::make_shared<CountingPlane>();
  const auto lower = std::make_shared<CountingPlane>();
  using Side       = SideOfSurface<2>::Side;
  Intersection<2>::Parts parts;
  parts.push_back(std::make_unique<SideOfSurface<2>>(upper, Side::below));
  parts.push_back(std::make_unique<SideOfSurface<2>>(lower, Side::above));
  const Intersection<2> nothing(std::move(parts));
  const Point<2>        above(3., 2.), below(3., -2.);
  EXPECT_TRUE(nothing.may_cut_ball(above, 3.));
  EXPECT_EQ(upper->n_bounds + lower->n_bounds, 0u);
  EXPECT_FALSE(nothing.may_cut_ball(above, 1.));
  EXPECT_EQ(upper->n_bounds, 1u);
  EXPECT_EQ(lower->n_bounds, 0u);
  EXPECT_FALSE(nothing.may_cut_ball(below, 1.));
  EXPECT_TRUE(nothing.may_cut_ball(below, 3.));
}



TEST(SideOfSurface, OppositeSides)
{
  using Side                     = SideOfSurface<3>::Side;
  const auto             surface = terrain<3>(raster_of(plane));
  const auto             other   = terrain<3>(raster_of(plane));
  const SideOfSurface<3> below(surface, Side::below);
  EXPECT_TRUE(below.is_beyond(SideOfSurface<3>(surface, Side::above)));
  EXPECT_FALSE(below.is_beyond(SideOfSurface<3>(surface, Side::below)));
  EXPECT_FALSE(below.is_beyond(SideOfSurface<3>(other, Side::above)));
  EXPECT_FALSE(
    below.is_beyond(HalfSpace<3>(Point<3>(), Point<3>(0., -1., 0.))));
}



// A steep face beside a box is unknown to the tangent plane at the centre of
// the box.
TEST_F(Layers, SteepFaceBesideAPlace)
{
  const auto      step = expression<2>("if(x < 5.3, 0, -8)");
  const auto      soil = side<2>(step, SideOfSurface<2>::Side::below);
  const Region<2> region(*soil);
  const double    volume =
    region.part_inside({Point<2>(4., -6.), Point<2>(6., -4.)}).volume;
  EXPECT_NEAR(volume, 1.3 * 2., 0.1);
  EXPECT_FALSE(soil->may_cut_ball(Point<2>(0., -6.), 2.));
  EXPECT_TRUE(soil->may_cut_ball(Point<2>(4., -6.), 2.));
}



// The soil under a wavy raster, against the sum of the heights.
TEST_F(Layers, VolumeUnderARaster)
{
  const auto wavy =
    terrain<2>(raster_of([](const double x, double) {
                 return 3. * std::sin((x - 612000.) / 25.);
               }),
               Point<3>(),
               {Point<2>(612000., 7123035.), Point<2>(612180., 7123035.)});
  const auto      soil = side<2>(wavy, SideOfSurface<2>::Side::below);
  const Region<2> region(*soil);
  double          volume = 0., expected = 0.;
  for (double x = 0.; x < 180.; x += 2.)
    for (double y = -10.; y < 10.; y += 2.)
      volume +=
        region.part_inside({Point<2>(x, y), Point<2>(x + 2., y + 2.)}).volume;
  const unsigned int n = 18000;
  for (unsigned int i = 0; i < n; ++i)
    expected +=
      180. / n * (wavy->at(Point<2>((i + 0.5) * 180. / n, 0.)).height + 10.);
  EXPECT_NEAR(volume, expected, 1e-4 * expected);
}

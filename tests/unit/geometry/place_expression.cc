// SPDX-License-Identifier: LGPL-2.1-or-later
// A quantity by place: a number, an expression in place and depth, and rasters.

#include <talus/base/errors.h>
#include <talus/geometry/place_expression.h>
#include <talus/geometry/terrain.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using dealii::Point;

namespace
{
  class PlaceExpressionTest : public testing::Test
  {
  protected:
    PlaceExpressionTest()
    {
      dealii::ParameterAcceptor::clear();
    }

    template <int dim = 3>
    PlaceExpression<dim>
    quantity(const std::string                               &words,
             const std::vector<typename Surface<dim>::Named> &surfaces = {})
    {
      return {"'Cap'", words, Constants(), surfaces};
    }
  };



  /// Ratio on the map, a plane, relative to the place (5e5, 6e6) [-].
  double
  ratio_at(const double east, const double north)
  {
    return 0.75 + 0.001 * east - 0.002 * north;
  }



  /// Raster of ratio_at(), 400 m wide, for a mesh with its origin 300 m up.
  template <int dim>
  typename Surface<dim>::Named
  ratio(const std::vector<Point<2>> &section)
  {
    Raster raster;
    raster.has_heights = false;
    raster.n_columns = raster.n_rows = 40;
    raster.dx = raster.dy = 10.;
    raster.west           = 5e5 - 200.;
    raster.south          = 6e6 - 200.;
    for (unsigned int r = 0; r < raster.n_rows; ++r)
      for (unsigned int i = 0; i < raster.n_columns; ++i)
        raster.values.push_back(ratio_at(raster.x(i) - 5e5, raster.y(r) - 6e6));
    return {"ratio",
            std::make_shared<Terrain<dim>>(
              std::make_shared<const HeightField>(raster),
              "ratio.asc",
              PlanOnMap<dim>(Point<3>(5e5, 6e6, 300.), section))};
  }
} // namespace



TEST_F(PlaceExpressionTest, NumberAndPlace)
{
  EXPECT_EQ(quantity("1e3").number(), 1000.);
  EXPECT_EQ(quantity("1e3").at(Point<3>(1, 2, 3)), 1000.);
  EXPECT_FALSE(quantity("2*500").number());
  EXPECT_FALSE(quantity("x + 10*y + 100*z").depends_on_depth());
  EXPECT_EQ(quantity("x + 10*y + 100*z").at(Point<3>(1, 2, 3)), 321.);
  EXPECT_THROW(quantity("depht"), ExcUser);
  EXPECT_THROW(quantity("1/(x - 1)").at(Point<3>(1, 2, 3)), ExcPoint);
}



TEST_F(PlaceExpressionTest, Depth)
{
  PlaceExpression<3> with_depth = quantity("100 + 7*depth");
  EXPECT_TRUE(with_depth.depends_on_depth());
  with_depth.set_depth([](const Point<3> &x) { return 5. - x[1]; });
  EXPECT_EQ(with_depth.at(Point<3>(1, 2, 3)), 121.);
}



// A raster of another quantity does not depend on the height of the mesh. In
// 3-D z points south; in 2-D x is the length along an oblique section.
TEST_F(PlaceExpressionTest, PlaneRaster)
{
  const std::string  words = "2000 + 1500*depth*ratio - ratio";
  const auto         depth = [](const auto &x) { return 5. - x[1]; };
  PlaceExpression<3> map   = quantity<3>(words, {ratio<3>({})});
  PlaceExpression<2> section =
    quantity<2>(words,
                {ratio<2>({Point<2>(5e5, 6e6), Point<2>(5e5 + 8., 6e6 + 6.)})});
  map.set_depth(depth);
  section.set_depth(depth);
  for (const double x : {-130., 0., 71.3})
    for (const double y : {-20., 3.})
      {
        const auto expected = [y](const double r) {
          return 2000. + 1500. * (5. - y) * r - r;
        };
        const double in_map     = expected(ratio_at(x, -0.4 * x - 7.)),
                     in_section = expected(ratio_at(0.8 * x, 0.6 * x));
        EXPECT_NEAR(map.at(Point<3>(x, y, 0.4 * x + 7.)),
                    in_map,
                    1e-12 * in_map);
        EXPECT_NEAR(section.at(Point<2>(x, y)), in_section, 1e-12 * in_section);
      }
  try
    {
      map.at(Point<3>(210., 0., 0.));
      FAIL();
    }
  catch (const ExcUser &error)
    {
      const std::string said = error.what();
      for (const std::string part : {"'ratio.asc'",
                                     "no value at (210 0 0) m",
                                     "easting 500210 m, northing 6000000 m",
                                     "fill the raster"})
        EXPECT_NE(said.find(part), std::string::npos) << part << said;
    }
}

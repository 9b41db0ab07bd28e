// SPDX-License-Identifier: LGPL-2.1-or-later
// Beds and layers by rasters: those of planes are half-planes and polygons.

#include "case.h"

#include <talus/base/raster.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>

using namespace talus;
using dealii::Point;
using namespace talus::cases;

namespace
{
  // Of the bed of prm/landslide-inclined.prm.
  const double gradient = -std::tan(5. * M_PI / 180.);



  /// Write a raster of 90 x 80 cells of 4 m around the map's place (4e5,
  /// 6.5e6), and return the path of its file.
  std::string
  write(const std::string                           &name,
        const std::function<double(double, double)> &height)
  {
    Raster raster;
    raster.n_columns = 90;
    raster.n_rows    = 80;
    raster.dx = raster.dy = 4.;
    raster.west           = 4e5 - 100.;
    raster.south          = 6.5e6 - 160.;
    for (unsigned int r = 0; r < raster.n_rows; ++r)
      for (unsigned int i = 0; i < raster.n_columns; ++i)
        raster.values.push_back(height(raster.x(i) - 4e5, raster.y(r) - 6.5e6));
    std::filesystem::create_directories(TALUS_RESULTS_DIR);
    const auto path = std::filesystem::path(TALUS_RESULTS_DIR) / name;
    write_esri_grid(path, raster);
    return path.string();
  }
} // namespace



// A second of the slide, with the bed along an oblique section of a plane.
TEST(Terrain, PlaneBedIsTheHalfPlane)
{
  const std::string file =
    write("plane.asc", [](const double x, const double y) {
      return gradient * (0.8 * x + 0.6 * y) + 300.;
    });
  const Overrides coarse = {"Grid/Cell size=0.8",
                            "End time=1",
                            "Output/Statistics interval=0.25"};
  const Table     half_plane =
    run<2>("landslide-inclined.prm", "terrain-half-plane", coarse);
  const Table terrain =
    run<2>("landslide-inclined.prm",
           "terrain-plane",
           coarse + Overrides{"Grid/Origin=0,0,300",
                              "Surfaces/Names=bed",
                              "Surfaces/bed/File=" + file,
                              "Surfaces/bed/Section=400000,6500000; "
                              "400008,6500006",
                              "Obstacles/bed/Shape=terrain",
                              "Obstacles/bed/Surface=bed"});
  ASSERT_EQ(terrain.n_rows(), half_plane.n_rows());
  for (const std::string column : {"front x [m]",
                                   "centre y [m]",
                                   "kinetic energy [J]",
                                   "contact work [J]",
                                   "friction work [J]",
                                   "mass [kg]"})
    for (unsigned int row = 0; row < terrain.n_rows(); ++row)
      EXPECT_NEAR(terrain[column][row],
                  half_plane[column][row],
                  1e-7 * std::abs(half_plane[column].back()))
        << column << ", row " << row;
}



// Strength and bed by the raster of a plane, along an oblique section, are
// those of an expression. The raster is no height: that of 'Grid/Origin' does
// not count.
TEST(Terrain, StrengthAndBedOfARaster)
{
  const std::string file =
    write("ratio.asc", [](const double x, const double y) {
      return 0.8 + 0.004 * (0.8 * x + 0.6 * y);
    });
  const auto slide = [&](const std::string &name, const std::string &ratio) {
    return run<2>("landslide-inclined.prm",
                  name,
                  {"Grid/Cell size=0.8",
                   "End time=1",
                   "Grid/Origin=0,0,300",
                   "Surfaces/Names=ratio",
                   "Surfaces/ratio/File=" + file,
                   "Surfaces/ratio/Quantity=other",
                   "Surfaces/ratio/Section=400000,6500000; 400008,6500006",
                   "Materials/clay/Undrained shear strength=1000 + 900*depth*" +
                     ratio,
                   "Obstacles/bed/Maximum shear stress=1000*" + ratio});
  };
  const Table raster     = slide("ratio-raster", "ratio");
  const Table expression = slide("ratio-expression", "(0.8 + 0.004*x)");
  const Table uniform    = slide("ratio-uniform", "0.8");
  ASSERT_EQ(raster.n_rows(), expression.n_rows());
  for (const std::string column :
       {"friction work [J]", "plastic work [J]", "kinetic energy [J]"})
    {
      const double end = expression[column].back();
      EXPECT_NEAR(raster[column].back(), end, 1e-9 * end) << column;
      EXPECT_GT(std::abs(uniform[column].back() - end), 0.005 * end) << column;
    }
}



// Two layers of a slope in 3-D that a bed cuts: volume, centre, who has what.
TEST(Terrain, LayersInThreeDimensions)
{
  const std::string file =
    write("slope.asc",
          [](const double x, const double y) { return 0.25 * x - 0.5 * y; });
  const Overrides overrides = {"Grid/Origin=400000,6500000,2",
                               "Grid/Lower corner=0,-8,0",
                               "Grid/Upper corner=16,16,16",
                               "Grid/Cell size=2",
                               "Surfaces/Names=mudline",
                               "Surfaces/mudline/File=" + file,
                               "Obstacles/plane/Point=0,-100,0",
                               "Bodies/block/Vertices=",
                               "Bodies/block/Shape=layer",
                               "Bodies/block/Upper surface=mudline",
                               "Bodies/block/Lower surface=mudline - 3",
                               "Bodies/block/Filling=clipped",
                               "Bodies/block/Lower corner=2,0,2",
                               "Bodies/block/Upper corner=9,0,14.5"};
  const Case<3>   layer("block-on-plane-3d.prm", overrides);
  const auto     &points = layer.points();
  double          volume = 0.;
  Point<3>        moment;
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const double part = points.data(points.reference_volume)[p];
      const auto   x    = load_place(points, points.position, p);
      volume += part;
      moment += part * x;
      const double depth = 0.25 * x[0] + 0.5 * x[2] - 2. - x[1];
      EXPECT_GT(depth, 0.);
      EXPECT_LT(depth, 3.);
    }
  EXPECT_NEAR(volume, 7. * 12.5 * 3., 1e-8);
  const Point<3> centre = moment / volume;
  EXPECT_NEAR(centre[0], 5.5, 1e-8);
  EXPECT_NEAR(centre[2], 8.25, 1e-8);
  EXPECT_NEAR(centre[1], 0.25 * 5.5 + 0.5 * 8.25 - 2. - 1.5, 1e-8);
}



// A route that runs along z, and goes on beyond the mesh, is a cylinder without
// ends: the same forces. The mesh, body and route are given on the map.
TEST(Terrain, PipeAlongARouteOfTheMap)
{
  const Overrides on_plane = {"Surfaces/mudline/Expression=",
                              "Surfaces/mudline/File=" +
                                write("dips-east.asc",
                                      [](const double x, const double) {
                                        return gradient * x + 300.;
                                      })};
  const auto      forces   = [](const std::string &name) {
    return Table(std::filesystem::path(TALUS_RESULTS_DIR) / name /
                 "obstacles.csv");
  };
  run<3>("slide-on-pipe-3d.prm", "slide-on-pipe", on_plane);
  run<3>("slide-on-pipe-3d.prm",
         "slide-on-cylinder",
         on_plane + Overrides{"Obstacles/pipe/Shape=cylinder",
                              "Obstacles/pipe/Coordinates=mesh",
                              text("Obstacles/pipe/Centre=6, ",
                                   std::setprecision(17),
                                   6. * gradient + 0.4,
                                   ", 0")});
  const Table pipe     = forces("slide-on-pipe"),
              cylinder = forces("slide-on-cylinder");
  ASSERT_EQ(pipe.n_rows(), cylinder.n_rows());
  const double last = cylinder["pipe impulse x [N s]"].back();
  EXPECT_GT(last, 100.);
  for (const std::string column :
       {"pipe impulse x [N s]", "pipe impulse y [N s]", "bed impulse y [N s]"})
    for (unsigned int row = 0; row < pipe.n_rows(); ++row)
      EXPECT_NEAR(pipe[column][row], cylinder[column][row], 1e-6 * last)
        << column << ", row " << row;
}



// The force of soil on a pipe without friction is square to the pipe, whatever
// its route: here 30 degrees from north, on a bed that dips along x. Facets are
// plane, on cells as large as the radius: 0.22 % of the force was along it.
TEST(Terrain, ForceIsSquareToAnObliquePipe)
{
  run<3>("slide-on-pipe-3d.prm",
         "slide-on-oblique-pipe",
         {"Surfaces/mudline/Expression=",
          "Surfaces/mudline/File=" + write("dips-east-too.asc",
                                           [](const double x, const double) {
                                             return gradient * x + 300.;
                                           }),
          "Obstacles/pipe/Route=400010, 6500005.428203230276; "
          "400002, 6499991.571796769724"});
  const Table table(std::filesystem::path(TALUS_RESULTS_DIR) /
                    "slide-on-oblique-pipe" / "obstacles.csv");
  Point<3>    impulse;
  for (unsigned int d = 0; d < 3; ++d)
    impulse[d] =
      table[std::string("pipe impulse ") + "xyz"[d] + " [N s]"].back();
  const Point<3> along(8., 8. * gradient, -8. * std::sqrt(3.));
  EXPECT_GT(impulse[0], 100.);
  EXPECT_GT(impulse[2], 0.3 * impulse[0]);
  EXPECT_NEAR(impulse * along / along.norm(), 0., 5e-3 * impulse.norm());
}



// Outside of the release area slip surface and mudline are one, and curved:
// what their errors leave between them is no soil. A box is 12.5 m wide.
TEST(Terrain, NoSoilBetweenSurfacesThatGoOnAsOne)
{
  Case<3> slope(
    "own-slope.prm",
    {"Grid/Cell size=25",
     "Grid/Upper corner=3500, -80, 2400",
     "Surfaces/slip/Expression=mudline - min(15, max(0, release))"});
  const auto   &points = slope.points();
  const double *volume = points.data(points.reference_volume);
  ASSERT_GT(points.size(), 2000u);
  EXPECT_GT(*std::min_element(volume, volume + points.size()),
            1e-3 * std::pow(12.5, 3));
}

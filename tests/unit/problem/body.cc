// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies filled with points.

#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/expression_surface.h>
#include <talus/geometry/side_of_surface.h>
#include <talus/problem/body.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double density = 1600.; // kg/m^3



  /// A mesh and bodies in it.
  template <int dim>
  struct WithBodies : Core<dim>
  {
    using Core<dim>::points;

    /// @p entries of each body; their names are 0, 1, ...
    explicit WithBodies(const std::vector<std::string> &entries)
      : Core<dim>(cube<dim>())
    {
      for (unsigned int b = 0; b < entries.size(); ++b)
        bodies.push_back(std::make_unique<Body<dim>>(std::to_string(b)));
      dealii::ParameterAcceptor::declare_all_parameters();
      for (unsigned int b = 0; b < entries.size(); ++b)
        dealii::ParameterAcceptor::prm.parse_input_from_string(
          in_section("Bodies", in_section(std::to_string(b), entries[b])));
      dealii::ParameterAcceptor::parse_all_parameters();
    }

    void
    create()
    {
      for (unsigned int b = 0; b < bodies.size(); ++b)
        bodies[b]->create_points(this->grid, b, density, points);
    }

    double
    sum(const unsigned int column) const
    {
      double result = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        result += points.data(column)[p];
      return result;
    }

    std::vector<std::unique_ptr<Body<dim>>> bodies;
  };



  const std::string clipped = "set Filling = clipped\n";
  const std::string centres = "set Filling = centres\n";



  std::string
  box(const std::string &lower, const std::string &upper)
  {
    return "set Shape = box\nset Lower corner = " + lower +
           "\nset Upper corner = " + upper + "\n";
  }



  std::string
  polygon(const std::string &vertices)
  {
    return "set Shape = polygon\nset Vertices = " + vertices + "\n";
  }



  template <int dim>
  std::string
  error(const std::vector<std::string> &entries)
  {
    WithBodies<dim> all(entries);
    return message_of<ExcUser>([&] { all.create(); });
  }



  TEST(Bodies, BoxOfWholeCells)
  {
    WithBodies<2> all({box("1, 0", "3, 1")});
    all.create();
    const auto &points = all.points;
    ASSERT_EQ(points.size(), 2 * 4);
    EXPECT_DOUBLE_EQ(all.sum(points.reference_volume), 2.);
    EXPECT_DOUBLE_EQ(all.sum(points.mass), 2. * density);
    double sum_x = 0., sum_y = 0.;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        sum_x += points.data(points.position, 0)[p];
        sum_y += points.data(points.position, 1)[p];
        EXPECT_EQ(all.get(points.initial_position, p),
                  all.get(points.position, p));
        EXPECT_EQ(all.get(points.velocity, p), (Tensor<1, 2>()));
        EXPECT_EQ(all.get(points.box_length, p), Point<2>(0.5, 0.5));
        EXPECT_EQ(all.get(points.length_at_creation, p), Point<2>(0.5, 0.5));
        EXPECT_EQ(all.edges(p), (Tensor<2, 2>({{0.5, 0.}, {0., 0.5}})));
        EXPECT_EQ(points.data(points.body)[p], 0.);
      }
    EXPECT_DOUBLE_EQ(sum_x / points.size(), 2.);
    EXPECT_DOUBLE_EQ(sum_y / points.size(), 0.5);
  }



  TEST(Bodies, PointsPerAxis)
  {
    WithBodies<3> all(
      {box("0, 1, 2", "2, 2, 4") + "set Points per cell and axis = 2, 3, 1"});
    all.create();
    const auto &points = all.points;
    ASSERT_EQ(points.size(), 4 * 6);
    EXPECT_NEAR(all.sum(points.reference_volume), 4., 1e-14);
    EXPECT_NEAR(all.sum(points.mass), 4. * density, 1e-10);
    for (const unsigned int column :
         {points.box_length, points.length_at_creation})
      EXPECT_EQ(all.get(column, 7), Point<3>(0.5, 1. / 3., 1.));
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        EXPECT_EQ(all.edges(7)[i][k],
                  i == k ? all.get(points.box_length, 7)[k] : 0.);
  }



  // With n points along each leg, n (n + 1)/2 points lie below the hypotenuse
  // or on the hypotenuse.
  TEST(Bodies, PointsOnTheEdgeBelongToIt)
  {
    WithBodies<2> all({polygon("0,0; 4,0; 0,4") + centres});
    all.create();
    EXPECT_EQ(all.points.size(), 8 * 9 / 2);
    EXPECT_EQ(all.sum(all.points.reference_volume), 9.);
  }



  // Cells of any size have the same number of points.
  TEST(Bodies, CellsOfSeveralSizes)
  {
    WithBodies<2> all({box("0, 0", "4, 4")});
    refine_corner(all);
    all.create();
    EXPECT_EQ(all.points.size(), (12 + 4 * 4) * 4);
    EXPECT_EQ(all.sum(all.points.reference_volume), 16.);
    EXPECT_EQ(all.sum(all.points.mass), 16. * density);
  }



  TEST(Bodies, PrismFillsTheMeshOrItsExtent)
  {
    const std::string square = polygon("0,0; 1,0; 1,1; 0,1");
    WithBodies<3> whole({square}), part({square + "set Extent in z = 1, 3"});
    whole.create();
    part.create();
    EXPECT_EQ(whole.sum(whole.points.reference_volume), 4.);
    EXPECT_EQ(part.sum(part.points.reference_volume), 2.);
  }



  TEST(Bodies, WhatCannotBeIsSaid)
  {
    const auto expect = [](const std::string &said, const std::string &part) {
      EXPECT_TRUE(contains(said, part)) << said;
    };
    expect(error<2>({box("0, 0", "2, 2"), box("1, 1", "3, 3")}),
           "The body '1' contains the point at (1.25 1.25) m");
    expect(
      error<2>({box("0, 0", "2, 5")}),
      "reaches from 0 m to 5 m along axis 1, but the mesh only from 0 m to "
      "4 m");
    expect(error<2>({box("0.1, 0.1", "0.2, 0.2") + centres}), "got no points");
    expect(error<2>({box("2, 0", "1, 1")}), "must lie above");
    expect(error<3>({polygon("0,0; 1,0; 1,1; 0,1") + "set Extent in z = 3, 1"}),
           "'Bodies/0/Extent in z' = '3, 1' ends before the beginning");
    expect(error<3>({box("0, 0, 0", "1, 1, 1") +
                     "set Points per cell and axis = 2, 3"}),
           "lists 2 numbers; give one, or one for each of the 3 axes");
    expect(error<2>({polygon("0,0; 1,0; up")}), "contains 'up'");
    expect(error<2>(
             {"set Shape = ball\nset Radius = 1\nset Inner radius = 1\n"}),
           "leaves nothing of the ball");
    const std::string corner = "set Shape = cone\nset End radius = 1\n";
    expect(error<3>({corner + "set Axis = 0, 0, 0; 0, 3, 0"}),
           "or leave out the part beyond by 'Bodies/0/Cut by mesh'");
    expect(error<3>({corner + "set Axis = 0, 0, 0"}),
           "'Bodies/0/Axis' has 1 place in 3-D, but a cone needs two");
    expect(error<2>({corner}), "has 0 places in 2-D");
    // Neighbours that share a face do not overlap.
    EXPECT_EQ(error<2>({box("0, 0", "2, 2"), box("2, 0", "3, 2")}), "");
  }



  template <int dim>
  double
  clipped_volume(const std::string &shape)
  {
    WithBodies<dim> all({shape + clipped});
    all.create();
    EXPECT_NEAR(all.sum(all.points.mass),
                density * all.sum(all.points.reference_volume),
                1e-9);
    return all.sum(all.points.reference_volume);
  }



  // Whole boxes are what they are by centres, to the bit.
  TEST(ClippedBodies, WholeBoxes)
  {
    const std::string shape =
      box("0, 1, 2", "2, 2, 4") + "set Points per cell and axis = 2, 3, 1\n";
    WithBodies<3> by_centres({shape + centres});
    by_centres.create();
    WithBodies<3> all({shape + clipped});
    all.create();
    ASSERT_EQ(all.points.size(), by_centres.points.size());
    for (unsigned int p = 0; p < all.points.size(); ++p)
      for (unsigned int array = 0; array < all.points.n_arrays(); ++array)
        EXPECT_EQ(all.points.data(array)[p], by_centres.points.data(array)[p]);
  }



  // Boxes of points of half a metre.
  TEST(ClippedBodies, VolumeIsThatOfTheShape)
  {
    EXPECT_NEAR(clipped_volume<2>(box("0.13, 0.21", "3.17, 3.59")),
                3.04 * 3.38,
                1e-4 * 10.);
    EXPECT_NEAR(clipped_volume<2>(polygon("0,0; 4,0; 0,3.3")),
                0.5 * 4. * 3.3,
                1e-4 * 6.);
    const std::string ball = "set Shape = ball\nset Radius = 1.7\n";
    EXPECT_NEAR(clipped_volume<2>(ball + "set Centre = 2, 2.1\n"),
                dealii::numbers::PI * 1.7 * 1.7,
                1e-3 * 9.);
    EXPECT_NEAR(clipped_volume<3>(ball + "set Centre = 2, 2.1, 1.9\n"),
                4. / 3. * dealii::numbers::PI * std::pow(1.7, 3),
                4e-3 * 20.);
    EXPECT_NEAR(clipped_volume<3>("set Shape = cylinder\nset Radius = 1.7\n"
                                  "set Centre = 2, 2, 0\n"
                                  "set Extent in z = 0.5, 2.3\n"),
                dealii::numbers::PI * 1.7 * 1.7 * 1.8,
                1e-2 * 16.);
    EXPECT_NEAR(clipped_volume<3>("set Shape = cylinder\nset Radius = 0.9\n"
                                  "set Inner radius = 0.4\n"
                                  "set Axis = 1, 1, 1.5; 2.5, 3, 2.5\n"),
                dealii::numbers::PI * (0.81 - 0.16) * std::sqrt(7.25),
                1e-2 * 5.5);
    const auto cone = [](const std::string &axis) {
      return clipped_volume<3>("set Shape = cone\nset Radius = 1.8\n"
                               "set End radius = 0.6\nset Axis = " +
                               axis + "\nset Cut by mesh = true\n");
    };
    const double volume =
      dealii::numbers::PI / 3. * 3. * (3.24 + 1.8 * 0.6 + 0.36);
    EXPECT_NEAR(cone("2, 0, 2; 2, 3, 2"), volume, 4e-3 * volume);
    EXPECT_NEAR(cone("0.4, 2, 2; 3.4, 2, 2"), volume, 4e-3 * volume);
    // Between planes of symmetry.
    EXPECT_NEAR(cone("0, 0, 0; 0, 3, 0"), volume / 4., 1e-3 * volume);
    EXPECT_NEAR(cone("4, 1, 2; 4, 4, 2"), volume / 2., 2e-3 * volume);
  }



  // What the slivers give goes on: first moments are exact, points keep their
  // distance, and none is lighter than a fifth of its neighbours.
  TEST(ClippedBodies, SliversAreMerged)
  {
    // The upper row of boxes is a tenth full.
    WithBodies<2> all({box("0, 0", "4, 1.05") + clipped});
    all.create();
    const auto &points = all.points;
    ASSERT_EQ(points.size(), 8u * 2u);
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double y = all.get(points.position, p)[1];
        if (y < 0.5)
          EXPECT_EQ(points.data(points.reference_volume)[p], 0.25);
        else
          {
            EXPECT_NEAR(y, 0.5 * (0.5 + 1.05), 1e-4);
            EXPECT_NEAR(points.data(points.reference_volume)[p], 0.275, 1e-4);
            EXPECT_NEAR(all.edges(p)[0][0], 0.5, 2e-3);
            EXPECT_NEAR(all.edges(p)[1][1], 0.55, 2e-3);
          }
      }
    // Soil that is thin everywhere stays as it is.
    WithBodies<2> thin({box("0, 0", "4, 0.05") + clipped});
    thin.create();
    EXPECT_EQ(thin.points.size(), 8u);
    EXPECT_NEAR(thin.sum(thin.points.reference_volume), 0.2, 1e-4);
  }



  // A wedge of 1 in 20 is thinner than a fifth of a box over the first two
  // cells. The tip has no kept box around, but must not become a point hundreds
  // of times lighter than the next point.
  TEST(ClippedBodies, ThinEdgesEndInPointsOfSomeWeight)
  {
    WithBodies<2> wedge({polygon("0.3,0; 4,0; 4,0.185") + clipped});
    wedge.create();
    const auto &points = wedge.points;
    EXPECT_NEAR(wedge.sum(points.reference_volume), 0.5 * 3.7 * 0.185, 1e-3);
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto distance =
            wedge.get(points.position, p) - wedge.get(points.position, q);
          if (distance.norm() < 0.75)
            {
              EXPECT_GT(points.data(points.reference_volume)[p],
                        0.15 * points.data(points.reference_volume)[q]);
            }
        }
  }



  // A slope without end fills the mesh below it.
  TEST(ClippedBodies, EndAtTheMesh)
  {
    EXPECT_NEAR(clipped_volume<2>("set Shape = half-plane\nset Point = 0, 1\n"
                                  "set Normal = -0.5, 1\n"),
                4. * 2.,
                1e-12);
    EXPECT_NEAR(clipped_volume<3>(polygon("-1,1; 2,1; 4,3") +
                                  "set Open = true\n"),
                4. * (2. + 2. * 2.),
                1e-2);
  }



  /// Returns what is to be said of it.
  template <int dim>
  std::string
  fill_down_to(const Shape<dim> &solid, WithBodies<dim> &all)
  {
    std::string notes;
    for (unsigned int b = 0; b < all.bodies.size(); ++b)
      notes += all.bodies[b]
                 ->create_points(all.grid, b, density, all.points, {&solid})
                 .sentence;

    return notes;
  }



  TEST(Bodies, AreFilledDownToObstacles)
  {
    const HalfSpace<2> bed(Point<2>(0., 0.5), Point<2>(-0.25, 1.));
    WithBodies<2>      all({box("0, 0", "4, 2") + clipped});
    EXPECT_EQ(
      fill_down_to(bed, all),
      "The obstacles take 4 m^2 of the body '0', 50 % of the body: no soil "
      "is put into obstacles.");
    EXPECT_NEAR(all.sum(all.points.reference_volume), 4. * (2. - 1.), 1e-12);
    for (unsigned int p = 0; p < all.points.size(); ++p)
      EXPECT_GT(bed.signed_distance(Point<2>(all.get(all.points.position, p))),
                0.);

    WithBodies<2>     by_centres({box("0, 0", "4, 2") + centres});
    const std::string note = fill_down_to(bed, by_centres);
    EXPECT_NE(note.find(
                text("take ",
                     8. - by_centres.sum(by_centres.points.reference_volume),
                     " m^2")),
              std::string::npos)
      << note;
    for (unsigned int p = 0; p < by_centres.points.size(); ++p)
      EXPECT_GE(bed.signed_distance(
                  Point<2>(by_centres.get(by_centres.points.position, p))),
                0.);
    EXPECT_NEAR(by_centres.sum(by_centres.points.reference_volume), 4., 0.5);

    WithBodies<2> whole(
      {box("0, 0", "4, 2") + "set Cut by obstacles = false\n"});
    const std::string said =
      message_of<ExcUser>([&] { fill_down_to(bed, whole); });
    EXPECT_TRUE(contains(said,
                         "m inside of an obstacle. Set 'Bodies/0/Cut by "
                         "obstacles' = true"))
      << said;
    WithBodies<2> buried({box("3, 0", "4, 1") + clipped});
    EXPECT_TRUE(
      contains(message_of<ExcUser>([&] { fill_down_to(bed, buried); }),
               "no part of its shape was found outside of the obstacles"));
  }



  /// The surface 'bed', and expressions without names.
  struct Bed : SurfaceSource<2>
  {
    std::shared_ptr<const Surface<2>>
    surface(const std::string &path,
            const std::string &expression) const override
    {
      using Named = ExpressionSurface<2>::Named;
      return expression == "bed"
               ? bed
               : std::make_shared<ExpressionSurface<2>>(path,
                                                        expression,
                                                        constants,
                                                        std::vector<Named>());
    }

    const Point<3> &
    origin() const override
    {
      return place;
    }

    std::vector<Point<2>>
    section(const std::string & /*path*/) const override
    {
      return {};
    }

    std::vector<Point<2>>
    read_route(const std::string & /*path*/,
               const std::string & /*file*/) const override
    {
      return {};
    }

    const Constants                         constants;
    const std::shared_ptr<const Surface<2>> bed =
      surface("'bed'", "1 + 0.3*sin(3*x)");
    const Point<3> place;
  };



  // Cut once more by the terrain on which the layer lies, the layer would lose
  // what the planes of a box lack of the curved surface.
  TEST(ClippedBodies, LayersLieOnTheirTerrain)
  {
    const std::string layer = "set Shape = layer\nset Upper surface = 3\n"
                              "set Lower surface = bed\n" +
                              clipped;
    WithBodies<2> alone({layer}), on_bed({layer}), below({layer});
    const Bed     surfaces;
    for (auto *all : {&alone, &on_bed, &below})
      all->bodies[0]->use_surfaces(surfaces);
    alone.create();
    using Side = SideOfSurface<2>::Side;
    EXPECT_EQ(fill_down_to(SideOfSurface<2>(surfaces.bed, Side::below), on_bed),
              "");
    ASSERT_EQ(on_bed.points.size(), alone.points.size());
    for (unsigned int p = 0; p < alone.points.size(); ++p)
      for (unsigned int array = 0; array < alone.points.n_arrays(); ++array)
        EXPECT_EQ(on_bed.points.data(array)[p], alone.points.data(array)[p]);
    EXPECT_TRUE(
      contains(message_of<ExcUser>([&] {
                 fill_down_to(SideOfSurface<2>(surfaces.bed, Side::above),
                              below);
               }),
               "no part of its shape was found outside"));
  }



  // Where both surfaces of a layer go on as one there is no soil.
  TEST(BoxesWithSoil, CoverALens)
  {
    const Bed surfaces;
    using Side                  = SideOfSurface<2>::Side;
    const std::string      line = "2 + 0.1*x";
    Region<2>              region;
    const SideOfSurface<2> top(surfaces.surface("", line), Side::below);
    const SideOfSurface<2> bottom(
      surfaces.surface("", line + " - 0.5*max(0, 1 - (x - 2)^2)"), Side::above);
    region.restrict_to(top);
    region.restrict_to(bottom);
    const auto boxes =
      boxes_with_soil(region, {Point<2>(0., 0.), Point<2>(4., 4.)}, 0.3);
    for (double x = 0.01; x < 4.; x += 0.02)
      for (double y = 0.01; y < 4.; y += 0.02)
        {
          const bool is_covered =
            std::any_of(boxes.begin(), boxes.end(), [=](const Box<2> &box) {
              return box.contains(Point<2>(x, y));
            });
          EXPECT_TRUE(is_covered ||
                      region.signed_distance(Point<2>(x, y)) >= 0.)
            << x << ", " << y;
        }
    for (const Box<2> &box : boxes)
      {
        EXPECT_LE(box.length(0), 0.3);
        EXPECT_LE(box.length(1), 0.3);
        EXPECT_GT(box.upper[0], 1.);
        EXPECT_LT(box.lower[0], 3.);
        EXPECT_GT(box.upper[1], 1.6);
        EXPECT_LT(box.lower[1], 2.3);
      }
  }



  // Bodies side by side that share cut boxes: their points do not disturb each
  // other, and their volumes add up.
  TEST(ClippedBodies, ShareTheirBoxes)
  {
    const std::string ring = "set Shape = ball\nset Centre = 2, 2\n"
                             "set Radius = 1.9\nset Inner radius = 1.1\n",
                      disc = "set Shape = ball\nset Centre = 2, 2\n"
                             "set Radius = 1.1\n";
    for (const bool ring_first : {true, false})
      {
        WithBodies<2> all({(ring_first ? ring : disc) + clipped,
                           (ring_first ? disc : ring) + clipped});
        all.create();
        EXPECT_NEAR(all.sum(all.points.reference_volume),
                    dealii::numbers::PI * 1.9 * 1.9,
                    2e-3 * 11.);
      }
    EXPECT_TRUE(contains(error<2>({ring + clipped,
                                   "set Shape = ball\nset Centre = 2, 2\n"
                                   "set Radius = 1.5\n" +
                                     clipped}),
                         "Bodies must not overlap"));
  }
} // namespace

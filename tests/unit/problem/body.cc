// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies filled with points.

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
        EXPECT_EQ(all.get(points.reference_length, p), Point<2>(0.5, 0.5));
        EXPECT_EQ(all.get(points.stretch, p), Point<2>(1., 1.));
        EXPECT_EQ(all.get(points.creation_stretch, p), Point<2>(1., 1.));
        EXPECT_EQ(determinant(all.deformation(p)), 1.);
        EXPECT_EQ(trace(all.deformation(p)), 2.);
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
    EXPECT_EQ(all.get(points.reference_length, 7), Point<3>(0.5, 1. / 3., 1.));
  }



  // On n points per axis of the legs, n (n + 1)/2 lie below the hypotenuse or on
  // it.
  TEST(Bodies, PointsOnTheEdgeBelongToIt)
  {
    WithBodies<2> all({polygon("0,0; 4,0; 0,4")});
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



  // The boxes of the points that do not agree with the disc lie within half a
  // diagonal of its edge.
  TEST(Bodies, DiscAndRing)
  {
    constexpr double pi   = dealii::numbers::PI;
    const auto       area = [](const std::string &inner) {
      WithBodies<2> all({"set Shape = ball\nset Centre = 2, 2\n"
                               "set Radius = 1.5\nset Inner radius = " +
                         inner + "\nset Points per cell and axis = 16"});
      all.create();
      return all.sum(all.points.reference_volume);
    };
    const double band = 2. * pi * std::sqrt(2.) / 16.;
    EXPECT_NEAR(area("0"), pi * 2.25, 1.5 * band);
    EXPECT_NEAR(area("1"), pi * 1.25, 2.5 * band);
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
    expect(error<2>({box("0.1, 0.1", "0.2, 0.2")}), "got no points");
    expect(error<2>({box("2, 0", "1, 1")}), "must lie above");
    expect(error<3>({box("0, 0, 0", "1, 1, 1") +
                     "set Points per cell and axis = 2, 3"}),
           "lists 2 numbers; give one, or one for each of the 3 axes");
    expect(error<2>({polygon("0,0; 1,0; up")}), "contains 'up'");
    expect(error<2>(
             {"set Shape = ball\nset Radius = 1\nset Inner radius = 1\n"}),
           "leaves nothing of the ball");
    // Neighbours that share a face do not overlap.
    EXPECT_EQ(error<2>({box("0, 0", "2, 2"), box("2, 0", "3, 2")}), "");
  }
} // namespace

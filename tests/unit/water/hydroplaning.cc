// SPDX-License-Identifier: LGPL-2.1-or-later
// Rule of hydroplaning: a layer 1 m thick from x = 2 to 4 m moves as a whole;
// its submerged density is 0.8 times the density of the water.

#include "whole_problem.h"

#include <talus/grid/node_places.h>

#include <gtest/gtest.h>

#include <cmath>

namespace hydroplaning_test
{
  constexpr double factor = 0.3, distance = 0.75, froude = 0.5;

  struct NoObserver
  {};



  struct MovingLayer : WholeProblem<NoObserver>
  {
    explicit MovingLayer(const std::string &more = "")
      : WholeProblem<NoObserver>(
          "",
          in_section(
            "Boundaries",
            "set Bottom = seabed\n" +
              in_section(
                "Seabed",
                "set Maximum shear stress = 2000\n" +
                  in_section("Hydroplaning",
                             talus::text("set Factor = ",
                                         factor,
                                         "\nset Distance from the nose = ",
                                         distance,
                                         "\nset Densimetric Froude number = ",
                                         froude)))) +
            more)
    {
      constants.gravity = problem.loading.gravity();
    }

    void
    move(const double from, const double to, const double u)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        if (const double x = points.data(points.position, 0)[p];
            x > from && x < to)
          points.data(points.velocity, 0)[p] = u;
    }

    /// Expect the cap to be reduced from @p lower to @p upper, m, and nowhere
    /// else.
    void
    expect_reduced(const double lower, const double upper)
    {
      problem.hydroplaning.begin_step(*this);
      const auto  &nodes = problem.contact.face_nodes();
      unsigned int n     = 0;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (nodes[i].face == 2)
          {
            ++n;
            const double x = nodes[i].x[0];
            EXPECT_DOUBLE_EQ(nodes.maximum_shear_stress(i),
                             (x >= lower && x <= upper ? factor : 1.) * 2000.)
              << x;
          }
      EXPECT_EQ(n, 17u);
    }
  };



  // Speed at the Froude number of the rule, m/s.
  const double limiting_speed = froude * std::sqrt(0.8 * 9.81 * 1.);



  // Nodes are 0.5 m apart: at 0 and 0.5 m from the nose the rule acts.
  TEST(Hydroplaning, ReducesTheCapBelowTheNose)
  {
    MovingLayer layer;
    layer.expect_reduced(1., 0.); // at rest: nowhere
    for (const double direction : {1., -1.})
      {
        layer.move(0., 8., 0.999 * direction * limiting_speed);
        layer.expect_reduced(1., 0.);
        layer.move(0., 8., 1.001 * direction * limiting_speed);
        if (direction > 0)
          layer.expect_reduced(3.5, 4.);
        else
          layer.expect_reduced(2., 2.5);
      }
  }



  // The Froude number is that of the soil above the node, and the nose is ahead
  // of the soil, wherever the rest moves.
  TEST(Hydroplaning, IsLocal)
  {
    MovingLayer layer;
    layer.move(0., 8., 1.001 * limiting_speed);
    layer.move(3.5, 8., 0.5 * limiting_speed);
    layer.expect_reduced(1., 0.);
    MovingLayer parted; // both ends are noses
    parted.move(0., 3., -1.001 * limiting_speed);
    parted.move(3., 8., 1.001 * limiting_speed);
    parted.problem.hydroplaning.begin_step(parted);
    const auto places = talus::places_of_owned_nodes(parted.grid);
    for (unsigned int node = 0; node < parted.grid.n_owned_nodes(); ++node)
      if (parted.grid.faces_of_node(node) & (1u << 2))
        {
          const double x = places[node][0];
          EXPECT_EQ(parted.problem.hydroplaning.acts_at(node),
                    (x >= 2. && x <= 2.5) || (x >= 3.5 && x <= 4.))
            << x;
        }
  }



  // Half as thick, the layer is faster by the Froude number.
  TEST(Hydroplaning, DependsOnTheThickness)
  {
    MovingLayer layer;
    layer.move(0., 8., 0.75 * limiting_speed);
    layer.expect_reduced(1., 0.);
    for (unsigned int p = 0; p < layer.points.size(); ++p)
      layer.points.data(layer.points.box_length, 1)[p] *= 0.5;
    for (unsigned int p = 0; p < layer.points.size(); ++p)
      layer.points.data(layer.points.mass)[p] *= 0.5;
    layer.expect_reduced(3.5, 4.);
  }
} // namespace hydroplaning_test

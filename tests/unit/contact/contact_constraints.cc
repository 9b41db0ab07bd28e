// SPDX-License-Identifier: LGPL-2.1-or-later
// Constraints of facets, on soil whose nodal masses follow by hand.

#include "soil_on_bed.h"
#include "suites.h"

namespace contact_constraints_test
{
  TALUS_ALSO_ON_RANKS(ContactConstraints, 2, 3);

  /// Call action(constraint, facet, x) for the loaded facets of this rank, with
  /// the lower end x of the cell, m. Returns their number on all ranks.
  template <int dim, typename Action>
  unsigned int
  for_each_loaded(const SoilOnBed<dim> &soil, const Action &action)
  {
    for (const unsigned int f : soil.constraints.loaded())
      {
        const ContactFacet<dim> &facet = soil.facets.owned()[f];
        action(soil.constraints[f],
               facet,
               soil.grid.cells()[facet.cell].lower[0]);
      }
    const unsigned int n = soil.constraints.loaded().size();
    return MPI::sum(n, soil.grid.communicator());
  }



  /// Where the cells above the bed are full, each facet moves the half cell of
  /// soil above.
  template <int dim>
  void
  expect_full_cells()
  {
    SoilOnBed<dim> soil;
    soil.fill_boxes({0., 2.}, {6., 4.});
    soil.move({});
    soil.find_constraints();
    const unsigned int n = for_each_loaded(
      soil,
      [&](const auto &constraint, const ContactFacet<dim> &facet, double) {
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          EXPECT_NEAR(constraint.share[v], facet.shape_value[v], 1e-13);
        EXPECT_NEAR(constraint.mass, soil.half_cell, 1e-9);
        EXPECT_NEAR(constraint.normal_mass, soil.half_cell, 1e-9);
        EXPECT_EQ(constraint.gap, 0.);
        EXPECT_NEAR(constraint.area, 1., 1e-12);
        EXPECT_EQ(constraint.averaging_weight, 1.);
      });
    EXPECT_EQ(n, dim == 2 ? 6u : 12u);
  }
} // namespace contact_constraints_test



TEST(ContactConstraints, FullCells)
{
  contact_constraints_test::expect_full_cells<2>();
  contact_constraints_test::expect_full_cells<3>();
}



// The node at the end of the soil, x = 3 m, has half the volume fraction and
// half the weight; 187.5 kg of soil for each of its two facets.
TEST(ContactConstraints, EndOfTheSoil)
{
  SoilOnBed<2> soil;
  soil.fill_boxes({0., 2.}, {3., 4.});
  soil.move({});
  soil.find_constraints();
  const unsigned int n = contact_constraints_test::for_each_loaded(
    soil, [&](const auto &constraint, const ContactFacet<2> &, const double x) {
      const std::array<double, 2> share =
        x < 1.5   ? std::array<double, 2>{{0.5, 0.5}}
        : x < 2.5 ? std::array<double, 2>{{2. / 3., 1. / 3.}}
                  : std::array<double, 2>{{1., 0.}};
      for (const unsigned int v : {0, 1})
        EXPECT_NEAR(constraint.share[v], share[v], 1e-13) << x;
      EXPECT_EQ(constraint.share[2], 0.);
      EXPECT_EQ(constraint.share[3], 0.);
      EXPECT_NEAR(constraint.mass,
                  x < 1.5   ? 750.
                  : x < 2.5 ? 562.5
                            : 187.5,
                  1e-9)
        << x;
    });
  EXPECT_EQ(n, 4u);
  for (unsigned int f = 0; f < soil.facets.owned().size(); ++f)
    if (soil.grid.cells()[soil.facets.owned()[f].cell].lower[0] > 3.5)
      {
        EXPECT_FALSE(soil.constraints[f].is_loaded);
        EXPECT_EQ(soil.constraints[f].mass, 0.);
      }
}



TEST(ContactConstraints, GapUnderTheSoil)
{
  for (const double height : {0., 0.03, 0.3})
    {
      SoilOnBed<2> soil;
      soil.fill_boxes({0., 2. + height}, {6., 3.5 + height});
      soil.move({});
      soil.find_constraints();
      const unsigned int n = contact_constraints_test::for_each_loaded(
        soil, [&](const auto &constraint, const auto &, double) {
          EXPECT_NEAR(constraint.gap, std::max(0., height - 0.05), 1e-14);
        });
      EXPECT_EQ(n, 6u);
    }
}



// All nodes of a mesh one cell wide lie on walls. Walls that hold x leave 0.64
// of a normal (0.6, 0.8), so the soil resists along the normal with 1/0.64 of
// its mass; walls that hold all leave nothing.
TEST(ContactConstraints, WallsHoldPartOfTheNormal)
{
  for (const std::string wall : {"free", "roller", "fixed"})
    {
      SCOPED_TRACE(wall);
      SoilOnBed<2> soil("set Point = 0.5, 2\nset Normal = 0.6, 0.8",
                        "set Left = " + wall + "\nset Right = " + wall,
                        mesh("0, 0", "1, 4"));
      soil.fill_boxes({0., 2.5}, {1., 4.});
      soil.move({});
      soil.find_constraints();
      const unsigned int n = contact_constraints_test::for_each_loaded(
        soil, [&](const auto &constraint, const auto &, double) {
          EXPECT_GT(constraint.mass, 0.);
          EXPECT_NEAR(constraint.normal_mass,
                      wall == "free"     ? constraint.mass
                      : wall == "roller" ? constraint.mass / 0.64
                                         : 0.,
                      1e-6 * constraint.mass);
        });
      EXPECT_GT(n, 0u);
    }
}



TEST(ContactConstraints, FrictionOfCoulombWithACap)
{
  SoilOnBed<2> soil(
    "set Friction coefficient = 0.25\nset Maximum shear stress = 1000");
  soil.fill_boxes({0., 2.}, {6., 4.});
  soil.move({});
  soil.find_constraints();
  const double dt = 0.01;
  for (const unsigned int f : soil.constraints.loaded())
    {
      // At most 1000 Pa on 1 m^2: 10 N s in the step.
      for (const auto &[normal, limit] :
           {std::pair(0., 0.), {8., 2.}, {39., 9.75}, {41., 10.}, {1e6, 10.}})
        {
          EXPECT_NEAR(dt * soil.constraints.limit(f).force(normal / dt),
                      limit,
                      1e-12);
          EXPECT_NEAR(soil.constraints.friction_impulse(f, 9., normal, dt),
                      std::min(9., limit),
                      1e-12);
        }
    }
}



// Slip of 0.02 m in the step; none where the obstacle moves with the soil.
TEST(ContactConstraints, MemoryFollowsTheSlip)
{
  for (const bool moves_along : {false, true})
    {
      SoilOnBed<2> soil(moves_along ? "set Velocity = 2; 0" : "");
      soil.time_step = 0.01;
      soil.fill_boxes({0., 2.}, {6., 4.});
      soil.move(Point<2>(2., -5.));
      soil.find_constraints(/*has_memory=*/true);
      const unsigned int n = contact_constraints_test::for_each_loaded(
        soil, [&](const auto &constraint, const auto &, double) {
          EXPECT_NEAR(constraint.averaging_weight,
                      1. / 32. + (moves_along ? 0. : 0.02 / 0.05),
                      1e-13);
        });
      EXPECT_EQ(n, 6u);
      for (const unsigned int f : soil.constraints.loaded())
        EXPECT_LT((soil.constraints.velocity(f) - Point<2>(2., -5.)).norm(),
                  1e-13);
    }
}



TEST(ContactConstraints, SoilWhereCellsDifferInSizeIsRefused)
{
  SoilOnBed<2> soil;
  soil.refine([](const Point<2> &x) { return x[0] < 2. && x[1] < 2.; });
  soil.prepare_contact();
  soil.fill_boxes({0., 2.}, {2., 3.});
  soil.move({});
  const std::string message =
    message_of<ExcPoint>([&]() { soil.find_constraints(); });
  if (soil.points.size() > 0)
    EXPECT_TRUE(contains(message, "surface of the obstacle 'bed'") &&
                contains(message, "where cells of different size meet"))
      << message;
}

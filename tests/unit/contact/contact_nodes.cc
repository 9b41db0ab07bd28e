// SPDX-License-Identifier: LGPL-2.1-or-later
#include "soil_on_bed.h"
#include "suites.h"

namespace contact_nodes_test
{
  TALUS_ALSO_ON_RANKS(ContactNodes, 2, 3);

  /// Soil from x = 0 to 3 m fills the cells above the bed. The node row on the
  /// bed has half of the volume, a node at the end of the soil half of it.
  template <int dim>
  void
  expect_loads()
  {
    SoilOnBed<dim> soil;
    soil.fill_boxes({0., 2.}, {3., 4.});
    soil.time_step = 0.1;
    soil.move(vector_xy<dim>(2., -1.));
    soil.find_constraints();
    unsigned int n_nodes = 0;
    soil.for_each_node_of_facets([&](const unsigned int node,
                                     const Point<dim>  &x) {
      ++n_nodes;
      const double fill = x[0] < 2.5 ? 1. : x[0] < 3.5 ? 0.5 : 0.;
      EXPECT_NEAR(soil.soil_at_places.volume_fraction(node), fill, 1e-13) << x;
      if (fill == 0.)
        {
          EXPECT_EQ(soil.contact_nodes.inverse_mass(node), 0.) << x;
          EXPECT_EQ(soil.contact_nodes.velocity(node).norm(), 0.) << x;
          return;
        }
      // Cells around the node above the bed, of which each has one facet.
      double n_facets = 1., n_cells = (x[1] < 2.5 ? 0.5 : 1.);
      for (unsigned int d = 0; d < dim; d += 2)
        {
          const bool is_end = x[d] < 0.5 || (d == 2 && x[d] > 1.5);
          n_facets *= is_end ? 1. : 2.;
          n_cells *= is_end ? 0.5 : 1.;
        }
      EXPECT_NEAR(soil.contact_nodes.inverse_mass(node),
                  n_facets / (fill * n_cells * soil.density),
                  1e-14)
        << x;
      EXPECT_LT(
        (soil.contact_nodes.velocity(node) - vector_xy<dim>(2., -1.)).norm(),
        1e-12)
        << x;
    });
    EXPECT_EQ(MPI::sum(n_nodes, soil.grid.communicator()),
              dim == 2 ? 6u * 4u : 12u * 8u);
  }
} // namespace contact_nodes_test



TEST(ContactNodes, VolumeFractionMassAndVelocity)
{
  contact_nodes_test::expect_loads<2>();
  contact_nodes_test::expect_loads<3>();
}



// Each of the facets around an inner node, on any rank, passes half of the
// impulse (1, 2) N s: together (1, 2) N s on 750 kg.
TEST(ContactNodes, ImpulsesOfAllRanksChangeVelocities)
{
  SoilOnBed<2> soil;
  soil.fill_boxes({0., 2.}, {6., 4.});
  soil.move({});
  soil.find_constraints();
  for (const ContactFacet<2> &facet : soil.facets.owned())
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      soil.contact_nodes.add_impulse(facet.node[v],
                                     facet.shape_value[v] * Point<2>(1., 2.));
  for (unsigned int i = 0; i < 2; ++i)
    {
      // The second call has no impulses to apply.
      soil.contact_nodes.update_velocities();
      soil.for_each_node_of_facets([&](const unsigned int node,
                                       const Point<2>    &x) {
        const Tensor<1, 2> expected =
          x[1] < 2.5 ? Point<2>(1., 2.) / soil.half_cell : Point<2>();
        EXPECT_LT((soil.contact_nodes.velocity(node) - expected).norm(), 1e-15)
          << x;
      });
    }
  soil.contact_nodes.write(soil);
  double momentum = 0;
  for (const unsigned int node : soil.nodes.active_nodes())
    momentum += soil.nodes.mass(node) * soil.nodes.velocity(node)[1];
  EXPECT_NEAR(MPI::sum(momentum, soil.grid.communicator()), 12., 1e-12);
}



// At the roller x = 0 no impulse changes the velocity along x: the wall bears
// the component, which is in the account of the walls' impulses.
TEST(ContactNodes, WallsHoldTheirComponents)
{
  SoilOnBed<2> soil("", "set Left = roller\n");
  soil.fill_boxes({0., 2.}, {6., 4.});
  soil.move(Point<2>(-3., 0.));
  soil.find_constraints();
  const auto of_walls = [&]() {
    return MPI::sum(soil.accounts.impulse("wall impulse")[0],
                    soil.grid.communicator());
  };
  // Nodes of the facet in the corner: a quarter and half a cell of soil stop.
  EXPECT_NEAR(of_walls(), 3. * soil.density * 0.75, 1e-9);
  soil.for_each_node_of_facets([&](const unsigned int node, const Point<2> &x) {
    EXPECT_EQ(soil.contact_nodes.is_held(node, 0), x[0] < 0.5) << x;
    EXPECT_FALSE(soil.contact_nodes.is_held(node, 1)) << x;
  });
  for (const ContactFacet<2> &facet : soil.facets.owned())
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      soil.contact_nodes.add_impulse(facet.node[v],
                                     facet.shape_value[v] * Point<2>(10., 20.));
  soil.contact_nodes.update_velocities();
  soil.for_each_node_of_facets([&](const unsigned int node, const Point<2> &x) {
    Tensor<1, 2> expected;
    if (x[1] < 2.5)
      expected = Point<2>(10., 20.) / soil.half_cell;
    expected[0] = x[0] < 0.5 ? 0. : expected[0] - 3.;
    EXPECT_LT((soil.contact_nodes.velocity(node) - expected).norm(), 1e-13)
      << x;
  });
  soil.contact_nodes.record_walls(soil, soil.boundaries);
  // Half of the impulse of the facet in the corner pulls the soil off the wall.
  EXPECT_NEAR(of_walls(), 3. * soil.density * 0.75 - 5., 1e-9);
}

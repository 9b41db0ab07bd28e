// SPDX-License-Identifier: LGPL-2.1-or-later
// Facets after changes of the mesh, and cells in which all surfaces are hidden.

#include <talus/contact/facets.h>
#include <talus/contact/nodal_gaps.h>

#include "obstacles_setup.h"
#include "ranks_setup.h"

namespace facet_numbers_test
{
  /// A bed on faces of the mesh: the cells below have a hidden surface only.
  struct BedOnFaces : Core<2>, WithObstacles<2>
  {
    BedOnFaces()
      : Core<2>(mesh("0, 0", "8, 4"), {}, MPI_COMM_SELF)
      , WithObstacles<2>(
          {{"bed", "Shape = half-plane|Point = 0, 2|Normal = 0, 1"}})
    {
      facets.prepare(grid, obstacles);
    }

    Facets<2> facets;
  };
} // namespace facet_numbers_test



// Refined cells in the corner shift the numbers of all later cells and nodes.
TEST(FacetNumbers, AllSurfacesOfACellNameTheCell)
{
  using namespace facet_numbers_test;
  BedOnFaces bed;
  for (const bool is_refined : {false, true})
    {
      if (is_refined)
        {
          bed.refine([](const Point<2> &x) { return x.norm() < 1.; });
          bed.facets.prepare(bed.grid, bed.obstacles);
        }
      unsigned int n_surfaces = 0;
      for (unsigned int c = 0; c < bed.grid.n_owned_cells(); ++c)
        bed.facets.for_each_in_cell(c, [&](const ContactFacet<2> &facet) {
          ++n_surfaces;
          EXPECT_EQ(facet.cell, c);
          EXPECT_EQ(facet.key, bed.grid.key_of_cell(c));
          EXPECT_EQ(facet.node, bed.grid.cells()[c].nodes());
        });
      EXPECT_EQ(n_surfaces, 16u); // above and below
    }
}



// Soil that has dipped into a cell with a hidden surface closes the gap at the
// nodes around, as soil in all other cells does.
TEST(FacetNumbers, SoilInCellsWithHiddenSurfacesClosesGaps)
{
  using namespace facet_numbers_test;
  BedOnFaces bed;
  bed.constants.box_shape = bed.transfer.box_shape();
  bed.add(Point<2>(3.5, 2.6), Point<2>(0.5, 0.5));
  bed.add(Point<2>(3.5, 1.9), Point<2>(0.5, 0.5));
  bed.sort();
  bed.scatter();
  for (const Segment &segment : bed.points.segments())
    EXPECT_TRUE(bed.facets.is_near(segment.cell));
  NodalGaps<2> gaps;
  gaps.prepare(bed.grid,
               {[](const Point<2> &x, const Tensor<1, 2> &half) {
                 return x[1] - half[1] - 2.;
               }},
               {0},
               [](const Point<2> &, double) {
                 return std::vector<unsigned int>{0};
               });
  gaps.find(bed,
            bed.facets.nodes_and_obstacles(),
            bed.facets.nearness_of_cells());
  const unsigned int c = bed.grid.find_cell(Point<2>(3.5, 2.6));
  for (const unsigned int v : {0, 1})
    EXPECT_EQ(gaps.room(bed.grid.cells()[c].nodes()[v], 0, 1.), 0.);
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Gaps between soil and surfaces, compared with a search over all boxes.

#include <talus/contact/facets.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/grid/node_places.h>

#include "obstacles_setup.h"
#include "ranks_setup.h"
#include "suites.h"

namespace nodal_gaps_test
{
  TALUS_ALSO_ON_RANKS(NodalGaps, 2, 3);

  constexpr double dead_band = 0.05; // cells, doc/method.md

  /// Plane through @p foot with the unit @p normal out of the surface.
  template <int dim>
  struct Plane
  {
    Point<dim>     foot;
    Tensor<1, dim> normal;

    double
    operator()(const Point<dim> &x, const Tensor<1, dim> &half) const
    {
      double support = 0;
      for (unsigned int d = 0; d < dim; ++d)
        support += half[d] * std::abs(normal[d]);
      return (x - foot) * normal - support;
    }
  };



  /// Number of a node that does not depend on the ranks: the position in
  /// sixty-fourths of a metre.
  template <int dim>
  using PlaceOfNode = std::array<long, dim>;

  template <int dim>
  PlaceOfNode<dim>
  place_of(const Point<dim> &x)
  {
    PlaceOfNode<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = std::lround(64. * x[d]);
    return place;
  }



  /// All surfaces are near every place.
  template <int dim>
  typename NodalGaps<dim>::Near
  all_near(const unsigned int n)
  {
    std::vector<unsigned int> numbers(n);
    for (unsigned int k = 0; k < n; ++k)
      numbers[k] = k;
    return [numbers](const Point<dim> &, double) { return numbers; };
  }



  /// Gaps of a cloud of boxes at all nodes, for two planes.
  template <int dim>
  struct CloudAndPlanes
  {
    /// By place of the node, for each plane, m.
    using Gaps = std::map<PlaceOfNode<dim>, std::array<double, 2>>;

    static std::array<Plane<dim>, 2>
    planes()
    {
      Plane<dim> bottom, oblique;
      bottom.foot[1]    = 0.8;
      bottom.normal[1]  = 1.;
      oblique.normal[0] = 0.6;
      oblique.normal[1] = 0.8;
      return {{bottom, oblique}};
    }

    static void
    add_points(Core<dim> &core)
    {
      core.constants.box_shape = core.transfer.box_shape();
      add_shared(core, dim == 2 ? 25 : 60, 1, [&]() { return core.place(); });
      core.sort();
      core.scatter();
    }

    /// Minimum over all boxes with a weight at the node, one by one.
    static Gaps
    search(Core<dim> &core)
    {
      add_points(core);
      const auto                   places = places_of_owned_nodes(core.grid);
      const auto                   planes = CloudAndPlanes::planes();
      std::vector<NodeWeight<dim>> weights;
      Gaps                         gaps;
      for (const Segment &segment : core.points.segments())
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            const double   h    = core.grid.cells()[segment.cell].size;
            Tensor<1, dim> half = core.get(core.points.box_length, p);
            for (unsigned int d = 0; d < dim; ++d)
              half[d] = std::clamp(0.5 * half[d], 0.1 * h, 0.5 * h);
            weights_of_point(core.points,
                             core.grid,
                             core.constants.box_shape,
                             segment.cell,
                             p,
                             weights);
            const Point<dim> x(core.get(core.points.position, p));
            for (const NodeWeight<dim> &weight : weights)
              if (weight.value > 0)
                for (unsigned int k = 0; k < 2; ++k)
                  {
                    auto &gap =
                      gaps
                        .try_emplace(place_of<dim>(places[weight.node]),
                                     std::array<double, 2>{
                                       {NodalGaps<dim>::none,
                                        NodalGaps<dim>::none}})
                        .first->second[k];
                    gap = std::min(gap, planes[k](x, half));
                  }
          }
      return gaps;
    }

    static void
    compare(Core<dim> &core, const Gaps &expected)
    {
      add_points(core);
      NodalGaps<dim> gaps;
      const auto     planes = CloudAndPlanes::planes();
      gaps.prepare(core.grid,
                   {planes.begin(), planes.end()},
                   {0, 1},
                   all_near<dim>(2));
      std::vector<NodeAndSurface> pairs;
      for (unsigned int node = 0; node < core.grid.n_nodes(); ++node)
        for (const unsigned int k : {0, 1})
          pairs.push_back({node, k});
      gaps.find(core,
                pairs,
                std::vector<unsigned char>(core.grid.cells().size(), 1));
      const auto   places     = places_of_owned_nodes(core.grid);
      const double h          = core.grid.finest_size();
      unsigned int n_compared = 0;
      for (unsigned int node = 0; node < core.grid.n_owned_nodes(); ++node)
        if (const auto at = expected.find(place_of<dim>(places[node]));
            at != expected.end() && core.nodes.mass(node) > 0)
          for (unsigned int k = 0; k < 2; ++k, ++n_compared)
            EXPECT_NEAR(gaps.room(node, k, h),
                        std::max(0., at->second[k] - dead_band * h),
                        1e-13)
              << places[node] << ", surface " << k;
      EXPECT_GT(MPI::sum(n_compared, core.grid.communicator()), 50u);
    }
  };
} // namespace nodal_gaps_test



TEST(NodalGaps, MinimumOverAllBoxes)
{
  using namespace nodal_gaps_test;
  on_all_meshes<2>("", CloudAndPlanes<2>::search, CloudAndPlanes<2>::compare);
  on_all_meshes<3>("", CloudAndPlanes<3>::search, CloudAndPlanes<3>::compare);
}



namespace nodal_gaps_test
{
  /// A box of half a metre whose lower side is @p height m above y = 1, on one
  /// rank, and the gap above the plane y = 1 at all nodes.
  struct OneBox : Core<2>
  {
    explicit OneBox(const double height)
      : Core<2>(mesh("0, 0", "4, 4"), {}, MPI_COMM_SELF)
    {
      constants.box_shape = transfer.box_shape();
      add(Point<2>(1.5, 1.25 + height), Point<2>(0.5, 0.5));
      sort();
      scatter();
      Plane<2> bed;
      bed.foot[1]   = 1.;
      bed.normal[1] = 1.;
      gaps.prepare(grid, {bed}, {0}, all_near<2>(1));
      for (unsigned int node = 0; node < grid.n_nodes(); ++node)
        pairs.push_back({node, 0});
    }

    /// Gap less dead band at the node at @p x after a search of cells with
    /// @p nearness, m.
    double
    room(const Point<2> &x, const unsigned char nearness)
    {
      gaps.find(*this,
                pairs,
                std::vector<unsigned char>(grid.cells().size(), nearness));
      const auto         places = places_of_owned_nodes(grid);
      const unsigned int node =
        std::find(places.begin(), places.end(), x) - places.begin();
      EXPECT_LT(node, places.size());
      return gaps.room(node, 0, 1.);
    }

    NodalGaps<2>                gaps;
    std::vector<NodeAndSurface> pairs;
  };
} // namespace nodal_gaps_test



TEST(NodalGaps, DeadBandOfATwentieth)
{
  using namespace nodal_gaps_test;
  for (const unsigned char nearness : {1, 2})
    {
      EXPECT_NEAR(OneBox(0.2).room({1., 1.}, nearness), 0.15, 1e-14);
      EXPECT_EQ(OneBox(0.04).room({1., 1.}, nearness), 0.);
      EXPECT_EQ(OneBox(-0.2).room({1., 1.}, nearness), 0.);
    }
  // The box reaches from x = 1.25 to 1.75, so less than a cell beyond node 3.
  EXPECT_GT(OneBox(0.).room({3., 1.}, 1), 1e6);
}



TEST(NodalGaps, CellsFarFromSurfacesAreSkipped)
{
  using namespace nodal_gaps_test;
  EXPECT_GT(OneBox(0.2).room({1., 1.}, 0), 1e6);
}



// Two walls 36 cells apart share a slot: soil at each wall meets that wall.
TEST(NodalGaps, SurfacesFarApartShareASlot)
{
  using namespace nodal_gaps_test;
  Core<2> core(mesh("0, 0", "36, 4"), {}, MPI_COMM_SELF);
  core.constants.box_shape = core.transfer.box_shape();
  core.add(Point<2>(0.75, 1.5), Point<2>(0.5, 0.5));
  core.add(Point<2>(35., 1.5), Point<2>(0.5, 0.5));
  core.sort();
  core.scatter();
  Plane<2> left, right;
  left.normal[0]  = 1.;
  right.normal[0] = -1.;
  right.foot[0]   = 36.;
  ASSERT_GT(36., NodalGaps<2>::min_distance_in_slot(1.) + 4.);
  NodalGaps<2> gaps;
  gaps.prepare(core.grid, {left, right}, {0, 0}, all_near<2>(2));
  const auto                  places = places_of_owned_nodes(core.grid);
  std::vector<NodeAndSurface> pairs;
  for (unsigned int node = 0; node < places.size(); ++node)
    if (places[node][0] <= 1.)
      pairs.push_back({node, 0});
    else if (places[node][0] >= 35.)
      pairs.push_back({node, 1});
  gaps.find(core,
            pairs,
            std::vector<unsigned char>(core.grid.cells().size(), 1));
  for (const NodeAndSurface &pair : pairs)
    if (core.nodes.mass(pair.node) > 0)
      EXPECT_NEAR(gaps.room(pair.node, pair.surface, 1.),
                  pair.surface == 0 ? 0.45 : 0.7,
                  1e-14)
        << places[pair.node];
}



// The second search must not remember the first one.
TEST(NodalGaps, SearchedAnewInEachStep)
{
  using namespace nodal_gaps_test;
  OneBox box(0.2);
  EXPECT_NEAR(box.room({1., 1.}, 1), 0.15, 1e-14);
  box.points.data(box.points.position, 1)[0] += 0.1;
  EXPECT_NEAR(box.room({1., 1.}, 1), 0.25, 1e-14);
}



// The exact surface lies 5 mm above the plane of the cell. Boxes in contact by
// more than half the dead band need no exact distance, and all others get it.
TEST(NodalGaps, PlaneOfCellSavesDistancesOfBoxesInContact)
{
  using namespace nodal_gaps_test;
  for (const double height : {-0.2, 0., 0.02, 0.03, 0.2})
    {
      OneBox   box(height);
      Plane<2> bed;
      bed.foot[1]           = 1.005;
      bed.normal[1]         = 1.;
      unsigned int n_exact  = 0;
      const auto   distance = [&](const Point<2> &x, const Tensor<1, 2> &half) {
        ++n_exact;
        return bed(x, half);
      };
      const auto plane_of_cell = [](const unsigned int) {
        return NodalGaps<2>::Plane{0, Point<2>(0., 1.), Point<2>(0., 1.)};
      };
      box.gaps.prepare(
        box.grid, {distance}, {0}, all_near<2>(1), plane_of_cell);
      EXPECT_NEAR(box.room({1., 1.}, 2),
                  std::max(0., height - 0.005 - dead_band),
                  1e-14)
        << height;
      EXPECT_EQ(n_exact, height < 0.025 ? 0u : 1u) << height;
    }
}

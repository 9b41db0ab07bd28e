// SPDX-License-Identifier: LGPL-2.1-or-later
#include "ranks_setup.h"
#include "suites.h"

#include <talus/contact/facets.h>
#include <talus/geometry/cut_box.h>

namespace
{
  TALUS_ALSO_ON_RANKS(Facets, 2, 3);

  /// The slab with obstacles, and their facets.
  template <int dim>
  struct Cut : Core<dim>
  {
    /// @p text of the section Obstacles.
    Cut(const std::vector<std::string> &names, const std::string &text)
      : Core<dim>(slab<dim>())
      , obstacles(names)
    {
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Obstacles", text));
      dealii::ParameterAcceptor::parse_all_parameters();
      obstacles.prepare(Constants());
      facets.prepare(this->grid, obstacles);
    }

    double
    area() const
    {
      double result = 0;
      for (const ContactFacet<dim> &facet : facets.owned())
        result += facet.area;
      return MPI::sum(result, this->grid.communicator());
    }

    /// Of the nodes that touch facets.
    double
    open_volume() const
    {
      double result = 0;
      for (const unsigned int node : facets.owned_nodes())
        result += facets.open_volume(node);
      return MPI::sum(result, this->grid.communicator());
    }

    Obstacles<dim> obstacles;
    Facets<dim>    facets;
  };

  const std::string ball_2d =
    "set Shape = ball\nset Centre = 3.03, 1.98\nset Radius = 1.3";
  const std::string ball_3d =
    "set Shape = ball\nset Centre = 3.03, 1.98, 1.02\nset Radius = 0.9";



  // The surface of a body has no edge, and so no vector area; that of its
  // facets, which are planes in small parts, is nearly its own.
  template <int dim>
  void
  expect_closed(const std::string &ball, const double exact, const double error)
  {
    const Cut<dim> cut({"ball"}, in_section("ball", ball));
    EXPECT_NEAR(cut.area(), exact, error * exact);
    Tensor<1, dim> sum;
    for (unsigned int c = 0; c < cut.grid.n_owned_cells(); ++c)
      {
        const Cell<dim> &cell = cut.grid.cells()[c];
        Box<dim>         box{cell.lower, cell.lower};
        for (unsigned int d = 0; d < dim; ++d)
          box.upper[d] += cell.size;
        sum += surface_in_box<dim>(box, [&](const Point<dim> &x) {
                 return cut.obstacles.signed_distance(x);
               }).vector_area;
      }
    EXPECT_LT(MPI::sum(sum, cut.grid.communicator()).norm(), 1e-12 * exact);
  }
} // namespace



TEST(Facets, SurfaceOfABallIsClosed)
{
  expect_closed<2>(ball_2d, 2 * M_PI * 1.3, 2e-3);
  // A cell is longer than the radius.
  expect_closed<3>(ball_3d, 4 * M_PI * 0.81, 2.5e-2);
}



// On a plane the facets have the plane's normal, and their contact points lie on
// it.
TEST(Facets, OfAPlaneLieOnIt)
{
  const double       angle = 17 * M_PI / 180;
  const Tensor<1, 2> normal({std::sin(angle), std::cos(angle)});
  const Cut<2>       cut(
    {"plane"},
    in_section("plane",
               "set Shape = half-plane\nset Point = 3, 2\nset Normal = " +
                 std::to_string(normal[0]) + ", " + std::to_string(normal[1])));
  for (const ContactFacet<2> &facet : cut.facets.owned())
    {
      EXPECT_LT((facet.normal - normal).norm(), 1e-6);
      EXPECT_NEAR(cut.obstacles[0].signed_distance(facet.centroid), 0., 1e-12);
      double sum = 0;
      for (const double value : facet.shape_value)
        sum += value;
      EXPECT_NEAR(sum, 1., 1e-14);
    }
  EXPECT_NEAR(cut.area(), 6. / std::cos(angle), 1e-5);
}



// A surface on the faces of cells has its facets in the cells above, once.
TEST(Facets, OfAPlaneOnTheMesh)
{
  const Cut<2> cut({"plane"},
                   in_section("plane",
                              "set Shape = half-plane\nset Point = 0, 2"));
  EXPECT_NEAR(cut.area(), 6., 1e-12);
  const double h = cut.grid.cell_size();
  for (const ContactFacet<2> &facet : cut.facets.owned())
    EXPECT_NEAR(cut.grid.cells()[facet.cell].lower[1], 2., 1e-12);
  // A row of nodes on the plane with half of their volume, one above with all.
  EXPECT_NEAR(cut.open_volume(), 6 * h * 1.5, 1e-10);
}



// What one rank sees of its nodes does not depend on what others have.
TEST(Facets, SumsAtNodesOfAllRanks)
{
  const Cut<2> cut(
    {"ball", "plane"},
    in_section("ball", ball_2d) +
      in_section(
        "plane",
        "set Shape = half-plane\nset Point = 0, 0.7\nset Normal = 0.2, 1"));
  unsigned long touches = 0;
  for (const unsigned int node : cut.facets.owned_nodes())
    touches += cut.facets.n_facets(node);
  const unsigned long n_facets =
    dealii::Utilities::MPI::sum(cut.facets.owned().size(),
                                cut.grid.communicator());
  EXPECT_EQ(dealii::Utilities::MPI::sum(touches, cut.grid.communicator()),
            4 * n_facets);
}



// Where two obstacles overlap, no contact point of one lies inside of the other.
// Facets are kept or left out as a whole, so that the area is right to a part of
// a cell at each of the two ends.
TEST(Facets, NoneInsideAnotherObstacle)
{
  const Cut<2> cut({"ball", "plane"},
                   in_section("ball", ball_2d) +
                     in_section("plane",
                                "set Shape = half-plane\nset Point = 0, 1.98"));
  for (const ContactFacet<2> &facet : cut.facets.owned())
    EXPECT_GE(cut.obstacles[1 - facet.obstacle].signed_distance(facet.centroid),
              0.);
  EXPECT_NEAR(cut.area(), M_PI * 1.3 + 6 - 2.6, cut.grid.cell_size());
}



// An obstacle that moves has, wherever it comes, the facets of one that was
// there from the start.
TEST(Facets, FollowAnObstacleThatMoves)
{
  Cut<2> moved({"ball"},
               in_section("ball", ball_2d + "\nset Velocity = 1; 0.5"));
  for (unsigned int step = 0; step < 8; ++step)
    {
      moved.obstacles.advance(0.1 * step, 0.1);
      moved.facets.update(moved.grid, moved.obstacles);
    }
  const std::vector<ContactFacet<2>> found = moved.facets.owned();
  const double                       open  = moved.open_volume();
  moved.facets.prepare(moved.grid, moved.obstacles);
  const auto &expected = moved.facets.owned();
  ASSERT_EQ(found.size(), expected.size());
  for (unsigned int i = 0; i < found.size(); ++i)
    {
      EXPECT_EQ(found[i].key, expected[i].key);
      EXPECT_EQ(found[i].area, expected[i].area);
    }
  EXPECT_EQ(open, moved.open_volume());
}

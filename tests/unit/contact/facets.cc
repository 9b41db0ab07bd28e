// SPDX-License-Identifier: LGPL-2.1-or-later
#include "ranks_setup.h"
#include "suites.h"

#include <talus/contact/contact_impulses.h>
#include <talus/contact/facets.h>
#include <talus/geometry/open_surface.h>

#include <iomanip>

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



// On a plane the facets have the plane's normal, and their contact points lie
// on it.
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



// Where two obstacles overlap, no contact point of one lies inside of the
// other, and each surface ends where it enters the other: the outline of the
// union. An arc ends in the plane under the angle asin(0.2 / 1.3).
TEST(Facets, OfABallInAPlane)
{
  const Cut<2> cut({"ball", "plane"},
                   in_section("ball", ball_2d) +
                     in_section("plane",
                                "set Shape = half-plane\nset Point = 0, 2.18"));
  for (const ContactFacet<2> &facet : cut.facets.owned())
    EXPECT_GE(cut.obstacles[1 - facet.obstacle].signed_distance(facet.centroid),
              -1e-9);
  const double arc     = 1.3 * (M_PI - 2 * std::asin(0.2 / 1.3));
  const double covered = 2 * std::sqrt(1.3 * 1.3 - 0.2 * 0.2);
  EXPECT_NEAR(cut.area(), arc + 6 - covered, 2e-3 * 2 * M_PI * 1.3);
}



namespace
{
  /// A bed at the height @p y, m, through which a box reaches from @p left to
  /// @p right, m.
  std::string
  box_in_bed(const double y, const double left, const double right)
  {
    return in_section("bed",
                      text(std::setprecision(17),
                           "set Shape = half-plane\nset Point = 0, ",
                           y)) +
           in_section("box",
                      text(std::setprecision(17),
                           "set Shape = box\nset Lower corner = ",
                           left,
                           ", -1\nset Upper corner = ",
                           right,
                           ", 10"));
  }
} // namespace



// A structure in a bed, wherever the two surfaces cut the cells: all of the bed
// beside the box, and all of the sides of the box above the bed.
TEST(Facets, OfABoxInABed)
{
  for (const double shift : {0., 0.13, 0.5, 0.77})
    for (unsigned int i = 0; i <= 100; i += (shift == 0. ? 1 : 9))
      {
        const double y    = 1 + 0.01 * i;
        const double left = 2 + shift, right = left + 1.6;
        const Cut<2> cut({"bed", "box"}, box_in_bed(y, left, right));
        ASSERT_EQ(cut.grid.cell_size(), 1.);
        EXPECT_NEAR(cut.area(), 6 - 1.6 + 2 * (4 - y), 1e-6)
          << "bed at " << y << ", shift " << shift;
      }
}



TEST(Facets, OfABoxInABed3d)
{
  for (const double b : {0., 0.1, 0.5, 0.6, 0.99, 1.})
    {
      const double y = 1 + b;
      const Cut<3> cut(
        {"bed", "box"},
        in_section("bed",
                   text("set Shape = half-plane\nset Point = 0, ", y, ", 0")) +
          in_section("box",
                     "set Shape = box\nset Lower corner = 2.25, -1, 0.5\n"
                     "set Upper corner = 3.5, 10, 1.75"));
      EXPECT_NEAR(cut.area(),
                  12 - 1.25 * 1.25 + 2 * (1.25 + 1.25) * (4 - y),
                  1e-6)
        << "b = " << b;
    }
}



// The foot of a box that stands on the bed is no surface, and neither is the
// bed under it.
TEST(Facets, OfABoxOnTheBed)
{
  for (const double y : {2., 2.25, 2.5})
    {
      const Cut<2> cut({"bed", "box"},
                       in_section("bed",
                                  text("set Shape = half-plane\n"
                                       "set Point = 0, ",
                                       y)) +
                         in_section("box",
                                    text("set Shape = box\n"
                                         "set Lower corner = 2.25, ",
                                         y,
                                         "\nset Upper corner = 3.5, 10")));
      EXPECT_NEAR(cut.area(), 6 - 1.25 + 2 * (4 - y), 1e-6) << y;
      for (const ContactFacet<2> &facet : cut.facets.owned())
        EXPECT_FALSE(facet.centroid[0] > 2.2501 && facet.centroid[0] < 3.4999)
          << facet.centroid;
    }
}



// Two boxes with a common face, and two that overlap: each part of the upper
// faces, which are one plane, counts once.
TEST(Facets, OfBoxesSideBySide)
{
  for (const double left : {3., 2.75, 2.25})
    {
      const Cut<2> cut({"a", "b"},
                       in_section("a",
                                  "set Shape = box\nset Lower corner = 1, 1\n"
                                  "set Upper corner = 3, 3.25") +
                         in_section("b",
                                    text("set Shape = box\n"
                                         "set Lower corner = ",
                                         left,
                                         ", 1\nset Upper corner = 5, 3.25")));
      EXPECT_NEAR(cut.area(), 2 * (4 + 2.25), 1e-6) << left;
    }
}



namespace
{
  /// Facets in the cell that @p x lies in, on one rank.
  template <int dim>
  std::vector<ContactFacet<dim>>
  facets_at(const Cut<dim> &cut, const Point<dim> &x)
  {
    std::vector<ContactFacet<dim>> result;
    for (const ContactFacet<dim> &facet : cut.facets.owned())
      if (facet.cell == cut.grid.find_cell(x))
        result.push_back(facet);
    return result;
  }

  const std::string notched =
    in_section("wall",
               "set Shape = polygon\nset Vertices = -1, -1; 7, -1; 7, 2.5; "
               "3.5, 2.5; 3.5, 5; -1, 5");
} // namespace



// Each face of a notch holds the soil along its own normal; around an edge that
// sticks out soil may go, so that there is one facet with the mean normal.
TEST(Facets, OfANotchAndAnEdge)
{
  {
    const Cut<2> cut({"wall"}, notched);
    if (MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      {
        const auto facets = facets_at(cut, Point<2>(3.6, 2.6));
        ASSERT_EQ(facets.size(), 2u);
        for (const ContactFacet<2> &facet : facets)
          {
            EXPECT_NEAR(facet.area, 0.5, 1e-12);
            EXPECT_NEAR(std::max(facet.normal[0], facet.normal[1]), 1., 1e-12);
          }
        EXPECT_NE(facets[0].number, facets[1].number);
      }
    EXPECT_NEAR(cut.area(), 6 - 3.5 + 4 - 2.5, 1e-12);
  }
  const Cut<2> edge({"box"},
                    in_section("box",
                               "set Shape = box\nset Lower corner = 1, 1\n"
                               "set Upper corner = 3.5, 2.5"));
  if (MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    {
      const auto facets = facets_at(edge, Point<2>(3.4, 2.4));
      ASSERT_EQ(facets.size(), 1u);
      EXPECT_NEAR(facets[0].normal[0], facets[0].normal[1], 1e-12);
      EXPECT_NEAR(facets[0].area, 1., 1e-12);
    }
}



// A wall a tenth of a cell thick has both of its sides wherever it stands.
TEST(Facets, OfAThinWall)
{
  for (unsigned int i = 0; i <= 20; ++i)
    {
      const double left = 2 + 0.05 * i;
      const Cut<2> cut({"wall"},
                       in_section("wall",
                                  text("set Shape = box\nset Lower corner = ",
                                       left,
                                       ", -1\nset Upper corner = ",
                                       left + 0.1,
                                       ", 10")));
      EXPECT_NEAR(cut.area(), 8., 1e-9) << left;
      for (const ContactFacet<2> &facet : cut.facets.owned())
        EXPECT_NEAR(facet.centroid[0],
                    facet.normal[0] > 0 ? left + 0.1 : left,
                    0.005);
    }
}



// The normals of a closed surface cancel, however many facets its parts make.
TEST(Facets, OfSmallBodiesAreClosed)
{
  for (const double radius : {0.2, 0.4, 0.8})
    for (const double x : {3.0, 3.12, 3.5})
      {
        const Cut<2> cut({"ball"},
                         in_section("ball",
                                    text("set Shape = ball\nset Centre = ",
                                         x,
                                         ", 2.07\nset Radius = ",
                                         radius)));
        EXPECT_NEAR(cut.area(), 2 * M_PI * radius, 0.03 * 2 * M_PI * radius);
        Tensor<1, 2> sum;
        for (const Cell<2> &cell : cut.grid.cells())
          if (cut.grid.find_cell(cell.lower + Point<2>(1e-9, 1e-9)) <
              cut.grid.n_owned_cells())
            for (const auto &surface :
                 surfaces_by_direction<2>(surface_pieces<2>(
                   cell.box(),
                   [&](const Point<2> &y) {
                     return cut.obstacles.signed_distance(y);
                   },
                   /*is_thin=*/true)))
              {
                EXPECT_GT(surface.vector_area.norm(), 0.3 * surface.area);
                sum += surface.vector_area;
              }
        EXPECT_LT(MPI::sum(sum, cut.grid.communicator()).norm(), 1e-12);
      }
}



// Two facets of one obstacle in one cell do not mix up their impulses.
TEST(Facets, KeepTheirImpulses)
{
  const Cut<2>       cut({"wall"}, notched);
  ContactImpulses<2> given, later;
  for (ContactImpulses<2> *const impulses : {&given, &later})
    impulses->update(keys_of(cut.facets.owned()));
  for (unsigned int i = 0; i < given.size(); ++i)
    given[i] = {1. + i, Tensor<1, 2>({0.5 * i, 2.}), 3. + i, 4. + i};
  later.restore(given.rows());
  for (unsigned int i = 0; i < given.size(); ++i)
    {
      EXPECT_EQ(later[i].normal, given[i].normal);
      EXPECT_EQ(later[i].tangential[0], given[i].tangential[0]);
      EXPECT_EQ(later[i].effective_mass, given[i].effective_mass);
      EXPECT_EQ(later[i].mean_normal, given[i].mean_normal);
    }
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

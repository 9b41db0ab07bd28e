// SPDX-License-Identifier: LGPL-2.1-or-later
// Layers that the mesh cuts, and layers that end in a free face.

#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/expression_surface.h>
#include <talus/geometry/side_of_surface.h>
#include <talus/problem/layer_ends.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;

  /// Surfaces that are expressions in x (and z).
  template <int dim>
  struct Expressions : SurfaceSource<dim>
  {
    std::shared_ptr<const Surface<dim>>
    surface(const std::string &path,
            const std::string &expression) const override
    {
      return std::make_shared<ExpressionSurface<dim>>(
        path,
        expression,
        Constants(),
        std::vector<typename ExpressionSurface<dim>::Named>());
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

    const Point<3> place;
  };



  /// Layers between two surfaces, named 0, 1, ..., in a mesh.
  template <int dim>
  struct Layers : FreshParameters
  {
    /// @p entries of each layer after upper and lower surface.
    Layers(const Box<dim> &domain, const std::vector<std::string> &entries)
    {
      for (unsigned int b = 0; b < entries.size(); ++b)
        bodies.push_back(std::make_unique<Body<dim>>(std::to_string(b)));
      dealii::ParameterAcceptor::declare_all_parameters();
      for (unsigned int b = 0; b < entries.size(); ++b)
        dealii::ParameterAcceptor::prm.parse_input_from_string(in_section(
          "Bodies",
          in_section(std::to_string(b), "set Shape = layer\n" + entries[b])));
      dealii::ParameterAcceptor::parse_all_parameters();
      for (const auto &body : bodies)
        body->use_surfaces(surfaces);
      site.domain    = domain;
      site.cell_size = 1.;
      site.is_free.fill(false);
    }

    std::string
    cut() const
    {
      return check_cut_by_mesh(*bodies[0], site);
    }

    std::string
    refusal() const
    {
      return message_of<ExcUser>([this] { cut(); });
    }

    std::string
    free_end() const
    {
      return note_on_free_end(bodies, 0, site);
    }

    const Expressions<dim>     surfaces;
    typename Bodies<dim>::List bodies;
    LayerSite<dim>             site;
  };



  std::string
  between(const std::string &lower, const std::string &upper)
  {
    return "set Lower surface = " + lower + "\nset Upper surface = " + upper +
           "\n";
  }



  std::string
  corners(const std::string &lower, const std::string &upper)
  {
    return "set Lower corner = " + lower + "\nset Upper corner = " + upper +
           "\n";
  }



  const Box<2> section{Point<2>(0., -4.), Point<2>(40., 4.)};



  // 10 m thick, 4 m in the mesh.
  TEST(LayerEnds, BelowTheBottomOfTheMesh)
  {
    Layers<2> layers(section,
                     {between("-10", "0") + corners("10, 0", "30, 0")});
    EXPECT_TRUE(contains(layers.cut(), "60 % of the layer")) << layers.cut();
    EXPECT_TRUE(contains(layers.cut(), "up to 6 m from it"));
    layers.site.is_free[2] = true;
    EXPECT_TRUE(contains(layers.refusal(), "60 % of the layer"));
    EXPECT_TRUE(contains(layers.refusal(), "the face is free"));
    // An obstacle carries the soil above.
    const HalfSpace<2> ground(Point<2>(0., -2.), Point<2>(0., 1.));
    layers.site.solids = {&ground};
    EXPECT_EQ(layers.cut(), "");
    // Round-off is no part of a layer.
    Layers<2> on_bottom(section, {between("-4 - 1e-9", "0")});
    EXPECT_EQ(on_bottom.cut(), "");
  }



  TEST(LayerEnds, FillsTheMeshDownwards)
  {
    Layers<2> layers(section, {between("-1e4", "0")});
    EXPECT_EQ(layers.cut(), "");
    layers.site.is_free[2] = true;
    EXPECT_TRUE(contains(layers.refusal(), "'Grid/Lower corner'"));
  }



  /// Ground at y = 0 that is known in the mesh only, like a raster.
  struct KnownInTheMesh : Surface<2>
  {
    Value
    at(const Point<2> &x) const override
    {
      AssertThrow(is_known_at(x), ExcUser("The ground is not known here."));
      return {0., {}};
    }

    bool
    is_known_at(const Point<2> &x) const override
    {
      return x[0] >= 0. && x[0] <= 40.;
    }

    double
    largest_change(const Point<2> & /*x*/,
                   const double /*distance*/) const override
    {
      return 0.;
    }
  };



  TEST(LayerEnds, BesideTheRasterOfAnObstacle)
  {
    Layers<2> layers(section, {between("0", "1")});
    layers.site.is_free.fill(true);
    const SideOfSurface<2> ground(std::make_shared<KnownInTheMesh>(),
                                  SideOfSurface<2>::Side::below);
    layers.site.solids = {&ground};
    EXPECT_EQ(layers.cut(), "");
  }



  // A wedge with half of the volume beyond each side.
  TEST(LayerEnds, BeyondFreeSides)
  {
    for (const bool is_upper : {false, true})
      {
        const std::string top = "4*max(0, 1 - abs(x - " +
                                std::string(is_upper ? "40" : "0") + ")/10)";
        Layers<2> layers(section, {between("0", top)});
        EXPECT_EQ(layers.cut(), ""); // on a wall
        layers.site.is_free[is_upper] = true;
        EXPECT_TRUE(contains(layers.refusal(), "50 % of the layer"))
          << layers.refusal();
        EXPECT_TRUE(
          contains(layers.refusal(),
                   is_upper ? "'Grid/Upper corner'" : "'Grid/Lower corner'"));
        Layers<2> bounded(section,
                          {between("0", top) + corners("0, 0", "40, 0")});
        bounded.site.is_free[is_upper] = true;
        EXPECT_EQ(bounded.cut(), "");
      }
    Layers<3> wedge({Point<3>(0., 0., 0.), Point<3>(8., 8., 40.)},
                    {between("0", "4*max(0, 1 - abs(z - 40)/10)")});
    wedge.site.is_free[5] = true;
    EXPECT_TRUE(contains(wedge.refusal(), "'Front'")) << wedge.refusal();
    EXPECT_TRUE(contains(wedge.refusal(), "50 % of the layer"));
  }



  TEST(LayerEnds, InAFreeFace)
  {
    const std::string layer = between("-3", "0");
    EXPECT_TRUE(contains(
      Layers<2>(section, {layer + corners("0, 0", "23, 0")}).free_end(),
      "ends in a free face of 3 m at x = 23 m, inside of the mesh"));
    EXPECT_TRUE(contains(
      Layers<2>(section, {layer + corners("17, 0", "40, 0")}).free_end(),
      "free face of 3 m at x = 17 m"));
    EXPECT_EQ(Layers<2>(section, {layer + corners("0, 0", "40, 0")}).free_end(),
              "");
    // Tapered to nothing.
    EXPECT_EQ(Layers<2>(section,
                        {between("-max(0, min(3, 20 - x))", "0") +
                         corners("0, 0", "20, 0")})
                .free_end(),
              "");
    // Another body goes on.
    Layers<2> beside(section,
                     {layer + corners("0, 0", "20, 0"),
                      between("-3", "0") + corners("20, 0", "40, 0")});
    EXPECT_EQ(beside.free_end(), "");
    // An obstacle holds the face.
    Layers<2>          held(section, {layer + corners("0, 0", "20, 0")});
    const BoxRegion<2> wall({Point<2>(20., -4.), Point<2>(21., 4.)});
    held.site.solids = {&wall};
    EXPECT_EQ(held.free_end(), "");
  }



  TEST(LayerEnds, InAFreeFaceInSpace)
  {
    const Box<3> domain{Point<3>(0., -4., 0.), Point<3>(40., 4., 20.)};
    const auto   end = [&domain](const std::string &lower,
                               const std::string &upper) {
      return Layers<3>(domain, {between("-3", "0") + corners(lower, upper)})
        .free_end();
    };
    EXPECT_EQ(end("0, 0, 0", "40, 0, 20"), "");
    EXPECT_TRUE(contains(end("0, 0, 0", "30, 0, 20"), "3 m at x = 30 m"));
    EXPECT_TRUE(contains(end("10, 0, 0", "40, 0, 20"), "3 m at x = 10 m"));
    EXPECT_TRUE(contains(end("0, 0, 5", "40, 0, 20"), "z = 5 m"));
    EXPECT_TRUE(contains(end("0, 0, 0", "40, 0, 15"), "z = 15 m"));
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
// The suite works on any number of ranks; ctest runs it on 1 and 3.
#include <talus/grid/node_places.h>
#include <talus/points/points_kernel.h>

#include "equilibrium_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(WellBalancedLoad, 3);

// A namespace of its own: several files are compiled as one.
namespace well_balanced_load_test
{
  namespace
  {
    constexpr double g = 10.; ///< m/s^2

    /// Rollers at the sides, and below where there is no bed.
    std::string
    walls(const unsigned int dim, const bool has_bed)
    {
      return in_section("Boundaries",
                        std::string("set Left = roller\nset Right = roller\n") +
                          (has_bed ? "" : "set Bottom = roller\n") +
                          (dim == 3 ? "set Front = roller\nset Back = roller\n"
                                    : ""));
    }



    std::string
    bed_at(const unsigned int dim, const double height)
    {
      return in_section(
        "Obstacles",
        in_section("bed",
                   text("set Shape = half-plane\nset Point = 0, ",
                        height,
                        dim == 2 ? "" : ", 0",
                        "\nset Normal = 0, 1",
                        dim == 2 ? "" : ", 0",
                        "\nset Friction coefficient = 10\n")));
    }



    /// Level ground of elastic soil from @p bottom to @p top in a mesh of 6 m x
    /// 4 m (x 2 m) with cells of 1 m, under the pressure of its weight.
    template <int dim>
    struct LevelGround : Statics<dim>
    {
      LevelGround(const double       bottom,
                  const double       top,
                  const std::string &own,
                  const bool         has_bed,
                  const MPI_Comm     communicator = MPI_COMM_WORLD,
                  const bool         is_refined   = false)
        : Statics<dim>(slab<dim>() + walls(dim, has_bed),
                       {{"soil", "linear elastic"}},
                       material("soil", stiff) + own +
                         (has_bed ? bed_at(dim, bottom) : ""),
                       communicator,
                       has_bed ? std::vector<std::string>{"bed"}
                               : std::vector<std::string>())
        , top(top)
      {
        if (is_refined)
          {
            this->refine([](const Point<dim> &x) { return x[0] < 2.; });
            this->contact.prepare(this->grid);
          }
        Point<dim> lower, upper;
        upper[0] = 6.;
        lower[1] = bottom;
        upper[1] = top;
        if (dim == 3)
          upper[2] = 2.;
        std::array<unsigned int, dim> n;
        n.fill(4);
        n[0] = 24;
        n[1] = 7;
        this->fill(lower, upper, n);
        Tensor<1, dim> gravity;
        gravity[1] = -g;
        this->load(gravity);
        for (unsigned int p = 0; p < this->points.size(); ++p)
          {
            Stress<dim, double> sigma{};
            sigma[0] = sigma[1] = sigma[2] = -pressure(p);
            store_stress<dim, double>(this->points, p, sigma);
          }
        this->mudline = [top](const Point<dim> &) { return top; };
      }

      /// Let the facets bear the pressure of the weight from the start.
      void
      load_bed(const double height)
      {
        StaticProblem<dim> all = this->problem();
        sum_forces(all);
        this->contact.find_constraints(*this);
        std::vector<ContactImpulse<dim>> forces;
        for (const auto &constraint : this->contact.constraints().all())
          {
            const double force =
              Statics<dim>::density * g * (top - height) * constraint.area;
            forces.push_back({force, {}, constraint.mass, force});
          }
        this->contact.set_forces(forces);
      }

      double
      pressure(const unsigned int p) const
      {
        return Statics<dim>::density * g *
               (top - this->points.data(this->points.position, 1)[p]);
      }

      /// Largest difference of a stress component from the pressure, over the
      /// weight of a cell per area; over all ranks.
      double
      error() const
      {
        double result = 0.;
        for (unsigned int p = 0; p < this->points.size(); ++p)
          {
            auto sigma = load_stress<dim, double>(this->points, p);
            for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
              result =
                std::max(result,
                         std::abs(sigma[c] + (c < 3 ? pressure(p) : 0.)));
          }
        return MPI::max(result, this->grid.communicator()) /
               (Statics<dim>::density * g);
      }

      double top;
    };



    const std::string exact = in_section("Equilibrium",
                                         "set Newton tolerance = 1e-11\n"
                                         "set Allowed imbalance = 1e-9\n");
    const std::string without =
      in_section("Equilibrium", "set Well-balanced load = false\n");
  } // namespace



  // The bed bears the pressure of the weight to begin with: then this is in
  // balance with the weight wherever mudline and bed cut their cells, and no
  // point changes its stress. The weight as it is leaves shear stresses.
  TEST(WellBalancedLoad, LevelGroundIsAtRest)
  {
    for (const double top : {2.95, 2.62, 2.31})
      for (const double bottom : {0.23, 0.71})
        {
          SCOPED_TRACE(text(bottom, " to ", top));
          {
            LevelGround<2> ground(bottom, top, exact, true);
            ground.load_bed(bottom);
            ASSERT_TRUE(ground.find()) << ground.equilibrium.failure();
            EXPECT_LT(ground.error(), 1e-6);
          }
          {
            LevelGround<2> ground(bottom, top, exact + without, true);
            ground.load_bed(bottom);
            ASSERT_TRUE(ground.find()) << ground.equilibrium.failure();
            EXPECT_GT(ground.error(), 1e-3);
          }
        }
  }



  TEST(WellBalancedLoad, LevelGroundIsAtRest3d)
  {
    LevelGround<3> ground(0.37, 2.62, exact, true);
    ground.load_bed(0.37);
    ASSERT_TRUE(ground.find()) << ground.equilibrium.failure();
    EXPECT_LT(ground.error(), 1e-6);
  }



  // Without obstacles, on the bottom of the mesh.
  TEST(WellBalancedLoad, LevelGroundOnHangingNodesIsAtRest)
  {
    LevelGround<2> ground(0., 2.62, exact, false, MPI_COMM_WORLD, true);
    ASSERT_TRUE(ground.find()) << ground.equilibrium.failure();
    EXPECT_LT(ground.error(), 1e-6);
    LevelGround<3> other(0., 2.62, exact, false, MPI_COMM_WORLD, true);
    ASSERT_TRUE(other.find()) << other.equilibrium.failure();
    EXPECT_LT(other.error(), 1e-6);
  }



  namespace
  {
    /// E of an inclined mudline in a mesh with hanging nodes, as sums over all
    /// nodes that do not depend on their order.
    template <int dim>
    std::array<double, 4>
    sums_of_correction(const MPI_Comm communicator)
    {
      LevelGround<dim> ground(0., 2.62, exact, false, communicator, true);
      ground.mudline = [](const Point<dim> &x) { return 2.3 + 0.11 * x[0]; };
      StepParts<dim>     parts(ground);
      StaticProblem<dim> problem = ground.problem();
      StaticContact<dim> contact;
      contact.begin(problem, parts.unknowns, 1.);
      WellBalancedLoad<dim> load;
      load.update(problem, parts.weights, contact, parts.unknowns);
      std::vector<double> sums(3, 0.);
      for (const unsigned int node : parts.unknowns.active_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double force = load.forces()[dim * node + d];
            sums[0] += force * force;
            sums[1] += force * (1. + 0.1 * number_of_node(ground.grid, node));
            sums[2] += std::abs(force);
          }
      MPI::sum(sums, communicator, sums);
      return {{sums[0], sums[1], sums[2], 1. * load.n_nodes_without()}};
    }
  } // namespace



  TEST(WellBalancedLoad, DoesNotDependOnRanks)
  {
    const auto alone = sums_of_correction<2>(MPI_COMM_SELF);
    const auto all   = sums_of_correction<2>(MPI_COMM_WORLD);
    EXPECT_GT(alone[0], 0.);
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_NEAR(all[i], alone[i], 1e-10 * std::abs(alone[i]));
  }



  // The free faces of a block bear no pressure: E is left out beside them.
  TEST(WellBalancedLoad, LeavesFreeFacesAlone)
  {
    Statics<2> block(mesh("0, 0", "12, 6") + walls(2, false),
                     {{"soil", "linear elastic"}},
                     material("soil", stiff));
    block.fill(Point<2>(3.2, 0.), Point<2>(8.7, 4.6), {{22, 18}});
    block.load(Point<2>(0., -g));
    block.mudline = [](const Point<2> &x) {
      return x[0] >= 3.2 && x[0] <= 8.7
               ? 4.6
               : std::numeric_limits<double>::quiet_NaN();
    };
    StepParts<2>     parts(block);
    StaticProblem<2> problem = block.problem();
    StaticContact<2> contact;
    contact.begin(problem, parts.unknowns, 1.);
    WellBalancedLoad<2> load;
    load.update(problem, parts.weights, contact, parts.unknowns);
    EXPECT_GT(load.n_nodes_without(), 0u);
    const auto places = places_of_owned_nodes(block.grid);
    for (const unsigned int node : parts.unknowns.active_nodes())
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double x = places[node][0], y = places[node][1];
          if ((x < 4.5 || x > 7.5) && y < 3.5)
            {
              EXPECT_EQ(load.forces()[2 * node + d], 0.) << places[node];
            }
          // In the middle E is the error at the mudline only.
          else if (x > 5.5 && x < 6.5 && y < 3.)
            {
              EXPECT_NEAR(load.forces()[2 * node + d],
                          0.,
                          1e-9 * Statics<2>::density * g);
            }
        }
  }
} // namespace well_balanced_load_test

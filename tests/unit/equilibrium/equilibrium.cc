// SPDX-License-Identifier: LGPL-2.1-or-later
// The search for equilibrium as a whole. Rank counts: equilibrium_ranks.cc.

#include "equilibrium_setup.h"

namespace
{
  /// No residual is left but round-off.
  const std::string tight =
    in_section("Equilibrium", "set Newton tolerance = 1e-11");

  const std::string on_rock = in_section("Boundaries", "set Bottom = fixed");



  template <int dim>
  Tensor<1, dim>
  down()
  {
    Tensor<1, dim> gravity;
    gravity[1] = -9.81;
    return gravity;
  }



  /// A block of one material on rock, 3 m long, 2 m high (and 2 m wide), with a
  /// vertical face behind and in front.
  template <int dim>
  struct Bank : Statics<dim>
  {
    explicit Bank(const MaterialName &name,
                  const std::string  &entries,
                  const std::string  &own   = tight,
                  const std::string  &below = on_rock)
      : Statics<dim>(slab<dim>() + below,
                     {name},
                     material(name.name, entries) + own)
    {
      Point<dim>                    lower, upper;
      std::array<unsigned int, dim> n;
      for (unsigned int d = 0; d < dim; ++d)
        {
          upper[d] = 2.;
          n[d]     = 4;
        }
      lower[0] = 1.;
      upper[0] = 4.;
      n[0]     = 6;
      this->fill(lower, upper, n);
      this->load(down<dim>());
    }

    /// Force out of balance at free nodes as the explicit scheme sees it, over
    /// that of the weight or of the stress, whichever is larger (Euclidean
    /// norms).
    double
    imbalance()
    {
      StaticProblem<dim> problem = this->problem();
      sum_forces(problem);
      double free = 0., weight = 0., internal = 0.;
      for (const unsigned int node : this->nodes.active_nodes())
        if (const double mass = this->nodes.mass(node);
            mass > this->constants.mass_cutoff)
          {
            const Tensor<1, dim> force = this->force(node);
            const Tensor<1, dim> loads = mass * down<dim>();
            const unsigned int   walls =
              this->boundaries.components_constrained_by_walls(
                this->grid.faces_of_node(node));
            weight += loads.norm_square();
            internal += (force - loads).norm_square();
            for (unsigned int d = 0; d < dim; ++d)
              if (!(walls & (1u << d)))
                free += force[d] * force[d];
          }
      return std::sqrt(free / std::max(weight, internal));
    }

    std::vector<std::vector<double>>
    columns() const
    {
      std::vector<std::vector<double>> result;
      for (unsigned int i = 0; i < this->points.n_arrays(); ++i)
        result.emplace_back(this->points.data(i),
                            this->points.data(i) + this->points.size());
      return result;
    }
  };



  template <int dim>
  void
  expect_one_correction()
  {
    Bank<dim> bank({"block", "linear elastic"}, stiff);
    ASSERT_TRUE(bank.find()) << bank.equilibrium.failure();
    ASSERT_EQ(bank.runs.size(), 1u);
    ASSERT_EQ(bank.runs[0].size(), 2u);
    EXPECT_GT(bank.runs[0][0].residual, 0.1);
    EXPECT_EQ(bank.runs[0][0].length, 1.);
    EXPECT_LT(bank.runs[0][1].residual, 1e-12);
    EXPECT_LT(bank.imbalance(), 1e-12);
    EXPECT_EQ(bank.equilibrium.n_steps(), 1u);
    EXPECT_EQ(bank.equilibrium.load(), 1.);
    EXPECT_LT(bank.equilibrium.imbalance(), 1e-12);
    EXPECT_LT(bank.equilibrium.newton().equations().largest_imbalance().first,
              1e-7);
  }



  /// Soil as wide as the mesh, which cannot move sideways: sigma_xx is
  /// nu/(1 - nu) sigma_yy at every point, and the virtual work of u = y e_y
  /// says what the mean of sigma_yy is.
  template <int dim>
  void
  expect_stress_at_rest()
  {
    std::string walls = "set Bottom = roller\nset Left = roller\n"
                        "set Right = roller\n";
    if (dim == 3)
      walls += "set Front = roller\nset Back = roller\n";
    Statics<dim> column(slab<dim>() + in_section("Boundaries", walls),
                        {{"block", "linear elastic"}},
                        material("block", stiff) + tight);
    std::array<unsigned int, dim> n;
    n.fill(3);
    n[0]             = 12;
    Point<dim> upper = column.grid.domain().upper;
    upper[1]         = 1.5;
    column.fill(Point<dim>(), upper, n);
    column.load(down<dim>());
    ASSERT_TRUE(column.find()) << column.equilibrium.failure();
    double work = 0., weight = 0.;
    for (unsigned int p = 0; p < column.points.size(); ++p)
      {
        const auto sigma = column.stress(p);
        work += column.volume(p) * sigma[1][1];
        weight -= column.points.data(column.points.mass)[p] * 9.81 *
                  column.points.data(column.points.position, 1)[p];
        for (unsigned int d = 0; d < dim; d += 2)
          EXPECT_NEAR(sigma[d][d], 0.3 / 0.7 * sigma[1][1], 1e-7);
        EXPECT_NEAR(sigma[0][1], 0., 1e-7);
      }
    EXPECT_NEAR(work, weight, 1e-9 * std::abs(weight));
  }



  /// Pairs of residuals that follow each other by whole corrections and obey
  /// r' <= C r^2 from one that is less than 0.1 on, in the longest row of such.
  unsigned int
  quadratic_steps(const std::vector<NewtonIteration> &run, const double C)
  {
    unsigned int n = 0, most = 0;
    for (unsigned int i = 0; i + 1 < run.size(); ++i)
      {
        const double r       = run[i].residual;
        const bool   is_such = run[i].length == 1. && r < 0.1 && r > 1e-7 &&
                             run[i + 1].residual <= C * r * r + 1e-13;
        n    = is_such ? n + 1 : 0;
        most = std::max(most, n);
      }
    return most;
  }



  std::string
  residuals_of(const std::vector<NewtonIteration> &run)
  {
    std::string result;
    for (const auto &iteration : run)
      result += text(iteration.residual, " (", iteration.length, ") ");
    return result;
  }
} // namespace



TEST(EquilibriumTest, ElasticSoilTakesOneCorrection)
{
  expect_one_correction<2>();
  expect_one_correction<3>();
}



TEST(EquilibriumTest, SoilAtRestBetweenWalls)
{
  expect_stress_at_rest<2>();
  expect_stress_at_rest<3>();
}



TEST(EquilibriumTest, QuadraticConvergenceOfYieldingSoil)
{
  for (const std::string more : {"", "set Hardening modulus = 1e5\n"})
    {
      Bank<2> bank({"clay", "von Mises"},
                   stiff + "set Undrained shear strength = 8.5e3\n" + more);
      bank.transfer.use_bbar({true});
      ASSERT_TRUE(bank.find()) << bank.equilibrium.failure();
      const auto *strain = bank.points.data(bank.points.find("plastic strain"));
      unsigned int n_flowing = 0;
      for (unsigned int p = 0; p < bank.points.size(); ++p)
        n_flowing += strain[p] > 1e-4;
      EXPECT_GT(n_flowing, 2u);
      EXPECT_GE(quadratic_steps(bank.runs[0], 1e3), 2u)
        << residuals_of(bank.runs[0]);
      EXPECT_LT(bank.imbalance(), 1e-11);
    }
}



// The displacement gradient is that of one step or of the sum of several.
TEST(EquilibriumTest, LoadStepsOfElasticSoilAddUp)
{
  std::vector<std::vector<double>> at_once;
  for (const unsigned int n_steps : {1, 4})
    {
      Bank<2>             bank({"block", "linear elastic"},
                   stiff,
                   in_section("Equilibrium",
                              text("set Load steps = ", n_steps)));
      std::vector<double> loads;
      bank.equilibrium.begin(bank.equilibrium.options());
      while (!bank.equilibrium.is_balanced())
        {
          StaticProblem<2> problem = bank.problem();
          ASSERT_TRUE(bank.equilibrium.advance(problem, [](const auto &) {
            return true;
          }));
          loads.push_back(bank.equilibrium.load());
        }
      EXPECT_EQ(bank.equilibrium.n_steps(), n_steps);
      for (unsigned int i = 0; i < n_steps; ++i)
        EXPECT_NEAR(loads[i], (i + 1.) / n_steps, 1e-14);
      const auto columns = bank.columns();
      for (unsigned int c = 0; c < 4 && n_steps > 1; ++c)
        for (unsigned int p = 0; p < bank.points.size(); ++p)
          EXPECT_NEAR(columns[bank.points.stress + c][p],
                      at_once[bank.points.stress + c][p],
                      1e-6);
      at_once = columns;
    }
}



// A step that fails leaves the soil as it was, and says why.
TEST(EquilibriumTest, SoilThatCannotStand)
{
  Bank<2> bank({"clay", "von Mises"},
               stiff + "set Undrained shear strength = 3e3\n",
               in_section("Equilibrium", "set Smallest load step = 1"));
  bank.transfer.use_bbar({true});
  const auto before = bank.columns();
  EXPECT_FALSE(bank.find());
  EXPECT_FALSE(bank.equilibrium.is_balanced());
  EXPECT_EQ(bank.equilibrium.load(), 0.);
  EXPECT_TRUE(contains(bank.equilibrium.failure(), "Newton's method diverges"))
    << bank.equilibrium.failure();
  EXPECT_TRUE(contains(bank.equilibrium.failure(),
                       "the largest residual force of a node is"));
  EXPECT_EQ(bank.columns(), before);
}



// With smaller steps it is found how much of the load the soil bears: cut
// where the method fails, down to the smallest.
TEST(EquilibriumTest, StepsAreCutUntilTheSmallest)
{
  Bank<2> bank({"clay", "von Mises"},
               stiff + "set Undrained shear strength = 3e3\n",
               in_section("Equilibrium",
                          "set Smallest load step = 0.05\n"
                          "set Newton iterations = 15"));
  bank.transfer.use_bbar({true});
  EXPECT_FALSE(bank.find());
  EXPECT_GT(bank.equilibrium.load(), 0.2);
  EXPECT_LT(bank.equilibrium.load(), 0.6);
  EXPECT_GT(bank.equilibrium.n_steps(), 1u);
}



// More steps than the smallest one allows are no reason to take none.
TEST(EquilibriumTest, LoadStepsSmallerThanTheSmallest)
{
  for (const std::string law : {"linear elastic", "von Mises"})
    {
      const bool yields = (law == "von Mises");
      Bank<2>    bank({"block", law},
                   stiff +
                     (yields ? "set Undrained shear strength = 3e3\n" : ""),
                   in_section("Equilibrium",
                              "set Load steps = 40\n"
                                 "set Smallest load step = 0.1"));
      bank.transfer.use_bbar({yields});
      EXPECT_EQ(bank.find(), !yields);
      EXPECT_GE(bank.equilibrium.n_steps(), yields ? 2u : 40u);
      EXPECT_EQ(bank.equilibrium.failure().empty(), !yields);
    }
}



// What nothing holds has no equilibrium: the first error is about that.
TEST(EquilibriumTest, SoilThatNothingHolds)
{
  Bank<2> bank({"block", "linear elastic"}, stiff, tight, "");
  EXPECT_FALSE(bank.find());
  EXPECT_TRUE(contains(bank.equilibrium.failure(), "singular"))
    << bank.equilibrium.failure();
}



TEST(EquilibriumTest, SmallStrainIsNotForHyperelasticLaws)
{
  Bank<2> bank({"rubber", "Hencky"}, stiff);
  EXPECT_TRUE(contains(message_of<ExcUser>([&]() {
                         bank.equilibrium.check(bank.materials, {"seal"});
                       }),
                       "the body 'seal' follows from its deformation"));
  Bank<2> elastic({"block", "linear elastic"}, stiff);
  elastic.equilibrium.check(elastic.materials, {"block"});
}

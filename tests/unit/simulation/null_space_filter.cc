// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/shape_function_cache.h>
#include <talus/simulation/null_space_filter.h>

#include "transfer_setup.h"

namespace
{
  using namespace talus;

  /// What one pass to the grid and back makes of velocities, by the weights as
  /// they are defined.
  template <int dim>
  std::vector<Tensor<1, dim>>
  pass(const Core<dim>                   &core,
       const ShapeFunctionCache<dim>     &kept,
       const std::vector<Tensor<1, dim>> &v)
  {
    std::vector<double>         mass(core.grid.n_nodes());
    std::vector<Tensor<1, dim>> momentum(mass.size()), result(v.size());
    for (const bool back : {false, true})
      for (unsigned int c = 0; c < kept.cells().size(); ++c)
        {
          const Batch &cell  = kept.cells()[c];
          const auto   patch = kept.patch(c);
          for (unsigned int p = cell.begin; p < cell.end; ++p)
            for (unsigned int a = 0; a < patch.n_nodes; ++a)
              {
                const unsigned int node = patch.nodes[a];
                const double       m    = core.points.data(core.points.mass)[p];
                const double S = kept.of_point(c, p - cell.begin)[a].value;
                if (back)
                  result[p] += S * momentum[node] / mass[node];
                else
                  {
                    mass[node] += S * m;
                    momentum[node] += S * m * v[p];
                  }
              }
        }
    return result;
  }



  /// XPIC(4) is P v + P (v - P v) + ... of four passes P.
  template <int dim>
  void
  expect_xpic(Core<dim> &core)
  {
    core.scatter();
    Unknowns<dim> unknowns;
    unknowns.number(core.nodes, core.grid, 0.);
    ShapeFunctionCache<dim> kept;
    kept.compute(core.points, core.grid, core.transfer.box_shape(), unknowns);

    const unsigned int          n = core.points.size();
    std::vector<Tensor<1, dim>> unseen(n), expected(n);
    Tensor<1, dim>              momentum;
    double                      scale = 0.;
    for (unsigned int p = 0; p < n; ++p)
      unseen[p] = core.get(core.points.velocity, p);
    for (unsigned int i = 0; i < 4; ++i)
      {
        const auto seen = pass(core, kept, unseen);
        for (unsigned int p = 0; p < n; ++p)
          {
            expected[p] += seen[p];
            unseen[p] -= seen[p];
          }
      }
    for (unsigned int p = 0; p < n; ++p)
      {
        const double m = core.points.data(core.points.mass)[p];
        momentum -= m * core.get(core.points.velocity, p);
        scale += m * core.get(core.points.velocity, p).norm();
      }
    filter_null_space(core, Materials<dim>({}), core.transfer);
    double most_taken = 0.;
    for (unsigned int p = 0; p < n; ++p)
      {
        const Tensor<1, dim> v = core.get(core.points.velocity, p);
        EXPECT_LT((v - expected[p]).norm(), 1e-12);
        momentum += core.points.data(core.points.mass)[p] * v;
        most_taken = std::max(most_taken, unseen[p].norm());
      }
    EXPECT_GT(most_taken, 0.1);
    EXPECT_LT(momentum.norm(), 1e-13 * scale);
  }



  /// The momentum that the points lose beside a held face is in the account of
  /// the wall.
  template <int dim>
  void
  expect_momentum_of_wall(Core<dim> &core)
  {
    core.boundaries.parse(Constants());
    core.boundaries.prepare(core.grid);
    core.boundaries.open_accounts(core.accounts);
    core.constants.held_faces = core.boundaries.fixed_faces();
    core.scatter();
    const auto momentum = [&]() {
      Tensor<1, dim> sum;
      for (unsigned int p = 0; p < core.points.size(); ++p)
        sum += core.points.data(core.points.mass)[p] *
               core.get(core.points.velocity, p);
      return sum;
    };
    const Tensor<1, dim> before = momentum();
    filter_null_space(core,
                      Materials<dim>({}),
                      core.transfer,
                      &core.boundaries);
    const Tensor<1, dim> taken = core.accounts.impulse("wall impulse");
    EXPECT_GT(taken.norm(), 1e-3 * before.norm());
    EXPECT_LT((momentum() - before - taken).norm(), 1e-12 * before.norm());
  }



  /// Points with the cell mean have the mean stress of their cell; neither the
  /// deviators nor the forces of the nodes have changed.
  template <int dim>
  void
  expect_mean_stress(Core<dim> &core)
  {
    const auto before = core.scatter();
    const auto stress = [&](const unsigned int p) {
      Stress<dim, double> result;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        result[c] = core.points.data(core.points.stress, c)[p];
      return result;
    };
    const unsigned int               n = core.points.size();
    std::vector<Stress<dim, double>> old(n);
    for (unsigned int p = 0; p < n; ++p)
      old[p] = stress(p);
    filter_null_space(core, Materials<dim>({}), core.transfer);
    double largest_change = 0.;
    for (unsigned int p = 0; p < n; ++p)
      {
        const auto   now    = stress(p);
        const double change = now[0] - old[p][0];
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          EXPECT_NEAR(now[c] - old[p][c], c < 3 ? change : 0., 1e-13);
        if (core.points.data(core.points.body)[p] == 1.)
          {
            EXPECT_EQ(change, 0.);
          }
        largest_change = std::max(largest_change, std::abs(change));
      }
    EXPECT_GT(largest_change, 0.1);

    const auto after = core.scatter();
    for (unsigned int node = 0; node < before.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        EXPECT_NEAR(after[node][SumIndex<dim>::force + d],
                    before[node][SumIndex<dim>::force + d],
                    1e-11);
    core.workspace.reinit(0, n);
    core.transfer.apply_bbar_to_stress(core.points,
                                       core.workspace,
                                       core.points.all());
    for (unsigned int p = 0; p < n; ++p)
      EXPECT_NEAR(core.workspace.mean_stress_shift()[p], 0., 1e-13);
  }



  /// The total stress gets the mean of its cell: in undrained soil by the
  /// water, unless it cavitates, otherwise by the soil.
  template <int dim>
  void
  expect_mean_of_water(Core<dim> &core)
  {
    Points<dim> &points = core.points;
    points.add_pore_pressure();
    Materials<dim> materials(
      {{"silt", "Mohr-Coulomb"}, {"sand", "Mohr-Coulomb"}});
    dealii::ParameterAcceptor::declare_all_parameters();
    dealii::ParameterAcceptor::prm.parse_input_from_string(
      "subsection Materials\nsubsection silt\nsubsection Pore water\n"
      "set Drainage = undrained\nset Largest suction = 2\nset Stiffness = 9\n"
      "end\nend\nend");
    dealii::ParameterAcceptor::parse_all_parameters();
    materials.assign({"0", "1", "2"}, {"silt", "silt", "sand"});
    double *const       u = points.data(points.pore_pressure());
    std::vector<double> pressure, stress;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        u[p] = core.number(-2., 2.);
        pressure.push_back(u[p]);
        stress.push_back(points.data(points.stress, 0)[p]);
      }
    filter_null_space(core, materials, core.transfer);
    core.workspace.reinit(0, points.size());
    core.transfer.apply_bbar_to_stress(points, core.workspace, points.all());
    std::array<unsigned int, 4> count{}; // by water, both, by soil, no change
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        EXPECT_NEAR(core.workspace.mean_stress_shift()[p], -u[p], 1e-13);
        EXPECT_GE(u[p], -2.);
        const bool is_silt  = points.data(points.body)[p] < 2.;
        const bool has_kept = points.data(points.stress, 0)[p] == stress[p];
        EXPECT_TRUE(is_silt ? has_kept || u[p] == -2. : u[p] == pressure[p]);
        ++count[!is_silt ? 2 : !has_kept ? 1 : u[p] == pressure[p] ? 3 : 0];
      }
    for (const unsigned int n : count)
      EXPECT_GT(n, 0u);
  }
} // namespace



TEST(NullSpaceFilter, IsXpic)
{
  on_both_meshes<2>("", expect_xpic<2>);
  on_both_meshes<3>("", expect_xpic<3>);
}



TEST(NullSpaceFilter, HeldFaceTakesMomentum)
{
  const std::string fixed = "subsection Boundaries\nset Bottom = fixed\nend\n";
  on_both_meshes<2>(fixed, expect_momentum_of_wall<2>);
  on_both_meshes<3>(fixed, expect_momentum_of_wall<3>);
}



TEST(NullSpaceFilter, MeanStressIsThatOfTheCell)
{
  on_both_meshes<2>("", expect_mean_stress<2>);
  on_both_meshes<3>("", expect_mean_stress<3>);
}



TEST(NullSpaceFilter, WaterTakesTheMeanStress)
{
  on_both_meshes<2>("", expect_mean_of_water<2>);
  on_both_meshes<3>("", expect_mean_of_water<3>);
}

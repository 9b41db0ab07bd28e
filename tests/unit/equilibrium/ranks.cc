// SPDX-License-Identifier: LGPL-2.1-or-later
// The suite works on any number of ranks; ctest runs it on 1, 2 and 3.
#include <set>

#include "equilibrium_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(StaticRanks, 2, 3);

namespace
{
  /// A number in [-1, 1) that depends on the node and the seed alone.
  template <int dim>
  double
  number_for(const Grid<dim>   &grid,
             const unsigned int node,
             const unsigned int seed)
  {
    std::mt19937 random(1000 * number_of_node(grid, node) + seed);
    return std::uniform_real_distribution<double>(-1., 1.)(random);
  }



  // --------------------------------------------------------------- unknowns

  /// What must not depend on the ranks.
  struct Record
  {
    std::set<unsigned long> nodes; ///< with unknowns
    double                  norm, product;
    unsigned long           n_free;
  };



  template <int dim>
  unsigned char
  mask_of(const Grid<dim> &grid, const unsigned int node)
  {
    return static_cast<unsigned char>((number_for(grid, node, 5) + 1.) *
                                      power(2, dim - 1));
  }



  /// Numbered, with random components held and random fields.
  template <int dim>
  Record
  number(Core<dim> &core, Unknowns<dim> &unknowns)
  {
    add_shared(core, 60, 3, [&]() { return core.place(0.1); });
    core.sort();
    core.scatter();
    unknowns.number(core.nodes, core.grid, 0.01);
    std::vector<unsigned char> held(core.grid.n_owned_nodes(), 0);
    for (const unsigned int node : unknowns.active_nodes())
      held[node] = mask_of(core.grid, node);
    unknowns.constrain(held);

    Record record;
    auto   a = unknowns.field(), b = a;
    for (const unsigned int node : unknowns.active_nodes())
      {
        record.nodes.insert(number_of_node(core.grid, node));
        for (unsigned int d = 0; d < dim; ++d)
          {
            a[dim * node + d] = number_for(core.grid, node, 10 + d);
            b[dim * node + d] = number_for(core.grid, node, 20 + d);
          }
      }
    record.norm          = unknowns.norm(a);
    record.product       = unknowns.product(a, b);
    unsigned long n_free = 0;
    unknowns.for_each_free_dof([&](const auto, const auto) { ++n_free; });
    record.n_free = MPI::sum(n_free, core.grid.communicator());
    return record;
  }



  /// Each node has the same number and mask wherever it is known, and numbers
  /// are without gap in the order of the ranks.
  template <int dim>
  void
  expect_agreement(const Core<dim> &core, const Unknowns<dim> &unknowns)
  {
    const auto                                           &grid = core.grid;
    std::map<unsigned long, std::array<unsigned long, 2>> own;
    unsigned long                                         next =
      unknowns.owned().n_elements() > 0 ? *unknowns.owned().begin() : 0;
    for (const unsigned int node : unknowns.active_nodes())
      {
        EXPECT_EQ(unknowns.first(node), next);
        next += dim;
        own[number_of_node(grid, node)] = {
          {unknowns.first(node), mask_of(grid, node)}};
      }
    EXPECT_EQ(unknowns.owned().n_elements(), dim * own.size());
    std::map<unsigned long, std::array<unsigned long, 2>> all;
    unsigned long                                         expected_begin = 0;
    const auto of_ranks = MPI::all_gather(grid.communicator(), own);
    for (unsigned int r = 0; r < of_ranks.size(); ++r)
      {
        if (r < MPI::this_mpi_process(grid.communicator()))
          expected_begin += dim * of_ranks[r].size();
        all.insert(of_ranks[r].begin(), of_ranks[r].end());
      }
    if (!own.empty())
      {
        EXPECT_EQ(*unknowns.owned().begin(), expected_begin);
      }
    EXPECT_EQ(unknowns.n_global(), dim * all.size());
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        const auto it = all.find(number_of_node(grid, node));
        ASSERT_EQ(unknowns.is_active(node), it != all.end());
        if (it == all.end())
          continue;
        EXPECT_EQ(unknowns.first(node), it->second[0]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const bool held = (it->second[1] >> d) & 1;
            EXPECT_EQ(unknowns.is_constrained(node, d), held);
            EXPECT_TRUE(
              unknowns.relevant().is_element(unknowns.first(node) + d));
          }
      }
  }



  template <int dim>
  void
  expect_unknowns_of_one_rank()
  {
    on_all_meshes<dim>(
      "",
      [](Core<dim> &core) {
        Unknowns<dim> unknowns;
        return number(core, unknowns);
      },
      [](Core<dim> &core, const Record &alone) {
        Unknowns<dim> unknowns;
        const Record  record = number(core, unknowns);
        expect_agreement(core, unknowns);
        for (const unsigned long node : record.nodes)
          EXPECT_EQ(alone.nodes.count(node), 1u);
        EXPECT_EQ(MPI::sum(record.nodes.size(), core.grid.communicator()),
                  alone.nodes.size());
        EXPECT_EQ(record.n_free, alone.n_free);
        EXPECT_NEAR(record.norm, alone.norm, 1e-13 * alone.norm);
        EXPECT_NEAR(record.product, alone.product, 1e-13 * alone.norm);
      });
  }



  /// Sums at ghosts go to the owners, values back.
  TEST(StaticRanks, FieldsAreExchanged)
  {
    Core<2> core(slab<2>());
    scramble(core, 2);
    Unknowns<2> unknowns;
    number(core, unknowns);
    auto field = unknowns.field(), count = field;
    for (unsigned int i = 0; i < 2 * core.grid.n_nodes(); ++i)
      {
        field[i] = number_for(core.grid, i / 2, i % 2);
        count[i] = 1.;
      }
    unknowns.add_to_owners(field);
    unknowns.add_to_owners(count);
    unknowns.copy_to_ghosts(field);
    unknowns.copy_to_ghosts(count);
    for (unsigned int i = 0; i < 2 * core.grid.n_nodes(); ++i)
      EXPECT_NEAR(field[i],
                  count[i] * number_for(core.grid, i / 2, i % 2),
                  1e-14 * count[i]);
    double most = 0.;
    for (const double c : count)
      most = std::max(most, c);
    EXPECT_EQ(MPI::max(most, MPI_COMM_WORLD) > 1.,
              MPI::n_mpi_processes(MPI_COMM_WORLD) > 1);
  }



  TEST(StaticRanks, UnknownsAreThoseOfOneRank)
  {
    expect_unknowns_of_one_rank<2>();
    expect_unknowns_of_one_rank<3>();
  }



  // ------------------------------------------------------------ equilibrium

  /// A law and how to solve.
  struct Task
  {
    MaterialName name;
    std::string  entries;
    std::string  solver;
    std::string  bottom = "set Bottom = fixed\n";
  };



  std::vector<Task>
  tasks()
  {
    const std::string weak = stiff + "set Undrained shear strength = 10e3\n";
    const std::string grip =
      "set Bottom = seabed\n" + in_section("Seabed",
                                           "set Friction coefficient = 10\n"
                                           "set Maximum shear stress = 5000");
    return {{{"block", "linear elastic"}, stiff, "direct"},
            {{"block", "linear elastic"}, stiff, "CG"},
            {{"block", "linear elastic"}, stiff, "GMRES"},
            {{"clay", "von Mises"}, weak, "direct"},
            {{"clay", "von Mises"}, weak, "CG"},
            {{"block", "linear elastic"}, stiff, "direct", grip}};
  }



  /// By point: stress and place. And what Newton's method said.
  struct Result
  {
    std::map<unsigned long, std::vector<double>> points;
    std::vector<unsigned int>                    n_iterations;
    unsigned long                                n_unknowns;
  };



  /// A bank from x = 1 m to @p end; at 4.1 m a tenth of a cell hangs over.
  template <int dim>
  Result
  solve(const Task        &task,
        const unsigned int kind,
        const double       end,
        const MPI_Comm     communicator)
  {
    Statics<dim> bank(
      slab<dim>() + in_section("Boundaries", task.bottom),
      {task.name},
      material(task.name.name, task.entries) +
        in_section("Equilibrium", "set Newton tolerance = 1e-11") +
        in_section("Linear solver",
                   "set Tolerance = 1e-12\nset Type = " + task.solver),
      communicator);
    make_mesh(bank, kind, 1);
    Point<dim>                    lower, upper;
    std::array<unsigned int, dim> n;
    Tensor<1, dim>                gravity;
    n.fill(8);
    for (unsigned int d = 0; d < dim; ++d)
      upper[d] = 2.;
    lower[0]   = 1.;
    upper[0]   = end;
    n[0]       = std::lround(4. * (end - 1.));
    gravity[1] = -9.81;
    bank.fill(lower, upper, n);
    bank.transfer.use_bbar({true});
    bank.load(gravity);
    EXPECT_TRUE(bank.find()) << bank.equilibrium.failure();

    Result result;
    for (unsigned int p = 0; p < bank.points.size(); ++p)
      {
        auto &values =
          result.points[std::lround(bank.points.data(bank.points.id)[p])];
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          values.push_back(bank.points.data(bank.points.stress, c)[p] / 1e4);
        for (unsigned int d = 0; d < dim; ++d)
          values.push_back(bank.points.data(bank.points.position, d)[p]);
      }
    for (const auto &run : bank.runs)
      result.n_iterations.push_back(run.size());
    result.n_unknowns = bank.equilibrium.newton().n_unknowns();
    return result;
  }



  /// The reference is the direct solver's on one rank.
  template <int dim>
  void
  expect_result_of_one_rank(const Task        &task,
                            const unsigned int kind,
                            const double       end = 4.1)
  {
    SCOPED_TRACE(
      text(dim, "-D, ", task.name.law, ", ", task.solver, ", mesh ", kind));
    Task direct        = task;
    direct.solver      = "direct";
    const Result alone = solve<dim>(direct, kind, end, MPI_COMM_SELF);
    const Result found = solve<dim>(task, kind, end, MPI_COMM_WORLD);
    EXPECT_EQ(MPI::sum(found.points.size(), MPI_COMM_WORLD),
              alone.points.size());
    EXPECT_EQ(found.n_unknowns, alone.n_unknowns);
    EXPECT_EQ(found.n_iterations.size(), alone.n_iterations.size());
    // Some nodes of the seabed slip in another run of Newton's method.
    if (contains(task.bottom, "seabed"))
      {
        EXPECT_GT(found.n_iterations.size(), 1u);
      }
    for (const auto &[id, values] : found.points)
      for (unsigned int i = 0; i < values.size(); ++i)
        EXPECT_NEAR(values[i], alone.points.at(id)[i], 1e-9) << id << ' ' << i;
  }



  TEST(StaticRanks, EquilibriumIsThatOfOneRank)
  {
    for (const Task &task : tasks())
      {
        expect_result_of_one_rank<2>(task, 0);
        expect_result_of_one_rank<2>(task, 2);
        expect_result_of_one_rank<3>(task, 1);
      }
  }



  // So little soil that not all ranks have some.
  TEST(StaticRanks, RanksWithoutSoil)
  {
    for (const Task &task : tasks())
      if (!contains(task.bottom, "seabed"))
        expect_result_of_one_rank<2>(task, 0, 1.9);
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes that repeat. The suite works on any number of ranks; ctest runs it on
// 1, 2 and 3.
#include <cstdio>

#include "periodic_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(Periodic, 2, 3);

namespace
{
  constexpr double step_length = 1e-3;

  /// The copies in the middle have two cells of others around them.
  unsigned int
  copies_before(const unsigned int width)
  {
    return (2 + width - 1) / width + 1;
  }



  /// Sums at the nodes of the copy in the middle of a mesh that is not
  /// periodic; @p scale becomes the largest of that mesh (on a single node
  /// forces cancel).
  template <int dim>
  SumsByPlace<dim>
  sums_in_the_middle(const Periodic<dim> &periodic, NodeSums<dim> &scale)
  {
    const unsigned int before = copies_before(periodic.width);
    Core<dim>          wide(periodic.grid(2 * before + 1), {}, MPI_COMM_SELF);
    add_repeated(wide, periodic, 2 * before + 1);
    SumsByPlace<dim> result;
    for (const auto &[place, sums] : sums_by_place(wide))
      {
        for (unsigned int i = 0; i < SumIndex<dim>::n_entries; ++i)
          scale[i] = std::max(scale[i], std::abs(sums[i]));
        Lattice<dim> at        = place;
        bool         is_middle = true;
        for (unsigned int d = 0; d < dim; ++d)
          if (periodic.axes[d])
            {
              at[d] -= before * periodic.width;
              is_middle = is_middle && at[d] >= 0 && at[d] <= periodic.width;
            }
        if (is_middle)
          result[at] = sums;
      }
    return result;
  }



  // What a mesh that repeats does to its nodes is what a wider one does where
  // the points repeat.
  TEST(Periodic, SumsAreThoseOfAWiderMesh)
  {
    on_periodic_meshes([](const auto &periodic) {
      constexpr unsigned int dim = std::size(decltype(periodic.axes){});
      NodeSums<dim>          scale{};
      const auto             expected = sums_in_the_middle(periodic, scale);
      for (unsigned int seed = 0; seed < 3; ++seed)
        {
          Core<dim> core(periodic.grid() + periodic.conditions());
          if (seed > 0)
            scramble(core, seed);
          add_repeated(core, periodic, 1);
          double worst = 0;
          for (const auto &[place, sums] : sums_by_place(core))
            for (unsigned int i = 0; i < SumIndex<dim>::n_entries; ++i)
              worst =
                std::max(worst,
                         std::abs(sums[i] - expected.at(place)[i]) / scale[i]);
          EXPECT_LT(worst, 1e-13);
        }
    });
  }



  /// One step without materials.
  template <int dim>
  void
  move(Core<dim> &core)
  {
    core.scatter();
    core.nodes.update_momentum(step_length, 1e-9);
    core.nodes.share_with_ghosts(core.grid);
    core.gather(step_length);
  }



  // Points see a constant velocity as such, and the nodes have all the mass.
  TEST(Periodic, ConstantsAreKept)
  {
    on_periodic_meshes([](const auto &periodic) {
      constexpr unsigned int dim = std::size(decltype(periodic.axes){});
      Core<dim>              core(periodic.grid() + periodic.conditions());
      scramble(core, 7);
      add_repeated(core, periodic, 1);
      auto          &points = core.points;
      Tensor<1, dim> v;
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = 0.3 + d;
      double mass = 0, mass_of_nodes = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          mass += points.data(points.mass)[p];
          core.set(points.velocity, p, v);
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            points.data(points.stress, c)[p] = 0;
        }
      move(core);
      for (const unsigned int node : core.nodes.active_nodes())
        mass_of_nodes += core.nodes.mass(node);
      EXPECT_NEAR(MPI::sum(mass, MPI_COMM_WORLD),
                  MPI::sum(mass_of_nodes, MPI_COMM_WORLD),
                  1e-13 * MPI::sum(mass, MPI_COMM_WORLD));
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          EXPECT_LT((core.get(points.velocity, p) - v).norm(), 1e-13);
          EXPECT_LT(core.velocity_gradient(p).norm(), 1e-12);
        }
    });
  }



  // A row of equal points makes all nodes of a row equal.
  TEST(Periodic, RowsAreUniform)
  {
    for (const unsigned int width : {1, 2, 5})
      {
        const Periodic<2> periodic{{{true, false}}, width};
        Core<2>           core(periodic.grid() + periodic.conditions());
        const double      offset = 0.137;
        for (unsigned int i = 0; i < 2 * width; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            {
              core.random.seed(j + 1);
              const Point<2> x(-2.75 + 0.5 * i + offset,
                               -2.75 + 0.5 * j + core.number(-0.2, 0.2));
              if (core.grid.find_cell(x) >= core.grid.n_owned_cells())
                continue;
              const unsigned int p = core.add(x, Point<2>(0.5, 0.4));
              core.randomize(p);
            }
        core.sort();
        std::map<long, NodeSums<2>> row;
        const auto   collected = MPI::all_gather(MPI_COMM_WORLD, [&]() {
          std::map<std::pair<long, long>, std::vector<double>> sums;
          for (const auto &[place, sum] : sums_by_place(core))
            sums[{place[0], place[1]}] = {sum.begin(), sum.end()};
          return sums;
        }());
        unsigned int n         = 0;
        for (const auto &part : collected)
          for (const auto &[place, sums] : part)
            {
              auto &first = row[place.second];
              if (first[0] == 0)
                std::copy(sums.begin(), sums.end(), first.begin());
              for (unsigned int i = 0; i < SumIndex<2>::n_entries; ++i)
                EXPECT_NEAR(sums[i], first[i], 1e-12 * (1 + std::abs(first[i])))
                  << place.first << ' ' << place.second;
              ++n;
            }
        EXPECT_GE(n, 4 * width);
      }
  }



  /// Fast and general weights, by the sums of one point at a time.
  TEST(Periodic, WeightsByDefinition)
  {
    on_periodic_meshes([](const auto &periodic) {
      constexpr unsigned int dim = std::size(decltype(periodic.axes){});
      Core<dim>              core(periodic.grid() + periodic.conditions());
      add_repeated(core, periodic, 1);
      std::vector<double>          mass(core.grid.n_nodes(), 0.);
      std::vector<NodeWeight<dim>> weights;
      for (const Segment &segment : core.points.segments())
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            weights_of_point(core.points,
                             core.grid,
                             core.transfer.box_shape(),
                             segment.cell,
                             p,
                             weights);
            for (const auto &w : weights)
              mass[w.node] += w.value * core.points.data(core.points.mass)[p];
          }
      core.nodes.clear();
      core.scatter_points();
      for (unsigned int node = 0; node < core.grid.n_nodes(); ++node)
        EXPECT_NEAR(core.nodes.mass(node), mass[node], 1e-12);
    });
  }



  // Seam nodes stand for as much of the seabed as the others; they are on no
  // periodic face.
  TEST(Periodic, SeamNodesHaveWholeShares)
  {
    on_periodic_meshes([](const auto &periodic) {
      constexpr unsigned int dim = std::size(decltype(periodic.axes){});
      Core<dim>              core(periodic.grid() + periodic.conditions());
      scramble(core, 3);
      const auto extent = periodic.extent();
      for_each_node(core.grid, [&](const unsigned int node, const auto &place) {
        unsigned char faces = 0;
        for (unsigned int d = 0; d < dim; ++d)
          if (!periodic.axes[d])
            faces |= (place[d] == 0 ? 1u << (2 * d) : 0u) |
                     (place[d] == extent[d] ? 2u << (2 * d) : 0u);
        EXPECT_EQ(core.grid.faces_of_node(node), faces);
        if (node >= core.grid.n_owned_nodes())
          return;
        for (unsigned int face = 0; face < 2 * dim; ++face)
          if (faces & (1u << face))
            {
              double area = 1.;
              for (unsigned int d = 0; d < dim; ++d)
                if (d != face / 2 && !periodic.axes[d] &&
                    (place[d] == 0 || place[d] == extent[d]))
                  area *= 0.5;
              EXPECT_NEAR(core.grid.face_share(face, node).area, area, 1e-14);
              EXPECT_NEAR(core.grid.face_share(face, node).volume,
                          0.5 * area,
                          1e-14);
            }
      });
    });
  }



  TEST(Periodic, SurvivesSaveAndLoad)
  {
    const Periodic<3> periodic{{{true, false, true}}, 2};
    const std::string path    = "talus-unit-periodic-mesh";
    const auto        patches = [](const Grid<3> &grid) {
      std::map<unsigned long, std::vector<unsigned long>> result;
      for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
        for (const unsigned int node : grid.cells()[c].patch)
          result[grid.key_of_cell(c)].push_back(number_of_node(grid, node));
      return result;
    };
    Core<3>    core(periodic.grid() + periodic.conditions());
    const auto before = patches(core.grid);
    core.grid.save(path);
    core.grid.create({}, false, periodic.axes);
    core.grid.load(path);
    core.grid.prepare();
    EXPECT_EQ(patches(core.grid), before);
    if (MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      for (const std::string end : {"", ".info", "_fixed.data"})
        std::remove((path + end).c_str());
  }



  // --------------------------------------------------------------- refusals

  std::string
  refusal(const std::string &conditions, const std::string &grid = "")
  {
    return message_of<ExcUser>([&]() {
      Core<2> core(cube<2>() + in_section("Boundaries", conditions) + grid);
    });
  }

  const std::string both = "set Left = periodic\nset Right = periodic";



  TEST(Periodic, RefusesOneFace)
  {
    const std::string message = refusal("set Left = periodic");
    EXPECT_TRUE(contains(message, "'Left' is periodic")) << message;
    EXPECT_TRUE(contains(message, "'Boundaries/Right' is 'free'")) << message;
    EXPECT_TRUE(contains(refusal("set Top = periodic\nset Bottom = seabed"),
                         "'Boundaries/Bottom' is 'seabed'"));
    EXPECT_EQ(refusal(both), "");
  }



  TEST(Periodic, RefusesCellsOfSeveralSizes)
  {
    const std::string boxes =
      refusal(both, in_section("Grid", "set Refinement boxes = 0,0; 4,1; 1"));
    EXPECT_TRUE(contains(boxes, "'Grid/Refinement boxes' is '0,0; 4,1; 1'"))
      << boxes;
    Core<2>           core(cube<2>());
    const std::string tracking = message_of<ExcUser>([&]() {
      core.grid.create({}, /*grow=*/true, {{true, false}});
    });
    EXPECT_TRUE(contains(tracking, "'Mesh tracking/Enabled' is true"))
      << tracking;
    EXPECT_TRUE(contains(tracking, "'Left' and 'Right' are periodic"));
  }



  TEST(Periodic, RefusesPartsOfCells)
  {
    const std::string message =
      refusal(both, in_section("Grid", "set Upper corner = 3.9, 4"));
    EXPECT_TRUE(contains(message, "no multiple of Grid/Cell size")) << message;
  }
} // namespace

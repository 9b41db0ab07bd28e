// SPDX-License-Identifier: LGPL-2.1-or-later
// The suite works on any number of ranks; ctest runs it on 1, 2 and 3.
#include <set>

#include "ranks_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(Ranks, 2, 3);

namespace
{
  // -------------------------------------------------------------- numbering

  /// The mesh as one rank knows it: its own cells, and where nodes are.
  template <int dim>
  struct Numbering
  {
    explicit Numbering(const Grid<dim> &grid)
    {
      for (unsigned int c = 0; c < grid.cells().size(); ++c)
        {
          if (c < grid.n_owned_cells())
            cells.push_back(grid.key_of_cell(c));
          const Cell<dim> &cell = grid.cells()[c];
          for (unsigned int v = 0; v < power(2, dim); ++v)
            {
              Point<dim>   x  = cell.lower;
              unsigned int at = 0;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  x[d] += ((v >> d) & 1) * cell.size;
                  at += (1 + ((v >> d) & 1)) * power(4, d);
                }
              nodes[number_of_node(grid, cell.patch[at])] = x;
            }
        }
    }

    std::vector<unsigned long>          cells; ///< keys
    std::map<unsigned long, Point<dim>> nodes;
  };



  template <int dim>
  void
  expect_same(const Grid<dim> &grid, const Numbering<dim> &alone)
  {
    const Numbering<dim>       found(grid);
    std::vector<unsigned long> cells;
    for (const auto &part : MPI::all_gather(grid.communicator(), found.cells))
      cells.insert(cells.end(), part.begin(), part.end());
    EXPECT_EQ(cells, alone.cells);
    EXPECT_EQ(MPI::sum(grid.n_owned_nodes(), grid.communicator()),
              alone.nodes.size());
    for (const auto &[number, x] : found.nodes)
      {
        const auto node = alone.nodes.find(number);
        ASSERT_NE(node, alone.nodes.end()) << number;
        EXPECT_LT(x.distance(node->second), 1e-14) << number;
      }
  }



  template <int dim>
  void
  expect_numbers_of_one_rank()
  {
    on_all_meshes<dim>(
      "",
      [](const Core<dim> &core) { return Numbering<dim>(core.grid); },
      [](const Core<dim> &core, const Numbering<dim> &alone) {
        expect_same(core.grid, alone);
      });
  }



  TEST(Ranks, NumbersAreThoseOfOneRank)
  {
    expect_numbers_of_one_rank<2>();
    expect_numbers_of_one_rank<3>();
  }



  /// Cells of level 4 around some places, larger ones elsewhere.
  template <int dim>
  typename Grid<dim>::WantsFiner
  around_places(const Grid<dim> &grid, const unsigned int seed)
  {
    std::vector<Point<dim>> places(5);
    for (unsigned int i = 0; i < places.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          Point<dim> key;
          key[0]       = i;
          key[1]       = d;
          places[i][d] = dice(key, seed) * grid.domain().upper[d];
        }
    return [&grid, places](const typename Grid<dim>::Lattice &place,
                           const unsigned int                 level) {
      return level < 4 &&
             std::any_of(places.begin(), places.end(), [&](const auto &x) {
               return grid.lattice_place(x, level) == place;
             });
    };
  }



  /// Divide and join cells, sharing them out anew on the way or not, until the
  /// mesh is as asked for: it must not remember.
  template <int dim>
  void
  expect_no_memory(const unsigned int seed, const bool spread)
  {
    SCOPED_TRACE(text(dim, "-D, seed ", seed, ", spread ", spread));
    const Numbering<dim> fresh = [&]() {
      Core<dim> alone(slab<dim>(), {}, MPI_COMM_SELF);
      alone.grid.create({});
      alone.grid.refine(around_places(alone.grid, seed), true);
      alone.grid.prepare();
      return Numbering<dim>(alone.grid);
    }();
    Core<dim> core(slab<dim>());
    for (const unsigned int other : {seed + 100, seed + 200, seed})
      {
        // On many ranks siblings are joined once they are on one of them.
        const auto wants = around_places(core.grid, other);
        for (unsigned int i = 0; core.grid.refine(wants, spread) && i < 10; ++i)
          scramble(core, other + i);
        scramble(core, other);
      }
    expect_same(core.grid, fresh);
  }



  TEST(Ranks, NumbersForgetTheHistory)
  {
    for (unsigned int seed = 1; seed < 4; ++seed)
      {
        expect_no_memory<2>(seed, false);
        expect_no_memory<2>(seed, true);
        expect_no_memory<3>(seed, false);
      }
  }



  // ------------------------------------------------------------ the boundary

  /// For each node and face of the mesh: on it?, area, volume.
  using Faces =
    std::map<std::pair<unsigned long, unsigned int>, std::array<double, 3>>;

  template <int dim>
  Faces
  faces_of(const Core<dim> &core)
  {
    const auto            &grid = core.grid;
    std::set<unsigned int> hanging;
    for (const auto &entry : grid.hanging_nodes())
      hanging.insert(entry.node);
    Faces faces;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        {
          auto &entry = faces[{number_of_node(grid, node), face}];
          entry       = {};
          if (grid.faces_of_node(node) & (1u << face))
            {
              entry[0] = 1.;
              if (hanging.count(node) == 0)
                {
                  const auto &share = grid.face_share(face, node);
                  entry[1]          = share.area;
                  entry[2]          = share.volume;
                }
            }
        }
    return faces;
  }



  template <int dim>
  void
  expect_faces_of_one_rank()
  {
    on_all_meshes<dim>("",
                       faces_of<dim>,
                       [](const Core<dim> &core, const Faces &alone) {
                         for (const auto &[key, entry] : faces_of(core))
                           {
                             const auto it = alone.find(key);
                             ASSERT_NE(it, alone.end());
                             for (unsigned int i = 0; i < 3; ++i)
                               EXPECT_NEAR(entry[i], it->second[i], 1e-14)
                                 << key.first << ' ' << key.second;
                           }
                       });
  }



  TEST(Ranks, FacesAreThoseOfOneRank)
  {
    expect_faces_of_one_rank<2>();
    expect_faces_of_one_rank<3>();
  }



  // ------------------------------------------------------------- a few steps

  using Values = std::map<unsigned long, std::vector<double>>;

  /// What a step leaves behind: sums at owned nodes, motions at all nodes whose
  /// motions count on this rank, and state of the points by id.
  struct StepRecord
  {
    Values sums, motions, points;
  };



  /// Nodes that the points of this rank touch, and all that do not hang.
  template <int dim>
  std::set<unsigned int>
  nodes_in_use(const Core<dim> &core)
  {
    std::set<unsigned int> nodes;
    for (unsigned int node = 0; node < core.grid.n_nodes(); ++node)
      nodes.insert(node);
    for (const auto &entry : core.grid.hanging_nodes())
      nodes.erase(entry.node);
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
          for (const auto &weight : weights)
            nodes.insert(weight.node);
        }
    return nodes;
  }



  /// As Simulation::advance() does it, without materials.
  template <int dim>
  StepRecord
  step(Core<dim> &core)
  {
    auto        &grid   = core.grid;
    auto        &nodes  = core.nodes;
    auto        &points = core.points;
    const double dt     = 0.01;
    core.sort();
    nodes.clear();
    core.scatter_points();
    nodes.sum_over_ranks(grid);

    StepRecord record;
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      if (node < grid.n_owned_nodes())
        {
          const auto sums = sums_of_node(nodes, node);
          record.sums[number_of_node(grid, node)].assign(sums.begin(),
                                                         sums.end());
        }
      else
        for (unsigned int c = 0; c < NodalSum<dim>::width; ++c)
          EXPECT_EQ(nodes.sum(node)[c], 0.) << "a ghost";
    nodes.update_momentum(dt, 1e-9);
    nodes.share_with_ghosts(grid);
    for (const unsigned int node : nodes_in_use(core))
      {
        auto &motion = record.motions[number_of_node(grid, node)];
        for (unsigned int d = 0; d < dim; ++d)
          {
            motion.push_back(nodes.velocity(node)[d]);
            motion.push_back(nodes.increment(node)[d]);
          }
      }
    core.gather(dt);
    core.transfer.apply_bbar_to_dilatation(points,
                                           core.workspace,
                                           points.all());
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        auto &state = record.points[std::lround(points.data(points.id)[p])];
        for (unsigned int d = 0; d < dim; ++d)
          {
            state.push_back(points.data(points.position, d)[p]);
            state.push_back(points.data(points.velocity, d)[p]);
            for (unsigned int e = 0; e < dim; ++e)
              state.push_back(core.velocity_gradient(p)[d][e]);
          }
      }
    return record;
  }



  template <int dim>
  std::vector<StepRecord>
  some_steps(Core<dim> &core)
  {
    core.transfer.use_bbar({true, false, true});
    core.loads.acceleration_of_body[0][0] = 3.;
    core.loads.acceleration_of_body[1][1] = -9.81;
    add_shared(core, 400, 3, [&]() { return core.place(0.1); });
    core.sort();
    std::vector<StepRecord> records;
    for (unsigned int i = 0; i < 4; ++i)
      records.push_back(step(core));
    return records;
  }



  /// Every value is that of one rank, relative to the largest of its kind.
  void
  expect_values(const Values &found, const Values &alone)
  {
    std::vector<double> scale;
    for (const auto &entry : alone)
      {
        scale.resize(entry.second.size());
        for (unsigned int i = 0; i < scale.size(); ++i)
          scale[i] = std::max(scale[i], std::abs(entry.second[i]));
      }
    for (const auto &[key, values] : found)
      {
        const auto it = alone.find(key);
        ASSERT_NE(it, alone.end()) << key;
        for (unsigned int i = 0; i < scale.size(); ++i)
          EXPECT_NEAR(values[i], it->second[i], 1e-13 * scale[i])
            << key << ' ' << i;
      }
  }



  template <int dim>
  void
  expect_steps_of_one_rank()
  {
    on_all_meshes<dim>(
      "",
      some_steps<dim>,
      [](Core<dim> &core, const std::vector<StepRecord> &alone) {
        const auto records = some_steps(core);
        for (unsigned int i = 0; i < records.size(); ++i)
          {
            SCOPED_TRACE(text("step ", i));
            for (const auto member : {&StepRecord::sums, &StepRecord::points})
              EXPECT_EQ(MPI::sum((records[i].*member).size(), MPI_COMM_WORLD),
                        (alone[i].*member).size());
            for (const auto member :
                 {&StepRecord::sums, &StepRecord::motions, &StepRecord::points})
              expect_values(records[i].*member, alone[i].*member);
          }
      });
  }



  TEST(Ranks, StepsAreThoseOfOneRank)
  {
    expect_steps_of_one_rank<2>();
    expect_steps_of_one_rank<3>();
  }
} // namespace

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



  // ----------------------------------------------- what the ranks exchange

  /// A mesh of 12^dim cells with a body of 2^dim cells, one point in the
  /// centre of each, that moves along the diagonal. A box of half a cell
  /// reaches the nodes of its own cell only.
  template <int dim>
  struct SmallBody : Core<dim>
  {
    SmallBody(const double lower, const double speed, const MPI_Comm ranks)
      : Core<dim>(dim == 2 ? mesh("0, 0", "12, 12")
                           : mesh("0, 0, 0", "12, 12, 12"),
                  {},
                  ranks)
      , lower(lower)
    {
      for (unsigned int i = 0; i < power(2, dim); ++i)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = lower + 0.5 + ((i >> d) & 1);
          if (this->grid.find_cell(x) >= this->grid.n_owned_cells())
            continue;
          Tensor<1, dim> half_a_cell, velocity;
          for (unsigned int d = 0; d < dim; ++d)
            {
              half_a_cell[d] = 0.5;
              velocity[d]    = speed * (1. + 0.01 * i);
            }
          const unsigned int p = this->add(x, half_a_cell);
          this->set(this->points.velocity, p, velocity);
          this->points.data(this->points.id)[p] = i;
        }
    }

    /// Number of ghosts of this rank at the cells of the body.
    unsigned int
    n_ghosts_with_soil() const
    {
      std::set<unsigned int> result;
      for (const auto &[number, x] : Numbering<dim>(this->grid).nodes)
        {
          bool is_ghost   = !this->grid.owned_nodes().is_element(number);
          bool is_at_body = true;
          for (unsigned int d = 0; d < dim; ++d)
            is_at_body = is_at_body && std::abs(x[d] - lower - 1.) < 1.1;
          if (is_ghost && is_at_body)
            result.insert(number);
        }
      return result.size();
    }

    const double lower; ///< lower corner of the body along each axis, m
  };



  /// The body sits in the corner, where no other rank is, then farther and
  /// farther along the diagonal, over the borders of the ranks.
  template <int dim>
  void
  expect_only_nodes_with_soil_are_sent()
  {
    for (unsigned int lower = 0; lower <= 10; ++lower)
      {
        SCOPED_TRACE(text(dim, "-D, body at ", lower));
        SmallBody<dim> core(lower, 1., MPI_COMM_WORLD);
        core.sort();
        core.nodes.clear();
        core.scatter_points();
        core.nodes.sum_over_ranks(core.grid);
        core.nodes.update_momentum(0.01, 1e-9);
        const unsigned int ghosts =
          MPI::sum(core.n_ghosts_with_soil(), MPI_COMM_WORLD);
        // Motions go from the owners to all ghosts.
        core.grid.sent() = {};
        core.nodes.share_with_ghosts(core.grid);
        EXPECT_EQ(MPI::sum(core.grid.sent().n_nodes, MPI_COMM_WORLD), ghosts);
        EXPECT_EQ(MPI::sum(core.grid.sent().n_ghosts_with_soil, MPI_COMM_WORLD),
                  ghosts);
        if (lower == 0)
          {
            EXPECT_EQ(ghosts, 0u);
          }
        // Ranks add no active nodes to the body and a layer around.
        unsigned int n_active = 1;
        for (unsigned int d = 0; d < dim; ++d)
          n_active *= (lower == 0 || lower == 10 ? 4 : 5);
        const unsigned int found =
          MPI::sum(core.nodes.active_nodes().size(), MPI_COMM_WORLD);
        EXPECT_LE(found, n_active);
        EXPECT_GE(found, power(3, dim));
      }
  }



  TEST(Ranks, OnlyNodesWithSoilAreSent)
  {
    expect_only_nodes_with_soil_are_sent<2>();
    expect_only_nodes_with_soil_are_sent<3>();
  }



  /// The body crosses all borders by 0.9 cells per step and more.
  template <int dim>
  void
  expect_fast_body_stays_whole()
  {
    SmallBody<dim> alone(0., 90., MPI_COMM_SELF);
    SmallBody<dim> core(0., 90., MPI_COMM_WORLD);
    const double   n = power(2, dim);
    for (unsigned int i = 0; i < 10; ++i)
      {
        SCOPED_TRACE(text(dim, "-D, step ", i));
        const StepRecord of_one = step(alone), of_all = step(core);
        for (const auto member :
             {&StepRecord::sums, &StepRecord::motions, &StepRecord::points})
          expect_values(of_all.*member, of_one.*member);
        EXPECT_EQ(MPI::sum(of_all.points.size(), MPI_COMM_WORLD), n);
        Tensor<1, dim> momentum;
        double         mass = 0;
        for (const unsigned int node : core.nodes.active_nodes())
          {
            mass += core.nodes.mass(node);
            momentum += core.nodes.momentum(node);
          }
        EXPECT_NEAR(MPI::sum(mass, MPI_COMM_WORLD), n, 1e-12);
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_NEAR(MPI::sum(momentum[d], MPI_COMM_WORLD),
                      90. * (n + 0.01 * n * (n - 1) / 2),
                      1e-10);
      }
  }



  TEST(Ranks, FastBodyLosesNothingAtTheBorder)
  {
    expect_fast_body_stays_whole<2>();
    expect_fast_body_stays_whole<3>();
  }



  TEST(Ranks, StepsAreThoseOfOneRank)
  {
    expect_steps_of_one_rank<2>();
    expect_steps_of_one_rank<3>();
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
// The suite works on any number of ranks; ctest runs it on 1, 2 and 3.
#include <talus/adaptivity/load_balance.h>

#include <numeric>

#include "ranks_setup.h"

namespace
{
  // ------------------------------------------------------- points that travel

  /// For each point, by id: the key of its cell.
  using Cells = std::map<unsigned long, unsigned long>;

  constexpr unsigned int n_walkers = 300;



  /// Points of two bodies; ids are their numbers over all ranks.
  template <int dim>
  void
  add_walkers(Core<dim> &core)
  {
    add_shared(core, n_walkers, 2, [&]() { return core.place(-0.1); });
    for (unsigned int p = 0; p < core.points.size(); ++p)
      sign(core.points, p);
  }



  /// One step of a random walk, the same on any number of ranks; where it leads
  /// too far out, the point stays. With what add_companions() adds it is less
  /// than the smallest cell: farther away a rank may know no cells.
  template <int dim>
  void
  walk(Core<dim> &core, const unsigned int step)
  {
    auto        &points = core.points;
    const double wall   = 0.49 * core.grid.finest_size();
    const double far    = 0.74 * core.grid.finest_size();
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        core.random.seed(1000 * step + points.data(points.id)[p]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            double      &x  = points.data(points.position, d)[p];
            const double to = x + core.number(-far, far);
            if (to > core.grid.domain().lower[d] - wall &&
                to < core.grid.domain().upper[d] + wall)
              x = to;
          }
      }
  }



  /// Some of the first points get a companion with an id of its own, not sorted
  /// in yet, as the children of a split are.
  template <int dim>
  void
  add_companions(Core<dim> &core, const unsigned int step)
  {
    auto              &points = core.points;
    const unsigned int n      = points.size();
    for (unsigned int p = 0; p < n; ++p)
      {
        const unsigned int id = std::lround(points.data(points.id)[p]);
        if (id >= n_walkers || (id + step) % 41 != 0)
          continue;
        const unsigned int q = points.append(1);
        points.copy(p, q);
        points.data(points.id)[q] = step * n_walkers + id;
        sign(points, q);
        double &x = points.data(points.position)[q];
        x += 0.25 * core.grid.finest_size() * (x < 3. ? 1. : -1.);
      }
  }



  template <int dim>
  Cells
  cells_of_points(const Core<dim> &core)
  {
    const auto &points = core.points;
    Cells       cells;
    for (const Segment &segment : points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          const unsigned long id = std::lround(points.data(points.id)[p]);
          EXPECT_EQ(cells.count(id), 0u) << "twice: " << id;
          cells[id] = core.grid.key_of_cell(segment.cell);
        }
    return cells;
  }



  template <int dim>
  std::vector<Cells>
  cells_on_the_way(Core<dim> &core)
  {
    add_walkers(core);
    core.sort();
    std::vector<Cells> cells{cells_of_points(core)};
    for (unsigned int step = 1; step <= 50; ++step)
      {
        walk(core, step);
        if (step % 5 == 0)
          add_companions(core, step);
        core.sort();
        expect_sorted(core);
        expect_signed(core.points);
        cells.push_back(cells_of_points(core));
      }
    return cells;
  }



  template <int dim>
  void
  expect_travel()
  {
    on_all_meshes<dim>(
      "",
      cells_on_the_way<dim>,
      [](Core<dim> &core, const std::vector<Cells> &alone) {
        const auto cells = cells_on_the_way(core);
        for (unsigned int step = 0; step < cells.size(); ++step)
          {
            // With the cells of one rank, nobody is on two.
            EXPECT_EQ(MPI::sum(cells[step].size(), MPI_COMM_WORLD),
                      alone[step].size());
            for (const auto &[id, cell] : cells[step])
              {
                const auto it = alone[step].find(id);
                EXPECT_TRUE(it != alone[step].end() && it->second == cell)
                  << id << " at " << step;
              }
          }
        EXPECT_GT(alone.back().size(), n_walkers);
      });
  }



  TEST(Ranks, PointsTravelToTheirCells)
  {
    expect_travel<2>();
    expect_travel<3>();
  }



  /// What the ranks say that have points when all go astray at once: if only
  /// one did, the others would wait for it.
  std::string
  message_of_astray(const bool is_outside)
  {
    Core<2> core(mesh("0, 0", "64, 4"));
    core.relocation.allow_outside({{0., 0., 0.5, 0.5}});
    add_shared(core, 200, 1, [&]() { return core.place(); });
    core.sort();
    Point<2> x(64.001, 2.);
    if (!is_outside)
      {
        // A place this rank does not know; alone, a rank knows all.
        x[0] = 0.5;
        while (core.grid.find_cell(x) != dealii::numbers::invalid_unsigned_int)
          if ((x[0] += 1.) > 64.)
            return "";
      }
    core.set(core.points.position, 0, x);
    core.points.data(core.points.id)[0] = 4711;
    return message_of<ExcPoint>([&]() { core.sort(); });
  }



  TEST(Ranks, PointsThatGoAstrayAreNamed)
  {
    const std::string outside = message_of_astray(true);
    EXPECT_TRUE(contains(outside,
                         "Point 4711 of body 0 left the mesh through "
                         "the face 'Right'"))
      << outside;
    const std::string far = message_of_astray(false);
    if (MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      {
        EXPECT_TRUE(contains(far, "Point 4711 went to (")) << far;
        EXPECT_TRUE(contains(far, "farther than to a neighbouring cell"))
          << far;
      }
    else
      EXPECT_EQ(far, "");
  }



  // -------------------------------------------------------------- the balance

  /// Ids of the points in each cell and body, in their order.
  using Orders =
    std::map<std::pair<unsigned long, unsigned int>, std::vector<unsigned int>>;

  template <int dim>
  Orders
  order_in_cells(const Core<dim> &core)
  {
    Orders orders;
    for (const Segment &segment : core.points.segments())
      {
        auto &order =
          orders[{core.grid.key_of_cell(segment.cell), segment.body}];
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          order.push_back(std::lround(core.points.data(core.points.id)[p]));
      }
    return orders;
  }



  /// Those of all ranks.
  Orders
  gathered(const Orders &own)
  {
    Orders orders;
    for (const auto &part : MPI::all_gather(MPI_COMM_WORLD, own))
      for (const auto &entry : part)
        EXPECT_TRUE(orders.insert(entry).second) << "a cell on two ranks";
    return orders;
  }



  /// Repartition as Simulation::share_out() does.
  template <int dim>
  void
  share_out(Core<dim> &core, LoadBalance<dim> &balance)
  {
    const auto cells = balance.repartition(core.grid, core.points);
    core.nodes.prepare(core.grid);
    core.relocation.rebuild(core.points, cells);
    core.nodes.activate(core.grid, core.relocation.occupied_cells());
  }



  /// Points at these places are shared out, walk and are shared out again: each
  /// time they stay in order, unchanged in any bit.
  template <int dim, typename Place>
  void
  expect_points_kept(Core<dim>         &core,
                     const unsigned int n,
                     const double       most,
                     const Place       &place)
  {
    LoadBalance<dim> balance;
    add_shared(core, n, 2, place);
    core.sort();
    for (unsigned int p = 0; p < core.points.size(); ++p)
      sign(core.points, p);
    for (unsigned int step = 1; step <= 3; ++step)
      {
        const Orders before = gathered(order_in_cells(core));
        share_out(core, balance);
        expect_sorted(core);
        expect_signed(core.points);
        EXPECT_EQ(gathered(order_in_cells(core)), before);
        EXPECT_EQ(MPI::sum(core.points.size(), MPI_COMM_WORLD), n);
        EXPECT_LT(balance.imbalance(core.points, MPI_COMM_WORLD), most);
        walk(core, step);
        core.sort();
      }
  }



  template <int dim>
  void
  expect_balance(const bool hanging_nodes)
  {
    Core<dim> core(dim == 2 ? mesh("0, 0", "40, 8")
                            : mesh("0, 0, 0", "16, 8, 4"));
    if (hanging_nodes)
      core.refine([](const Point<dim> &x) { return x[0] < 6. && x[1] < 2.; });
    // All soil in the left part, which the first ranks own.
    const auto place = [&]() {
      Point<dim> x = core.place();
      x[0] *= 0.25;
      return x;
    };
    expect_points_kept(core, 4000, 1.2, place);
  }



  TEST(Ranks, SharesHaveEqualNumbersOfPoints)
  {
    for (const bool hanging_nodes : {false, true})
      {
        expect_balance<2>(hanging_nodes);
        expect_balance<3>(hanging_nodes);
      }
  }



  TEST(Ranks, SharesWithoutPointsOrCells)
  {
    const double any = 100.;
    {
      // Nobody.
      Core<2> core(slab<2>());
      expect_points_kept(core, 0, any, [&]() { return core.place(); });
    }
    {
      // All in one cell.
      Core<2> core(slab<2>());
      expect_points_kept(core, 50, any, [&]() {
        return Point<2>(core.number(4., 5.), core.number(1., 2.));
      });
    }
    for (const std::string upper : {"1, 1", "2, 1", "2, 2"})
      {
        Core<2> core(mesh("0, 0", upper));
        expect_points_kept(core, 50, any, [&]() { return core.place(); });
      }
    Core<3> core(mesh("0, 0, 0", "2, 1, 1"));
    expect_points_kept(core, 50, any, [&]() { return core.place(); });
  }



  TEST(Ranks, BalanceIsDueByPoints)
  {
    Core<2>        core(mesh("0, 0", "40, 8"));
    LoadBalance<2> balance;
    const MPI_Comm world = MPI_COMM_WORLD;
    const bool     alone = (MPI::n_mpi_processes(world) == 1);
    add_shared(core, 1000, 1, [&]() {
      const Point<2> x = core.place();
      return Point<2>(0.25 * x[0], x[1]);
    });
    core.sort();
    EXPECT_EQ(balance.is_due(100, world), !alone);
    EXPECT_FALSE(balance.is_due(101, world)) << "every 50 steps";
    EXPECT_EQ(balance.is_needed(core.points, world), !alone);
    share_out(core, balance);
    EXPECT_FALSE(balance.is_needed(core.points, world));
  }



  /// What cannot be shared out better is not shared out again.
  TEST(Ranks, BalanceKnowsItsLimit)
  {
    Core<2>        core(slab<2>());
    LoadBalance<2> balance;
    add_shared(core, 50, 1, [&]() {
      return Point<2>(core.number(4., 5.), core.number(1., 2.));
    });
    core.sort();
    EXPECT_EQ(balance.imbalance(core.points, MPI_COMM_WORLD),
              MPI::n_mpi_processes(MPI_COMM_WORLD));
    share_out(core, balance);
    EXPECT_FALSE(balance.is_needed(core.points, MPI_COMM_WORLD));
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  /// Fill all columns but those that Core::add() knows with numbers that tell
  /// the point and the column.
  template <int dim>
  void
  sign_columns(Core<dim> &core, const unsigned int begin)
  {
    auto &points = core.points;
    for (const Column &column : points.columns())
      for (unsigned int c = 0; c < column.n_components; ++c)
        if (column.first != points.position && column.first != points.body &&
            column.first != points.id)
          for (unsigned int p = begin; p < points.size(); ++p)
            points.data(column.first, c)[p] =
              points.data(points.id)[p] + 1e-3 * (column.first + c);
  }



  /// Sorted by cell and body, each point in its cell, nobody lost, and every
  /// column still that of its point.
  template <int dim>
  void
  expect_in_order(const Core<dim> &core)
  {
    const auto       &points = core.points;
    std::vector<bool> seen(points.size(), false);
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double id = points.data(points.id)[p];
        ASSERT_LT(id, points.size());
        EXPECT_FALSE(seen[static_cast<unsigned int>(id)]) << id;
        seen[static_cast<unsigned int>(id)] = true;
        EXPECT_EQ(points.data(points.body)[p], std::fmod(id, 3.));
        for (const Column &column : points.columns())
          for (unsigned int c = 0; c < column.n_components; ++c)
            if (column.first != points.position &&
                column.first != points.body && column.first != points.id)
              {
                EXPECT_EQ(points.data(column.first, c)[p],
                          id + 1e-3 * (column.first + c));
              }
      }

    unsigned int              end = 0;
    std::vector<unsigned int> occupied;
    const Segment            *last = nullptr;
    for (const Segment &segment : points.segments())
      {
        EXPECT_EQ(segment.begin, end);
        EXPECT_LT(segment.begin, segment.end);
        end = segment.end;
        if (last)
          {
            EXPECT_LT(std::tie(last->cell, last->body),
                      std::tie(segment.cell, segment.body));
          }
        last = &segment;
        if (occupied.empty() || occupied.back() != segment.cell)
          occupied.push_back(segment.cell);
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            const Point<dim> x(core.get(points.position, p));
            EXPECT_EQ(core.grid.find_cell(x), segment.cell);
            EXPECT_EQ(points.data(points.body)[p], segment.body);
          }
      }
    EXPECT_EQ(end, points.size());
    EXPECT_EQ(core.relocation.occupied_cells(), occupied);
  }



  /// Move all points a bit, some of them far; where that leads out of the mesh
  /// by more than @p margin, stay.
  template <int dim>
  void
  stir(Core<dim> &core, const double margin)
  {
    auto        &points = core.points;
    const double far    = core.number(0., 1.) < 0.2 ? 3. : 0.2;
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        {
          double      &x  = points.data(points.position, d)[p];
          const double to = x + core.number(-far, far);
          if (to > core.grid.domain().lower[d] - margin &&
              to < core.grid.domain().upper[d] + margin)
            x = to;
        }
  }



  template <int dim>
  void
  expect_order_kept(Core<dim> &core, const unsigned int n_steps)
  {
    // Cells of 0.5 m have walls of 0.25 m.
    const double margin = 0.5 * core.grid.finest_size();
    for (unsigned int i = 0; i < 100; ++i)
      core.add(core.place(-margin), Tensor<1, dim>(), i % 3);
    sign_columns(core, 0);
    EXPECT_TRUE(core.relocation.update(core.points, core.grid));
    expect_in_order(core);
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        stir(core, margin);
        for (unsigned int i = 0; i < step % 3; ++i)
          {
            const unsigned int id = core.points.size();
            core.add(core.place(-margin), Tensor<1, dim>(), id % 3);
            sign_columns(core, id);
          }
        core.relocation.update(core.points, core.grid);
        expect_in_order(core);
        // Nobody moved.
        EXPECT_FALSE(core.relocation.update(core.points, core.grid));
      }
    // From nothing.
    core.relocation.rebuild(core.points, core.grid);
    expect_in_order(core);
  }



  TEST(Relocation, KeepsTheOrder)
  {
    {
      Core<2> core(cube<2>());
      expect_order_kept(core, 200);
    }
    Core<3> core(cube<3>());
    expect_order_kept(core, 100);
  }



  TEST(Relocation, KeepsTheOrderAcrossHangingNodes)
  {
    {
      Core<2> core(cube<2>());
      refine_corner(core);
      core.refine([](const Point<2> &x) { return x.norm() < 0.6; });
      expect_order_kept(core, 200);
    }
    Core<3> core(cube<3>());
    refine_corner(core);
    expect_order_kept(core, 100);
  }



  TEST(Relocation, KeepsTheOrderAfterAChangeOfTheMesh)
  {
    Core<2> core(cube<2>());
    expect_order_kept(core, 10);
    refine_corner(core);
    // Now some lie farther outside than half of the smaller cells.
    for (unsigned int p = 0; p < core.points.size(); ++p)
      for (unsigned int d = 0; d < 2; ++d)
        {
          double &x = core.points.data(core.points.position, d)[p];
          x         = std::clamp(x, -0.25, 4.25);
        }
    core.relocation.rebuild(core.points, core.grid);
    expect_in_order(core);
  }



  /// Those that stayed come first, then the newcomers as they were.
  TEST(Relocation, OrderWithinASegment)
  {
    Core<2> core(cube<2>());
    for (const double x : {0.1, 0.2, 0.3, 1.1, 1.2, 1.3})
      core.add({x, 0.5}, Tensor<1, 2>());
    core.sort();
    core.points.data(core.points.position)[1] = 1.9;
    core.points.data(core.points.position)[4] = 0.9;
    core.add({1.5, 0.5}, Tensor<1, 2>());
    core.sort();
    const std::vector<double> expected{0, 2, 4, 3, 5, 1, 6};
    for (unsigned int p = 0; p < expected.size(); ++p)
      EXPECT_EQ(core.points.data(core.points.id)[p], expected[p]) << p;
  }



  // ------------------------------------------------------------ the boundary

  /// Walls half a cell thick, but for the free top.
  template <int dim>
  struct Walled : Core<dim>
  {
    Walled()
      : Core<dim>(cube<dim>())
    {
      std::array<double, 2 * dim> half;
      half.fill(0.5);
      half[3] = 0.;
      this->relocation.allow_outside(half);
    }
  };



  TEST(Relocation, BoundaryCellReachesOutside)
  {
    Walled<2>          core;
    const unsigned int p    = core.add({0.3, 0.3}, Tensor<1, 2>());
    const unsigned int cell = core.grid.find_cell({0.5, 0.5});
    core.sort();
    for (const Point<2> x :
         {Point<2>{-0.4999, 0.3}, Point<2>{0.3, -0.5}, Point<2>{-0.4, -0.4}})
      {
        core.set(core.points.position, p, x);
        core.sort();
        ASSERT_EQ(core.points.segments().size(), 1u);
        EXPECT_EQ(core.points.segments()[0].cell, cell) << x;
        EXPECT_EQ(core.get(core.points.position, p), x) << "not moved";
      }
    // And along the wall.
    core.set(core.points.position, p, Point<2>(1.2, -0.4));
    core.sort();
    EXPECT_EQ(core.points.segments()[0].cell, core.grid.find_cell({1.5, 0.5}));
  }



  /// Message of the error when point 7 of two goes to @p x.
  template <int dim>
  std::string
  message_at(const Point<dim> &x, const bool appended)
  {
    Walled<dim> core;
    Point<dim>  start;
    start[0] = start[1] = 1.5;
    core.add(start, Tensor<1, dim>());
    if (!appended)
      {
        const unsigned int p                = core.add(start, Tensor<1, dim>());
        core.points.data(core.points.id)[p] = 7;
        core.sort();
        core.set(core.points.position, 1, x);
      }
    else
      {
        core.sort();
        const unsigned int p                = core.add(x, Tensor<1, dim>());
        core.points.data(core.points.id)[p] = 7;
      }
    return message_of<ExcPoint>([&]() { core.sort(); });
  }



  TEST(Relocation, PointsThatLeaveAreNamed)
  {
    for (const bool appended : {false, true})
      {
        for (const auto &[x, face] :
             {std::make_pair(Point<2>(-0.51, 1.), "'Left'"),
              std::make_pair(Point<2>(4.51, 1.), "'Right'"),
              std::make_pair(Point<2>(1., -0.51), "'Bottom'"),
              std::make_pair(Point<2>(1., 4.001), "'Top'"),
              std::make_pair(Point<2>(-1e300, 1.), "'Left'")})
          {
            const std::string message = message_at(x, appended);
            EXPECT_TRUE(contains(message, face)) << x << message;
            EXPECT_TRUE(contains(message, "Point 7 of body 0")) << message;
          }
        const std::string message =
          message_at(Point<3>(1., 1., 4.51), appended);
        EXPECT_TRUE(contains(message, "'Front'")) << message;
        EXPECT_EQ(message_at(Point<2>(1., 3.999), appended), "");
      }
  }



  TEST(Relocation, NotANumberIsAnError)
  {
    const double nan = std::nan("");
    for (const bool appended : {false, true})
      {
        for (const Point<2> x : {Point<2>(nan, 1.), Point<2>(1., nan)})
          EXPECT_TRUE(contains(message_at(x, appended), "no finite position"));
        const double infinity = std::numeric_limits<double>::infinity();
        EXPECT_TRUE(contains(message_at(Point<2>(1., infinity), appended),
                             "no finite position"));
        EXPECT_TRUE(contains(message_at(Point<3>(1., 1., nan), appended),
                             "no finite position"));
      }
  }



  /// Half of the cell where the point is now, not of the one it comes from.
  TEST(Relocation, WallIsHalfTheBoundaryCellThick)
  {
    Core<2> core(cube<2>());
    core.refine([](const Point<2> &x) { return x.norm() < 3. && x[1] < 1.; });
    ASSERT_EQ(core.grid.cells()[core.grid.find_cell({0.1, 0.1})].size, 0.5);
    ASSERT_EQ(core.grid.cells()[core.grid.find_cell({1.5, 1.5})].size, 1.);
    const auto move = [&](const Point<2> &from, const Point<2> &to) {
      return message_of<ExcPoint>([&]() {
        core.set(core.points.position, 0, from);
        core.sort();
        core.set(core.points.position, 0, to);
        core.sort();
      });
    };
    core.add({1.5, 1.5}, Tensor<1, 2>());
    // Into the wall of a small cell, from a large one.
    EXPECT_EQ(move({1.5, 1.5}, {1.6, -0.24}), "");
    EXPECT_NE(move({1.5, 1.5}, {1.6, -0.4}), "");
    // Into the wall of a large one, from a small one.
    EXPECT_EQ(move({0.1, 0.9}, {-0.4, 1.1}), "");
    EXPECT_NE(move({0.1, 0.9}, {-0.51, 1.1}), "");
  }
} // namespace

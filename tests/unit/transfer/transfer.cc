// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/reference.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "transfer_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  // ----------------------------------------------------------------- scatter

  template <int dim>
  void
  expect_conservation(Core<dim> &core)
  {
    using Index = SumIndex<dim>;
    NodeSums<dim> of_nodes{}, of_points{}, scale{};
    for (const auto &sum : core.scatter())
      for (unsigned int c = 0; c < Index::n_entries; ++c)
        of_nodes[c] += sum[c], scale[c] += std::abs(sum[c]);
    const auto &points = core.points;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double mass = points.data(points.mass)[p];
        of_points[Index::mass] += mass;
        of_points[Index::volume] += points.data(points.reference_volume)[p];
        for (unsigned int d = 0; d < dim; ++d)
          {
            of_points[Index::momentum + d] +=
              mass * points.data(points.velocity, d)[p];
            // Internal forces are in balance.
            of_points[Index::force + d] += mass * acceleration(core, p)[d];
          }
      }
    for (unsigned int c = 0; c < Index::n_entries; ++c)
      EXPECT_NEAR(of_nodes[c], of_points[c], 1e-13 * scale[c]) << c;
  }



  TEST(Transfer, ScatterConserves)
  {
    for (const std::string &rule : box_rules)
      {
        on_both_meshes<2>(in_section("Transfer", rule), expect_conservation<2>);
        on_both_meshes<3>(in_section("Transfer", rule), expect_conservation<3>);
      }
  }



  template <int dim>
  void
  expect_sums_by_definition(Core<dim> &core)
  {
    constexpr unsigned int n_entries = SumIndex<dim>::n_entries;
    const auto             sums      = core.scatter();
    core.nodes.clear();
    NodeWeights<dim> room;
    for (const Segment &segment : core.points.segments())
      scatter_by_definition(core.with(core.loads),
                            core.transfer.box_shape(),
                            segment,
                            room);
    auto expected = core.sums_of_nodes();
    for (const auto &hanging : core.grid.hanging_nodes())
      for (unsigned int c = 0; c < n_entries; ++c)
        {
          for (const auto &[master, weight] : hanging.masters)
            expected[master][c] += weight * expected[hanging.node][c];
          expected[hanging.node][c] = 0.;
        }
    NodeSums<dim> largest{};
    for (const auto &sum : expected)
      for (unsigned int c = 0; c < n_entries; ++c)
        largest[c] = std::max(largest[c], std::abs(sum[c]));
    for (unsigned int n = 0; n < sums.size(); ++n)
      for (unsigned int c = 0; c < n_entries; ++c)
        EXPECT_NEAR(sums[n][c], expected[n][c], 1e-13 * largest[c])
          << "node " << n << " component " << c;
  }



  TEST(Transfer, ScatterByDefinition)
  {
    for (const std::string &rule : box_rules)
      {
        on_both_meshes<2>(in_section("Transfer", rule),
                          expect_sums_by_definition<2>);
        on_both_meshes<3>(in_section("Transfer", rule),
                          expect_sums_by_definition<3>);
      }
  }



  /// All nodes that a point reaches are active, the masters of hanging nodes
  /// included; otherwise they would get no velocity.
  template <int dim>
  void
  expect_reached_nodes_active(const std::string &rule)
  {
    for (unsigned int i = 0; i < (dim == 2 ? 100 : 15); ++i)
      {
        Core<dim> core(cube<dim>() + in_section("Transfer", rule));
        core.random.seed(i);
        refine_corner(core);
        core.randomize(core.add(core.place(), core.vector(0.2, 1.)));
        core.sort();
        const auto                   sums = core.scatter();
        const std::set<unsigned int> active(core.nodes.active_nodes().begin(),
                                            core.nodes.active_nodes().end());
        EXPECT_EQ(active.size(), core.nodes.active_nodes().size()) << "twice";
        for (unsigned int n = 0; n < sums.size(); ++n)
          if (sums[n][SumIndex<dim>::mass] > 0.)
            {
              EXPECT_EQ(active.count(n), 1u) << n;
            }
        core.nodes.clear();
        for (unsigned int n = 0; n < sums.size(); ++n)
          for (unsigned int c = 0; c < NodalSum<dim>::width; ++c)
            EXPECT_EQ(core.nodes.sum(n)[c], 0.);
      }
  }



  TEST(Transfer, ReachedNodesAreActive)
  {
    for (const std::string &rule : box_rules)
      {
        expect_reached_nodes_active<2>(rule);
        expect_reached_nodes_active<3>(rule);
      }
  }



  // ------------------------------------------------------------------ gather

  /// v(x) = A x + b.
  template <int dim>
  struct LinearField
  {
    explicit LinearField(Core<dim> &core)
      : A(core.tensor(-1., 1.))
      , b(core.vector(-1., 1.))
    {}

    Tensor<1, dim>
    operator()(const Tensor<1, dim> &x) const
    {
      return A * x + b;
    }

    Tensor<2, dim> A;
    Tensor<1, dim> b;
  };



  /// Only points whose boxes lie in the mesh see a linear field undisturbed.
  template <int dim>
  bool
  is_interior(const Core<dim> &core, const Tensor<1, dim> &x)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (x[d] < core.grid.domain().lower[d] + 0.5 ||
          x[d] > core.grid.domain().upper[d] - 0.5)
        return false;
    return true;
  }



  template <int dim>
  void
  set_motion(Core<dim>              &core,
             const LinearField<dim> &velocity,
             const LinearField<dim> &increment)
  {
    const auto places = places_of_nodes(core.grid);
    for (unsigned int n = 0; n < places.size(); ++n)
      core.nodes.set_motion(n, velocity(places[n]), increment(places[n]));
  }



  template <int dim>
  void
  expect_linear_field(Core<dim> &core, const double flip)
  {
    const LinearField<dim> velocity(core), increment(core);
    set_motion(core, velocity, increment);
    const auto                 &points = core.points;
    const double                dt     = 0.013;
    std::vector<Tensor<1, dim>> old_x, old_v;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        old_x.push_back(core.get(points.position, p));
        old_v.push_back(core.get(points.velocity, p));
      }
    core.gather(dt);

    unsigned int n_interior = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const Tensor<1, dim> x = old_x[p];
        if (!is_interior(core, x))
          continue;
        ++n_interior;
        EXPECT_LT((core.velocity_gradient(p) - velocity.A).norm(), 1e-13);
        EXPECT_LT((core.get(points.position, p) - x - dt * velocity(x)).norm(),
                  1e-14);
        EXPECT_LT((core.get(points.velocity, p) -
                   (flip * (old_v[p] + increment(x)) +
                    (1. - flip) * velocity(x)))
                    .norm(),
                  1e-13);
      }
    EXPECT_GT(n_interior, 100u);
  }



  template <int dim>
  void
  expect_linear_field()
  {
    for (const double flip : {1., 0., 0.3})
      on_both_meshes<dim>(
        in_section("Transfer", text("set FLIP fraction = ", flip)),
        [flip](Core<dim> &core) { expect_linear_field(core, flip); });
  }



  TEST(Transfer, GatherOfALinearField)
  {
    expect_linear_field<2>();
    expect_linear_field<3>();
  }



  /// What a gather does to the points.
  template <int dim>
  struct Gathered
  {
    std::vector<Tensor<1, dim>> position, velocity;
    std::vector<Tensor<2, dim>> velocity_gradient;
    std::vector<unsigned int>   out_of_cell; ///< ascending
    double                      work = 0.;   ///< of the loads, J

    /// Call @p gather, which returns that work, and undo it.
    template <typename Action>
    Gathered(Core<dim> &core, const Action &gather)
    {
      auto                       &points = core.points;
      std::vector<Tensor<1, dim>> old_x, old_v;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          old_x.push_back(core.get(points.position, p));
          old_v.push_back(core.get(points.velocity, p));
        }
      core.workspace.points_out_of_cell().clear();
      work        = gather();
      out_of_cell = core.workspace.points_out_of_cell();
      std::sort(out_of_cell.begin(), out_of_cell.end());
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          position.push_back(core.get(points.position, p));
          velocity.push_back(core.get(points.velocity, p));
          velocity_gradient.push_back(core.velocity_gradient(p));
          core.set(points.position, p, old_x[p]);
          core.set(points.velocity, p, old_v[p]);
        }
    }
  };



  /// Any motion of the nodes, and of points that reach beyond the mesh, too.
  template <int dim>
  void
  expect_gather_by_definition(Core<dim> &core, const double flip)
  {
    const double dt = 0.1;
    for (unsigned int n = 0; n < core.grid.n_nodes(); ++n)
      core.nodes.set_motion(n, core.vector(-1., 1.), core.vector(-1., 1.));
    core.nodes.share_with_ghosts(core.grid);

    const Gathered<dim> expected(core, [&]() {
      core.workspace.reinit(0, core.points.size());
      double power = 0.;
      for (const Segment &segment : core.points.segments())
        power += gather_by_definition(core.with(core.loads),
                                      core.transfer.box_shape(),
                                      segment,
                                      dt,
                                      VelocityUpdate{flip});
      return dt * power;
    });
    const Gathered<dim> found(core, [&]() { return core.gather(dt); });

    double scale = 0.;
    for (unsigned int p = 0; p < core.points.size(); ++p)
      {
        EXPECT_LT((found.position[p] - expected.position[p]).norm(), 1e-14);
        EXPECT_LT((found.velocity[p] - expected.velocity[p]).norm(), 1e-14);
        EXPECT_LT(
          (found.velocity_gradient[p] - expected.velocity_gradient[p]).norm(),
          1e-13 * (1. + expected.velocity_gradient[p].norm()));
        scale += dt * core.points.data(core.points.mass)[p] *
                 acceleration(core, p).norm();
      }
    EXPECT_NEAR(found.work, expected.work, 1e-14 * scale);
    EXPECT_EQ(found.out_of_cell, expected.out_of_cell);
    EXPECT_GT(found.out_of_cell.size(), 10u);
  }



  template <int dim>
  void
  expect_gather_by_definition()
  {
    for (const std::string &rule : box_rules)
      for (const double flip : {1., 0., 0.3})
        on_both_meshes<dim>(
          in_section("Transfer", text(rule, "\nset FLIP fraction = ", flip)),
          [flip](Core<dim> &core) { expect_gather_by_definition(core, flip); });
  }



  TEST(Transfer, GatherByDefinition)
  {
    expect_gather_by_definition<2>();
    expect_gather_by_definition<3>();
  }



  /// Those that get no number for a place, too.
  template <int dim>
  void
  expect_points_out_of_cell(Core<dim> &core)
  {
    const LinearField<dim> velocity(core), increment(core);
    set_motion(core, velocity, increment);
    auto              &points = core.points;
    const unsigned int node   = core.nodes.active_nodes()[0];
    Tensor<1, dim>     v      = core.nodes.velocity(node);
    v[dim - 1]                = std::nan("");
    core.nodes.set_motion(node, v, core.nodes.increment(node));
    core.gather(0.1);
    std::vector<unsigned int> left;
    for (const Segment &segment : points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          const Cell<dim> &cell      = core.grid.cells()[segment.cell];
          bool             is_inside = true;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double x = points.data(points.position, d)[p];
              is_inside      = is_inside && x >= cell.lower[d] &&
                          x < cell.lower[d] + cell.size;
            }
          if (!is_inside)
            left.push_back(p);
        }
    EXPECT_GT(left.size(), 10u);
    EXPECT_LT(left.size(), points.size());
    auto &noted = core.workspace.points_out_of_cell();
    std::sort(noted.begin(), noted.end());
    EXPECT_EQ(noted, left);
  }



  TEST(Transfer, GatherNotesThoseThatLeaveTheirCell)
  {
    on_both_meshes<2>("", expect_points_out_of_cell<2>);
    on_both_meshes<3>("", expect_points_out_of_cell<3>);
  }



  template <int dim>
  void
  expect_work_of_loads(Core<dim> &core)
  {
    // In the interior; the others weigh nothing.
    const LinearField<dim> velocity(core), increment(core);
    set_motion(core, velocity, increment);
    const double dt       = 0.013;
    double       expected = 0, scale = 0;
    for (unsigned int p = 0; p < core.points.size(); ++p)
      {
        const Tensor<1, dim> x    = core.get(core.points.position, p);
        double              &mass = core.points.data(core.points.mass)[p];
        if (!is_interior(core, x))
          mass = 0;
        const double work = dt * mass * acceleration(core, p) *
                            (velocity(x) - 0.5 * increment(x));
        expected += work;
        scale += std::abs(work);
      }
    EXPECT_NEAR(core.gather(dt), expected, 1e-13 * scale);
  }



  TEST(Transfer, WorkOfLoads)
  {
    on_both_meshes<2>("", expect_work_of_loads<2>);
    on_both_meshes<3>("", expect_work_of_loads<3>);
  }
} // namespace

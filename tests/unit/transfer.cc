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
    std::array<double, n_lanes> of_nodes{}, of_points{}, scale{};
    for (const auto &sum : core.scatter())
      for (unsigned int c = 0; c < n_lanes; ++c)
        of_nodes[c] += sum[c], scale[c] += std::abs(sum[c]);
    const auto &points = core.points;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double mass = points.data(points.mass)[p];
        of_points[NodalSum<dim>::mass] += mass;
        of_points[NodalSum<dim>::volume] +=
          points.data(points.reference_volume)[p];
        for (unsigned int d = 0; d < dim; ++d)
          {
            of_points[NodalSum<dim>::momentum + d] +=
              mass * points.data(points.velocity, d)[p];
            // Internal forces are in balance.
            of_points[NodalSum<dim>::force + d] +=
              mass * acceleration(core, p)[d];
          }
      }
    for (unsigned int c = 0; c <= NodalSum<dim>::volume; ++c)
      EXPECT_NEAR(of_nodes[c], of_points[c], 1e-13 * scale[c]) << c;
  }



  TEST(Transfer, ScatterConserves)
  {
    on_both_meshes<2>("", expect_conservation<2>);
    on_both_meshes<3>("", expect_conservation<3>);
  }



  /// The sums of the points' shares, point by point from the definition.
  template <int dim>
  std::vector<std::array<double, n_lanes>>
  scatter_by_definition(Core<dim> &core)
  {
    const auto                              &points = core.points;
    std::vector<std::array<double, n_lanes>> sums(core.grid.n_nodes());
    for (auto &sum : sums)
      sum.fill(0.);
    std::vector<NodeWeight<dim>> weights;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const unsigned int c =
          core.grid.find_cell(Point<dim>(core.get(points.position, p)));
        weights_of_point(
          points, core.grid, core.transfer.box_shape(), c, p, weights);
        const double         mass  = points.data(points.mass)[p];
        const Tensor<1, dim> b     = acceleration(core, p);
        Tensor<2, dim>       sigma = core.stress(p);
        for (unsigned int d = 0; d < dim; ++d)
          sigma[d][d] += core.points.mean_stress_shift()[p];
        for (const auto &w : weights)
          {
            auto                &sum = sums[w.node];
            const Tensor<1, dim> force =
              mass * w.value * b - core.volume(p) * sigma * w.gradient;
            sum[NodalSum<dim>::mass] += mass * w.value;
            sum[NodalSum<dim>::volume] +=
              points.data(points.reference_volume)[p] * w.value;
            for (unsigned int d = 0; d < dim; ++d)
              {
                sum[NodalSum<dim>::momentum + d] +=
                  mass * w.value * points.data(points.velocity, d)[p];
                sum[NodalSum<dim>::force + d] += force[d];
              }
          }
      }
    return sums;
  }



  template <int dim>
  void
  expect_sums_by_definition(Core<dim> &core)
  {
    const auto sums     = core.scatter();
    auto       expected = scatter_by_definition(core);
    for (const auto &hanging : core.grid.hanging_nodes())
      for (unsigned int c = 0; c < n_lanes; ++c)
        {
          for (const auto &[master, weight] : hanging.masters)
            expected[master][c] += weight * expected[hanging.node][c];
          expected[hanging.node][c] = 0.;
        }
    std::array<double, n_lanes> largest{};
    for (const auto &sum : expected)
      for (unsigned int c = 0; c < n_lanes; ++c)
        largest[c] = std::max(largest[c], std::abs(sum[c]));
    for (unsigned int n = 0; n < sums.size(); ++n)
      for (unsigned int c = 0; c < n_lanes; ++c)
        EXPECT_NEAR(sums[n][c], expected[n][c], 1e-13 * largest[c])
          << "node " << n << " component " << c;
  }



  TEST(Transfer, ScatterByDefinition)
  {
    on_both_meshes<2>("", expect_sums_by_definition<2>);
    on_both_meshes<3>("", expect_sums_by_definition<3>);
  }



  /// All nodes that a point reaches are active, the masters of hanging nodes
  /// included; otherwise they would get no velocity.
  template <int dim>
  void
  expect_reached_nodes_active()
  {
    for (unsigned int i = 0; i < (dim == 2 ? 100 : 15); ++i)
      {
        Core<dim> core(cube<dim>());
        core.random.seed(i);
        refine_corner(core);
        core.randomize(core.add(core.place(), core.vector(0.2, 1.)));
        core.sort();
        const auto                   sums = core.scatter();
        const std::set<unsigned int> active(core.nodes.active_nodes().begin(),
                                            core.nodes.active_nodes().end());
        EXPECT_EQ(active.size(), core.nodes.active_nodes().size()) << "twice";
        for (unsigned int n = 0; n < sums.size(); ++n)
          if (sums[n][NodalSum<dim>::mass] > 0.)
            {
              EXPECT_EQ(active.count(n), 1u) << n;
            }
        core.nodes.clear();
        for (unsigned int n = 0; n < sums.size(); ++n)
          for (unsigned int c = 0; c < n_lanes; ++c)
            EXPECT_EQ(core.nodes.sum(n)[c], 0.);
      }
  }



  TEST(Transfer, ReachedNodesAreActive)
  {
    expect_reached_nodes_active<2>();
    expect_reached_nodes_active<3>();
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
      for (unsigned int d = 0; d < dim; ++d)
        {
          double *v                          = core.nodes.motion(n);
          v[NodalMotion<dim>::velocity + d]  = velocity(places[n])[d];
          v[NodalMotion<dim>::increment + d] = increment(places[n])[d];
        }
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



  /// Those that get no number for a place, too.
  template <int dim>
  void
  expect_strays(Core<dim> &core)
  {
    const LinearField<dim> velocity(core), increment(core);
    set_motion(core, velocity, increment);
    auto &points                                             = core.points;
    core.nodes.motion(core.nodes.active_nodes()[0])[dim - 1] = std::nan("");
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
    std::sort(points.strays().begin(), points.strays().end());
    EXPECT_EQ(points.strays(), left);
  }



  TEST(Transfer, GatherNotesThoseThatLeaveTheirCell)
  {
    on_both_meshes<2>("", expect_strays<2>);
    on_both_meshes<3>("", expect_strays<3>);
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

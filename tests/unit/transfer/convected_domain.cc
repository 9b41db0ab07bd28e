// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/convected_domain.h>

#include "weights_setup.h"

namespace
{
  // Points whose domains go with F: any rotation, stretch and shear.

  const std::string convected =
    in_section("Transfer", "set Box rule = convected domain");

  template <int dim>
  Tensor<2, dim>
  identity()
  {
    return dealii::unit_symmetric_tensor<dim>();
  }



  /// Proper rotation by angles up to pi about each pair of axes.
  template <int dim>
  Tensor<2, dim>
  random_rotation(Core<dim> &core)
  {
    Tensor<2, dim> R = identity<dim>();
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < i; ++j)
        {
          const double   angle = core.number(-M_PI, M_PI);
          Tensor<2, dim> Q     = identity<dim>();
          Q[i][i] = Q[j][j] = std::cos(angle);
          Q[i][j]           = -std::sin(angle);
          Q[j][i]           = std::sin(angle);
          R                 = Q * R;
        }
    return R;
  }



  /// F that is no farther from a rotation than @p distortion.
  template <int dim>
  Tensor<2, dim>
  random_deformation(Core<dim> &core, const double distortion)
  {
    return random_rotation(core) *
           (identity<dim>() + core.tensor(-distortion, distortion));
  }



  template <int dim>
  unsigned int
  add_point(Core<dim>            &core,
            const Point<dim>     &x,
            const Tensor<1, dim> &length,
            const Tensor<2, dim> &F)
  {
    const unsigned int p = core.add(x, length);
    core.randomize(p);
    core.set_deformation(p, F);
    begin_stretch(core.points, p, p + 1, BoxRule::convected_domain);
    return p;
  }



  template <int dim>
  ConvectedDomain<dim>
  domain_of(const Core<dim> &core, const unsigned int p)
  {
    const Point<dim> x(core.get(core.points.position, p));
    return ConvectedDomain<dim>(core.points,
                                core.grid,
                                core.transfer.box_shape(),
                                core.grid.find_cell(x),
                                p);
  }



  /// By node, hanging nodes passed on to their masters.
  template <int dim>
  Weights<dim>
  weights_of(const Core<dim> &core, const unsigned int p)
  {
    const Point<dim> x(core.get(core.points.position, p));
    std::map<unsigned int, const HangingNode *> hanging;
    for (const HangingNode &node : core.grid.hanging_nodes())
      hanging[node.node] = &node;
    std::vector<NodeWeight<dim>> list;
    weights_of_point(core.points,
                     core.grid,
                     core.transfer.box_shape(),
                     core.grid.find_cell(x),
                     p,
                     list);
    Weights<dim> weights;
    const auto add = [&](const unsigned int node, const double share, auto w) {
      weights[node].value += share * w.value;
      weights[node].gradient += share * w.gradient;
    };
    for (const auto &w : list)
      if (const auto it = hanging.find(w.node); it != hanging.end())
        for (const auto &[master, share] : it->second->masters)
          add(master, share, w);
      else
        add(w.node, 1., w);
    return weights;
  }



  // ------------------------------------------------------------ invariants

  /// Sum S = 1, sum grad S = 0, and in the interior sum S x = x_p and
  /// sum x (x) grad S = 1, whatever is clipped.
  template <int dim>
  void
  expect_reproduction(Core<dim>    &core,
                      const double  margin,
                      unsigned int &n_clipped)
  {
    const auto places = places_of_nodes(core.grid);
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const auto     p   = add_point(core,
                                 core.place(margin),
                                 core.vector(0.02, 1.2),
                                 random_deformation(core, 0.4));
        double         one = 0;
        Tensor<1, dim> x, zero;
        Tensor<2, dim> slope;
        for (const auto &[node, weight] : weights_of(core, p))
          {
            EXPECT_GE(weight.value, 0.);
            one += weight.value;
            zero += weight.gradient;
            x += weight.value * places[node];
            slope += outer_product(places[node], weight.gradient);
          }
        const double scale = zero.norm() + slope.norm();
        EXPECT_NEAR(one, 1., 4e-15);
        EXPECT_LT(zero.norm(), 1e-12 * scale);
        n_clipped += domain_of(core, p).n_clipped();
        if (margin <= 0)
          continue;
        EXPECT_LT((x - core.get(core.points.position, p)).norm(), 1e-14);
        slope -= identity<dim>();
        EXPECT_LT(slope.norm(), 1e-12);
      }
  }



  template <int dim>
  void
  expect_reproduction()
  {
    unsigned int n_clipped = 0;
    Core<dim>    core(cube<dim>() + convected);
    expect_reproduction(core, 1., n_clipped);
    expect_reproduction(core, -0.2, n_clipped);
    refine_corner(core);
    expect_reproduction(core, 1., n_clipped);
    expect_reproduction(core, -0.2, n_clipped);
    core.refine([](const Point<dim> &x) { return x.norm() < 0.6; });
    expect_reproduction(core, 1., n_clipped);
    EXPECT_GT(n_clipped, 1000u);
  }



  TEST(ConvectedDomains, UnityAndLinearReproduction)
  {
    expect_reproduction<2>();
    expect_reproduction<3>();
  }



  // ------------------------------------------------------------ closed forms

  /// The formula of the source for r1, r2, the edges of the parallelogram,
  /// whose corners 1 to 4 go around counterclockwise, @cite sadeghirad2011.
  Sum<2>
  published_formula(const std::array<double, 4> &N,
                    const Tensor<1, 2>          &r1,
                    const Tensor<1, 2>          &r2)
  {
    const double V = r1[0] * r2[1] - r1[1] * r2[0];
    Sum<2>       sum;
    sum.value = 0.25 * (N[0] + N[1] + N[2] + N[3]);
    sum.gradient[0] =
      0.5 / V *
      ((N[0] - N[2]) * (r1[1] - r2[1]) + (N[1] - N[3]) * (r1[1] + r2[1]));
    sum.gradient[1] =
      0.5 / V *
      ((N[0] - N[2]) * (r2[0] - r1[0]) - (N[1] - N[3]) * (r1[0] + r2[0]));
    return sum;
  }



  /// The shape function of a node of a mesh of cells of 1 m.
  double
  hat(const Point<2> &node, const Point<2> &x)
  {
    return std::max(0., 1. - std::abs(x[0] - node[0])) *
           std::max(0., 1. - std::abs(x[1] - node[1]));
  }



  TEST(ConvectedDomains, PublishedFormula)
  {
    Core<2>    core(cube<2>() + convected);
    const auto places = places_of_nodes(core.grid);
    for (unsigned int i = 0; i < 500; ++i)
      {
        const auto p = add_point(core,
                                 core.place(1.),
                                 core.vector(0.4, 0.8),
                                 random_deformation(core, 0.2));
        ASSERT_EQ(domain_of(core, p).n_clipped(), 0u);
        const Tensor<1, 2> r1 = transpose(core.edges(p))[0];
        const Tensor<1, 2> r2 = transpose(core.edges(p))[1];
        const Point<2>     x(core.get(core.points.position, p));
        Weights<2>         expected;
        for (unsigned int n = 0; n < places.size(); ++n)
          {
            const auto N = [&](const double a, const double b) {
              return hat(places[n], x + 0.5 * (a * r1 + b * r2));
            };
            expected[n] =
              published_formula({{N(-1, -1), N(1, -1), N(1, 1), N(-1, 1)}},
                                r1,
                                r2);
          }
        expect_equal(weights_of(core, p), expected, 1e-13);
      }
  }



  /// Inside a cell, where no shape function has a kink, a domain that is a box
  /// has the weights of the box.
  template <int dim>
  void
  expect_weights_of_box()
  {
    Core<dim> core(cube<dim>() + convected);
    for (unsigned int i = 0; i < 200; ++i)
      {
        const auto length = core.vector(0.2, 0.4);
        Point<dim> x(core.vector(1.2, 1.8));
        const auto p = add_point(core, x, length, identity<dim>());
        expect_equal(weights_of(core, p),
                     by_definition(core.grid, x, 0.5 * length),
                     1e-14);
      }
  }



  TEST(ConvectedDomains, BoxInsideACell)
  {
    expect_weights_of_box<2>();
    expect_weights_of_box<3>();
  }



  // ------------------------------------------------------------------ limits

  /// A layer that is sheared until nothing is left of its thickness.
  TEST(ConvectedDomains, SidesAreKeptApart)
  {
    Core<2>      core(cube<2>() + convected);
    Tensor<2, 2> F;
    F[0][0] = F[1][1] = 1.;
    F[0][1]           = 1.5;
    const auto p = add_point(core, Point<2>(2.1, 2.2), Point<2>(0.5, 0.05), F);
    const auto domain = domain_of(core, p);
    EXPECT_EQ(domain.n_clipped(), 1u);
    // Edge 2 is (0.075, 0.05): 0.05 is widened to 0.2, x is left.
    const Tensor<1, 2> across = domain.corner(2) - domain.corner(0);
    EXPECT_NEAR(across[0], 0.075, 1e-15);
    EXPECT_NEAR(across[1], 0.2, 1e-15);
    const Tensor<1, 2> along = domain.corner(1) - domain.corner(0);
    EXPECT_NEAR(along[0], 0.5, 1e-15);
    EXPECT_NEAR(along[1], 0., 1e-15);
  }



  TEST(ConvectedDomains, CornersStayInTheCellsAround)
  {
    Core<2>      core(cube<2>() + convected);
    Tensor<2, 2> F;
    F[0][0]        = 3.;
    F[1][1]        = 1.;
    const auto far = [&](const Point<2> &x) {
      const auto domain =
        domain_of(core, add_point(core, x, Point<2>(0.8, 0.5), F));
      EXPECT_EQ(domain.n_clipped(), 1u);
      return 0.5 * (domain.corner(3) - domain.corner(0));
    };
    // Half of 2.4 m is more than a cell, also than a smaller one nearby.
    EXPECT_NEAR(far(Point<2>(2.5, 2.5))[0], 1., 1e-15);
    EXPECT_NEAR(far(Point<2>(2.5, 2.5))[1], 0.25, 1e-15);
    refine_corner(core);
    EXPECT_NEAR(far(Point<2>(3.5, 3.5))[0], 1., 1e-15);
    EXPECT_NEAR(far(Point<2>(2.5, 1.5))[0], 0.5, 1e-15);
    EXPECT_NEAR(far(Point<2>(1.5, 1.5))[0], 0.5, 1e-15);
  }



  // ---------------------------------------------------------------- splitting

  /// A place to 1e-9, so that equal ones compare equal.
  template <int dim>
  std::array<double, dim>
  rounded(const Point<dim> &x)
  {
    std::array<double, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = 1e-9 * std::round(1e9 * x[d]);
    return result;
  }



  /// Corners of the domains of all points, sorted by where they are.
  template <int dim>
  std::vector<std::array<double, dim>>
  all_corners(const Core<dim> &core)
  {
    std::vector<std::array<double, dim>> corners;
    for (unsigned int p = 0; p < core.points.size(); ++p)
      for (unsigned int v = 0; v < (1u << dim); ++v)
        {
          const Point<dim> x = domain_of(core, p).corner(v);
          corners.push_back(rounded(x));
        }
    std::sort(corners.begin(), corners.end());
    return corners;
  }



  /// The lattice of corners that tiles the domain of point @p p: each edge in
  /// two, inner places belonging to several children.
  template <int dim>
  std::vector<std::array<double, dim>>
  tiling(const Core<dim> &core, const unsigned int p)
  {
    const auto                           domain = domain_of(core, p);
    std::vector<std::array<double, dim>> corners;
    for (unsigned int child = 0; child < (1u << dim); ++child)
      for (unsigned int v = 0; v < (1u << dim); ++v)
        {
          // Half way between corner of child and corner v of the parent.
          const Point<dim> x = domain.corner(child) +
                               0.5 * (domain.corner(v) - domain.corner(child));
          corners.push_back(rounded(x));
        }
    std::sort(corners.begin(), corners.end());
    return corners;
  }



  template <int dim>
  void
  expect_children_to_tile()
  {
    for (unsigned int i = 0; i < 100; ++i)
      {
        Core<dim> core(cube<dim>() + convected + splitting_along("all"));
        core.random.seed(i);
        const auto p = add_point(core,
                                 core.place(1.),
                                 core.vector(0.5, 0.7),
                                 random_deformation(core, 0.1));
        core.points.data(core.points.length_at_creation)[p] *= 0.5;
        ASSERT_EQ(domain_of(core, p).n_clipped(), 0u);
        const auto   expected = tiling(core, p);
        const double volume   = core.volume(p);
        core.sort();
        ASSERT_TRUE(core.split());
        ASSERT_EQ(core.points.size(), 1u << dim);
        EXPECT_EQ(all_corners(core), expected);
        EXPECT_NEAR(core.volume(p), volume / (1u << dim), 1e-15);
      }
  }



  TEST(ConvectedDomains, ChildrenTileAtAnyRotation)
  {
    expect_children_to_tile<2>();
    expect_children_to_tile<3>();
  }



  /// What nodes hold in all: mass, moment of mass, and the moment of the
  /// forces, which is minus the volume times the stress.
  template <int dim>
  Tensor<2, dim + 2>
  totals(Core<dim> &core)
  {
    const auto         sums   = core.scatter();
    const auto         places = places_of_nodes(core.grid);
    Tensor<2, dim + 2> total;
    for (unsigned int n = 0; n < sums.size(); ++n)
      {
        total[dim][dim] += sums[n][SumIndex<dim>::mass];
        for (unsigned int i = 0; i < dim; ++i)
          {
            const double f = sums[n][SumIndex<dim>::force + i];
            total[dim][i] += sums[n][SumIndex<dim>::mass] * places[n][i];
            total[i][dim] += sums[n][SumIndex<dim>::momentum + i];
            total[dim + 1][i] += f;
            for (unsigned int j = 0; j < dim; ++j)
              total[i][j] += f * places[n][j];
          }
      }
    return total;
  }



  template <int dim>
  void
  expect_totals_to_stay(const bool hanging_nodes)
  {
    for (unsigned int i = 0; i < 20; ++i)
      {
        Core<dim> core(cube<dim>() + convected + splitting_along("stretched"));
        core.random.seed(i);
        if (hanging_nodes)
          refine_corner(core);
        const auto p = add_point(core,
                                 core.place(1.),
                                 core.vector(0.5, 0.6),
                                 random_deformation(core, 0.2));
        core.points.data(core.points.length_at_creation)[p] *= 0.5;
        core.sort();
        const auto before = totals(core);
        ASSERT_TRUE(core.split());
        core.sort();
        const auto after = totals(core);
        EXPECT_LT((after - before).norm(), 1e-13 * before.norm());
      }
  }



  /// Single nodes do change: there are more corners than before.
  TEST(ConvectedDomains, SplitsKeepTheTotals)
  {
    expect_totals_to_stay<2>(false);
    expect_totals_to_stay<3>(false);
    expect_totals_to_stay<2>(true);
    expect_totals_to_stay<3>(true);
  }
} // namespace

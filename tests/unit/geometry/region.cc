// SPDX-License-Identifier: LGPL-2.1-or-later
// Simplices cut by a plane, and how much of a box lies in a region.

#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/polygon.h>
#include <talus/geometry/region.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;
  constexpr double pi = dealii::numbers::PI;

  /// Volume and first moment.
  template <int dim, typename Simplices>
  std::pair<double, Tensor<1, dim>>
  moments(const Simplices &simplices)
  {
    std::pair<double, Tensor<1, dim>> sum;
    for (const Simplex<dim> &simplex : simplices)
      {
        sum.first += volume<dim>(simplex);
        sum.second += volume<dim>(simplex) * centroid<dim>(simplex);
      }
    return sum;
  }



  /// Both sides of random cuts, corners on the cut among them: they tile the
  /// simplex, the facet is on the plane and, by the divergence theorem for
  /// x / dim seen from a place on it, is the only face of the part that was not
  /// one of the simplex.
  template <int dim>
  void
  cut_at_random()
  {
    std::mt19937                           random(1);
    std::uniform_real_distribution<double> number(-1., 1.);
    for (unsigned int i = 0; i < 500; ++i)
      {
        Simplex<dim>   simplex;
        Tensor<1, dim> gradient;
        for (unsigned int d = 0; d < dim; ++d)
          {
            gradient[d] = number(random);
            for (auto &corner : simplex)
              corner[d] = number(random);
          }
        // Through a corner in every third case.
        const Point<dim> origin = i % 3 == 0 ? simplex[i % dim] : Point<dim>();
        std::array<double, dim + 1> values, negative;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            values[v]   = (simplex[v] - origin) * gradient;
            negative[v] = -values[v];
          }
        const auto below = clip_simplex<dim>(simplex, values);
        const auto above = clip_simplex<dim>(simplex, negative);
        const auto a     = moments<dim>(below.parts);
        const auto b     = moments<dim>(above.parts);
        EXPECT_NEAR(a.first + b.first, volume<dim>(simplex), 1e-14);
        const Tensor<1, dim> whole =
          volume<dim>(simplex) * centroid<dim>(simplex);
        EXPECT_LT((a.second + b.second - whole).norm(), 1e-14);
        for (const auto &x : below.facet)
          EXPECT_NEAR((x - origin) * gradient, 0., 1e-14);
        if (i % 3 != 0)
          {
            EXPECT_EQ(below.facet.empty(), above.facet.empty());
          }
        if (below.facet.empty() || above.facet.empty())
          continue;
        const Tensor<1, dim> area = vector_area<dim>(below.facet);
        EXPECT_GT(area * gradient, -1e-14);
        EXPECT_NEAR(area * gradient, area.norm() * gradient.norm(), 1e-14);
        EXPECT_LT((area + vector_area<dim>(above.facet)).norm(), 1e-14);
        EXPECT_LT(
          (centroid<dim>(below.facet) - centroid<dim>(above.facet)).norm(),
          1e-12);
      }
  }



  TEST(ClipSimplex, BothSidesTileIt)
  {
    cut_at_random<2>();
    cut_at_random<3>();
  }



  /// Cut across x + y (+ z) = s, whose facet is known, so that the faces inside
  /// are found to have no area.
  TEST(ClipSimplex, FacetHasItsArea)
  {
    const Simplex<3> corner = {{Point<3>(0, 0, 0),
                                Point<3>(1, 0, 0),
                                Point<3>(0, 1, 0),
                                Point<3>(0, 0, 1)}};
    for (const double s : {0.1, 0.5, 0.9})
      {
        const auto below = clip_simplex<3>(corner, {{-s, 1 - s, 1 - s, 1 - s}});
        EXPECT_NEAR(moments<3>(below.parts).first, s * s * s / 6., 1e-15);
        EXPECT_LT((vector_area<3>(below.facet) -
                   0.5 * s * s * Tensor<1, 3>({1., 1., 1.}))
                    .norm(),
                  1e-15);
        EXPECT_LT(centroid<3>(below.facet).distance(Point<3>(s, s, s) / 3.),
                  1e-15);
      }
    // Two corners on each side: a quadrilateral between the middles of edges.
    const auto half = clip_simplex<3>(corner, {{-1., -1., 1., 1.}});
    EXPECT_NEAR(moments<3>(half.parts).first, 1. / 12., 1e-15);
    ASSERT_EQ(half.facet.size(), 4u);
    EXPECT_NEAR(vector_area<3>(half.facet).norm(), 0.25 * std::sqrt(2.), 1e-15);
  }



  /// A face on the cut belongs to one of the two simplices beside it.
  TEST(ClipSimplex, FacesOnTheCutCountOnce)
  {
    const Simplex<2> triangle = {
      {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)}};
    EXPECT_TRUE(clip_simplex<2>(triangle, {{0., 0., -1.}}).facet.empty());
    const auto above = clip_simplex<2>(triangle, {{0., 0., 1.}});
    EXPECT_EQ(moments<2>(above.parts).first, 0.);
    EXPECT_EQ(vector_area<2>(above.facet), Point<2>(0., 1.));
  }



  /// Volume and first moment of all boxes of a lattice of @p n per axis over
  /// (-1, 1)^dim.
  template <int dim>
  std::pair<double, Tensor<1, dim>>
  lattice_sum(const Region<dim> &region, const unsigned int n)
  {
    std::pair<double, Tensor<1, dim>> sum;
    for (unsigned int i = 0; i < std::pow(n, dim); ++i)
      {
        Box<dim>     box;
        unsigned int at = i;
        for (unsigned int d = 0; d < dim; ++d, at /= n)
          {
            box.lower[d] = -1. + 2. * (at % n) / n;
            box.upper[d] = -1. + 2. * (at % n + 1) / n;
          }
        const PartInside<dim> part = region.part_inside(box);
        sum.first += part.volume;
        sum.second += part.volume * part.centroid;
        EXPECT_GE(part.volume, 0.);
      }
    return sum;
  }



  TEST(Region, PlanesAreExact)
  {
    // x + y < 0.3 and x - y < 0.2, which meet at a right angle.
    const HalfSpace<2> a(Point<2>(0.3, 0.), Point<2>(1., 1.)),
      b(Point<2>(0.2, 0.), Point<2>(1., -1.));
    Region<2> one(a), both(a), other(a);
    both.restrict_to(b);
    other.cut_away({&b});
    // A square of side 2 without the triangle beyond x + y = 0.3.
    EXPECT_NEAR(lattice_sum(one, 5).first, 4. - 1.7 * 1.7 / 2., 1e-14);
    // Its mean x: the triangle's centroid is at 1 - 1.7/3.
    EXPECT_NEAR(lattice_sum(one, 5).second[0],
                -1.7 * 1.7 / 2. * (1. - 1.7 / 3.),
                1e-14);
    EXPECT_NEAR(lattice_sum(both, 5).first + lattice_sum(other, 5).first,
                lattice_sum(one, 5).first,
                1e-14);
    // What lies left of the corner at (0.25, 0.05), between the two lines: a
    // triangle with a right angle there, cut off by the edge x = -1 of the
    // square, and by its upper and lower edges.
    EXPECT_NEAR(lattice_sum(both, 5).first,
                1.25 * 1.25 - (0.3 * 0.3 + 0.2 * 0.2) / 2.,
                1e-14);
    const HalfSpace<3> c(Point<3>(), Point<3>(1., 2., -3.));
    EXPECT_NEAR(lattice_sum(Region<3>(c), 3).first, 4., 1e-14);
  }



  /// Relative error of the volume on lattices of @p n and twice as many boxes
  /// per axis: at most @p tolerance, and half of that.
  template <int dim>
  void
  expect_volume(const Region<dim> &region,
                const double       exact,
                const unsigned int n,
                const double       tolerance)
  {
    const double coarse = std::abs(lattice_sum(region, n).first / exact - 1.),
                 fine = std::abs(lattice_sum(region, 2 * n).first / exact - 1.);
    std::cout << "relative errors " << coarse << ", " << fine << std::endl;
    EXPECT_LT(coarse, tolerance);
    EXPECT_LT(fine, 0.5 * tolerance);
  }



  TEST(Region, CurvedOnes)
  {
    const Ball<2> disc(Point<2>(0.1, -0.05), 0.7), ring(Point<2>(), 0.9, 0.4);
    expect_volume(Region<2>(disc), pi * 0.49, 5, 1e-3);
    expect_volume(Region<2>(ring), pi * (0.81 - 0.16), 5, 1e-3);
    const Ball<3> ball(Point<3>(0.1, -0.05, 0.), 0.7);
    expect_volume(Region<3>(ball), 4. / 3. * pi * 0.343, 3, 2e-3);
    const auto sum = lattice_sum(Region<2>(disc), 10);
    EXPECT_LT((sum.second / sum.first - Point<2>(0.1, -0.05)).norm(), 1e-5);
  }



  // The surface of the disc, minus a solid, crosses or surrounds some boxes.
  TEST(Region, BoxesThatMayOverlap)
  {
    const Ball<2> disc(Point<2>(0.1, -0.05), 0.7);
    const Ball<2> solid(Point<2>(0.1, 0.4), 0.5);
    Region<2>     region(disc);
    region.cut_away({&solid});
    constexpr unsigned int n         = 40;
    unsigned int           n_outside = 0;
    for (unsigned int i = 0; i < n * n; ++i)
      {
        const Point<2> lower(-2. + 4. * (i % n) / n, -2. + 4. * (i / n) / n);
        const Box<2>   box{lower, lower + Point<2>(4. / n, 4. / n)};
        if (region.may_overlap(box))
          continue;
        ++n_outside;
        EXPECT_EQ(region.part_inside(box).volume, 0.);
      }
    // Only boxes beside the surface are in doubt: at most a ring of two boxes.
    EXPECT_GT(n_outside, 0.85 * n * n);
    EXPECT_TRUE(region.may_overlap({Point<2>(-9., -9.), Point<2>(9., 9.)}));
  }



  // Smaller than the boxes, and between their nodes.
  TEST(Region, SmallAndThinOnes)
  {
    const Ball<2> pipe(Point<2>(0.05, 0.07), 0.15);
    expect_volume(Region<2>(pipe), pi * 0.0225, 1, 2e-2);
    const BoxRegion<2> layer({Point<2>(-1., 0.03), Point<2>(1., 0.06)});
    expect_volume(Region<2>(layer), 0.06, 5, 1e-3);
    const BoxRegion<3> plate(
      {Point<3>(-1., 0.03, -1.), Point<3>(1., 0.15, 1.)});
    expect_volume(Region<3>(plate), 0.48, 4, 5e-3);
  }



  /// Ball that counts the calls of signed_distance().
  struct CountedBall : Ball<3>
  {
    using Ball<3>::Ball;

    double
    signed_distance(const Point<3> &x) const override
    {
      ++n_questions;
      return Ball<3>::signed_distance(x);
    }

    mutable unsigned int n_questions = 0;
  };



  // Where the two surfaces of a layer coincide there is no soil, and boxes are
  // not halved down to the largest depth, with 13 000 calls.
  TEST(Region, BetweenSurfacesThatCoincide)
  {
    const CountedBall ball(Point<3>(), 1.);
    Region<3>         region(ball);
    region.cut_away({&ball});
    const auto part =
      region.part_inside({Point<3>(0.4, 0.4, 0.4), Point<3>(0.8, 0.8, 0.8)});
    EXPECT_EQ(part.volume, 0.);
    EXPECT_LT(ball.n_questions, 64u * 32u);
    EXPECT_GT(ball.n_questions, 64u);
  }



  // Corners lie between the nodes.
  TEST(Region, PolygonsToTheirCorners)
  {
    const std::vector<Point<2>> corners = {{-0.83, -0.71},
                                           {0.79, -0.71},
                                           {0.33, 0.57},
                                           {-0.51, 0.57}};
    const double                area    = 0.5 * (1.62 + 0.84) * 1.28;
    expect_volume(Region<2>(Polygon("Vertices", corners)), area, 5, 1e-4);
    const Prism prism(std::make_unique<Polygon>("Vertices", corners),
                      -0.33,
                      0.71);
    expect_volume(Region<3>(prism), area * 1.04, 4, 2e-3);
  }



  // What surfaces on faces of the lattice leave is whole boxes, to the bit.
  TEST(Region, NoSliversOfRoundOff)
  {
    const BoxRegion<2> box({Point<2>(-0.6, -1.), Point<2>(0.2, 0.6)});
    const Region<2>    region(box);
    for (unsigned int i = 0; i < 10; ++i)
      {
        const double x = -1. + 0.2 * i;
        const Box<2> part{Point<2>(x, -0.2), Point<2>(x + 0.2, 0.)};
        const bool   is_inside = i >= 2 && i < 6;
        const auto   found     = region.part_inside(part);
        EXPECT_EQ(found.volume,
                  is_inside ? part.length(0) * part.length(1) : 0.);
      }
  }



  // The mean square distance from the centroid of a triangle with a right angle
  // is leg^2/18 along either leg.
  TEST(Region, Variance)
  {
    const HalfSpace<2> slope(Point<2>(1., 0.), Point<2>(1., 1.));
    const Box<2>       unit{Point<2>(0., 0.), Point<2>(1., 1.)};
    const auto         half = Region<2>(slope).part_inside(unit);
    EXPECT_NEAR(half.volume, 0.5, 1e-15);
    EXPECT_LT((half.variance - Point<2>(1., 1.) / 18.).norm(), 1e-15);
    const HalfSpace<3> above(Point<3>(0., 0.3, 0.), Point<3>(0., -1., 0.));
    const auto         part = Region<3>(above).part_inside(
      {Point<3>(0., 0., 0.), Point<3>(1., 1., 2.)});
    EXPECT_LT((part.variance - Point<3>(1., 0.49, 4.) / 12.).norm(), 1e-14);
    EXPECT_LT(part.centroid.distance(Point<3>(0.5, 0.65, 1.)), 1e-14);
  }



  TEST(Region, ContainsAndDistance)
  {
    const Ball<2>      disc(Point<2>(), 1.);
    const HalfSpace<2> bed(Point<2>(0., -0.5), Point<2>(0., 1.));
    Region<2>          region(disc);
    region.cut_away({&bed});
    EXPECT_TRUE(region.contains(Point<2>(0., -0.5)));
    EXPECT_FALSE(region.contains(Point<2>(0., -0.6)));
    EXPECT_FALSE(region.contains(Point<2>(0., 1.1)));
    EXPECT_DOUBLE_EQ(region.signed_distance(Point<2>(0., -0.4)), -0.1);
    EXPECT_DOUBLE_EQ(region.signed_distance(Point<2>(0., 0.9)), -0.1);
  }
} // namespace

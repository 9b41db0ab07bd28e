// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/edge_reduction.h>
#include <talus/transfer/film.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  Tensor<2, dim>
  identity_tensor()
  {
    return Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  }



  /// Add a point with these edges at creation and now, m.
  template <int dim>
  unsigned int
  add_cell(Core<dim>            &core,
           const Tensor<2, dim> &at_creation,
           const Tensor<2, dim> &now)
  {
    Point<dim>     x;
    Tensor<1, dim> length;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 1.5, length[d] = 0.5;
    const unsigned int p = core.add(x, length);
    core.set(core.points.edges, p, at_creation);
    begin_stretch(core.points, p, p + 1, BoxRule::second_moments);
    core.set(core.points.edges, p, now);
    return p;
  }



  /// Simple shear along the rows, by 1000 in 1e5 steps, without any split.
  template <int dim>
  void
  expect_shear_returns(const Tensor<1, dim> &length)
  {
    Core<dim>  core(cube<dim>());
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 1.5;
    core.add(x, length);
    core.sort();
    const Tensor<2, dim> start   = core.edges(0);
    const unsigned int   n_steps = 100000;
    Tensor<2, dim>       step    = identity_tensor<dim>();
    // Whole units of shear of the lattice.
    step[0][1] = 1000. * (length[0] / length[1]) / n_steps;
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        core.set_deformation(0, step * core.deformation(0));
        reduce_edges(core.points, 0, 1, /*counts_shear=*/false);
        update_box_lengths(core.points, 0, 1, BoxRule::second_moments);
        ASSERT_FALSE(core.split()) << i;
        // The row keeps its height.
        EXPECT_NEAR(core.get(core.points.box_length, 0)[1], length[1], 1e-12);
      }
    EXPECT_LT((core.edges(0) - start).norm(), 1e-9);
    EXPECT_NEAR(determinant(core.deformation(0)), 1., 1e-12);
  }



  TEST(EdgeReduction, SimpleShearReturns)
  {
    expect_shear_returns<2>(Tensor<1, 2>({0.5, 0.5}));
    expect_shear_returns<2>(Tensor<1, 2>({0.5, 0.4}));
    expect_shear_returns<3>(Tensor<1, 3>({0.5, 0.5, 0.3}));
  }



  // In a film one point thick a long edge along the film stays, to be split:
  // the short edge across the film would make it compact, and leave a gap.
  TEST(EdgeReduction, AFilmKeepsItsLongEdges)
  {
    const Tensor<2, 2> start({{0.3, 0.}, {0., 0.2}}),
      stretched({{0.35, 0.}, {0.2, 0.22}});
    for (const bool is_film : {false, true})
      {
        Core<2>            core(cube<2>());
        const unsigned int p = add_cell<2>(core, start, stretched);
        reduce_edges<2>(core.points, 0, 1, false, [&](const unsigned int) {
          return is_film
                   ? std::make_optional(Film<2>{Tensor<1, 2>({0., 1.}), 0.2})
                   : std::nullopt;
        });
        const Tensor<2, 2> reduced = core.edges(p);
        EXPECT_NEAR(determinant(reduced), determinant(stretched), 1e-15);
        EXPECT_EQ(reduced == stretched, is_film);
      }
  }



  // Of four and more points above each other most have neighbours across.
  TEST(EdgeReduction, AFilmOfFourPoints)
  {
    const Tensor<2, 3> start({{0.3, 0., 0.}, {0., 0.2, 0.}, {0., 0., 0.3}}),
      stretched({{0.35, 0., 0.}, {0.2, 0.22, 0.}, {0., 0., 0.3}});
    for (const double thickness : {0., 0.2, 0.87, 0.89})
      {
        Core<3>            core(cube<3>());
        const unsigned int p = add_cell<3>(core, start, stretched);
        reduce_edges<3>(core.points, 0, 1, false, [&](const unsigned int) {
          return thickness > 0.
                   ? std::make_optional(
                       Film<3>{Tensor<1, 3>({0., 1., 0.}), thickness})
                   : std::nullopt;
        });
        EXPECT_EQ(core.edges(p) == stretched,
                  thickness > 0. && thickness < 0.88)
          << thickness;
      }
  }



  // Shear across a film that is one point thick lengthens the edge across the
  // film without end, and neighbours along the film replace it.
  TEST(EdgeReduction, ShearAcrossAFilm)
  {
    const Tensor<2, 3> start({{0.3, 0., 0.}, {0., 0.2, 0.}, {0., 0., 0.3}});
    for (const double angle : {0., 0.5})
      {
        const Tensor<2, 3> turn({{std::cos(angle), -std::sin(angle), 0.},
                                 {std::sin(angle), std::cos(angle), 0.},
                                 {0., 0., 1.}});
        Tensor<2, 3>       shear = identity_tensor<3>();
        shear[0][1]              = 0.05;
        Core<3>            core(cube<3>());
        const unsigned int n = 9;
        for (unsigned int p = 0; p < n; ++p)
          {
            add_cell<3>(core, turn * start, turn * start);
            const Tensor<1, 3> x =
              turn * Tensor<1, 3>({0.3 * (p / 3), 0., 0.3 * (p % 3)});
            for (unsigned int d = 0; d < 3; ++d)
              core.points.data(core.points.position, d)[p] = 1.5 + x[d];
          }
        for (unsigned int i = 0; i < 200; ++i)
          {
            for (unsigned int p = 0; p < n; ++p)
              core.set(core.points.edges,
                       p,
                       turn * shear * transpose(turn) * core.edges(p));
            const Film<3> film = film_of(core.points, 0, n);
            reduce_edges<3>(core.points, 0, n, false, [&](const unsigned int) {
              return film;
            });
          }
        for (unsigned int p = 0; p < n; ++p)
          for (unsigned int k = 0; k < 3; ++k)
            EXPECT_LT(transpose(core.edges(p))[k].norm(), 0.32) << angle;
      }
  }



  TEST(EdgeReduction, NormalAndThicknessOfAFilm)
  {
    Core<3>            core(cube<3>());
    const Tensor<1, 3> length({0.25, 0.1, 0.25});
    const double       angle = 0.4;
    const Tensor<2, 3> turn({{std::cos(angle), -std::sin(angle), 0.},
                             {std::sin(angle), std::cos(angle), 0.},
                             {0., 0., 1.}});
    for (int i = -2; i < 2; ++i)
      for (int j = -1; j < 2; ++j)
        for (int k = -2; k < 2; ++k)
          {
            const Tensor<1, 3> x =
              turn *
              Tensor<1, 3>({0.25 * (i + 0.5), 0.1 * j, 0.25 * (k + 0.5)});
            const unsigned int p =
              core.add(Point<3>(1.5, 1.5, 1.5) + x, length);
            core.set(core.points.edges, p, turn * core.edges(p));
          }
    const Film<3> film = film_of(core.points, 0, core.points.size());
    EXPECT_NEAR(film.thickness, 0.3, 1e-12);
    EXPECT_NEAR(std::abs(film.normal * (turn * Tensor<1, 3>({0., 1., 0.}))),
                1.,
                1e-12);
  }



  // A layer of one cell is a film; the surface of a thick layer is none.
  TEST(EdgeReduction, WhatIsAFilm)
  {
    for (const auto &[height, is_thin] : std::vector<std::pair<double, bool>>{
           {0.4, true}, {1., true}, {1.7, false}})
      {
        Core<2>            core(cube<2>());
        const unsigned int n_rows = 4;
        const Tensor<1, 2> length({0.25, height / n_rows});
        for (unsigned int row = 0; row < n_rows; ++row)
          for (unsigned int i = 0; i < 12; ++i)
            core.add(Point<2>(0.25 * (i + 0.5), length[1] * (row + 0.5)),
                     length);
        core.sort();
        core.scatter();
        const unsigned int cell =
          core.grid.find_cell(Point<2>(1.5, 0.9 * height));
        EXPECT_EQ(is_film(core.grid.cells()[cell], core.nodes), is_thin)
          << height;
        sum_volumes(core.points, core.grid, core.nodes);
        EXPECT_EQ(is_film(core.grid.cells()[cell], core.nodes), is_thin)
          << height;
      }
  }



  /// Largest component of an edge along another edge, or along the sum or
  /// difference of two others, in lengths of the latter.
  template <int dim>
  double
  largest_overlap(const Tensor<2, dim> &A)
  {
    const Tensor<2, dim> rows   = transpose(A);
    double               result = 0;
    for (unsigned int k = 0; k < dim; ++k)
      for (const double s : {-1., 0., 1.})
        for (const double t : {-1., 0., 1.})
          {
            if ((s == 0 && t == 0) || (dim == 2 && t != 0))
              continue;
            const Tensor<1, dim> v =
              s * rows[(k + 1) % dim] + t * rows[(k + 2) % dim];
            result = std::max(result, std::abs(rows[k] * v) / v.norm_square());
          }
    return result;
  }



  /// Edges of a cube of 0.5 m, multiplied by an integer matrix of determinant 1
  /// and turned: reduction must find short edges of the same lattice.
  template <int dim>
  void
  expect_same_lattice(const unsigned int seed)
  {
    Core<dim> core(cube<dim>());
    core.random.seed(seed);
    Tensor<2, dim> A = core.tensor(-0.1, 0.1) + 0.5 * identity_tensor<dim>();
    for (unsigned int i = 0; i < 6; ++i)
      {
        Tensor<2, dim>     M = identity_tensor<dim>();
        const unsigned int j = (i + seed) % dim;
        M[j][(j + 1 + i / dim) % dim] += (i % 2 == 0 ? 1. : -1.);
        if (determinant(M) == 1.)
          A = A * M;
      }
    // Small at creation: all edges have grown, beyond the largest growth.
    const unsigned int p = add_cell<dim>(core, 0.01 * A, A);
    reduce_edges(core.points, 0, 1, false);
    const Tensor<2, dim> reduced = core.edges(p);
    EXPECT_NEAR(determinant(reduced), determinant(A), 1e-12);
    EXPECT_LE(largest_overlap(reduced), 0.6);
    const Tensor<2, dim> M = invert(A) * reduced;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        EXPECT_NEAR(M[i][j], std::round(M[i][j]), 1e-9);
    // A second call changes nothing, not even a bit.
    const Tensor<2, dim> before = core.edges(p);
    reduce_edges(core.points, 0, 1, false);
    EXPECT_EQ(core.edges(p), before);
  }



  TEST(EdgeReduction, KeepsTheLattice)
  {
    for (unsigned int seed = 0; seed < 50; ++seed)
      {
        expect_same_lattice<2>(seed);
        expect_same_lattice<3>(seed);
      }
  }



  // Lattice of sums: edge 2 is short only as a_2 - a_0 - a_1. Pairs do not find
  // the sum, as the components along a_0 and a_1 are 0.55.
  TEST(EdgeReduction, SumOfTwoEdges)
  {
    Core<3>      core(cube<3>());
    Tensor<2, 3> A = identity_tensor<3>();
    A[0][1]        = -0.4; // a_0 . a_1 = -0.4
    A[0][2]        = 0.55;
    A[1][2]        = 0.55;
    A[2][2]        = 0.1;
    A *= 0.5;
    add_cell<3>(core, 0.15 * A, A);
    const double before = edge_of_cell(core.points, 2, 0).norm();
    reduce_edges(core.points, 0, 1, false);
    EXPECT_LT(edge_of_cell(core.points, 2, 0).norm(), 0.9 * before);
    EXPECT_LE(largest_overlap(core.edges(0)), 0.6);
  }



  /// Number of edges that change.
  unsigned int
  n_changed(const Tensor<2, 2> &at_creation, const Tensor<2, 2> &now)
  {
    Core<2>            core(cube<2>());
    const unsigned int p = add_cell<2>(core, at_creation, now);
    reduce_edges(core.points, 0, 1, false);
    unsigned int n = 0;
    for (unsigned int k = 0; k < 2; ++k)
      n += (transpose(core.edges(p))[k] - transpose(now)[k]).norm() > 1e-12;
    return n;
  }



  TEST(EdgeReduction, HysteresisAndGrowth)
  {
    const auto cell = [](const double x) {
      return Tensor<2, 2>({{1., x}, {0., 1.}});
    };
    EXPECT_EQ(n_changed(cell(0.), cell(0.6 - 1e-9)), 0u);
    EXPECT_EQ(n_changed(cell(0.), cell(0.6 + 1e-9)), 1u);
    // Flat or oblique at creation, as at a clipped surface: not grown.
    EXPECT_EQ(n_changed(cell(0.7), cell(0.7)), 0u);
    EXPECT_EQ(n_changed(cell(0.7), cell(0.9)), 0u);  // |a| times 1.10
    EXPECT_EQ(n_changed(cell(0.7), cell(1.05)), 1u); // 1.19
  }



  // A film one point thick: the long edge must not be shortened along the short
  // edge, across which there is no neighbour, unless the splitter cannot split
  // the long edge.
  TEST(EdgeReduction, FilmKeepsItsLongEdge)
  {
    const auto cell = [](const double length) {
      return Tensor<2, 2>({{length, 0.2}, {0., 0.3}});
    };
    EXPECT_EQ(n_changed(cell(1.), cell(3.)), 0u);
    EXPECT_EQ(n_changed(cell(1.), cell(4.59)), 0u);
    EXPECT_EQ(n_changed(cell(1.), cell(4.61)), 1u);
  }



  // Where shear is counted, only edges that would take the digits of the
  // determinant are shortened.
  TEST(EdgeReduction, CountedShearEndsAtALargeStretch)
  {
    for (const double gamma : {900., 1100.})
      {
        Core<2>      core(cube<2>());
        Tensor<2, 2> A = 0.5 * identity_tensor<2>();
        A[0][1]        = 0.5 * gamma;
        add_cell<2>(core, 0.5 * identity_tensor<2>(), A);
        reduce_edges(core.points, 0, 1, /*counts_shear=*/true);
        EXPECT_EQ(core.edges(0).norm() < 1., gamma > 1000.);
        EXPECT_NEAR(core.volume(0), 0.25, 1e-12);
      }
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>

#include "weights_setup.h"

namespace
{
  /// Places along an axis and their weights for the mean over [a, b]: two Gauss
  /// points in each part between the lines of the finest lattice.
  template <int dim>
  std::vector<std::pair<double, double>>
  abscissae(const Grid<dim>   &grid,
            const unsigned int d,
            const double       a,
            const double       b)
  {
    std::vector<double> cuts{a};
    for (double x = grid.domain().lower[d]; x < grid.domain().upper[d] + 1e-12;
         x += grid.finest_size())
      if (x > a && x < b)
        cuts.push_back(x);
    cuts.push_back(b);
    const dealii::QGauss<1>                gauss(2);
    std::vector<std::pair<double, double>> result;
    for (unsigned int i = 0; i + 1 < cuts.size(); ++i)
      for (unsigned int q = 0; q < gauss.size(); ++q)
        result.emplace_back(cuts[i] +
                              gauss.point(q)[0] * (cuts[i + 1] - cuts[i]),
                            gauss.weight(q) * (cuts[i + 1] - cuts[i]) /
                              (b - a));
    return result;
  }



  /// Add the shape functions at @p x, by deal.II. Outside of the mesh they are
  /// continued constantly along the normal.
  template <int dim>
  void
  add_shape_functions(const Grid<dim>  &grid,
                      const Point<dim> &x,
                      const double      weight,
                      Weights<dim>     &weights)
  {
    const dealii::FE_Q<dim> fe(1);
    Point<dim>              inside;
    for (unsigned int d = 0; d < dim; ++d)
      inside[d] =
        std::clamp(x[d], grid.domain().lower[d], grid.domain().upper[d]);
    for (const auto &cell : grid.dof_handler().active_cell_iterators())
      {
        const double     size = cell->extent_in_direction(0);
        const Point<dim> unit((inside - cell->vertex(0)) / size);
        if (!dealii::GeometryInfo<dim>::is_inside_unit_cell(unit, 1e-12))
          continue;
        for (const unsigned int v : cell->vertex_indices())
          {
            auto &sum = weights[cell->vertex_dof_index(v, 0)];
            sum.value += weight * fe.shape_value(v, unit);
            for (unsigned int d = 0; d < dim; ++d)
              if (x[d] == inside[d])
                sum.gradient[d] += weight * fe.shape_grad(v, unit)[d] / size;
          }
        return;
      }
  }



  /// Mean over a box of the shape functions and their gradients by quadrature
  /// on the parts where all of them are linear in each coordinate.
  template <int dim>
  Weights<dim>
  by_quadrature(const Grid<dim>      &grid,
                const Point<dim>     &centre,
                const Tensor<1, dim> &half)
  {
    std::array<std::vector<std::pair<double, double>>, dim> at;
    unsigned int                                            n = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        at[d] = abscissae(grid, d, centre[d] - half[d], centre[d] + half[d]);
        n *= at[d].size();
      }
    Weights<dim> weights;
    for (unsigned int k = 0; k < n; ++k)
      {
        Point<dim>   x;
        double       weight = 1.;
        unsigned int rest   = k;
        for (unsigned int d = 0; d < dim; ++d)
          {
            x[d] = at[d][rest % at[d].size()].first;
            weight *= at[d][rest % at[d].size()].second;
            rest /= at[d].size();
          }
        add_shape_functions(grid, x, weight, weights);
      }
    return weights;
  }



  template <int dim>
  void
  expect_integrals(Core<dim> &core, const unsigned int n_boxes)
  {
    for (unsigned int i = 0; i < n_boxes; ++i)
      {
        const auto [centre, half] = random_box(core);
        expect_equal(by_definition(core.grid, centre, half),
                     by_quadrature(core.grid, centre, half),
                     1e-13);
      }
  }



  TEST(Weights, IntegralsAcrossHangingNodes)
  {
    {
      Core<2> core(cube<2>());
      refine_corner(core);
      expect_integrals(core, 300);
      core.refine([](const Point<2> &x) { return x.norm() < 0.6; });
      expect_integrals(core, 300);
    }
    Core<3> core(cube<3>());
    refine_corner(core);
    expect_integrals(core, 40);
  }



  /// Hanging nodes pass their weight on to their masters.
  template <int dim>
  Weights<dim>
  condensed(const Grid<dim> &grid, Weights<dim> weights)
  {
    for (const auto &hanging : grid.hanging_nodes())
      if (const auto it = weights.find(hanging.node); it != weights.end())
        {
          for (const auto &[master, share] : hanging.masters)
            {
              weights[master].value += share * it->second.value;
              weights[master].gradient += share * it->second.gradient;
            }
          weights.erase(hanging.node);
        }
    return weights;
  }



  /// Mean over [a, b] of x moved into [lower, upper], and of its derivative.
  std::pair<double, double>
  mean_of_clamped(const double a,
                  const double b,
                  const double lower,
                  const double upper)
  {
    const double first = std::clamp(a, lower, upper);
    const double last  = std::clamp(b, lower, upper);
    return {(std::max(0., std::min(b, lower) - a) * lower +
             std::max(0., b - std::max(a, upper)) * upper +
             0.5 * (last * last - first * first)) /
              (b - a),
            (last - first) / (b - a)};
  }



  /// Weights sum to one; sum S_i x_i is the mean of x over the box, in the
  /// interior its centre, and at the boundary that of x folded onto the mesh.
  template <int dim>
  void
  expect_linear_reproduction(Core<dim> &core)
  {
    const auto  places = places_of_nodes(core.grid);
    const auto &domain = core.grid.domain();
    for (unsigned int i = 0; i < 3000; ++i)
      {
        const auto [centre, half] = random_box(core);
        double         one        = 0;
        Tensor<1, dim> x, zero;
        Tensor<2, dim> slope;
        for (const auto &[node, weight] :
             condensed(core.grid, by_definition(core.grid, centre, half)))
          {
            one += weight.value;
            zero += weight.gradient;
            x += weight.value * places[node];
            slope += outer_product(places[node], weight.gradient);
          }
        EXPECT_NEAR(one, 1., 4e-15);
        EXPECT_LT(zero.norm(), 1e-13);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto [mean, derivative] = mean_of_clamped(centre[d] - half[d],
                                                            centre[d] + half[d],
                                                            domain.lower[d],
                                                            domain.upper[d]);
            EXPECT_NEAR(x[d], mean, 1e-13);
            for (unsigned int e = 0; e < dim; ++e)
              EXPECT_NEAR(slope[d][e], (d == e ? derivative : 0.), 1e-13);
          }
      }
  }



  template <int dim>
  void
  expect_linear_reproduction()
  {
    Core<dim> core(cube<dim>());
    expect_linear_reproduction(core);
    refine_corner(core);
    expect_linear_reproduction(core);
    core.refine([](const Point<dim> &x) { return x.norm() < 0.6; });
    expect_linear_reproduction(core);
  }



  TEST(Weights, UnityAndLinearReproduction)
  {
    expect_linear_reproduction<2>();
    expect_linear_reproduction<3>();
  }
} // namespace

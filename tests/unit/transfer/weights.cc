// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/weights_kernel.h>

#include "weights_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  // ---------------------------------------------------------- along an axis

  /// The weight of a node at distance @p x from the centre of a box of half
  /// length @p l, cells of length one, @cite bardenhagen2004, and its slope.
  std::pair<double, double>
  closed_form(const double x, const double l)
  {
    const double r = std::abs(x), sign = (x < 0 ? -1. : 1.);
    if (r < l)
      return {1. - (r * r + l * l) / (2. * l), -x / l};
    if (r < 1. - l)
      return {1. - r, -sign};
    if (r < 1. + l)
      return {(1. + l - r) * (1. + l - r) / (4. * l),
              -sign * (1. + l - r) / (2. * l)};
    return {0., 0.};
  }



  /// Centres as far as half a cell outside, boxes from the floor to the cap.
  template <typename Action>
  void
  for_boxes(const Action &action)
  {
    for (const double half : {0.1, 0.17, 0.25, 0.333, 0.4999, 0.5})
      for (int i = -50; i <= 150; ++i)
        action(0.01 * i, half);
  }



  TEST(AxisWeights, ClosedForm)
  {
    for_boxes([](const double centre, const double half) {
      const auto w = axis_weights(centre, half);
      for (int node = -1; node <= 2; ++node)
        {
          const auto [value, slope] = closed_form(centre - node, half);
          EXPECT_NEAR(w.value[node + 1], value, 2e-15)
            << centre << ' ' << half << ' ' << node;
          EXPECT_NEAR(w.gradient[node + 1], slope, 1e-14)
            << centre << ' ' << half << ' ' << node;
        }
    });
  }



  TEST(AxisWeights, UnityAndLinearReproduction)
  {
    for_boxes([](const double centre, const double half) {
      const auto w   = axis_weights(centre, half);
      double     one = 0, x = 0, zero = 0, slope = 0;
      for (int node = -1; node <= 2; ++node)
        {
          one += w.value[node + 1];
          x += w.value[node + 1] * node;
          zero += w.gradient[node + 1];
          slope += w.gradient[node + 1] * node;
          EXPECT_GE(w.value[node + 1], -1e-15);
        }
      EXPECT_NEAR(one, 1., 1e-15);
      EXPECT_NEAR(x, centre, 4e-15);
      EXPECT_NEAR(zero, 0., 4e-15);
      EXPECT_NEAR(slope, 1., 1e-14);
    });
  }



  template <unsigned int n>
  void
  expect_weights_of_doubles()
  {
    constexpr unsigned int n_boxes = 8;
    double                 centre[n_boxes], half[n_boxes];
    for (unsigned int i = 0; i < n_boxes; ++i)
      {
        centre[i] = -0.5 + 0.27 * i;
        half[i]   = 0.1 + 0.05 * i;
      }
    for (unsigned int i = 0; i < n_boxes; ++i)
      {
        const unsigned int first = i / n * n;
        const auto         found = axis_weights(Simd<n>::load(centre + first),
                                        Simd<n>::load(half + first));
        const auto         w     = axis_weights<double>(centre[i], half[i]);
        for (unsigned int k = 0; k < 4; ++k)
          {
            EXPECT_NEAR(found.value[k][i - first], w.value[k], 1e-15);
            EXPECT_NEAR(found.gradient[k][i - first], w.gradient[k], 4e-15);
          }
      }
  }



  TEST(AxisWeights, SimdAsDoubles)
  {
    expect_weights_of_doubles<1>();
    expect_weights_of_doubles<2>();
    expect_weights_of_doubles<4>();
    expect_weights_of_doubles<8>();
  }



  // ------------------------------------------------------------- on a patch

  /// Weights as the blocks use them: products over a patch of 4^dim nodes.
  template <int dim>
  Weights<dim>
  by_patch(const Grid<dim>      &grid,
           const Point<dim>     &centre,
           const Tensor<1, dim> &half)
  {
    const Cell<dim> &cell = grid.cells()[grid.find_cell(centre)];
    std::vector<AxisWeights<double>> axis;
    for (unsigned int d = 0; d < dim; ++d)
      axis.push_back(axis_weights((centre[d] - cell.lower[d]) / cell.size,
                                  half[d] / cell.size));
    Weights<dim> weights;
    for (unsigned int k = 0; k < cell.patch.size(); ++k)
      {
        Sum<dim> product;
        product.value = 1.;
        for (unsigned int e = 0; e < dim; ++e)
          product.gradient[e] = 1. / cell.size;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = k / power(4, d) % 4;
            product.value *= axis[d].value[i];
            for (unsigned int e = 0; e < dim; ++e)
              product.gradient[e] *=
                (d == e ? axis[d].gradient[i] : axis[d].value[i]);
          }
        weights[cell.patch[k]].value += product.value;
        weights[cell.patch[k]].gradient += product.gradient;
      }
    return weights;
  }



  template <int dim>
  void
  expect_patch_equals_definition(const std::string &parameters)
  {
    Core<dim> core(parameters);
    for (unsigned int i = 0; i < 5000; ++i)
      {
        const auto [centre, half] = random_box(core);
        expect_equal(by_patch(core.grid, centre, half),
                     by_definition(core.grid, centre, half),
                     1e-14);
      }
  }



  TEST(Weights, PatchEqualsDefinition)
  {
    // Boxes anywhere: interior, faces, edges, corners.
    expect_patch_equals_definition<2>(cube<2>());
    expect_patch_equals_definition<3>(mesh("0, 0, 0", "3, 3, 3"));
    expect_patch_equals_definition<2>(mesh("-1, -1", "3, 0"));
    expect_patch_equals_definition<3>(mesh("0, 0, 0", "3, 1, 2"));
  }
} // namespace

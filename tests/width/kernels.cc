// SPDX-License-Identifier: LGPL-2.1-or-later
// A point's result never depends on its neighbours in a register: the functions
// of one point, computed with 1, 2, 4 and 8 points side by side, give the same
// bits. A program of its own, compiled without contraction and for one set of
// instructions: where a product and a sum become one instruction the compiler
// chooses anew for each width. No deal.II, which is compiled as it likes.

#include <talus/base/ordered_sum.h>
#include <talus/materials/hencky_kernel.h>
#include <talus/materials/herschel_bulkley_kernel.h>
#include <talus/materials/neo_hookean_kernel.h>
#include <talus/materials/von_mises_kernel.h>
#include <talus/transfer/weights_kernel.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace
{
  using namespace talus;

  // A multiple of all widths, and of four registers.
  constexpr unsigned int n_points = 4096;
  constexpr double       dt       = 1e-3;
  constexpr Moduli       moduli   = {2e6, 1e6, 8e6 / 3.};



  /// Whether all bits are the same, those of what is no number, too.
  ::testing::AssertionResult
  same_bits(const std::vector<double> &a, const std::vector<double> &b)
  {
    if (a.size() != b.size())
      return ::testing::AssertionFailure() << a.size() << " and " << b.size();
    unsigned int n_others = 0, last = 0;
    for (unsigned int i = 0; i < a.size(); ++i)
      if (std::memcmp(&a[i], &b[i], sizeof(double)) != 0)
        {
          ++n_others;
          last = i;
        }
    if (n_others == 0)
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure()
           << n_others << " of " << a.size() << " numbers differ, the last, "
           << last << ", by " << a[last] - b[last] << " of " << a[last];
  }



  /// Points with columns for the plastic variable, the softening, the strength,
  /// its factor, and F of hyperelastic laws, in plain memory.
  template <int dim>
  struct State
  {
    static constexpr unsigned int plastic_strain  = PointColumns<dim>::n_arrays;
    static constexpr unsigned int softening       = plastic_strain + 1;
    static constexpr unsigned int strength        = softening + 1;
    static constexpr unsigned int strength_factor = strength + 1;
    static constexpr unsigned int deformation     = strength_factor + 1;
    static constexpr unsigned int n_columns       = deformation + dim * dim;

    std::vector<double> columns, work;

    /// Strains of some thousandths, turned by up to 90 degrees; stresses of up
    /// to twice the strength, so that neighbours yield and do not.
    State()
      : columns(n_columns * n_points, 0.)
      , work((dim * dim + 1) * n_points, 0.)
    {
      std::mt19937 generator(1);
      const auto   random = [&](const double lower, const double upper) {
        return std::uniform_real_distribution<double>(lower, upper)(generator);
      };
      const auto points = view();
      for (unsigned int p = 0; p < n_points; ++p)
        {
          for (unsigned int i = 0; i < dim; ++i)
            {
              points.data(points.position, i)[p]   = random(0., 1.);
              const double length                  = random(0.3, 0.6);
              points.data(points.box_length, i)[p] = length * random(0.1, 2.5);
              for (unsigned int j = 0; j < dim; ++j)
                {
                  const double F = (i == j) + random(-0.2, 0.2);
                  points.data(deformation, dim * i + j)[p]  = F;
                  points.data(points.edges, dim * i + j)[p] = 0.4 * F;
                }
            }
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            points.data(points.stress, c)[p] = random(-5e3, 5e3);
          points.data(points.reference_volume)[p] = random(0.1, 1.);
          points.data(points.elastic_energy)[p]   = random(0., 10.);
          points.data(points.plastic_work)[p]     = random(0., 10.);
          points.data(plastic_strain)[p]  = p % 3 == 0 ? 0. : random(0., 2.);
          points.data(softening)[p]       = random(0., 1.);
          points.data(strength)[p]        = random(1e3, 3e3);
          points.data(strength_factor)[p] = random(0.5, 1.5);
          // Some rest, and some move fast.
          const double rate = p % 5 == 0 ? 0. : p % 7 == 0 ? 200. : 3.;
          for (unsigned int r = 0; r < dim * dim; ++r)
            work[r * n_points + p] = random(-rate, rate);
        }
    }

    PointsView<dim>
    view()
    {
      return {{}, columns.data(), n_points};
    }

    WorkspaceView<dim>
    workspace()
    {
      return {work.data(), n_points, 0};
    }
  };



  /// All columns after update(points, workspace, p, Simd<n>()) at all points.
  template <int dim, unsigned int n, typename Update>
  std::vector<double>
  after(const Update &update, const unsigned int n_at_once = n)
  {
    State<dim> state;
    bool       is_sound = true;
    for (unsigned int p = 0; p < n_points; p += n_at_once)
      is_sound &= update(state.view(), state.workspace(), p, Simd<n>());
    EXPECT_TRUE(is_sound);
    return state.columns;
  }



  template <int dim, typename Update>
  void
  expect_same(const Update &update)
  {
    const auto one = after<dim, 1>(update);
    EXPECT_FALSE(same_bits(one, State<dim>().columns)) << "nothing was done";
    EXPECT_TRUE(same_bits(one, after<dim, 2>(update))) << dim << "-D, 2 lanes";
    EXPECT_TRUE(same_bits(one, after<dim, 4>(update))) << dim << "-D, 4 lanes";
    EXPECT_TRUE(same_bits(one, after<dim, 8>(update))) << dim << "-D, 8 lanes";
  }



  /// The points that follow @p p, in @p n_registers of the type of @p number.
  /// Stiffness and softening are columns, or belong to the strain.
  template <int dim, unsigned int n_registers = 1, typename FlowRule>
  auto
  step_of(const FlowRule &flow_rule, const bool by_columns = false)
  {
    return [=](const auto         points,
               const auto         work,
               const unsigned int p,
               const auto         number) {
      using Soil = State<dim>;
      StrengthOfPoints strength;
      strength.strength.column  = points.data(Soil::strength);
      strength.factor.column    = points.data(Soil::strength_factor);
      strength.softening_column = Soil::plastic_strain;
      if (by_columns)
        {
          strength.stiffness.column = points.data(Soil::strength_factor);
          strength.cell_size.column = points.data(points.reference_volume);
          strength.softening_column = Soil::softening;
        }
      return update_rate_law_points<dim,
                                    std::decay_t<decltype(number)>,
                                    n_registers>(
        RateLawStep<dim, FlowRule>{
          points, work, Soil::plastic_strain, dt, moduli, flow_rule, strength},
        p);
    };
  }



  TEST(Width, LinearElastic)
  {
    expect_same<2>(step_of<2>(NoFlow()));
    expect_same<3>(step_of<3>(NoFlow()));
  }



  TEST(Width, VonMises)
  {
    for (const double hardening : {0., 2e3, -2e3})
      for (const bool by_columns : {false, true})
        {
          SCOPED_TRACE(hardening);
          const VonMisesFlow flow_rule = {moduli.mu,
                                          hardening,
                                          1e3,
                                          by_columns};
          expect_same<2>(step_of<2>(flow_rule, by_columns));
          expect_same<3>(step_of<3>(flow_rule, by_columns));
        }
  }



  /// In one register, and in four of the native width.
  template <int dim>
  void
  expect_same_herschel_bulkley(const double exponent, const double decay)
  {
    const HerschelBulkleyFlow flow_rule = {
      decay > 0. ? 1. / 3. : 1., {moduli.mu, 50., exponent, decay, dt}};
    for (const bool by_columns : {false, true})
      {
        const auto in_one = step_of<dim>(flow_rule, by_columns);
        expect_same<dim>(in_one);
        EXPECT_TRUE(
          same_bits(after<dim, 1>(in_one),
                    after<dim, simd_width>(
                      step_of<dim, 4>(flow_rule, by_columns), 4 * simd_width)))
          << dim << "-D, four registers";
      }
  }



  TEST(Width, HerschelBulkley)
  {
    for (const double exponent : {0.5, 0.7, 1., 1.5})
      for (const double decay : {0., 3.})
        {
          SCOPED_TRACE("n = " + std::to_string(exponent) +
                       (decay > 0. ? ", remoulded" : ""));
          expect_same_herschel_bulkley<2>(exponent, decay);
          expect_same_herschel_bulkley<3>(exponent, decay);
        }
  }



  template <int dim, typename StrainEnergy>
  void
  expect_same_by_state(const StrainEnergy &energy)
  {
    expect_same<dim>(
      [&](const auto points, const auto work, const unsigned int p, auto n) {
        return update_point_by_state<dim, decltype(n)>(
          points, work, State<dim>::deformation, p, dt, energy);
      });
  }



  TEST(Width, NeoHookean)
  {
    expect_same_by_state<2>(NeoHookeanEnergy{moduli});
    expect_same_by_state<3>(NeoHookeanEnergy{moduli});
  }



  TEST(Width, Hencky)
  {
    expect_same_by_state<2>(HenckyEnergy{moduli});
    expect_same_by_state<3>(HenckyEnergy{moduli});
  }



  template <unsigned int n>
  std::vector<double>
  weights_of(const BoxRule rule)
  {
    using Number = Simd<n>;
    State<2>   state;
    const auto points = state.view();
    BoxShape   shape;
    shape.rule = rule;
    std::vector<double> result(20 * n_points);
    for (unsigned int p = 0; p < n_points; p += n)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const auto x = load<Number>(points.data(points.position, d) + p);
          const auto half =
            half_length_in_cells<2, Number>(points, shape, d, p, Number(1.3));
          const auto w  = axis_weights(x, half);
          double    *to = result.data() + 10 * d * n_points + p;
          for (unsigned int i = 0; i < 4; ++i)
            {
              store(to + 2 * i * n_points, w.value[i]);
              store(to + (2 * i + 1) * n_points, w.gradient[i]);
            }
          store(to + 8 * n_points, w.lower_end);
          store(to + 9 * n_points, w.upper_end);
        }
    return result;
  }



  TEST(Width, AxisWeights)
  {
    for (const BoxRule rule : {BoxRule::fixed, BoxRule::second_moments})
      {
        const auto one = weights_of<1>(rule);
        EXPECT_TRUE(same_bits(one, weights_of<2>(rule)));
        EXPECT_TRUE(same_bits(one, weights_of<4>(rule)));
        EXPECT_TRUE(same_bits(one, weights_of<8>(rule)));
      }
  }



  /// The first @p n_numbers in registers of n, the rest one by one, as
  /// for_each_simd() does.
  template <unsigned int n>
  double
  sum_of(const std::vector<double> &numbers, const unsigned int n_numbers)
  {
    OrderedSum   sum;
    unsigned int k = 0;
    for (; k + n <= n_numbers; k += n)
      sum.add(k, Simd<n>::load(&numbers[k]));
    for (; k < n_numbers; ++k)
      sum.add(k, Simd<1>(numbers[k]));
    return sum.total();
  }



  TEST(Width, OrderedSum)
  {
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> random(-1., 1.);
    std::vector<double>                    numbers(64);
    for (double &number : numbers)
      number = random(generator);
    for (unsigned int size = 0; size <= numbers.size(); ++size)
      {
        const std::vector<double> one = {sum_of<1>(numbers, size)};
        EXPECT_TRUE(same_bits(one, {sum_of<2>(numbers, size)})) << size;
        EXPECT_TRUE(same_bits(one, {sum_of<4>(numbers, size)})) << size;
        EXPECT_TRUE(same_bits(one, {sum_of<8>(numbers, size)})) << size;
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  ::testing::InitGoogleTest(&argc, argv);
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    {
      std::puts("SKIPPED: this processor has no AVX2.");
      return 77;
    }
#endif
  return RUN_ALL_TESTS();
}

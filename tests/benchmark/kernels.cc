// SPDX-License-Identifier: LGPL-2.1-or-later
// The work on points alone, on data that stay in the cache.

#include "sample.h"

#include <talus/transfer/weights_kernel.h>

#include <benchmark/benchmark.h>

namespace
{
  using namespace talus;

  void
  count_points(benchmark::State &state, const double n_points)
  {
    const double all = n_points * state.iterations();
    state.counters["points"] =
      benchmark::Counter(all, benchmark::Counter::kIsRate);
    state.counters["s_per_point"] = benchmark::Counter(
      all, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  }



  /// Weights along one axis.
  void
  weights(benchmark::State &state)
  {
    constexpr unsigned int n = 512;
    alignas(64) double     centre[n], half[n], value[3][n], gradient[3][n];
    for (unsigned int i = 0; i < n; ++i)
      {
        centre[i] = (i + 0.5) / n;
        half[i]   = 0.1 + 0.4 * ((7 * i) % n) / n;
      }
    for (auto _ : state)
      {
        for (unsigned int i = 0; i < n; i += simd_width)
          {
            using Number = Simd<simd_width>;
            const auto w =
              axis_weights(load<Number>(centre + i), load<Number>(half + i));
            for (unsigned int k = 0; k < 3; ++k)
              {
                store(value[k] + i, w.value[k]);
                store(gradient[k] + i, w.gradient[k]);
              }
          }
        benchmark::ClobberMemory();
      }
    count_points(state, n);
  }



  template <int dim>
  void
  stress(benchmark::State &state, const std::string &law)
  {
    Sample<dim> sample(law);
    for (auto _ : state)
      {
        sample.law->update_stress(
          sample.points, sample.workspace, 0, sample.points.size(), sample.dt);
        benchmark::ClobberMemory();
      }
    count_points(state, sample.points.size());
  }



  template <int dim>
  void
  box_lengths(benchmark::State &state, const BoxRule rule)
  {
    Sample<dim> sample("linear elastic");
    sample.law->update_stress(
      sample.points, sample.workspace, 0, sample.points.size(), 0.3);
    for (auto _ : state)
      {
        update_box_lengths(sample.points, 0, sample.points.size(), rule);
        benchmark::ClobberMemory();
      }
    count_points(state, sample.points.size());
  }



  [[maybe_unused]] const bool kernels_registered = []() {
    benchmark::RegisterBenchmark("axis_weights", weights);
    for (const std::string law : {"linear elastic",
                                  "neo-Hookean",
                                  "Hencky",
                                  "von Mises",
                                  "Herschel-Bulkley"})
      {
        benchmark::RegisterBenchmark(("update_stress<2>/" + law).c_str(),
                                     stress<2>,
                                     law);
        benchmark::RegisterBenchmark(("update_stress<3>/" + law).c_str(),
                                     stress<3>,
                                     law);
      }
    benchmark::RegisterBenchmark("update_box_lengths<2>/second moments",
                                 box_lengths<2>,
                                 BoxRule::second_moments);
    benchmark::RegisterBenchmark("update_box_lengths<3>/second moments",
                                 box_lengths<3>,
                                 BoxRule::second_moments);
    return true;
  }();
} // namespace

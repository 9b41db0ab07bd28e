// SPDX-License-Identifier: LGPL-2.1-or-later
// What the machine can do at most, on one core: the two lines of the roofline.

#include <talus/base/large_pages.h>
#include <talus/base/simd.h>

#include <benchmark/benchmark.h>

namespace
{
  using namespace talus;
  using Number = Simd<simd_width>;

  /// a = b + s c with arrays of 128 MB each, four times the last-level cache of
  /// this kind of machine. Counted are the 24 bytes that the loop names, not
  /// that a line of a is read before it is written.
  void
  triad(benchmark::State &state)
  {
    const std::size_t       n = 1 << 24;
    LargePageVector<double> a(n), b(n), c(n);
    for (std::size_t i = 0; i < n; ++i)
      {
        b[i] = 1.;
        c[i] = 1e-3 * i;
      }
    for (auto _ : state)
      {
        double *const       to = a.data();
        const double *const x = b.data(), *const y = c.data();
        for (std::size_t i = 0; i < n; i += simd_width)
          store(to + i, load<Number>(x + i) + 0.5 * load<Number>(y + i));
        benchmark::ClobberMemory();
      }
    state.counters["bytes_per_second"] =
      benchmark::Counter(24. * n * state.iterations(),
                         benchmark::Counter::kIsRate);
  }



  /// Multiply-adds that do not wait for each other: as many in flight as there
  /// are registers for.
  void
  multiply_add(benchmark::State &state)
  {
    constexpr unsigned int n_chains = 16, n_rounds = 1000;
    Number                 sum[n_chains] = {};
    Number                 factor        = Number(0.999);
    Number                 increment     = Number(1e-3);
    benchmark::DoNotOptimize(factor);
    benchmark::DoNotOptimize(increment);
    for (auto _ : state)
      {
        for (unsigned int i = 0; i < n_rounds; ++i)
#pragma GCC unroll 16
          for (unsigned int k = 0; k < n_chains; ++k)
            sum[k] = sum[k] * factor + increment;
        benchmark::DoNotOptimize(sum);
      }
    state.counters["operations_per_second"] =
      benchmark::Counter(2. * simd_width * n_chains * n_rounds *
                           state.iterations(),
                         benchmark::Counter::kIsRate);
  }
} // namespace

BENCHMARK(triad)->Name("roofline/triad")->Unit(benchmark::kMillisecond);
BENCHMARK(multiply_add)->Name("roofline/multiply-add");

// SPDX-License-Identifier: LGPL-2.1-or-later
// Whole runs, step by step through Simulation::advance().

#include "../cases/case.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace
{
  using namespace talus;
  using cases::Overrides;

  /// Steps whose time is taken, after some that are not: they fill the caches
  /// and what the first steps allocate.
  template <int dim>
  void
  take_steps(benchmark::State  &state,
             const std::string &file,
             const Overrides   &overrides)
  {
    cases::Case<dim> run(file, overrides);
    for (unsigned int i = 0; i < 3; ++i)
      run->advance();
    double point_steps = 0;
    for (auto _ : state)
      {
        run->advance();
        point_steps += run.points().size();
      }
    state.counters["point-steps"] =
      benchmark::Counter(point_steps, benchmark::Counter::kIsRate);
    state.counters["s_per_point-step"] = benchmark::Counter(
      point_steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["points"] = run.points().size();
    state.counters["bytes_per_point"] =
      double(run.points().memory_consumption()) / run.points().size();
  }



  /// Overrides that make the block of a file one of @p n cells along an axis,
  /// with three empty ones at its sides, and @p beside more of them to the
  /// right.
  template <int dim>
  Overrides
  block_of(const unsigned int n, const unsigned int beside = 0)
  {
    const double       h = 1. / n;
    std::ostringstream size, lower, upper;
    size << std::setprecision(17) << "Grid/Cell size=" << h;
    lower << std::setprecision(17) << "Grid/Lower corner=" << -3. * h;
    upper << std::setprecision(17)
          << "Grid/Upper corner=" << 1. + (3. + beside) * h;
    for (unsigned int d = 1; d < dim; ++d)
      {
        lower << ", " << (d == 1 ? 0. : -3. * h);
        upper << ", " << 1. + 3. * h;
      }
    return {"End time=1e9", size.str(), lower.str(), upper.str()};
  }



  /// As many steps as make about @p point_steps.
  template <int dim>
  void
  add_run(const std::string &name,
          const std::string &file,
          const Overrides   &overrides,
          const double       n_points,
          const double       point_steps = 1e7)
  {
    benchmark::RegisterBenchmark(
      (name + "/" + std::to_string(std::lround(n_points))).c_str(),
      take_steps<dim>,
      file,
      overrides)
      ->Iterations(std::max(5l, std::lround(point_steps / n_points)))
      ->Unit(benchmark::kMillisecond);
  }



  [[maybe_unused]] const bool runs_registered = []() {
    for (const unsigned int n : {50, 100, 158, 200, 400, 500})
      {
        const double n_points = 4. * n * n;
        add_run<2>("block", "block.prm", block_of<2>(n), n_points);
        add_run<2>("block of clay",
                   "block-of-clay.prm",
                   block_of<2>(n),
                   n_points);
      }
    // 10 300 and 103 000 empty cells.
    for (const unsigned int beside : {100, 1000})
      add_run<2>("block beside " + std::to_string(beside) + " empty columns",
                 "block.prm",
                 block_of<2>(100, beside),
                 40000);
    for (const unsigned int n : {10, 20, 40})
      add_run<3>(
        "block in 3-D", "block-3d.prm", block_of<3>(n), 8. * n * n * n, 4e6);
    // The first steps, with all that a landslide has. How it fares when it runs
    // is what table.py measures.
    add_run<2>("landslide", "landslide-quick.prm", {}, 5000);
    add_run<2>("landslide", "landslide.prm", {}, 20000);
    return true;
  }();
} // namespace

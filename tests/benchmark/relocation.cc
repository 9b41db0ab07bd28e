// SPDX-License-Identifier: LGPL-2.1-or-later
// Keeping the points sorted by cell.

#include <talus/transfer/relocation.h>

#include <benchmark/benchmark.h>

namespace
{
  using namespace talus;
  using dealii::ParameterAcceptor;

  struct FreshParameters
  {
    FreshParameters()
    {
      ParameterAcceptor::clear();
      ParameterAcceptor::prm.clear();
    }
  };



  /// 50 x 50 cells of 1 m with four points each; deal.II's parameters are
  /// global, so the old ones must be departed before the grid declares its own.
  struct Field : FreshParameters
  {
    Grid<2>       grid{MPI_COMM_WORLD};
    Points<2>     points;
    Relocation<2> relocation;

    Field()
    {
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        "subsection Grid\n"
        "set Upper corner = 50, 50\n"
        "set Cell size = 1\n"
        "end\n");
      ParameterAcceptor::parse_all_parameters();
      grid.create({}, false, {});
      grid.refine();
      grid.prepare();
      points.append(10000);
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          points.data(points.position, 0)[p] = 0.25 + 0.5 * (p % 100);
          points.data(points.position, 1)[p] = 0.25 + 0.5 * (p / 100);
        }
      relocation.update(points, grid);
    }
  };



  void
  count_relocated(benchmark::State &state, const double n_points)
  {
    state.counters["s_per_point"] =
      benchmark::Counter(n_points * state.iterations(),
                         benchmark::Counter::kIsRate |
                           benchmark::Counter::kInvert);
  }



  void
  nobody_moves(benchmark::State &state)
  {
    Field field;
    for (auto _ : state)
      benchmark::DoNotOptimize(
        field.relocation.update(field.points, field.grid));
    count_relocated(state, field.points.size());
  }



  /// Every thousandth point goes to the next cell, and back the next time.
  void
  few_move(benchmark::State &state)
  {
    Field         field;
    double *const x = field.points.data(field.points.position, 0);
    for (auto _ : state)
      {
        // Over the whole field, whatever the order is now.
        for (unsigned int p = 500; p < field.points.size(); p += 1000)
          x[p] += (x[p] < 25. ? 1. : -1.);
        benchmark::DoNotOptimize(
          field.relocation.update(field.points, field.grid));
      }
    count_relocated(state, field.points.size());
  }
} // namespace

BENCHMARK(nobody_moves)->Name("relocation/no mover");
BENCHMARK(few_move)->Name("relocation/0.1 % changes");

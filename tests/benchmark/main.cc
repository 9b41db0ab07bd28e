// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/mpi_setup.h>

#include <deal.II/base/mpi.h>

#include <benchmark/benchmark.h>

int
main(int argc, char **argv)
{
  talus::prepare_mpi();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

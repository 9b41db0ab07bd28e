#include <talus/base/mpi_io.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

int
main(int argc, char **argv)
{
  talus::choose_mpi_io();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // The other ranks only tell what failed.
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
    testing::GTEST_FLAG(brief) = true;
  testing::InitGoogleTest(&argc, argv);
  const int status =
    dealii::Utilities::MPI::max(RUN_ALL_TESTS(), MPI_COMM_WORLD);
  // A filter that names no test any more must not pass for a test.
  const auto *tests   = testing::UnitTest::GetInstance();
  const bool  is_rest = testing::GTEST_FLAG(filter)[0] == '-';
  return !is_rest && tests->test_to_run_count() == 0 ? 1 : status;
}

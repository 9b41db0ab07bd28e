// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/mpi_setup.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstring>
#include <iostream>

#include "suites.h"

namespace
{
  /// All tests, a line each: the name and the numbers of ranks to run it on.
  /// The entries of ctest are made of the list, so that no suite can be
  /// forgotten.
  int
  list_tests()
  {
    const auto &tests = *testing::UnitTest::GetInstance();
    auto        ranks = further_ranks();
    for (int i = 0; i < tests.total_test_suite_count(); ++i)
      {
        const auto &suite = *tests.GetTestSuite(i);
        for (int k = 0; k < suite.total_test_count(); ++k)
          {
            std::cout << suite.name() << '.' << suite.GetTestInfo(k)->name()
                      << " 1";
            for (const unsigned int n : ranks[suite.name()])
              std::cout << ' ' << n;
            std::cout << std::endl;
          }
        ranks.erase(suite.name());
      }
    for (const auto &rest : ranks)
      std::cerr << "TALUS_ALSO_ON_RANKS names the suite '" << rest.first
                << "', which has no tests. Correct the name." << std::endl;
    return ranks.empty() ? 0 : 1;
  }
} // namespace



int
main(int argc, char **argv)
{
  if (argc == 2 && std::strcmp(argv[1], "--list-tests") == 0)
    {
      testing::InitGoogleTest();
      return list_tests();
    }
  talus::prepare_mpi();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // The other ranks only tell what failed.
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
    testing::GTEST_FLAG(brief) = true;
  testing::InitGoogleTest(&argc, argv);
  const int status =
    dealii::Utilities::MPI::max(RUN_ALL_TESTS(), MPI_COMM_WORLD);
  // A filter that names no test any more must not pass for a test.
  return testing::UnitTest::GetInstance()->test_to_run_count() == 0 ? 1
                                                                    : status;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "suites.h"

#include <talus/simulation/step_agreement.h>

#include <gtest/gtest.h>

namespace Utilities = dealii::Utilities;
using namespace talus;

namespace
{
  TALUS_ALSO_ON_RANKS(Agreement, 2, 3);
}



TEST(Agreement, OfAllRanks)
{
  const unsigned int  rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int  n    = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const StepAgreement agreement;
  const StepPlan      plan =
    agreement.agree({1. / (rank + 1.),
                     rank == 0 ? RunRequest::checkpoint : RunRequest::none,
                     10. * (rank + 1),
                     2. + rank},
                    MPI_COMM_WORLD);
  EXPECT_EQ(plan.time_step, 1. / n);
  EXPECT_EQ(plan.request, RunRequest::checkpoint);
  EXPECT_EQ(plan.n_points, 5. * n * (n + 1));
  EXPECT_EQ(plan.max_speed, 1. + n);
}

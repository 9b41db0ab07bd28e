// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/step_agreement.h>

#include <algorithm>

namespace talus
{
  namespace
  {
    /// Combine plans element by element: minimum time step, maximum request,
    /// sum of points, maximum speed. The signature is required by MPI for
    /// user-defined operations. All four operations commute, including sums of
    /// whole numbers, so the result does not depend on the order of the ranks.
    void
    combine(void *more, void *all, int *n, MPI_Datatype *)
    {
      for (int i = 0; i < *n; ++i)
        {
          const StepPlan &one    = static_cast<const StepPlan *>(more)[i];
          StepPlan       &result = static_cast<StepPlan *>(all)[i];
          result.time_step       = std::min(result.time_step, one.time_step);
          result.request         = std::max(result.request, one.request);
          result.n_points += one.n_points;
          result.max_speed = std::max(result.max_speed, one.max_speed);
        }
    }
  } // namespace



  /// Plans are sent as bytes: all ranks run the same program on machines of the
  /// same kind.
  StepAgreement::StepAgreement()
  {
    MPI_Type_contiguous(sizeof(StepPlan), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
    MPI_Op_create(&combine, /*commute=*/1, &operation_);
  }



  StepAgreement::~StepAgreement()
  {
    MPI_Op_free(&operation_);
    MPI_Type_free(&type_);
  }



  /// In most steps the reduction is the only message of all ranks.
  StepPlan
  StepAgreement::agree(const StepPlan &own, const MPI_Comm communicator) const
  {
    StepPlan all = own;
    MPI_Allreduce(&own, &all, 1, type_, operation_, communicator);
    return all;
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/step_agreement.h>

#include <algorithm>

namespace talus
{
  namespace
  {
    /// Least time step, largest request and number of points, element by
    /// element: the form that MPI wants for an operation of one's own. All
    /// commute, sums of whole numbers, too, so the result does not depend on the
    /// order of the ranks.
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
        }
    }
  } // namespace



  /// As bytes: ranks of a run are the same program on the same kind of machine.
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



  /// In most steps the only message of all ranks.
  StepPlan
  StepAgreement::agree(const StepPlan &own, const MPI_Comm communicator) const
  {
    StepPlan all = own;
    MPI_Allreduce(&own, &all, 1, type_, operation_, communicator);
    return all;
  }
} // namespace talus

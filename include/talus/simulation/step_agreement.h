// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_step_agreement_h
#define talus_simulation_step_agreement_h

#include <deal.II/base/mpi.h>

namespace talus
{
  /// Action after a step.
  enum class RunRequest : unsigned int
  {
    none       = 0,
    checkpoint = 1, ///< write a checkpoint and continue
    stop       = 2  ///< write a checkpoint and end
  };



  /// Data of a step to be agreed by all ranks.
  struct StepPlan
  {
    double     time_step; ///< s; minimum over the ranks
    RunRequest request;   ///< maximum over the ranks
    double     n_points;  ///< sum over the ranks
    double     max_speed; ///< largest of a point, m/s; maximum over ranks
  };



  /// Combines the step plans of all ranks in a single message. Without mesh
  /// tracking, outflow and maps, no other message of a step involves all ranks:
  /// on many ranks the time is spent waiting for the message.
  class StepAgreement
  {
  public:
    StepAgreement();
    StepAgreement(const StepAgreement &) = delete;
    ~StepAgreement();

    /// Return the combined plan of all ranks. Collective.
    StepPlan
    agree(const StepPlan &own, MPI_Comm communicator) const;

  private:
    MPI_Datatype type_;
    MPI_Op       operation_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_step_agreement_h
#define talus_simulation_step_agreement_h

#include <deal.II/base/mpi.h>

namespace talus
{
  /// What is to happen after a step.
  enum class RunRequest : unsigned int
  {
    none       = 0,
    checkpoint = 1, ///< write one and go on
    stop       = 2  ///< write one and end
  };



  /// What the ranks must know of each other in a step.
  struct StepPlan
  {
    double     time_step; ///< s; the least of all ranks is taken
    RunRequest request;   ///< the greatest of all ranks is fulfilled
    double     n_points;  ///< those of all ranks are added up
  };



  /// Lets all ranks agree on a step, in a single message: but for mesh tracking
  /// it is the only one in a step that all take part in, and on many ranks it is
  /// waiting for it that costs.
  class StepAgreement
  {
  public:
    StepAgreement();
    StepAgreement(const StepAgreement &) = delete;
    ~StepAgreement();

    /// The plan of all. Collective.
    StepPlan
    agree(const StepPlan &own, MPI_Comm communicator) const;

  private:
    MPI_Datatype type_;
    MPI_Op       operation_;
  };
} // namespace talus

#endif

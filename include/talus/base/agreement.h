// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_agreement_h
#define talus_base_agreement_h

#include <deal.II/base/mpi.h>

#include <string>

namespace talus
{
  inline bool
  is_first_rank(const MPI_Comm communicator)
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  }



  /// Return the error sentence of the lowest rank with an error, on all ranks;
  /// empty if no rank has an error. Collective: an error on one rank must end
  /// all ranks, and no rank may keep waiting for a message.
  inline std::string
  first_sentence(const std::string &own, const MPI_Comm communicator)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    const unsigned int first =
      MPI::min(own.empty() ? n_ranks : MPI::this_mpi_process(communicator),
               communicator);
    return first == n_ranks ? "" : MPI::broadcast(communicator, own, first);
  }
} // namespace talus

#endif

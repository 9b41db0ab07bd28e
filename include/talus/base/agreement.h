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



  /// The sentence of the first rank that has one, on all ranks; empty if none
  /// has. Collective: what went wrong on one rank is to end all of them, with
  /// none left waiting for a message.
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

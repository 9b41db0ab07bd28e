// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_neighbor_exchange_h
#define talus_grid_neighbor_exchange_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>
#include <vector>

namespace talus
{
  /// Sends a list of doubles of any length to each neighbour rank, and receives
  /// a list from each. Empty lists are sent, too: without the message a
  /// neighbour would need an operation over all ranks in every step to know
  /// that nothing arrives.
  class NeighborExchange
  {
  public:
    using Message = std::vector<double>;

    /// Prepare for exchanges. The first call duplicates the communicator; later
    /// calls do nothing. Collective over all ranks, including ranks without
    /// neighbours.
    void
    connect(MPI_Comm communicator);

    /// Send @p outgoing[i] to @p ranks[i], and call @p receive(message) for the
    /// message of each of @p ranks, in the order of @p ranks and not in the
    /// order of arrival, so that results are identical in every run. @p ranks
    /// must be symmetric (Grid::neighbor_ranks()). Collective.
    void
    exchange(const std::vector<unsigned int>            &ranks,
             const std::vector<Message>                 &outgoing,
             const std::function<void(const Message &)> &receive);

  private:
    // Separate tags need a separate communicator.
    std::unique_ptr<dealii::Utilities::MPI::DuplicatedCommunicator>
      communicator_;

    // Kept between calls so that a step does not allocate.
    Message                  incoming_;
    std::vector<MPI_Request> requests_;
  };
} // namespace talus

#endif

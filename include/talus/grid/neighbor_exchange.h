// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_neighbor_exchange_h
#define talus_grid_neighbor_exchange_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>
#include <vector>

namespace talus
{
  /// Passes a list of doubles, of any length, to each neighbouring rank and
  /// receives one from each. An empty list is a message, too: without it a
  /// neighbour could not know that nothing will come, short of an operation of
  /// all ranks in every step.
  class NeighborExchange
  {
  public:
    using Message = std::vector<double>;

    /// Prepare for exchanges. Only the first call does something: all ranks
    /// duplicate the communicator together. Collective over all ranks, also
    /// those without neighbours.
    void
    connect(MPI_Comm communicator);

    /// Send @p outgoing[i] to @p ranks[i], and call @p receive(message) for the
    /// message of each of @p ranks, in their order and not in that of arrival,
    /// so that results are the same in every run. @p ranks must be symmetric
    /// (Grid::neighbor_ranks()). Collective.
    void
    exchange(const std::vector<unsigned int>            &ranks,
             const std::vector<Message>                 &outgoing,
             const std::function<void(const Message &)> &receive);

  private:
    // Own tags need an own communicator.
    std::unique_ptr<dealii::Utilities::MPI::DuplicatedCommunicator>
      communicator_;

    // Kept between calls so that a step does not allocate.
    Message                  incoming_;
    std::vector<MPI_Request> requests_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/neighbor_exchange.h>

#include <talus/base/assertion.h>

namespace talus
{
  using namespace dealii;

  void
  NeighborExchange::connect(const MPI_Comm communicator)
  {
    if (communicator_ == nullptr)
      communicator_ =
        std::make_unique<Utilities::MPI::DuplicatedCommunicator>(communicator);
  }



  // All sends start before the first receive, so ranks cannot deadlock.
  void
  NeighborExchange::exchange(
    const std::vector<unsigned int>            &ranks,
    const std::vector<Message>                 &outgoing,
    const std::function<void(const Message &)> &receive)
  {
    TalusAssert(ranks.size() == outgoing.size(),
                dealii::ExcDimensionMismatch(ranks.size(), outgoing.size()));
    requests_.resize(ranks.size());
    for (unsigned int i = 0; i < ranks.size(); ++i)
      {
        const int error = MPI_Isend(outgoing[i].data(),
                                    outgoing[i].size(),
                                    MPI_DOUBLE,
                                    ranks[i],
                                    0,
                                    **communicator_,
                                    &requests_[i]);
        AssertThrowMPI(error);
      }
    for (const unsigned int rank : ranks)
      {
        MPI_Status status;
        int error = MPI_Probe(rank, 0, **communicator_, &status), size = 0;
        AssertThrowMPI(error);
        error = MPI_Get_count(&status, MPI_DOUBLE, &size);
        AssertThrowMPI(error);
        incoming_.resize(size);
        error = MPI_Recv(incoming_.data(),
                         size,
                         MPI_DOUBLE,
                         rank,
                         0,
                         **communicator_,
                         MPI_STATUS_IGNORE);
        AssertThrowMPI(error);
        receive(incoming_);
      }
    const int error =
      MPI_Waitall(requests_.size(), requests_.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/point_exchange.h>

#include <algorithm>
#include <cstring>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Its bits may be those of a number that is none: they are copied, never
    // computed with.
    static_assert(sizeof(unsigned long) == sizeof(double),
                  "The key of a cell travels among doubles.");

  } // namespace



  // Only once: a communicator is duplicated by all ranks together, which a step
  // cannot afford.
  template <int dim>
  void
  PointExchange<dim>::connect(const MPI_Comm communicator)
  {
    if (communicator_ == nullptr)
      communicator_ =
        std::make_unique<Utilities::MPI::DuplicatedCommunicator>(communicator);
  }



  /// A message is the list of its points, each the key of its new cell and then
  /// all columns. The sender has found the cell, so the receiver need not look
  /// for it. A neighbour that gets no point gets an empty message: else it could
  /// not know that none will come, short of an operation of all ranks in every
  /// step.
  template <int dim>
  void
  PointExchange<dim>::send(const std::vector<OutgoingPoint> &outgoing,
                           const Grid<dim>                  &grid,
                           const Points<dim>                &points)
  {
    const auto        &ranks = grid.neighbor_ranks();
    const unsigned int n     = points.n_arrays();
    outgoing_.resize(ranks.size());
    for (auto &message : outgoing_)
      message.clear();
    for (const OutgoingPoint &point : outgoing)
      {
        const unsigned int to = grid.owner_of_cell(point.cell);
        auto              &message =
          outgoing_[std::lower_bound(ranks.begin(), ranks.end(), to) -
                    ranks.begin()];
        const unsigned long key = grid.key_of_cell(point.cell);
        double              key_as_double;
        std::memcpy(&key_as_double, &key, sizeof(key));
        message.push_back(key_as_double);
        for (unsigned int array = 0; array < n; ++array)
          message.push_back(points.data(array)[point.index]);
      }
    requests_.resize(ranks.size());
    for (unsigned int i = 0; i < ranks.size(); ++i)
      {
        const int error = MPI_Isend(outgoing_[i].data(),
                                    outgoing_[i].size(),
                                    MPI_DOUBLE,
                                    ranks[i],
                                    0,
                                    **communicator_,
                                    &requests_[i]);
        AssertThrowMPI(error);
      }
  }



  /// Await the message of one neighbour, whatever its size, and append its
  /// points.
  template <int dim>
  void
  PointExchange<dim>::receive(const unsigned int rank,
                              const Grid<dim>   &grid,
                              Points<dim>       &points)
  {
    MPI_Status status;
    int        error = MPI_Probe(rank, 0, **communicator_, &status), size = 0;
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

    const unsigned int n     = points.n_arrays();
    const double      *value = incoming_.data();
    const unsigned int count = size / (n + 1);
    unsigned int       p     = points.append(count);
    for (unsigned int i = 0; i < count; ++i, ++p)
      {
        unsigned long key;
        std::memcpy(&key, value++, sizeof(key));
        arrivals_.push_back({p, grid.cell_of_key(key)});
        Assert(arrivals_.back().cell < grid.n_owned_cells(),
               ExcInternalError());
        for (unsigned int array = 0; array < n; ++array)
          points.data(array)[p] = *value++;
      }
  }



  // All sends are started before the first message is awaited, so ranks cannot
  // wait for each other in a circle. Messages are taken in the order of the
  // ranks and not in that of their arrival: the order of the points in a cell
  // is part of the state, and a run must be the same bit by bit each time.
  template <int dim>
  const std::vector<typename PointExchange<dim>::IncomingPoint> &
  PointExchange<dim>::exchange(const std::vector<OutgoingPoint> &outgoing,
                               const Grid<dim>                  &grid,
                               Points<dim>                      &points)
  {
    arrivals_.clear();
    send(outgoing, grid, points);
    for (const unsigned int rank : grid.neighbor_ranks())
      receive(rank, grid, points);
    const int error =
      MPI_Waitall(requests_.size(), requests_.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    return arrivals_;
  }



  template class PointExchange<2>;
  template class PointExchange<3>;
} // namespace talus

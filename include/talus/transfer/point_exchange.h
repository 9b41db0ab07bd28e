// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_point_exchange_h
#define talus_transfer_point_exchange_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <vector>

namespace talus
{
  /// Takes points whose cell belongs to another rank there: one message to each
  /// neighbour, empty or not, and no operation of all ranks.
  template <int dim>
  class PointExchange
  {
  public:
    struct OutgoingPoint
    {
      unsigned int index; ///< of the point
      unsigned int cell;  ///< a ghost
    };

    struct IncomingPoint
    {
      unsigned int index; ///< of the point, appended
      unsigned int cell;  ///< an owned cell
    };

    /// To be called before the first exchange. Collective over all ranks, also
    /// those that have no neighbours.
    void
    connect(MPI_Comm communicator);

    /// Send these points, which stay here as dead copies, and append those that
    /// come in, in the order of the ranks and of their lists. Collective.
    const std::vector<IncomingPoint> &
    exchange(const std::vector<OutgoingPoint> &outgoing,
             const Grid<dim>                  &grid,
             Points<dim>                      &points);

  private:
    void
    send(const std::vector<OutgoingPoint> &outgoing,
         const Grid<dim>                  &grid,
         const Points<dim>                &points);
    void
    receive(unsigned int rank, const Grid<dim> &grid, Points<dim> &points);

    // Own tags need an own communicator.
    std::unique_ptr<dealii::Utilities::MPI::DuplicatedCommunicator>
      communicator_;

    // Kept between calls so that a step does not allocate.
    std::vector<IncomingPoint>       arrivals_;
    std::vector<std::vector<double>> outgoing_; ///< for each neighbour
    std::vector<double>              incoming_;
    std::vector<MPI_Request>         requests_;
  };
} // namespace talus

#endif

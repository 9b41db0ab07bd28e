// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_point_exchange_h
#define talus_transfer_point_exchange_h

#include <talus/grid/grid.h>
#include <talus/grid/neighbor_exchange.h>
#include <talus/points/points.h>

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

    /// Prepare for exchanges; see NeighborExchange::connect(). Collective.
    void
    connect(const MPI_Comm communicator)
    {
      messages_.connect(communicator);
    }

    /// Send these points, which stay here as dead copies, and append those that
    /// come in, in the order of the ranks and of their lists. Collective.
    const std::vector<IncomingPoint> &
    exchange(const std::vector<OutgoingPoint> &outgoing,
             const Grid<dim>                  &grid,
             Points<dim>                      &points);

  private:
    void
    pack(const std::vector<OutgoingPoint> &outgoing,
         const Grid<dim>                  &grid,
         const Points<dim>                &points);
    void
    append(const NeighborExchange::Message &message,
           const Grid<dim>                 &grid,
           Points<dim>                     &points);

    NeighborExchange messages_;

    // Kept between calls so that a step does not allocate.
    std::vector<IncomingPoint>             arrivals_;
    std::vector<NeighborExchange::Message> outgoing_; ///< for each neighbour
  };
} // namespace talus

#endif

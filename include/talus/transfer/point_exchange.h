// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_point_exchange_h
#define talus_transfer_point_exchange_h

#include <talus/grid/grid.h>
#include <talus/grid/neighbor_exchange.h>
#include <talus/points/points.h>

#include <vector>

namespace talus
{
  /// Sends points to the rank that owns their cell: one message to each
  /// neighbour rank, empty or not, and no operation over all ranks.
  template <int dim>
  class PointExchange
  {
  public:
    struct OutgoingPoint
    {
      unsigned int index; ///< index of the point
      unsigned int cell;  ///< ghost cell
    };

    struct IncomingPoint
    {
      unsigned int index; ///< index of the appended point
      unsigned int cell;  ///< owned cell
    };

    /// Prepare for exchanges; see NeighborExchange::connect(). Collective.
    void
    connect(const MPI_Comm communicator)
    {
      messages_.connect(communicator);
    }

    /// Send the points of @p outgoing and append the points received, ordered
    /// by rank and by position in the message. Points sent stay in @p points as
    /// dead copies. Return the points received. Collective.
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
    std::vector<NeighborExchange::Message> outgoing_; ///< by neighbour rank
  };
} // namespace talus

#endif

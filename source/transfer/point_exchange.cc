// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/point_exchange.h>

#include <talus/base/assertion.h>

#include <algorithm>
#include <cstring>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // The bits of a key may be a NaN as a double: keys are copied, never used
    // in arithmetic.
    static_assert(sizeof(unsigned long) == sizeof(double),
                  "The key of a cell travels among doubles.");

  } // namespace



  /// Pack the messages: for each point the key of its new cell, then all
  /// columns. The sender has found the cell, so the receiver need not search.
  template <int dim>
  void
  PointExchange<dim>::pack(const std::vector<OutgoingPoint> &outgoing,
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
  }



  /// Append the points in the message of one neighbour rank.
  template <int dim>
  void
  PointExchange<dim>::append(const NeighborExchange::Message &message,
                             const Grid<dim>                 &grid,
                             Points<dim>                     &points)
  {
    const unsigned int n     = points.n_arrays();
    const double      *value = message.data();
    const unsigned int count = message.size() / (n + 1);
    unsigned int       p     = points.append(count);
    for (unsigned int i = 0; i < count; ++i, ++p)
      {
        unsigned long key;
        std::memcpy(&key, value++, sizeof(key));
        arrivals_.push_back({p, grid.cell_of_key(key)});
        TalusAssert(arrivals_.back().cell < grid.n_owned_cells(),
                    ExcInternalError());
        for (unsigned int array = 0; array < n; ++array)
          points.data(array)[p] = *value++;
      }
  }



  // Messages are appended in the order of the ranks: the order of the points in
  // a cell is part of the state, and runs must be bit-identical.
  template <int dim>
  const std::vector<typename PointExchange<dim>::IncomingPoint> &
  PointExchange<dim>::exchange(const std::vector<OutgoingPoint> &outgoing,
                               const Grid<dim>                  &grid,
                               Points<dim>                      &points)
  {
    arrivals_.clear();
    pack(outgoing, grid, points);
    messages_.exchange(grid.neighbor_ranks(),
                       outgoing_,
                       [&](const NeighborExchange::Message &message) {
                         append(message, grid, points);
                       });
    return arrivals_;
  }



  template class PointExchange<2>;
  template class PointExchange<3>;
} // namespace talus

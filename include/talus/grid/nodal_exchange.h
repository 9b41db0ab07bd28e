// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_nodal_exchange_h
#define talus_grid_nodal_exchange_h

#include <talus/grid/node_numbering.h>

#include <vector>

namespace talus
{
  /// Exchanges records of doubles between the owner of a node and the ranks
  /// where the node is a ghost, in one message per neighbour. A message names
  /// the nodes with a record that differs from the value at rest; the other
  /// records are not sent.
  ///
  /// The arrays hold the records of all nodes of the grid in the order of their
  /// numbers, owned nodes first, then ghosts. All exchanges are collective.
  template <int dim>
  class NodalExchange
  {
  public:
    /// Set the length of the records, in doubles, and the distance between two
    /// records in the arrays, which is the length if 0. @p nodes must outlive
    /// all exchanges.
    void
    prepare(const NodeNumbering<dim> &nodes,
            unsigned int              width,
            unsigned int              stride = 0);

    /// Add the records of ghosts to the records of their owners, in the order
    /// of the ranks, so that sums are identical in each run. Ghosts become
    /// zero.
    void
    add_to_owners(double *records);

    /// Set the numbers at owners to the minimum over owner and ghosts. Ghosts
    /// have no number if they are at @p rest.
    void
    minimum_to_owners(double *records, double rest);

    /// Copy the records of owners to the ghosts. A record with all numbers
    /// equal to @p rest is not sent.
    void
    copy_to_ghosts(double *records, double rest = 0.);

    /// Nodes with a record in the last messages to this rank, ascending.
    const std::vector<unsigned int> &
    received_nodes() const
    {
      return received_nodes_;
    }

  private:
    using Nodes   = std::vector<unsigned int> NodesWithRank::*;
    using Message = std::vector<double>;

    void
    pack(const std::vector<unsigned int> &nodes,
         const double                    *records,
         double                           rest,
         Message                         &message) const;
    template <typename Receive>
    void
    exchange(Nodes          from,
             Nodes          to,
             double        *records,
             double         rest,
             const Receive &receive);
    void
    count_sent() const;
    void
    set_ghosts(double *records, double value) const;

    const NodeNumbering<dim> *nodes_ = nullptr;
    unsigned int              width_ = 0, stride_ = 0; ///< doubles

    // Kept between calls so that a step does not allocate.
    std::vector<Message>      outgoing_, incoming_; ///< by neighbour
    std::vector<MPI_Request>  requests_;
    std::vector<MPI_Status>   statuses_;
    std::vector<unsigned int> received_nodes_;
  };
} // namespace talus

#endif

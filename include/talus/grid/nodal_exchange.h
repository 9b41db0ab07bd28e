// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_nodal_exchange_h
#define talus_grid_nodal_exchange_h

#include <talus/grid/node_numbering.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace talus
{
  /// Exchanges records of doubles between the owner of a node and the ranks
  /// where the node is a ghost, in one message per neighbour.
  ///
  /// The arrays hold the records of all nodes of the grid in the order of their
  /// numbers, owned nodes first, then ghosts. All exchanges are collective.
  template <int dim>
  class NodalExchange
  {
  public:
    /// Set up the messages for @p width doubles per node. Throws ExcUser if the
    /// mesh is too large for deal.II's indices.
    void
    prepare(const NodeNumbering<dim> &nodes, unsigned int width);

    /// Add the records of ghosts to the records of their owners, in the order
    /// of the ranks, so that sums are identical in each run. Ghosts become
    /// zero.
    void
    add_to_owners(double *records);

    /// Set the numbers at owners to the minimum over owner and ghosts.
    void
    minimum_to_owners(double *records);

    /// Copy the records of owners to the ghosts.
    void
    copy_to_ghosts(double *records);

  private:
    void
    combine_at_owners(double                         *records,
                      dealii::VectorOperation::values operation);

    std::unique_ptr<dealii::Utilities::MPI::Partitioner> partitioner_;

    dealii::AlignedVector<double> buffer_;
    std::vector<MPI_Request>      requests_;
  };
} // namespace talus

#endif

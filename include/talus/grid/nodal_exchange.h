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
  /// Carries records of doubles at the nodes between the rank that owns a node
  /// and those that have it as a ghost, in one message per neighbour.
  ///
  /// The arrays hold the records of all nodes of the grid in the order of their
  /// numbers, that is, the owned ones and then the ghosts. Collective.
  template <int dim>
  class NodalExchange
  {
  public:
    /// @p width: doubles per node. Throws ExcUser if the mesh is too large for
    /// deal.II's indices.
    void
    prepare(const NodeNumbering<dim> &nodes, unsigned int width);

    /// Add what the ghosts hold to their owners' records, in the order of the
    /// ranks, so that the sums are the same in each run. Ghosts become zero.
    void
    add_to_owners(double *records);

    /// Give owners the least of their own numbers and those of the ghosts.
    void
    minimum_to_owners(double *records);

    /// Copy the owners' records to the ghosts.
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/grid/nodal_exchange.h>

#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Replace each index by @p width consecutive indices: the partitioner of
    /// deal.II exchanges single numbers, and thereby records.
    IndexSet
    widened(const IndexSet &indices, const unsigned int width)
    {
      IndexSet result(indices.size() * width);
      for (auto range = indices.begin_intervals();
           range != indices.end_intervals();
           ++range)
        result.add_range(*range->begin() * width, (range->last() + 1) * width);
      result.compress();
      return result;
    }
  } // namespace



  // One partitioner instead of a deal.II vector per quantity: all numbers of a
  // node travel in one message per neighbour, since the cost of a message
  // hardly depends on its length. Senders and message sizes are determined once
  // per mesh; a step needs no operation over all ranks.
  template <int dim>
  void
  NodalExchange<dim>::prepare(const NodeNumbering<dim> &nodes,
                              const unsigned int        width)
  {
    const IndexSet &owned = nodes.owned_nodes();
    const double largest  = std::numeric_limits<types::global_dof_index>::max();
    AssertThrow(1. * owned.size() * width < largest,
                ExcUser(text("The mesh has ",
                             owned.size(),
                             " nodes; messages between ranks can name at most ",
                             static_cast<unsigned long>(largest / width),
                             ". Choose a larger 'Grid/Cell size' or a smaller "
                             "box.")));
    // A new object: reinit() of deal.II 9.4 keeps the old ghosts if there are
    // none now.
    partitioner_ = std::make_unique<Utilities::MPI::Partitioner>(
      widened(owned, width),
      widened(nodes.ghost_nodes(), width),
      nodes.dof_handler().get_communicator());
    buffer_.resize_fast(partitioner_->n_import_indices());
  }



  // All messages arrive before any is added, in the order of the ranks and not
  // of arrival: sums, and therefore runs, are bit-identical. Channel 0, and 1
  // below, separate the two kinds of messages.
  template <int dim>
  void
  NodalExchange<dim>::combine_at_owners(double                       *records,
                                        const VectorOperation::values operation)
  {
    // Counted in doubles, not in nodes.
    const unsigned int      n_owned = partitioner_->locally_owned_size();
    const ArrayView<double> owned(records, n_owned);
    const ArrayView<double> ghosts(records + n_owned,
                                   partitioner_->n_ghost_indices());
    const ArrayView<double> buffer(buffer_.data(), buffer_.size());
    requests_.clear();
    partitioner_->import_from_ghosted_array_start(
      operation, 0, ghosts, buffer, requests_);
    partitioner_->import_from_ghosted_array_finish(
      operation,
      ArrayView<const double>(buffer.data(), buffer.size()),
      owned,
      ghosts,
      requests_);
  }



  template <int dim>
  void
  NodalExchange<dim>::add_to_owners(double *records)
  {
    combine_at_owners(records, VectorOperation::add);
  }



  template <int dim>
  void
  NodalExchange<dim>::minimum_to_owners(double *records)
  {
    combine_at_owners(records, VectorOperation::min);
  }



  template <int dim>
  void
  NodalExchange<dim>::copy_to_ghosts(double *records)
  {
    const unsigned int      n_owned = partitioner_->locally_owned_size();
    const ArrayView<double> ghosts(records + n_owned,
                                   partitioner_->n_ghost_indices());
    requests_.clear();
    partitioner_->export_to_ghosted_array_start(
      1,
      ArrayView<const double>(records, n_owned),
      ArrayView<double>(buffer_.data(), buffer_.size()),
      ghosts,
      requests_);
    partitioner_->export_to_ghosted_array_finish(ghosts, requests_);
  }



  template class NodalExchange<2>;
  template class NodalExchange<3>;
} // namespace talus

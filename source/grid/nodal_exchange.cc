// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/grid/nodal_exchange.h>

#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Each index becomes @p width consecutive ones: so deal.II's partitioner,
    /// which knows single numbers only, carries records.
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



  // deal.II's partitioner and not one of its vectors per quantity: all numbers
  // of a node travel in one message per neighbour, since what a message costs
  // hardly depends on its length. Who sends how much to whom is settled here,
  // once per mesh; a step then needs no operation of all ranks.
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
    // A new one: deal.II 9.4's reinit() forgets ghosts that had become none.
    partitioner_ = std::make_unique<Utilities::MPI::Partitioner>(
      widened(owned, width),
      widened(nodes.ghost_nodes(), width),
      nodes.dof_handler().get_communicator());
    buffer_.resize_fast(partitioner_->n_import_indices());
  }



  // All messages are awaited before any is added, in the order of the ranks and
  // not in that of their arrival: so sums, and with them the run, are the same
  // bit by bit each time. The number 0, and 1 below, keep the two kinds of
  // messages apart.
  template <int dim>
  void
  NodalExchange<dim>::combine_at_owners(double                       *records,
                                        const VectorOperation::values operation)
  {
    // In doubles, not in nodes.
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

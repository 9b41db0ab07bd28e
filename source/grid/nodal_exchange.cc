// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/nodal_exchange.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  NodalExchange<dim>::prepare(const NodeNumbering<dim> &nodes,
                              const unsigned int        width,
                              const unsigned int        stride)
  {
    nodes_  = &nodes;
    width_  = width;
    stride_ = (stride == 0 ? width : stride);
    received_nodes_.clear();
  }



  /// Write the records that differ from @p rest: the place of the node in the
  /// list of both ranks, exact as a double, then the numbers.
  template <int dim>
  void
  NodalExchange<dim>::pack(const std::vector<unsigned int> &nodes,
                           const double                    *records,
                           const double                     rest,
                           Message                         &message) const
  {
    // The nodes are scattered over the memory.
    constexpr unsigned int ahead = 16;
    message.clear();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        if (i + ahead < nodes.size())
          __builtin_prefetch(records + std::size_t(stride_) * nodes[i + ahead]);
        const double *const record = records + std::size_t(stride_) * nodes[i];
        if (std::all_of(record, record + width_, [rest](const double x) {
              return x == rest;
            }))
          continue;
        message.push_back(i);
        message.insert(message.end(), record, record + width_);
      }
  }



  // Most nodes at the border of two ranks are far from the soil. Which nodes
  // have soil changes in each step, and neither rank knows the points of the
  // other. The messages therefore name their nodes: no list of both ranks can
  // be out of date, and no node with soil can be missed.
  //
  // All numbers of a node travel in one message, since the cost of a message
  // hardly depends on its length. All messages arrive before any is used, in
  // the order of the ranks and not of arrival: sums, and therefore runs, are
  // bit-identical.
  template <int dim>
  template <typename Receive>
  void
  NodalExchange<dim>::exchange(const Nodes    from,
                               const Nodes    to,
                               double        *records,
                               const double   rest,
                               const Receive &receive)
  {
    const auto        &neighbors    = nodes_->shared_nodes();
    const unsigned int n            = neighbors.size();
    const MPI_Comm     communicator = nodes_->dof_handler().get_communicator();
    constexpr int      tag          = 3110; // of no other message
    outgoing_.resize(n);
    incoming_.resize(n);
    requests_.resize(2 * n);
    statuses_.resize(2 * n);
    for (unsigned int i = 0; i < n; ++i)
      {
        incoming_[i].resize((neighbors[i].*to).size() * (1 + width_));
        const int error = MPI_Irecv(incoming_[i].data(),
                                    incoming_[i].size(),
                                    MPI_DOUBLE,
                                    neighbors[i].rank,
                                    tag,
                                    communicator,
                                    &requests_[i]);
        AssertThrowMPI(error);
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        pack(neighbors[i].*from, records, rest, outgoing_[i]);
        const int error = MPI_Isend(outgoing_[i].data(),
                                    outgoing_[i].size(),
                                    MPI_DOUBLE,
                                    neighbors[i].rank,
                                    tag,
                                    communicator,
                                    &requests_[n + i]);
        AssertThrowMPI(error);
      }
    count_sent();
    const int error = MPI_Waitall(2 * n, requests_.data(), statuses_.data());
    AssertThrowMPI(error);
    received_nodes_.clear();
    for (unsigned int i = 0; i < n; ++i)
      {
        int size = 0;
        MPI_Get_count(&statuses_[i], MPI_DOUBLE, &size);
        for (int at = 0; at < size; at += 1 + width_)
          {
            const double *const entry = incoming_[i].data() + at;
            const unsigned int  node =
              (neighbors[i].*to)[static_cast<unsigned int>(entry[0])];
            received_nodes_.push_back(node);
            receive(records + std::size_t(stride_) * node, entry + 1);
          }
      }
    std::sort(received_nodes_.begin(), received_nodes_.end());
    received_nodes_.erase(std::unique(received_nodes_.begin(),
                                      received_nodes_.end()),
                          received_nodes_.end());
  }



  template <int dim>
  void
  NodalExchange<dim>::add_to_owners(double *records)
  {
    exchange(&NodesWithRank::ghosts,
             &NodesWithRank::owned,
             records,
             0.,
             [this](double *record, const double *sent) {
               for (unsigned int k = 0; k < width_; ++k)
                 record[k] += sent[k];
             });
    set_ghosts(records, 0.);
  }



  template <int dim>
  void
  NodalExchange<dim>::minimum_to_owners(double *records, const double rest)
  {
    exchange(&NodesWithRank::ghosts,
             &NodesWithRank::owned,
             records,
             rest,
             [this](double *record, const double *sent) {
               for (unsigned int k = 0; k < width_; ++k)
                 record[k] = std::min(record[k], sent[k]);
             });
  }



  template <int dim>
  void
  NodalExchange<dim>::copy_to_ghosts(double *records, const double rest)
  {
    set_ghosts(records, rest);
    exchange(&NodesWithRank::owned,
             &NodesWithRank::ghosts,
             records,
             rest,
             [this](double *record, const double *sent) {
               std::copy_n(sent, width_, record);
             });
  }



  template <int dim>
  void
  NodalExchange<dim>::count_sent() const
  {
    SentByRank &sent = nodes_->sent();
    sent.n_nodes_with_soil += sent.n_ghosts_with_soil;
    sent.n_messages += outgoing_.size();
    for (const Message &message : outgoing_)
      {
        sent.n_nodes += message.size() / (1 + width_);
        sent.n_bytes += sizeof(double) * message.size();
      }
  }



  /// Set all records of ghosts to @p value.
  template <int dim>
  void
  NodalExchange<dim>::set_ghosts(double *records, const double value) const
  {
    for (unsigned int node = nodes_->n_owned_nodes(); node < nodes_->n_nodes();
         ++node)
      std::fill_n(records + std::size_t(stride_) * node, width_, value);
  }



  template class NodalExchange<2>;
  template class NodalExchange<3>;
} // namespace talus

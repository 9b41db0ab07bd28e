// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/unknowns.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  /// Unknowns are numbered in the order of the owned nodes, rank after rank, so
  /// that each rank owns a contiguous range, as Trilinos requires. Active nodes
  /// are sorted by number: the order then depends only on mesh and soil, not on
  /// the order of activation. Ghosts receive a record of doubles per node
  /// (first unknown, held components, mass, volume) with one message per
  /// neighbour; a double holds integers up to 2^53.
  template <int dim>
  void
  Unknowns<dim>::number(const NodalFields<dim> &nodes,
                        const Grid<dim>        &grid,
                        const double            mass_cutoff)
  {
    communicator_ = grid.communicator();
    n_nodes_      = grid.n_nodes();
    exchange_of_records_.prepare(grid, width);
    exchange_of_fields_.prepare(grid, dim);
    active_nodes_ = nodes.active_nodes();
    std::sort(active_nodes_.begin(), active_nodes_.end());
    // Lighter nodes have no row: they do not move in the dynamics either.
    active_nodes_.erase(std::remove_if(active_nodes_.begin(),
                                       active_nodes_.end(),
                                       [&](const unsigned int node) {
                                         return !(nodes.mass(node) >
                                                  mass_cutoff);
                                       }),
                        active_nodes_.end());

    const unsigned long n_own = dim * active_nodes_.size();
    const auto counts        = Utilities::MPI::all_gather(communicator_, n_own);
    const unsigned int rank  = Utilities::MPI::this_mpi_process(communicator_);
    unsigned long      begin = 0, n_all = 0;
    for (unsigned int r = 0; r < counts.size(); ++r)
      {
        begin += (r < rank ? counts[r] : 0);
        n_all += counts[r];
      }
    records_.assign(width * std::size_t(n_nodes_), 0.);
    for (unsigned int node = 0; node < n_nodes_; ++node)
      records_[width * std::size_t(node)] = -1.;
    for (unsigned int k = 0; k < active_nodes_.size(); ++k)
      {
        // Entry 1, the held components, stays 0 until constrain().
        double *record = &records_[width * std::size_t(active_nodes_[k])];
        record[0]      = begin + dim * k;
        record[2]      = nodes.mass(active_nodes_[k]);
        record[3]      = nodes.volume(active_nodes_[k]);
      }
    exchange_of_records_.copy_to_ghosts(records_.data());

    owned_ = IndexSet(n_all);
    owned_.add_range(begin, begin + n_own);
    relevant_ = owned_;
    // Add unknowns of ghosts: this rank may add to their rows.
    for (unsigned int node = grid.n_owned_nodes(); node < n_nodes_; ++node)
      if (is_active(node))
        relevant_.add_range(first(node), first(node) + dim);
    relevant_.compress();
  }



  /// Unknowns keep their numbers when a node begins to slip.
  template <int dim>
  void
  Unknowns<dim>::constrain(const std::vector<unsigned char> &held)
  {
    for (const unsigned int node : active_nodes_)
      records_[width * std::size_t(node) + 1] = held[node];
    exchange_of_records_.copy_to_ghosts(records_.data());
  }



  template <int dim>
  double
  Unknowns<dim>::norm(const std::vector<double> &field) const
  {
    return std::sqrt(product(field, field));
  }



  /// Sum over owned nodes only, so that ghosts do not count twice.
  template <int dim>
  double
  Unknowns<dim>::product(const std::vector<double> &a,
                         const std::vector<double> &b) const
  {
    double sum = 0;
    for_each_free_dof([&](const unsigned int node, const unsigned int d) {
      sum += a[dim * node + d] * b[dim * node + d];
    });
    return Utilities::MPI::sum(sum, communicator_);
  }



  template class Unknowns<2>;
  template class Unknowns<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/node_numbering.h>

#include <talus/base/assertion.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Masters of each hanging node with weights, by global indices.
    using Masters = std::vector<std::pair<types::global_dof_index, double>>;
    using Hanging = std::map<types::global_dof_index, Masters>;

    /// Sort the ghosts by owner. Collective.
    std::map<unsigned int, std::vector<types::global_dof_index>>
    sort_by_owner(const IndexSet &owned, const IndexSet &ghosts, MPI_Comm comm)
    {
      const std::vector<unsigned int> owners =
        Utilities::MPI::compute_index_owner(owned, ghosts, comm);
      std::map<unsigned int, std::vector<types::global_dof_index>> result;
      for (unsigned int i = 0; i < owners.size(); ++i)
        result[owners[i]].push_back(ghosts.nth_index_in_set(i));
      return result;
    }



    /// Return the hanging nodes of the cells known to this rank, and their
    /// masters. Masters do not hang: close() replaces a hanging master by its
    /// masters.
    template <int dim>
    Hanging
    masters_of_hanging_nodes(const DoFHandler<dim> &dof_handler,
                             const IndexSet        &relevant)
    {
      AffineConstraints<double> constraints(relevant);
      DoFTools::make_hanging_node_constraints(dof_handler, constraints);
      constraints.close();
      Hanging hanging;
      for (const auto &line : constraints.get_lines())
        hanging[line.index] = line.entries;
      return hanging;
    }



    /// Return the twins of nodes on upper periodic faces as single masters with
    /// weight 1. A uniform mesh has no hanging nodes, but for nodes at the edge
    /// of the known cells the rank may have to ask the owner for the twin.
    template <int dim>
    Hanging
    masters_at_seams(const DoFHandler<dim>  &dof_handler,
                     const Periodicity<dim> &periodicity,
                     const double            cell_size)
    {
      Hanging hanging;
      for (const auto &[node, twin] :
           periodicity.find_twins(dof_handler, cell_size))
        hanging[node] = {{twin, 1.}};
      return hanging;
    }



    /// Complete the hanging nodes at the edge of the cells known to a rank,
    /// which may hang on cells unknown to the rank: ask the owner. In 3-D even
    /// the owner may have to learn from another rank. The reason: boxes reach
    /// across corners, so points add sums to nodes at the far side of the ghost
    /// cells, which may hang on cells that deal.II does not show to this rank.
    /// Without known masters the sums would reach the owner of the node after
    /// it has distributed its sums, and would be lost. A second layer of ghost
    /// cells would help, too, but deal.II has one layer.
    ///
    /// Three rounds of messages among ranks that know nodes of each other, once
    /// per mesh: known masters of nodes of other ranks, requests for nodes of
    /// other ranks, answers. Collective.
    void
    complete_hanging_nodes(
      const IndexSet &owned,
      const std::map<unsigned int, std::vector<types::global_dof_index>>
                    &ghosts,
      const MPI_Comm comm,
      Hanging       &hanging)
    {
      std::map<unsigned int, Hanging> known;
      for (const auto &[owner, nodes] : ghosts)
        for (const auto node : nodes)
          if (const auto it = hanging.find(node); it != hanging.end())
            known[owner].insert(*it);
      for (const auto &message : Utilities::MPI::some_to_some(comm, known))
        for (const auto &[node, masters] : message.second)
          if (owned.is_element(node))
            hanging.emplace(node, masters);

      std::map<unsigned int, Hanging> answers;
      for (const auto &[rank, nodes] :
           Utilities::MPI::some_to_some(comm, ghosts))
        for (const auto node : nodes)
          if (const auto it = hanging.find(node); it != hanging.end())
            answers[rank].insert(*it);
      for (const auto &message : Utilities::MPI::some_to_some(comm, answers))
        hanging.insert(message.second.begin(), message.second.end());
    }
  } // namespace



  template <int dim>
  NodeNumbering<dim>::NodeNumbering(const Mesh<dim> &mesh)
    : fe_(1)
    , dof_handler_(mesh.triangulation())
  {}



  template <int dim>
  void
  NodeNumbering<dim>::prepare_nodes(const Mesh<dim> &mesh)
  {
    number_nodes(mesh);
    find_ghost_nodes(mesh);
    find_shared_nodes(mesh.communicator());
  }



  template <int dim>
  std::vector<types::global_dof_index>
  NodeNumbering<dim>::dofs_of(const CellIterator &cell) const
  {
    std::vector<types::global_dof_index> dofs(fe_.n_dofs_per_cell());
    typename DoFHandler<dim>::active_cell_iterator(&cell->get_triangulation(),
                                                   cell->level(),
                                                   cell->index(),
                                                   &dof_handler_)
      ->get_dof_indices(dofs);
    return dofs;
  }



  template <int dim>
  std::vector<unsigned int>
  NodeNumbering<dim>::nodes_of(const CellIterator &cell) const
  {
    std::vector<unsigned int> nodes;
    for (const auto dof : dofs_of(cell))
      nodes.push_back(local_node(dof));
    return nodes;
  }



  /// Number the nodes in the order of their first occurrence in the cells. The
  /// numbering of deal.II depends on the history of the mesh. This numbering
  /// depends on the mesh only, so that sums over nodes have the same order in a
  /// resumed run; and nodes of consecutive cells are close in memory. Only
  /// owned nodes are renumbered within the index range of the rank, without
  /// communication.
  template <int dim>
  void
  NodeNumbering<dim>::number_nodes(const Mesh<dim> &mesh)
  {
    dof_handler_.distribute_dofs(fe_);
    const IndexSet &owned = dof_handler_.locally_owned_dofs();
    std::vector<types::global_dof_index> numbers(owned.n_elements(),
                                                 numbers::invalid_dof_index);
    types::global_dof_index              next =
      owned.n_elements() == 0 ? 0 : owned.nth_index_in_set(0);
    for (const auto &cell : mesh.cells_in_order())
      if (cell->is_locally_owned())
        for (const auto dof : dofs_of(cell))
          if (owned.is_element(dof))
            if (auto &number = numbers[owned.index_within_set(dof)];
                number == numbers::invalid_dof_index)
              number = next++;
    dof_handler_.renumber_dofs(numbers);
  }



  /// Return the local number of a node from its global index: owned nodes
  /// first, then ghosts, sorted by global index and hence by owner.
  template <int dim>
  unsigned int
  NodeNumbering<dim>::local_node(const types::global_dof_index node) const
  {
    // Cells at an upper periodic face use the nodes of the lower face; the
    // nodes on the upper face are never used.
    const auto twin = twins_.find(node);
    const auto n    = (twin == twins_.end() ? node : twin->second);
    return owned_nodes_.is_element(n)
             ? owned_nodes_.index_within_set(n)
             : owned_nodes_.n_elements() + ghost_nodes_.index_within_set(n);
  }



  /// Set the lists of owned, ghost and hanging nodes. At a hanging node the
  /// shape functions of large and small cells do not match; the node therefore
  /// takes the weighted mean of its masters, which makes the interpolation
  /// continuous. The transfer ignores the constraint and adds sums to hanging
  /// nodes as to all nodes. NodalFields distributes the sums by the transposed
  /// constraint, so that no mass or momentum is lost.
  ///
  /// A node on an upper periodic face is identical to its twin: cells use the
  /// number of the twin, and no sums need to be distributed.
  template <int dim>
  void
  NodeNumbering<dim>::find_ghost_nodes(const Mesh<dim> &mesh)
  {
    const MPI_Comm comm        = mesh.communicator();
    const bool     is_periodic = mesh.periodicity().any();
    owned_nodes_               = dof_handler_.locally_owned_dofs();
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler_, relevant);
    Hanging hanging =
      (is_periodic
         ? masters_at_seams(dof_handler_, mesh.periodicity(), mesh.cell_size())
         : masters_of_hanging_nodes(dof_handler_, relevant));

    ghost_nodes_ = relevant;
    ghost_nodes_.subtract_set(owned_nodes_);
    if (Utilities::MPI::n_mpi_processes(comm) > 1 &&
        Utilities::MPI::max(static_cast<unsigned int>(hanging.size()), comm) >
          0)
      {
        complete_hanging_nodes(owned_nodes_,
                               sort_by_owner(owned_nodes_, ghost_nodes_, comm),
                               comm,
                               hanging);
        for (const auto &[node, masters] : hanging)
          for (const auto &master : masters)
            if (!owned_nodes_.is_element(master.first))
              ghost_nodes_.add_index(master.first);
      }
    ghost_nodes_.compress();

    hanging_nodes_.clear();
    twins_.clear();
    for (const auto &[node, masters] : hanging)
      if (is_periodic)
        twins_[node] = masters[0].first;
      else
        {
          HangingNode entry{local_node(node), {}};
          for (const auto &[master, weight] : masters)
            {
              // Masters do not hang: one pass in any order distributes the
              // sums.
              TalusAssert(hanging.count(master) == 0, ExcInternalError());
              entry.masters.emplace_back(local_node(master), weight);
            }
          hanging_nodes_.push_back(entry);
        }
  }



  template <int dim>
  void
  NodeNumbering<dim>::find_shared_nodes(const MPI_Comm communicator)
  {
    // The partitioner has asked the other ranks for their ghosts. Ghosts are
    // sorted by owner.
    const Utilities::MPI::Partitioner     partitioner(owned_nodes_,
                                                  ghost_nodes_,
                                                  communicator);
    std::map<unsigned int, NodesWithRank> by_rank;
    unsigned int                          ghost = n_owned_nodes();
    for (const auto &[rank, n] : partitioner.ghost_targets())
      for (unsigned int i = 0; i < n; ++i)
        by_rank[rank].ghosts.push_back(ghost++);
    std::vector<unsigned int> owned;
    for (const auto &[begin, end] : partitioner.import_indices())
      for (unsigned int node = begin; node < end; ++node)
        owned.push_back(node);
    auto at = owned.begin();
    for (const auto &[rank, n] : partitioner.import_targets())
      {
        by_rank[rank].owned.assign(at, at + n);
        at += n;
      }
    shared_nodes_.clear();
    for (auto &[rank, nodes] : by_rank)
      {
        nodes.rank = rank;
        shared_nodes_.push_back(std::move(nodes));
      }
  }



  template class NodeNumbering<2>;
  template class NodeNumbering<3>;
} // namespace talus

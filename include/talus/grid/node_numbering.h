// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_node_numbering_h
#define talus_grid_node_numbering_h

#include <talus/grid/mesh.h>

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>

#include <map>
#include <utility>
#include <vector>

namespace talus
{
  /// Hanging node; its value is the weighted mean of its masters' values.
  struct HangingNode
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };



  /// Nodes shared with another rank. Both ranks list the nodes in the same
  /// order.
  struct NodesWithRank
  {
    unsigned int              rank;
    std::vector<unsigned int> ghosts; ///< owned by the other rank
    std::vector<unsigned int> owned;  ///< ghosts on the other rank
  };



  /// Messages with nodal records that this rank has sent.
  struct SentByRank
  {
    double n_messages         = 0;
    double n_nodes            = 0; ///< summed over the exchanges
    double n_bytes            = 0;
    double n_ghosts_with_soil = 0; ///< in the last step
    double n_nodes_with_soil  = 0; ///< ghosts, summed over the exchanges
  };



  /// Numbers of the nodes known to this rank: owned nodes in the order of their
  /// first occurrence in the owned cells, then ghosts by owner. Ghosts are the
  /// nodes of owned and ghost cells owned by other ranks, and the masters of
  /// hanging nodes among them.
  template <int dim>
  class NodeNumbering
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;

    /// Number of nodes known to this rank.
    unsigned int
    n_nodes() const
    {
      return n_owned_nodes() + ghost_nodes_.n_elements();
    }

    unsigned int
    n_owned_nodes() const
    {
      return owned_nodes_.n_elements();
    }

    /// Global indices of the nodes owned by this rank.
    const dealii::IndexSet &
    owned_nodes() const
    {
      return owned_nodes_;
    }

    const dealii::IndexSet &
    ghost_nodes() const
    {
      return ghost_nodes_;
    }

    /// Nodes shared with each neighbour, in the order of the ranks.
    const std::vector<NodesWithRank> &
    shared_nodes() const
    {
      return shared_nodes_;
    }

    /// Counts of NodalExchange, no part of the numbering.
    SentByRank &
    sent() const
    {
      return sent_;
    }

    const std::vector<HangingNode> &
    hanging_nodes() const
    {
      return hanging_nodes_;
    }

    /// Return the nodes at the vertices of a cell, in the order of deal.II.
    std::vector<unsigned int>
    nodes_of(const CellIterator &cell) const;

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dof_handler_;
    }

  protected:
    explicit NodeNumbering(const Mesh<dim> &mesh);

    /// Number the nodes and find ghost, hanging and shared nodes.
    /// Collective.
    void
    prepare_nodes(const Mesh<dim> &mesh);

  private:
    std::vector<dealii::types::global_dof_index>
    dofs_of(const CellIterator &cell) const;
    void
    number_nodes(const Mesh<dim> &mesh);
    unsigned int
    local_node(dealii::types::global_dof_index node) const;
    void
    find_ghost_nodes(const Mesh<dim> &mesh);
    void
    find_shared_nodes(MPI_Comm communicator);

    dealii::FE_Q<dim>          fe_;
    dealii::DoFHandler<dim>    dof_handler_;
    dealii::IndexSet           owned_nodes_;
    dealii::IndexSet           ghost_nodes_;
    std::vector<NodesWithRank> shared_nodes_;
    mutable SentByRank         sent_;
    std::vector<HangingNode>   hanging_nodes_;
    std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
      twins_; ///< twin of each node on an upper periodic face
  };
} // namespace talus

#endif

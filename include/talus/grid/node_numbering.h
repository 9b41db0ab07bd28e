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
  /// A hanging node: its value is a mean of those of its masters.
  struct HangingNode
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };



  /// The nodes of the mesh that this rank knows, and their numbers: as the
  /// owned cells, in the order of the mesh, meet them; then come the ghosts, by
  /// owner. Ghosts are the nodes of the cells around the owned ones, and the
  /// masters of those among them that hang.
  template <int dim>
  class NodeNumbering
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;

    /// Nodes this rank knows.
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

    /// Indices over all ranks of the nodes this rank owns, and of its ghosts.
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

    /// Nodes of this rank that are ghosts elsewhere, ascending.
    const std::vector<unsigned int> &
    interface_nodes() const
    {
      return interface_nodes_;
    }

    const std::vector<HangingNode> &
    hanging_nodes() const
    {
      return hanging_nodes_;
    }

    /// The nodes at the vertices of a cell, in deal.II's order.
    std::vector<unsigned int>
    nodes_of(const CellIterator &cell) const;

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dof_handler_;
    }

  protected:
    explicit NodeNumbering(const Mesh<dim> &mesh);

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
    find_interface_nodes(MPI_Comm communicator);

    dealii::FE_Q<dim>         fe_;
    dealii::DoFHandler<dim>   dof_handler_;
    dealii::IndexSet          owned_nodes_;
    dealii::IndexSet          ghost_nodes_;
    std::vector<unsigned int> interface_nodes_;
    std::vector<HangingNode>  hanging_nodes_;
    std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
      twins_; ///< of nodes on upper periodic faces
  };
} // namespace talus

#endif

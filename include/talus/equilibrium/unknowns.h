// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_unknowns_h
#define talus_equilibrium_unknowns_h

#include <talus/grid/nodal_exchange.h>
#include <talus/grid/nodal_fields.h>

#include <deal.II/base/index_set.h>

#include <vector>

namespace talus
{
  /// Unknown displacements: dim for each node that soil touches. Further nodes
  /// have no unknowns, so the matrix has no empty rows. Hanging nodes have none
  /// either: their weights go to the master nodes.
  ///
  /// Unknowns are numbered over all ranks, contiguous on each rank and in the
  /// order of its nodes. Nodal fields are arrays with dim doubles for each node
  /// of the grid, ghosts included.
  template <int dim>
  class Unknowns
  {
  public:
    /// Number the unknowns of all nodes with a mass above @p mass_cutoff, kg,
    /// by the mass known to the owner. Collective.
    void
    number(const NodalFields<dim> &nodes,
           const Grid<dim>        &grid,
           double                  mass_cutoff);

    /// Hold components of the owned nodes, with zero displacement: bit d of
    /// held[node] holds component d. Collective.
    void
    constrain(const std::vector<unsigned char> &held);

    /// Owned nodes with unknowns, ascending.
    const std::vector<unsigned int> &
    active_nodes() const
    {
      return active_nodes_;
    }

    /// Return whether the node, owned or ghost, has unknowns.
    bool
    is_active(const unsigned int node) const
    {
      return records_[width * std::size_t(node)] >= 0.;
    }

    /// Index of the first unknown of an active node.
    dealii::types::global_dof_index
    first(const unsigned int node) const
    {
      return static_cast<dealii::types::global_dof_index>(
        records_[width * std::size_t(node)]);
    }

    /// Return whether component @p d of an owned or ghost node is held.
    bool
    is_constrained(const unsigned int node, const unsigned int d) const
    {
      return (static_cast<unsigned int>(
                records_[width * std::size_t(node) + 1]) >>
              d) &
             1u;
    }

    /// Mass of an owned or ghost node, kg.
    double
    mass(const unsigned int node) const
    {
      return records_[width * std::size_t(node) + 2];
    }

    /// Volume of the soil near an owned or ghost node at its reference density,
    /// m^dim.
    double
    volume(const unsigned int node) const
    {
      return records_[width * std::size_t(node) + 3];
    }

    const dealii::IndexSet &
    owned() const
    {
      return owned_;
    }

    const dealii::IndexSet &
    relevant() const
    {
      return relevant_;
    }

    dealii::types::global_dof_index
    n_global() const
    {
      return owned_.size();
    }

    MPI_Comm
    communicator() const
    {
      return communicator_;
    }

    /// Nodal field of zeros.
    std::vector<double>
    field() const
    {
      return std::vector<double>(dim * std::size_t(n_nodes_), 0.);
    }

    /// Add the values of a field at ghosts to the values of their owners.
    /// Collective.
    void
    add_to_owners(std::vector<double> &field)
    {
      exchange_of_fields_.add_to_owners(field.data());
    }

    /// Copy a field from the owners to the ghosts. Collective.
    void
    copy_to_ghosts(std::vector<double> &field)
    {
      exchange_of_fields_.copy_to_ghosts(field.data());
    }

    /// Call action(node, component) for each unknown of this rank that is not
    /// held.
    template <typename Action>
    void
    for_each_free_dof(const Action &action) const
    {
      for (const unsigned int node : active_nodes_)
        for (unsigned int d = 0; d < dim; ++d)
          if (!is_constrained(node, d))
            action(node, d);
    }

    /// Euclidean norm of a field over all free unknowns. Collective.
    double
    norm(const std::vector<double> &field) const;

    /// Scalar product of two fields over all free unknowns. Collective.
    double
    product(const std::vector<double> &a, const std::vector<double> &b) const;

  private:
    // Columns of records_: first unknown (-1: none), held components as bits,
    // mass, volume.
    static constexpr unsigned int width = 4;

    MPI_Comm                  communicator_ = MPI_COMM_NULL;
    unsigned int              n_nodes_      = 0;
    std::vector<unsigned int> active_nodes_;
    std::vector<double>       records_;
    dealii::IndexSet          owned_, relevant_;
    NodalExchange<dim>        exchange_of_records_;
    NodalExchange<dim>        exchange_of_fields_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/nodal_fields.h>

#include <algorithm>
#include <array>

namespace talus
{
  using namespace dealii;

  // Two arrays of records instead of one array per quantity: all data that a
  // point adds to a node or reads from a node lie in one or two cache lines.
  // Sums and motions are separate, because each sweep of a step needs only one
  // of them.
  template <int dim>
  void
  NodalFields<dim>::prepare(const Grid<dim> &grid)
  {
    n_nodes_       = grid.n_nodes();
    n_owned_nodes_ = grid.n_owned_nodes();
    sums_.assign(Sum::width * std::size_t(n_nodes_), 0.);
    motions_.assign(Motion::width * std::size_t(n_nodes_), 0.);
    exchange_of_sums_.prepare(grid, Sum::width);
    exchange_of_motions_.prepare(grid, Motion::width);
    exchange_of_volumes_.prepare(grid, 1, Sum::width);
    is_active_.assign(n_nodes_, 0);
    active_nodes_.clear();
    active_ghosts_.clear();
    active_boundary_nodes_.clear();
    n_active_of_cells_ = n_active_boundary_of_cells_ = 0;
  }



  /// Append a node to the lists of active nodes unless it is active already.
  template <int dim>
  void
  NodalFields<dim>::add_active(const Grid<dim> &grid, const unsigned int node)
  {
    if (is_active_[node])
      return;
    is_active_[node] = 1;
    if (node >= n_owned_nodes_)
      {
        active_ghosts_.push_back(node);
        return;
      }
    active_nodes_.push_back(node);
    if (grid.faces_of_node(node) != 0)
      active_boundary_nodes_.push_back(node);
  }



  namespace
  {
    /// Call action(k) for the entries k of the patch of a uniform cell that are
    /// in no patch of a face neighbour with a nonzero value in @p is_visited:
    /// along each axis, a neighbour has three of the four layers. Most cells
    /// have a visited neighbour along each axis, and a single new entry.
    template <int dim, typename Action>
    void
    for_each_new_entry(const Cell<dim>                  &cell,
                       const std::vector<unsigned char> &is_visited,
                       const Action                     &action)
    {
      constexpr unsigned int        middle = power(3, dim) / 2;
      std::array<unsigned int, dim> first, n;
      unsigned int                  n_entries = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto has_visited = [&](const unsigned int neighbor) {
            const unsigned int c = cell.neighbors[neighbor];
            return c < is_visited.size() && is_visited[c];
          };
          const bool below = has_visited(middle - power(3, d));
          const bool above = has_visited(middle + power(3, d));
          first[d]         = below ? 3 : 0;
          n[d]             = below && above ? 0 : below || above ? 1 : 4;
          n_entries *= n[d];
        }
      for (unsigned int i = 0; i < n_entries; ++i)
        {
          unsigned int k = 0;
          for (unsigned int d = 0, rest = i; d < dim; rest /= n[d++])
            k += (first[d] + rest % n[d]) * power(4, d);
          action(k);
        }
    }
  } // namespace



  // The cost of a step must depend on the number of points and not on the size
  // of the mesh, which may be mostly empty. Therefore loops run over lists of
  // the nodes that points may touch. The lists change only with the set of
  // occupied cells; their order follows the cells, so that sums over nodes have
  // the same order in a resumed run. Records of inactive owned nodes are zero:
  // a step neither clears nor reads them.
  template <int dim>
  void
  NodalFields<dim>::activate(const Grid<dim>                 &grid,
                             const std::vector<unsigned int> &cells)
  {
    std::swap(active_nodes_, formerly_active_nodes_);
    formerly_active_nodes_.insert(formerly_active_nodes_.end(),
                                  active_ghosts_.begin(),
                                  active_ghosts_.end());
    for (const unsigned int node : formerly_active_nodes_)
      is_active_[node] = 0;
    active_nodes_.clear();
    active_ghosts_.clear();
    active_boundary_nodes_.clear();

    // For a cell that is not uniform only its own nodes: the touching cells add
    // the nodes around.
    std::vector<unsigned char> is_visited(grid.cells().size(), 0);
    const auto                 add_patch = [&](const unsigned int c) {
      const Cell<dim> &cell = grid.cells()[c];
      if (cell.uniform)
        for_each_new_entry(cell, is_visited, [&](const unsigned int k) {
          add_active(grid, cell.patch[k]);
        });
      else
        for (unsigned int k = 0; k < cell.patch.size(); ++k)
          if (is_own_node<dim>(k))
            add_active(grid, cell.patch[k]);
      is_visited[c] = cell.uniform;
    };
    for (const unsigned int c : cells)
      if (grid.cells()[c].uniform)
        add_patch(c);
      else
        for (const unsigned int t : grid.touching_cells(c))
          add_patch(t);
    for (const auto &hanging : grid.hanging_nodes())
      if (is_active_[hanging.node])
        for (const auto &master : hanging.masters)
          add_active(grid, master.first);
    n_active_of_cells_          = active_nodes_.size();
    n_active_boundary_of_cells_ = active_boundary_nodes_.size();
    activate_received(grid);

    // Nodes without soil must be zero when they become active again.
    for (const unsigned int node : formerly_active_nodes_)
      if (!is_active_[node])
        {
          std::fill_n(sum(node), Sum::width, 0.);
          std::fill_n(motion(node), Motion::width, 0.);
        }
  }



  // The points of other ranks touch other nodes in each step. In ascending
  // order the nodes with soil have the same order in a resumed run.
  /// Activate the nodes that got sums from other ranks.
  template <int dim>
  void
  NodalFields<dim>::activate_received(const Grid<dim> &grid)
  {
    for (const unsigned int node : exchange_of_sums_.received_nodes())
      add_active(grid, node);
  }



  template <int dim>
  void
  NodalFields<dim>::deactivate_received()
  {
    for (std::size_t i = n_active_of_cells_; i < active_nodes_.size(); ++i)
      {
        is_active_[active_nodes_[i]] = 0;
        std::fill_n(motion(active_nodes_[i]), Motion::width, 0.);
      }
    active_nodes_.resize(n_active_of_cells_);
    active_boundary_nodes_.resize(n_active_boundary_of_cells_);
  }



  // All ghosts, active or not: other ranks share volumes at any node.
  template <int dim>
  void
  NodalFields<dim>::clear()
  {
    for (const unsigned int node : active_nodes_)
      std::fill_n(sum(node), Sum::width, 0.);
    for (unsigned int node = n_owned_nodes_; node < n_nodes_; ++node)
      std::fill_n(sum(node), Sum::width, 0.);
    deactivate_received();
  }



  // Hanging nodes come first: masters may be ghosts, whose sums are sent
  // afterwards. With the weights w of the constraint u_h = sum w u_m the master
  // gets w times the sum: the transpose of the interpolation conserves the
  // sums, and the power of nodal forces stays the same.
  template <int dim>
  void
  NodalFields<dim>::sum_over_ranks(const Grid<dim> &grid)
  {
    for (const auto &hanging : grid.hanging_nodes())
      if (is_active_[hanging.node])
        {
          double *const value = sum(hanging.node);
          for (const auto &[node, weight] : hanging.masters)
            for (unsigned int c = 0; c < Sum::n_entries; ++c)
              sum(node)[c] += weight * value[c];
          std::fill_n(value, Sum::width, 0.);
        }
    exchange_of_sums_.add_to_owners(sums_.data());
    activate_received(grid);
  }



  template <int dim>
  void
  NodalFields<dim>::share_volumes()
  {
    exchange_of_volumes_.copy_to_ghosts(sums_.data() + Sum::volume);
  }



  // The lumped mass decouples the nodes. Without the cut-off f/m is unbounded:
  // when a point barely touches a node, the mass of the node falls faster than
  // the force. The cut-off must be small; otherwise nodes in front of the slide
  // act as a wall.
  template <int dim>
  void
  NodalFields<dim>::update_momentum(const double dt, const double mass_cutoff)
  {
    // The list follows the cells, so the processor cannot predict the next
    // node: prefetch some nodes ahead.
    constexpr std::size_t ahead = 16;
    const std::size_t     n     = active_nodes_.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        if (i + ahead < n)
          {
            __builtin_prefetch(sum(active_nodes_[i + ahead]));
            __builtin_prefetch(motion(active_nodes_[i + ahead]), 1);
          }
        const double *s            = sum(active_nodes_[i]);
        double       *v            = motion(active_nodes_[i]);
        const double  mass         = s[Sum::mass];
        const double  inverse_mass = (mass > mass_cutoff ? 1. / mass : 0.);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double increment =
              dt * (s[Sum::force + d] + s[Sum::force_by_x + d]) * inverse_mass;
            v[Motion::increment + d] = increment;
            v[Motion::velocity + d] =
              s[Sum::momentum + d] * inverse_mass + increment;
          }
      }
  }



  // Reverse order of sum_over_ranks(): ghosts first, since masters may be
  // ghosts.
  template <int dim>
  void
  NodalFields<dim>::share_with_ghosts(const Grid<dim> &grid)
  {
    exchange_of_motions_.copy_to_ghosts(motions_.data());
    grid.sent().n_ghosts_with_soil =
      exchange_of_motions_.received_nodes().size();
    for (const auto &hanging : grid.hanging_nodes())
      if (is_active_[hanging.node])
        {
          double *const value = motion(hanging.node);
          std::fill_n(value, Motion::width, 0.);
          for (const auto &[node, weight] : hanging.masters)
            for (unsigned int c = 0; c < Motion::width; ++c)
              value[c] += weight * motion(node)[c];
        }
  }



  template <int dim>
  void
  NodalFields<dim>::add_force(const unsigned int    node,
                              const Tensor<1, dim> &force)
  {
    for (unsigned int d = 0; d < dim; ++d)
      sum(node)[Sum::force + d] += force[d];
  }



  template <int dim>
  void
  NodalFields<dim>::set_sums(const unsigned int    node,
                             const double          mass,
                             const double          volume,
                             const Tensor<1, dim> &momentum,
                             const Tensor<1, dim> &force)
  {
    std::fill_n(sum(node), Sum::width, 0.);
    add_sums(node, mass, volume, momentum, force);
  }



  template <int dim>
  void
  NodalFields<dim>::set_motion(const unsigned int    node,
                               const Tensor<1, dim> &velocity,
                               const Tensor<1, dim> &increment)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        motion(node)[Motion::velocity + d]  = velocity[d];
        motion(node)[Motion::increment + d] = increment[d];
      }
  }



  // The increment changes with the velocity, so that FLIP transfers the action
  // of boundaries to the points, and the mean velocity of the step is correct.
  template <int dim>
  Tensor<1, dim>
  NodalFields<dim>::set_velocity(const unsigned int    node,
                                 const Tensor<1, dim> &velocity)
  {
    double        *v = motion(node);
    Tensor<1, dim> impulse;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double change     = velocity[d] - v[Motion::velocity + d];
        v[Motion::velocity + d] = velocity[d];
        v[Motion::increment + d] += change;
        impulse[d] = mass(node) * change;
      }
    return impulse;
  }



  // Without ghosts, so that the sum over the ranks counts each node once.
  template <int dim>
  double
  NodalFields<dim>::kinetic_energy() const
  {
    double energy = 0;
    for (const unsigned int node : active_nodes_)
      energy += 0.5 * mass(node) * velocity(node).norm_square();
    return energy;
  }



  template class NodalFields<2>;
  template class NodalFields<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/nodal_fields.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  // Two arrays of records and not one per quantity: what a point gives to a
  // node, and takes from it, lies in one or two lines of the cache. Sums and
  // motions are apart because the two sweeps of a step each need one of them
  // only.
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
    is_active_.assign(n_nodes_, 0);
    active_nodes_.clear();
    active_ghosts_.clear();
    active_boundary_nodes_.clear();
  }



  /// Put a node on the lists that loops over nodes go along, unless it is
  /// there.
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



  // The cost of a step must follow the points and not the mesh, most of which
  // may be empty. So loops go over lists of the nodes that points may touch;
  // these are made only when the set of occupied cells changes, in the order of
  // the cells, so that the sums over nodes have the same order in a resumed
  // run. Records of owned nodes that are not active are zero: they are neither
  // cleared nor looked at in a step.
  template <int dim>
  void
  NodalFields<dim>::activate(const Grid<dim>                 &grid,
                             const std::vector<unsigned int> &cells)
  {
    std::swap(active_nodes_, formerly_active_nodes_);
    for (const unsigned int node : formerly_active_nodes_)
      is_active_[node] = 0;
    for (const unsigned int node : active_ghosts_)
      is_active_[node] = 0;
    active_nodes_.clear();
    active_ghosts_.clear();
    active_boundary_nodes_.clear();

    // Of a cell that is not uniform only its own nodes: those of the cells
    // around are theirs.
    const auto add_patch = [&](const unsigned int c) {
      const Cell<dim> &cell = grid.cells()[c];
      for (unsigned int k = 0; k < cell.patch.size(); ++k)
        if (cell.uniform || is_own_node<dim>(k))
          add_active(grid, cell.patch[k]);
    };
    for (const unsigned int c : cells)
      if (grid.cells()[c].uniform)
        add_patch(c);
      else
        for (const unsigned int t : grid.touching_cells(c))
          add_patch(t);
    // Points on another rank may touch what is shared with it.
    for (const unsigned int node : grid.interface_nodes())
      add_active(grid, node);
    for (const auto &hanging : grid.hanging_nodes())
      if (is_active_[hanging.node])
        for (const auto &master : hanging.masters)
          add_active(grid, master.first);

    // Nodes that soil has left are empty when it comes back.
    for (const unsigned int node : formerly_active_nodes_)
      if (!is_active_[node])
        {
          std::fill_n(sum(node), Sum::width, 0.);
          std::fill_n(motion(node), Motion::width, 0.);
        }
  }



  // Ghosts without exception: their records travel whether they are active or
  // not.
  template <int dim>
  void
  NodalFields<dim>::clear()
  {
    for (const unsigned int node : active_nodes_)
      std::fill_n(sum(node), Sum::width, 0.);
    for (unsigned int node = n_owned_nodes_; node < n_nodes_; ++node)
      std::fill_n(sum(node), Sum::width, 0.);
  }



  // Hanging nodes come first: masters may be ghosts, whose sums then travel
  // with the rest. With the weights w of the constraint u_h = sum w u_m the
  // master gets w times the sum: what is transposed to the interpolation
  // conserves the sums, and the power of nodal forces is the same before and
  // after.
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
  }



  // With the lumped mass each node stands alone. The cut-off is there because
  // the mass of a node falls faster than the force on it as a point barely
  // touches it: without it f/m has no bound. It must be small, or nodes in
  // front of the slide act as a wall.
  template <int dim>
  void
  NodalFields<dim>::update_momentum(const double dt, const double mass_cutoff)
  {
    // The list goes from cell to cell, so that the machine does not see which
    // node will be next: ask for it some nodes before.
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



  // The other way round: ghosts first, since they may be masters.
  template <int dim>
  void
  NodalFields<dim>::share_with_ghosts(const Grid<dim> &grid)
  {
    exchange_of_motions_.copy_to_ghosts(motions_.data());
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



  /// Unlike velocity times mass it is what the points sent, untouched by the
  /// step.
  template <int dim>
  Tensor<1, dim>
  NodalFields<dim>::momentum(const unsigned int node) const
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = sum(node)[Sum::momentum + d];
    return result;
  }



  /// The two parts in which the kernels add it up (NodalSum) together.
  template <int dim>
  Tensor<1, dim>
  NodalFields<dim>::force(const unsigned int node) const
  {
    const double  *s = sum(node);
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = s[Sum::force + d] + s[Sum::force_by_x + d];
    return result;
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
  NodalFields<dim>::scale_inertia(const unsigned int node, const double factor)
  {
    sum(node)[Sum::mass] *= factor;
    for (unsigned int d = 0; d < dim; ++d)
      sum(node)[Sum::momentum + d] *= factor;
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



  // The increment changes with the velocity, so that FLIP gives the points what
  // boundaries do, too, and the mean velocity of the step stays right.
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



  // A constant force over dt does the work dt f . (v_before + v_after)/2
  // exactly; v_after alone would falsify the energy budget by (dt f)^2/(2 m).
  template <int dim>
  Tensor<1, dim>
  NodalFields<dim>::mean_velocity(const unsigned int node) const
  {
    Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = motion(node)[Motion::velocity + d] -
             0.5 * motion(node)[Motion::increment + d];
    return v;
  }



  // Ghosts are left out, so that the sum over the ranks counts each node once.
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_nodal_fields_h
#define talus_grid_nodal_fields_h

#include <talus/base/large_pages.h>
#include <talus/grid/grid.h>
#include <talus/grid/nodal_exchange.h>
#include <talus/grid/nodal_record.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace talus
{
  /// Nodal values of one step on the background grid. Only nodes near soil are
  /// active; all loops run over active nodes.
  template <int dim>
  class NodalFields
  {
  public:
    using Sum    = NodalSum<dim>;
    using Motion = NodalMotion<dim>;

    /// Allocate the records for the nodes of @p grid; no node is active.
    void
    prepare(const Grid<dim> &grid);

    /// Activate the nodes in the patches of the given cells (ascending), and
    /// the nodes that got sums from other ranks in the last sum_over_ranks().
    void
    activate(const Grid<dim> &grid, const std::vector<unsigned int> &cells);

    /// Set all sums of active nodes and of all ghosts to zero.
    void
    clear();

    /// Add the sums at hanging nodes to their masters, and the sums of ghosts
    /// to their owners, with one message per neighbour. Nodes of this rank that
    /// get sums from other ranks are active until clear(). Collective.
    void
    sum_over_ranks(const Grid<dim> &grid);

    /// Copy the volume of soil at the owners to the ghosts, after
    /// sum_over_ranks(). Collective.
    void
    share_volumes();

    /// Compute increment dt f/m and new velocity of all active nodes of this
    /// rank with more mass than @p mass_cutoff, kg; other nodes get zero
    /// velocity. @p dt is in s.
    void
    update_momentum(double dt, double mass_cutoff);

    /// Copy the motion of owners to the ghosts, and interpolate the motion of
    /// hanging nodes from their masters, with one message per neighbour.
    /// Collective.
    void
    share_with_ghosts(const Grid<dim> &grid);

    /// Active nodes owned by this rank.
    const std::vector<unsigned int> &
    active_nodes() const
    {
      return active_nodes_;
    }

    /// Active nodes owned by this rank that lie on a face of the mesh.
    const std::vector<unsigned int> &
    active_boundary_nodes() const
    {
      return active_boundary_nodes_;
    }

    double
    mass(const unsigned int node) const
    {
      return sum(node)[Sum::mass];
    }

    /// Volume of the soil at reference density, m^dim.
    double
    volume(const unsigned int node) const
    {
      return sum(node)[Sum::volume];
    }

    /// Momentum before the step, kg m/s.
    dealii::Tensor<1, dim>
    momentum(unsigned int node) const;

    /// Force on the node, N.
    dealii::Tensor<1, dim>
    force(unsigned int node) const;

    void
    add_force(unsigned int node, const dealii::Tensor<1, dim> &force);

    /// Add the contribution of a point to the sums of a node.
    ///
    /// @param mass kg
    /// @param volume reference volume, m^dim
    /// @param momentum kg m/s
    /// @param force N
    void
    add_sums(unsigned int                  node,
             double                        mass,
             double                        volume,
             const dealii::Tensor<1, dim> &momentum,
             const dealii::Tensor<1, dim> &force);

    /// Replace the sums of a node, with the units of add_sums().
    void
    set_sums(unsigned int                  node,
             double                        mass,
             double                        volume,
             const dealii::Tensor<1, dim> &momentum,
             const dealii::Tensor<1, dim> &force);

    /// Multiply mass and momentum of a node by @p factor; the velocity is
    /// unchanged.
    void
    scale_inertia(unsigned int node, double factor);

    dealii::Tensor<1, dim>
    velocity(const unsigned int node) const;

    /// Change of the velocity of a node in the step, m/s.
    dealii::Tensor<1, dim>
    increment(const unsigned int node) const;

    /// Set the new velocity of a node, m/s, and change the increment by the
    /// same amount. Return the impulse of the change, N s.
    dealii::Tensor<1, dim>
    set_velocity(unsigned int node, const dealii::Tensor<1, dim> &velocity);

    /// Mean of the velocities before and after the step, m/s. The work of a
    /// nodal force over the step is force times time step times mean velocity.
    dealii::Tensor<1, dim>
    mean_velocity(const unsigned int node) const;

    /// Set velocity and increment of a node, m/s, independent of the step.
    void
    set_motion(unsigned int                  node,
               const dealii::Tensor<1, dim> &velocity,
               const dealii::Tensor<1, dim> &increment);

    /// Kinetic energy of the nodes owned by this rank, J.
    double
    kinetic_energy() const;

    // Records of a node, for the kernels of the transfer.

    double *
    sum(const unsigned int node)
    {
      return sums_.data() + Sum::width * std::size_t(node);
    }

    const double *
    sum(const unsigned int node) const
    {
      return sums_.data() + Sum::width * std::size_t(node);
    }

    double *
    motion(const unsigned int node)
    {
      return motions_.data() + Motion::width * std::size_t(node);
    }

    const double *
    motion(const unsigned int node) const
    {
      return motions_.data() + Motion::width * std::size_t(node);
    }

  private:
    void
    add_active(const Grid<dim> &grid, unsigned int node);
    void
    activate_received(const Grid<dim> &grid);
    void
    deactivate_received();

    unsigned int              n_owned_nodes_ = 0;
    unsigned int              n_nodes_       = 0;
    LargePageVector<double>   sums_;
    LargePageVector<double>   motions_;
    NodalExchange<dim>        exchange_of_sums_;
    NodalExchange<dim>        exchange_of_motions_;
    NodalExchange<dim>        exchange_of_volumes_;
    std::vector<unsigned int> active_nodes_;
    std::vector<unsigned int> active_ghosts_;
    std::vector<unsigned int> formerly_active_nodes_;
    std::vector<unsigned int> active_boundary_nodes_;
    unsigned int n_active_of_cells_          = 0; ///< then those of other ranks
    unsigned int n_active_boundary_of_cells_ = 0;
    std::vector<unsigned char> is_active_;
  };



  /// The sum of the contributions of points. Unlike velocity times mass it is
  /// not changed by the step.
  template <int dim>
  inline dealii::Tensor<1, dim>
  NodalFields<dim>::momentum(const unsigned int node) const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = sum(node)[Sum::momentum + d];
    return result;
  }



  /// Sum of the two parts of NodalSum.
  template <int dim>
  inline dealii::Tensor<1, dim>
  NodalFields<dim>::force(const unsigned int node) const
  {
    const double          *s = sum(node);
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = s[Sum::force + d] + s[Sum::force_by_x + d];
    return result;
  }



  template <int dim>
  inline void
  NodalFields<dim>::scale_inertia(const unsigned int node, const double factor)
  {
    sum(node)[Sum::mass] *= factor;
    for (unsigned int d = 0; d < dim; ++d)
      sum(node)[Sum::momentum + d] *= factor;
  }



  // A constant force over dt does exactly the work dt f . (v_before +
  // v_after)/2; with v_after alone the energy budget would have an error of (dt
  // f)^2/(2 m).
  template <int dim>
  inline dealii::Tensor<1, dim>
  NodalFields<dim>::mean_velocity(const unsigned int node) const
  {
    dealii::Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = motion(node)[Motion::velocity + d] -
             0.5 * motion(node)[Motion::increment + d];
    return v;
  }



  template <int dim>
  inline dealii::Tensor<1, dim>
  NodalFields<dim>::velocity(const unsigned int node) const
  {
    dealii::Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = motion(node)[Motion::velocity + d];
    return v;
  }



  template <int dim>
  inline dealii::Tensor<1, dim>
  NodalFields<dim>::increment(const unsigned int node) const
  {
    dealii::Tensor<1, dim> dv;
    for (unsigned int d = 0; d < dim; ++d)
      dv[d] = motion(node)[Motion::increment + d];
    return dv;
  }



  template <int dim>
  inline void
  NodalFields<dim>::add_sums(const unsigned int            node,
                             const double                  mass,
                             const double                  volume,
                             const dealii::Tensor<1, dim> &momentum,
                             const dealii::Tensor<1, dim> &force)
  {
    double *const s = sum(node);
    s[Sum::mass] += mass;
    s[Sum::volume] += volume;
    for (unsigned int d = 0; d < dim; ++d)
      {
        s[Sum::momentum + d] += momentum[d];
        s[Sum::force + d] += force[d];
      }
  }
} // namespace talus

#endif

#ifndef talus_grid_nodal_fields_h
#define talus_grid_nodal_fields_h

#include <talus/base/lanes.h>
#include <talus/base/large_pages.h>
#include <talus/grid/grid.h>
#include <talus/grid/nodal_exchange.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace talus
{
  /// What the points send to a node: one register wide, so that one fused
  /// multiply-add adds a point's share of everything.
  template <int dim>
  struct NodalSum
  {
    static constexpr unsigned int mass     = 0;       ///< kg
    static constexpr unsigned int momentum = 1;       ///< kg m/s
    static constexpr unsigned int force    = 1 + dim; ///< N
    /// Volume of the soil in its reference density, m^dim.
    static constexpr unsigned int volume = 1 + 2 * dim;
    /// In 2-D two entries are free, and take the part of the internal force
    /// that comes with the gradient along y apart from the rest of the force.
    static constexpr unsigned int force_by_y = (dim == 2 ? 6 : n_lanes);
    static_assert(volume < n_lanes && volume < force_by_y);

    /// Component @p d of the whole force in a sum, N.
    static double
    whole_force(const double *sum, const unsigned int d)
    {
      return dim == 2 ? sum[force + d] + sum[force_by_y + d] : sum[force + d];
    }
  };

  /// 2 dim doubles, padded to whole registers.
  template <int dim>
  struct MotionRecord;

  template <>
  struct MotionRecord<2>
  {
    using type = double __attribute__((vector_size(8 * 4)));
  };

  template <>
  struct MotionRecord<3>
  {
    using type = double __attribute__((vector_size(8 * 8)));
  };

  /// What a node sends back: new velocity and its increment.
  template <int dim>
  struct NodalMotion
  {
    using Record                            = typename MotionRecord<dim>::type;
    static constexpr unsigned int width     = sizeof(Record) / sizeof(double);
    static constexpr unsigned int velocity  = 0;   ///< m/s
    static constexpr unsigned int increment = dim; ///< m/s
  };

  /// The nodal values of one step on the background grid. Only nodes near soil
  /// are active; nothing here loops over the others.
  template <int dim>
  class NodalFields
  {
  public:
    using Sum    = NodalSum<dim>;
    using Motion = NodalMotion<dim>;

    /// Allocate for the nodes of @p grid; none is active.
    void
    prepare(const Grid<dim> &grid);

    /// Make the nodes of the patches of these cells (ascending) active, and
    /// those this rank shares with others, which may have points near them.
    void
    activate(const Grid<dim> &grid, const std::vector<unsigned int> &cells);

    /// Set all sums of the active nodes, and of all ghosts, to zero.
    void
    clear();

    /// Add the sums at hanging nodes to their masters', and those of the ghosts
    /// to their owners': one message to each neighbour. Collective.
    void
    sum_over_ranks(const Grid<dim> &grid);

    /// v += dt f/m on all active nodes of this rank with more mass than
    /// @p least_mass; the others carry nothing and get no velocity.
    void
    update_momentum(double dt, double least_mass);

    /// Give ghosts the motion of their owners, and hanging nodes the one that
    /// their masters imply: one message to each neighbour. Collective.
    void
    share_with_ghosts(const Grid<dim> &grid);

    /// Active nodes that this rank owns.
    const std::vector<unsigned int> &
    active_nodes() const
    {
      return active_nodes_;
    }

    /// Those of them on a face of the mesh.
    const std::vector<unsigned int> &
    active_boundary_nodes() const
    {
      return active_boundary_nodes_;
    }

    double *
    sum(const unsigned int node)
    {
      return sums_.data() + n_lanes * std::size_t(node);
    }

    const double *
    sum(const unsigned int node) const
    {
      return sums_.data() + n_lanes * std::size_t(node);
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

    double
    mass(const unsigned int node) const
    {
      return sum(node)[Sum::mass];
    }

    dealii::Tensor<1, dim>
    velocity(const unsigned int node) const;

    /// Set the new velocity of a node and its increment accordingly. Returns
    /// the impulse that this takes, N s.
    dealii::Tensor<1, dim>
    set_velocity(unsigned int node, const dealii::Tensor<1, dim> &velocity);

    /// Mean of the velocities before and after the step: what a force's work
    /// over the step is to be taken with.
    dealii::Tensor<1, dim>
    mean_velocity(const unsigned int node) const;

    /// Kinetic energy of the nodes of this rank, J.
    double
    kinetic_energy() const;

  private:
    void
    add_active(const Grid<dim> &grid, unsigned int node);

    unsigned int               n_owned_nodes_ = 0;
    unsigned int               n_nodes_       = 0;
    LargePageVector<double>    sums_;
    LargePageVector<double>    motions_;
    NodalExchange<dim>         exchange_of_sums_;
    NodalExchange<dim>         exchange_of_motions_;
    std::vector<unsigned int>  active_nodes_;
    std::vector<unsigned int>  active_ghosts_;
    std::vector<unsigned int>  formerly_active_nodes_;
    std::vector<unsigned int>  active_boundary_nodes_;
    std::vector<unsigned char> is_active_;
  };
} // namespace talus

#endif

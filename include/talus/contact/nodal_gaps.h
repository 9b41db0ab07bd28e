// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_nodal_gaps_h
#define talus_contact_nodal_gaps_h

#include <talus/state/state.h>

#include <functional>
#include <limits>
#include <tuple>
#include <vector>

namespace talus
{
  /// A node that may come to a surface, by their numbers.
  struct NodeAndSurface
  {
    unsigned int node, surface;

    bool
    operator<(const NodeAndSurface &other) const
    {
      return std::tie(node, surface) < std::tie(other.node, other.surface);
    }

    bool
    operator==(const NodeAndSurface &other) const
    {
      return node == other.node && surface == other.surface;
    }
  };



  /// How near soil comes to surfaces, as the nodes know it: at each node and for
  /// each surface beside it, the least distance of those boxes of points that
  /// reach the node.
  template <int dim>
  class NodalGaps
  {
  public:
    /// Distance from the surface, m, of the box with these half lengths, m, about
    /// a place; negative if it dips into it.
    using Surface = std::function<double(const dealii::Point<dim> &,
                                         const dealii::Tensor<1, dim> &)>;

    /// Numbers of the surfaces, ascending, that may be nearer to a place than a
    /// distance, m, and perhaps of some others.
    using Near =
      std::function<std::vector<unsigned int>(const dealii::Point<dim> &,
                                              double)>;

    /// Of a node that no box reaches.
    static constexpr double none = std::numeric_limits<double>::max();

    /// Distance that points may have from a surface beside a node that their
    /// boxes reach, in cells; twice that where cells of two sizes meet.
    static constexpr double reach = 3. * 1.7320508075688772;

    /// To be called after each change of the mesh, its partition or the slots. A
    /// node has one gap per slot: surfaces with the same entry of @p slots are so
    /// far apart (min_distance_in_slot()) that no node is beside two of them.
    void
    prepare(const Grid<dim>          &grid,
            std::vector<Surface>      surfaces,
            std::vector<unsigned int> slots,
            Near                      near);

    /// Slots of the surfaces, as prepare() got them.
    const std::vector<unsigned int> &
    slots() const
    {
      return slots_;
    }

    /// Distance, m, between surfaces of one slot, in cells of @p cell_size: of a
    /// point near one of them the other one is farther away.
    static double
    min_distance_in_slot(const double cell_size)
    {
      return 3. * reach * cell_size;
    }

    /// Find the gaps of those of @p pairs that are ghosts or have mass. @p
    /// nearness of a cell is not 0 if its points may reach one of them; it is 2
    /// for those at the surface, which are looked at before those with 1.
    /// Collective.
    void
    find(const State<dim>                  &state,
         const std::vector<NodeAndSurface> &pairs,
         const std::vector<unsigned char>  &nearness);

    /// Room that is left at a node before surface @p k, m: zero as soon as boxes
    /// come nearer than a twentieth of a cell of @p cell_size, m. At rest they
    /// lie a little above the surface or below, and contact that ended whenever
    /// one is 1e-4 of a cell above would be switched on and off from step to
    /// step.
    double
    room(const unsigned int node,
         const unsigned int k,
         const double       cell_size) const
    {
      return std::max(0.,
                      gaps_[n_slots_ * node + slots_[k]] -
                        dead_band * cell_size);
    }

  private:
    static constexpr double dead_band = 0.05; // cells

    dealii::Tensor<1, dim>
    half_lengths(const State<dim> &state,
                 const Cell<dim>  &cell,
                 unsigned int      p) const;
    void
    look_around(const Cell<dim> &cell);
    void
    find_of_point(const dealii::Point<dim>     &x,
                  const dealii::Tensor<1, dim> &half);
    void
    lower(unsigned int node);
    void
    add_segment(const State<dim> &state, const Segment &segment);
    void
    add_to_patch(const State<dim> &state, const Segment &segment);

    std::vector<Surface>       surfaces_;
    std::vector<unsigned int>  slots_; ///< by surface
    Near                       near_;
    std::size_t                n_slots_ = 0;
    std::vector<double>        gaps_;      ///< by node and slot, m
    std::vector<unsigned char> is_open_;   ///< by node, while they are found
    std::vector<unsigned int>  near_cell_; ///< surfaces
    std::vector<double>        of_point_;  ///< one for each slot, m
    std::vector<unsigned int>  present_;   ///< nodes of a step
    std::vector<Segment> later_;      ///< of the cells that are not the nearest
    double               closed_ = 0; ///< gaps this small are none, m
    NodalExchange<dim>   exchange_;
  };
} // namespace talus

#endif

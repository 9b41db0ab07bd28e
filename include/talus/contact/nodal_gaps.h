// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_nodal_gaps_h
#define talus_contact_nodal_gaps_h

#include <talus/contact/surface_table.h>
#include <talus/state/state.h>

#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace talus
{
  /// Numbers of a node and of a surface near the node.
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



  /// Gaps between soil and surfaces: for each node and each surface near the
  /// node, the minimum distance between the surface and the boxes of the points
  /// which reach the node.
  template <int dim>
  class NodalGaps
  {
  public:
    /// Distance, m, between a surface and the box with the given centre, m, and
    /// half lengths, m; negative if the box dips into the surface.
    using Surface = std::function<double(const dealii::Point<dim> &,
                                         const dealii::Tensor<1, dim> &)>;

    /// Numbers, ascending, of all surfaces nearer to the given place than the
    /// given distance, m; surfaces farther away may be included.
    using Near =
      std::function<std::vector<unsigned int>(const dealii::Point<dim> &,
                                              double)>;

    /// Plane of the only surface in a cell, where the surface deviates from
    /// the plane by less than a hundredth of the cell size.
    struct Plane
    {
      unsigned int           surface;
      dealii::Point<dim>     place;  ///< on the plane, m
      dealii::Tensor<1, dim> normal; ///< out of the body behind the surface
    };

    /// Plane of the given cell, if the surface is flat there. The plane saves
    /// the exact distances of boxes which are in contact anyway.
    using PlaneOfCell = std::function<std::optional<Plane>(unsigned int)>;

    /// Table of the distances from the only surface in the given cell, with the
    /// number of the surface; nullptr: exact distances.
    using TableOfCell =
      std::function<std::pair<const SurfaceTable<dim> *, unsigned int>(
        unsigned int)>;

    /// Volume fraction of an owned node [-].
    using VolumeFraction = std::function<double(unsigned int)>;

    /// Gap at a node which no box reaches.
    static constexpr double none = std::numeric_limits<double>::max();

    /// Maximum distance, in cells, between a surface and a point whose box
    /// reaches a node near the surface; twice as much where cells of two sizes
    /// meet.
    static constexpr double reach = 3. * 1.7320508075688772;

    /// Set the surfaces and delete all gaps. Call after each change of the
    /// mesh, the partition, or the slots. @p slots: slot of each surface. A
    /// node stores one gap per slot: no node may be near two surfaces of a
    /// slot, see min_distance_in_slot().
    void
    prepare(const Grid<dim>          &grid,
            std::vector<Surface>      surfaces,
            std::vector<unsigned int> slots,
            Near                      near,
            PlaneOfCell               plane_of_cell = {},
            TableOfCell               table_of_cell = {});

    /// Slots of the surfaces, as set by prepare().
    const std::vector<unsigned int> &
    slots() const
    {
      return slots_;
    }

    /// Minimum distance, m, between two surfaces in the same slot, for cells of
    /// @p cell_size, m: a point within reach of a surface is farther from the
    /// second one.
    static double
    min_distance_in_slot(const double cell_size)
    {
      return 3. * reach * cell_size;
    }

    /// Compute the gaps of all @p pairs with a ghost node or a node with mass.
    /// @p nearness, by cell: 2 at a surface (examined first), 1 if points may
    /// reach a node of @p pairs; points in other cells are skipped. The search
    /// at a node stops once all gaps are within the dead band. The volume
    /// fractions of the owned nodes travel with the gaps. Collective.
    void
    find(const State<dim>                  &state,
         const std::vector<NodeAndSurface> &pairs,
         const std::vector<unsigned char>  &nearness,
         const VolumeFraction              &volume_fraction = {});

    /// Volume fraction of a node of the last pairs [-], also of a ghost; 0
    /// without soil.
    double
    volume_fraction(const unsigned int node) const
    {
      return fractions_[node];
    }

    /// Return the clearance between the soil at @p node and surface @p k, m:
    /// the gap less a dead band of a twentieth of @p cell_size, m; at least 0.
    /// At rest boxes lie slightly above or below the surface; without the dead
    /// band contact would be switched on and off from step to step.
    double
    room(const unsigned int node,
         const unsigned int k,
         const double       cell_size) const
    {
      return std::max(0.,
                      records_[width_ * node + slots_[k]] -
                        dead_band * cell_size);
    }

  private:
    static constexpr double dead_band = 0.05; // cells

    double *
    record(const unsigned int node)
    {
      return records_.data() + width_ * node;
    }

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
    find_of_point(const SurfaceTable<dim>      &table,
                  unsigned int                  surface,
                  const dealii::Point<dim>     &x,
                  const dealii::Tensor<1, dim> &half);
    bool
    is_in_contact(const Plane                  &plane,
                  double                        cell_size,
                  const dealii::Point<dim>     &x,
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
    PlaneOfCell                plane_of_cell_;
    TableOfCell                table_of_cell_;
    std::size_t                n_slots_ = 0;
    std::size_t                width_   = 0;
    std::vector<double>        records_;   ///< by node: gaps, m, fraction [-]
    std::vector<double>        fractions_; ///< by node [-]
    std::vector<unsigned char> is_open_;   ///< by node, used in find()
    std::size_t                n_open_ = 0;
    std::vector<unsigned int>  near_cell_; ///< surfaces near the current cell
    std::vector<double>        of_point_;  ///< gaps of a point, by slot, m
    std::vector<unsigned int>  present_;   ///< nodes of the step
    std::vector<Segment>       later_;     ///< segments with nearness 1
    double             closed_ = 0; ///< gaps up to this count as closed, m
    NodalExchange<dim> exchange_;
  };
} // namespace talus

#endif

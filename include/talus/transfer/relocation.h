// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_relocation_h
#define talus_transfer_relocation_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/points/reordering.h>
#include <talus/transfer/point_exchange.h>

#include <array>
#include <functional>
#include <vector>

namespace talus
{
  /// Keeps the points sorted by cell as they move, and on the rank that owns
  /// their cell. The cost is that of looking at every point once, plus, when
  /// points changed cell, of shifting those between their old and new places.
  template <int dim>
  class Relocation
  {
  public:
    /// For each face of the mesh, how far outside a point's centre may lie and
    /// still belong to the boundary cell, in units of that cell: half a cell at
    /// a wall, nothing at a free face.
    void
    allow_outside(const std::array<double, 2 * dim> &fraction)
    {
      allowed_outside_ = fraction;
    }

    /// Find the cells of all points and sort those that changed cell, and those
    /// appended since the last call, into the order; those whose new cell
    /// belongs to another rank travel there. Returns whether the set of the
    /// occupied cells changed. One that left through a periodic face goes on at
    /// the opposite one, its initial position shifted as far, so that its
    /// displacement does not jump. Throws ExcPoint, naming the point, if one
    /// left the mesh. Collective.
    bool
    update(Points<dim> &points, const Grid<dim> &grid);

    /// Whether the point of this index leaves the run. Asked once for each point
    /// that left its cell, in the order of the indices.
    using Leaves = std::function<bool(unsigned int)>;

    /// The same if only these points can have left their cell, in any order,
    /// some perhaps twice; see StepWorkspace::points_out_of_cell(). The list is
    /// empty afterwards. Points that @p leaves says so of are taken out of
    /// @p points; no point, if it is empty.
    bool
    update_points_out_of_cell(Points<dim>               &points,
                              const Grid<dim>           &grid,
                              std::vector<unsigned int> &out_of_cell,
                              const Leaves              &leaves = {});

    /// The same after the mesh changed: nothing is known of the old cells.
    void
    rebuild(Points<dim> &points, const Grid<dim> &grid);

    /// The same if the owned cell of each point is known.
    void
    rebuild(Points<dim> &points, const std::vector<unsigned int> &cells);

    /// Cells that hold points, ascending.
    const std::vector<unsigned int> &
    occupied_cells() const
    {
      return occupied_cells_;
    }

  private:
    unsigned int
    locate(const Points<dim> &points,
           const Grid<dim>   &grid,
           unsigned int       p,
           unsigned int       old_cell) const;
    void
    check_inside(const Points<dim> &points,
                 const Grid<dim>   &grid,
                 unsigned int       p,
                 double             cell_size) const;
    unsigned int
    cell_of(const Points<dim> &points,
            const Grid<dim>   &grid,
            unsigned int       p) const;
    void
    look_for(Points<dim>     &points,
             const Grid<dim> &grid,
             const Segment   &segment,
             unsigned int     p,
             const Leaves    &leaves);
    void
    find_sorted_changes(Points<dim> &points, const Grid<dim> &grid);
    void
    find_changes_out_of_cell(Points<dim>               &points,
                             const Grid<dim>           &grid,
                             std::vector<unsigned int> &out_of_cell,
                             const Leaves              &leaves);
    void
    find_appended_changes(Points<dim>     &points,
                          const Grid<dim> &grid,
                          const Leaves    &leaves);
    void
    find_all_changes(Points<dim> &points, const Grid<dim> &grid);
    bool
    send_and_sort_in(Points<dim> &points, const Grid<dim> &grid);
    void
    send_departed(Points<dim> &points, const Grid<dim> &grid);
    bool
    sort_in(Points<dim> &points);
    bool
    find_occupied_cells(const Points<dim> &points);

    std::array<double, 2 * dim> allowed_outside_{};
    std::vector<unsigned int>   occupied_cells_;

    PointExchange<dim> exchange_;

    Reordering reordering_;

    // Kept between calls so that a step does not allocate.
    std::vector<CellChange>                                 changes_;
    std::vector<typename PointExchange<dim>::OutgoingPoint> outgoing_;
    std::vector<unsigned int> leaving_;  ///< points that leave the run
    std::vector<unsigned int> departed_; ///< indices of outgoing and leaving
    std::vector<unsigned int> formerly_occupied_cells_;
  };
} // namespace talus

#endif

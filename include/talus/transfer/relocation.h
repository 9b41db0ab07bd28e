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
  /// Keeps moving points sorted by cell, on the rank that owns their cell. The
  /// cost is a test of every point, and a shift in memory of the points between
  /// old and new position of each point that changed cell.
  template <int dim>
  class Relocation
  {
  public:
    /// Set, for each face of the mesh, how far outside the centre of a point
    /// may lie and still belong to the boundary cell, in sizes of the boundary
    /// cell: 0.5 at a wall, 0 at a free face.
    void
    allow_outside(const std::array<double, 2 * dim> &fraction)
    {
      allowed_outside_ = fraction;
    }

    /// Find the cells of all points, and sort the points that changed cell or
    /// were appended since the last call into the order. A point whose new cell
    /// belongs to another rank is sent there. A point that leaves through a
    /// periodic face enters through the opposite face; its initial position is
    /// shifted by the same vector, so that the displacement does not jump.
    /// Return whether the set of occupied cells changed. Throw ExcPoint with
    /// the id of the point if a point left the mesh. Collective.
    bool
    update(Points<dim> &points, const Grid<dim> &grid);

    /// Whether the point with the given index leaves the run. Called once for
    /// each point that left its cell, in ascending order of the indices.
    using Leaves = std::function<bool(unsigned int)>;

    /// Do the work of update(), if only the points in @p out_of_cell and
    /// appended points can have left their cell. Collective.
    ///
    /// @param out_of_cell indices in any order, possibly with duplicates; see
    ///   StepWorkspace::points_out_of_cell(); empty afterwards
    /// @param leaves if true for a point, the point is removed from @p points;
    ///   if empty, no point leaves
    /// @return whether the set of occupied cells changed
    bool
    update_points_out_of_cell(Points<dim>               &points,
                              const Grid<dim>           &grid,
                              std::vector<unsigned int> &out_of_cell,
                              const Leaves              &leaves = {});

    /// Find and sort all points after a change of the mesh, when the old cells
    /// are meaningless. Collective.
    void
    rebuild(Points<dim> &points, const Grid<dim> &grid);

    /// Sort all points into the given owned cells, one per point.
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
    std::vector<unsigned int> departed_; ///< outgoing and leaving points
    std::vector<unsigned int> formerly_occupied_cells_;
  };
} // namespace talus

#endif

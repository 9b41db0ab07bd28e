// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/transfer/relocation.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Shift a point beyond a periodic face, with its initial position, by the
    /// period.
    template <int dim>
    void
    wrap(Points<dim>            &points,
         const Periodicity<dim> &periodicity,
         const unsigned int      p)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          double      &x     = points.data(points.position, d)[p];
          const double shift = periodicity.shift(d, x);
          if (shift != 0)
            {
              x -= shift;
              points.data(points.initial_position, d)[p] -= shift;
            }
        }
    }



    /// Whether the centres of all points [segment.begin, segment.end) are in
    /// the cell. False if a coordinate is NaN. Cells are half open, so a point
    /// on a face belongs to exactly one cell.
    template <int dim>
    bool
    all_inside(const Points<dim> &points,
               const Segment     &segment,
               const Cell<dim>   &cell)
    {
      bool inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *const x     = points.data(points.position, d);
          const double        lower = cell.lower[d];
          for (unsigned int p = segment.begin; p < segment.end; ++p)
            inside = inside && x[p] >= lower && x[p] < lower + cell.size;
        }
      return inside;
    }
  } // namespace



  /// Throw ExcPoint if point @p p lies farther outside of the mesh than the
  /// boundary conditions allow, in cells of @p cell_size, m. The centre of a
  /// point may lie beyond a wall: a wall stops nodes and not points, and the
  /// boundary cell continues outside.
  template <int dim>
  void
  Relocation<dim>::check_inside(const Points<dim> &points,
                                const Grid<dim>   &grid,
                                const unsigned int p,
                                const double       cell_size) const
  {
    const Point<dim> x = load_place(points, points.position, p);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        const unsigned int d = face / 2;
        const double outside = (face % 2 == 0 ? grid.domain().lower[d] - x[d]
                                              : x[d] - grid.domain().upper[d]);
        // The condition fails if a coordinate is NaN.
        if (outside <= allowed_outside_[face] * cell_size)
          continue;
        const bool is_number = std::isfinite(x[d]);
        AssertThrow(
          false,
          ExcPoint(text(
            "Point ",
            points.data(points.id)[p],
            " of body ",
            points.data(points.body)[p],
            is_number ? " left the mesh through the face '"
                      : " has no finite position near the face '",
            face_names[face],
            "': its centre is at (",
            x,
            ") m, ",
            outside,
            " m outside, where at most ",
            allowed_outside_[face] * cell_size,
            " m are allowed. ",
            is_number
              ? "Make the mesh larger ('Grid/Lower corner', 'Grid/Upper "
                "corner'), or lower 'Time step/CFL number' if the point was "
                "thrown out."
              : "The simulation became unstable: lower 'Time step/CFL "
                "number'.")));
      }
  }



  /// Find the cell of a point that left @p old_cell. In a step a point moves by
  /// a fraction of a cell (doc/method.md, section 8), so neighbours are tested
  /// first, without a search. Next to cells of another size, beyond the mesh,
  /// and for unknown neighbours, the lattice is searched.
  template <int dim>
  unsigned int
  Relocation<dim>::locate(const Points<dim> &points,
                          const Grid<dim>   &grid,
                          const unsigned int p,
                          const unsigned int old_cell) const
  {
    const Point<dim> x    = load_place(points, points.position, p);
    const Cell<dim> &cell = grid.cells()[old_cell];
    if (cell.uniform && grid.domain().contains(x))
      {
        // Nearly always the new cell is a neighbour.
        unsigned int neighbor = 0;
        bool         is_near  = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double       xi     = (x[d] - cell.lower[d]) / cell.size;
            const unsigned int offset = (xi < 0 ? 0 : (xi < 1 ? 1 : 2));
            is_near                   = is_near && xi >= -1 && xi < 2;
            neighbor += offset * power(3, d);
          }
        if (is_near &&
            cell.neighbors[neighbor] != numbers::invalid_unsigned_int)
          return cell.neighbors[neighbor];
      }
    return cell_of(points, grid, p);
  }



  /// Find the cell of a point without knowledge of its old cell. A point
  /// outside of the mesh belongs to the nearest cell, if the boundary condition
  /// allows points outside.
  template <int dim>
  unsigned int
  Relocation<dim>::cell_of(const Points<dim> &points,
                           const Grid<dim>   &grid,
                           const unsigned int p) const
  {
    const unsigned int c =
      grid.find_cell(load_place(points, points.position, p));
    const bool is_known = (c != numbers::invalid_unsigned_int);
    // The distance allowed depends on the size of the current cell.
    check_inside(points,
                 grid,
                 p,
                 is_known ? grid.cells()[c].size : grid.finest_size());
    AssertThrow(is_known,
                ExcPoint(text("Point ",
                              points.data(points.id)[p],
                              " went to (",
                              load_place(points, points.position, p),
                              ") m in one step, farther than to a neighbouring "
                              "cell. The simulation became unstable: lower "
                              "'Time step/CFL number'.")));
    return c;
  }



  /// List point @p p of @p segment as changed or leaving if it is outside of
  /// its cell.
  template <int dim>
  void
  Relocation<dim>::look_for(Points<dim>       &points,
                            const Grid<dim>   &grid,
                            const Segment     &segment,
                            const unsigned int p,
                            const Leaves      &leaves)
  {
    if (all_inside(points, {0, 0, p, p + 1}, grid.cells()[segment.cell]))
      return;
    if (leaves && leaves(p))
      {
        leaving_.push_back(p);
        return;
      }
    if (grid.periodicity().any())
      wrap(points, grid.periodicity(), p);
    const unsigned int c = locate(points, grid, p, segment.cell);
    if (c != segment.cell)
      changes_.push_back({c, segment.body, p});
  }



  /// Test all sorted points, whole segments first: most segments lose no point.
  template <int dim>
  void
  Relocation<dim>::find_sorted_changes(Points<dim>     &points,
                                       const Grid<dim> &grid)
  {
    for (const Segment &segment : points.segments())
      if (!all_inside(points, segment, grid.cells()[segment.cell]))
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          look_for(points, grid, segment, p, {});
  }



  /// Test only the points listed by the gather and the splitter. In ascending
  /// order they meet their segments in one pass, and changes are found in the
  /// same order as by a test of all points: both ways give the same order of
  /// the points.
  template <int dim>
  void
  Relocation<dim>::find_changes_out_of_cell(
    Points<dim>               &points,
    const Grid<dim>           &grid,
    std::vector<unsigned int> &out_of_cell,
    const Leaves              &leaves)
  {
    std::sort(out_of_cell.begin(), out_of_cell.end());
    out_of_cell.erase(std::unique(out_of_cell.begin(), out_of_cell.end()),
                      out_of_cell.end());
    auto segment = points.segments().begin();
    for (const unsigned int p : out_of_cell)
      {
        segment =
          std::partition_point(segment,
                               points.segments().end(),
                               [p](const Segment &s) { return s.end <= p; });
        look_for(points, grid, *segment, p, leaves);
      }
  }



  /// Find the cells of all appended points: children of a split, new points.
  template <int dim>
  void
  Relocation<dim>::find_appended_changes(Points<dim>     &points,
                                         const Grid<dim> &grid,
                                         const Leaves    &leaves)
  {
    for (unsigned int p = points.n_sorted(); p < points.size(); ++p)
      {
        if (leaves && leaves(p))
          {
            leaving_.push_back(p);
            continue;
          }
        if (grid.periodicity().any())
          wrap(points, grid.periodicity(), p);
        changes_.push_back(
          {cell_of(points, grid, p),
           static_cast<unsigned int>(points.data(points.body)[p]),
           p});
      }
  }



  /// Test all points, for callers without a list of points that left their
  /// cell.
  template <int dim>
  void
  Relocation<dim>::find_all_changes(Points<dim> &points, const Grid<dim> &grid)
  {
    changes_.clear();
    leaving_.clear();
    find_sorted_changes(points, grid);
    find_appended_changes(points, grid, {});
  }



  /// Send the points whose new cell is a ghost cell to the owner of the cell.
  /// Owners of ghost cells are neighbour ranks, so no other rank is involved.
  /// Points received are appended and listed as changes.
  template <int dim>
  void
  Relocation<dim>::send_departed(Points<dim> &points, const Grid<dim> &grid)
  {
    outgoing_.clear();
    // connect() is collective: ranks without neighbours call it, too.
    exchange_.connect(grid.communicator());
    if (grid.neighbor_ranks().empty())
      return;
    const auto leaves = [&](const CellChange &change) {
      return change.cell >= grid.n_owned_cells();
    };
    for (const CellChange &change : changes_)
      if (leaves(change))
        outgoing_.push_back({change.index, change.cell});
    changes_.erase(std::remove_if(changes_.begin(), changes_.end(), leaves),
                   changes_.end());
    for (const auto &[index, cell] :
         exchange_.exchange(outgoing_, grid, points))
      changes_.push_back(
        {cell,
         static_cast<unsigned int>(points.data(points.body)[index]),
         index});
  }



  // Why points are sorted by cell: B-bar, scatter and gather loop over cells,
  // so neighbours in memory share nodes, cells and means; unsorted points would
  // load the nodes again for each point. Why points are not sorted from
  // scratch: few points change their cell in a step. The changes are listed,
  // sent, and merged into the order of the remaining points (Reordering), in
  // three stages:
  //
  // 1. find the points whose cell changed: find_...(),
  // 2. send points to the owners of their new cells: send_departed(),
  // 3. merge the points into the order in memory: sort_in().
  //
  // Afterwards every point is in its cell and on the rank that owns the cell,
  // the points of a cell are contiguous, grouped by body, and points that
  // stayed have kept their order.
  template <int dim>
  bool
  Relocation<dim>::update(Points<dim> &points, const Grid<dim> &grid)
  {
    find_all_changes(points, grid);
    return send_and_sort_in(points, grid);
  }



  template <int dim>
  bool
  Relocation<dim>::update_points_out_of_cell(
    Points<dim>               &points,
    const Grid<dim>           &grid,
    std::vector<unsigned int> &out_of_cell,
    const Leaves              &leaves)
  {
    changes_.clear();
    leaving_.clear();
    find_changes_out_of_cell(points, grid, out_of_cell, leaves);
    out_of_cell.clear();
    find_appended_changes(points, grid, leaves);
    return send_and_sort_in(points, grid);
  }



  /// Send and merge the changes. Return whether the set of occupied cells
  /// changed. Without changes the order stays. Collective, since points may
  /// arrive.
  template <int dim>
  bool
  Relocation<dim>::send_and_sort_in(Points<dim> &points, const Grid<dim> &grid)
  {
    send_departed(points, grid);
    if (changes_.empty() && outgoing_.empty() && leaving_.empty())
      return false;
    return sort_in(points);
  }



  /// Merge the changes into the order and move the data. Return whether the set
  /// of occupied cells changed. The number of points is checked in every build:
  /// the mass of a lost point would disappear without any other error.
  template <int dim>
  bool
  Relocation<dim>::sort_in(Points<dim> &points)
  {
    departed_.clear();
    for (const auto &point : outgoing_)
      // Appended points belong to no segment.
      if (point.index < points.n_sorted())
        departed_.push_back(point.index);
    for (const unsigned int p : leaving_)
      if (p < points.n_sorted())
        departed_.push_back(p);
    reordering_.merge(points.segments(), changes_, departed_);
    AssertThrow(reordering_.n_points() + outgoing_.size() + leaving_.size() ==
                  points.size(),
                ExcMessage(text("Points were lost or counted twice: ",
                                points.size(),
                                " before sorting, ",
                                reordering_.n_points(),
                                " after, ",
                                outgoing_.size(),
                                " went to other ranks, and ",
                                leaving_.size(),
                                " left the mesh by an outflow face.")));
    reordering_.apply(points);
    // At the start and after a change of the mesh all points move, in a step
    // only a few: release the memory of the long lists.
    if (changes_.size() > points.size() / 8)
      {
        std::vector<CellChange>().swap(changes_);
        reordering_.clear();
      }
    return find_occupied_cells(points);
  }



  /// Update the list of occupied cells. Return whether it changed; only then
  /// the active nodes change. Segments ascend by cell, so the bodies of a cell
  /// are adjacent.
  template <int dim>
  bool
  Relocation<dim>::find_occupied_cells(const Points<dim> &points)
  {
    formerly_occupied_cells_.swap(occupied_cells_);
    occupied_cells_.clear();
    for (const Segment &segment : points.segments())
      if (occupied_cells_.empty() || occupied_cells_.back() != segment.cell)
        occupied_cells_.push_back(segment.cell);
    return occupied_cells_ != formerly_occupied_cells_;
  }



  template <int dim>
  void
  Relocation<dim>::rebuild(Points<dim> &points, const Grid<dim> &grid)
  {
    points.forget_order();
    find_all_changes(points, grid);
    send_departed(points, grid);
    sort_in(points);
  }



  template <int dim>
  void
  Relocation<dim>::rebuild(Points<dim>                     &points,
                           const std::vector<unsigned int> &cells)
  {
    TalusAssert(cells.size() == points.size(),
                dealii::ExcDimensionMismatch(cells.size(), points.size()));
    points.forget_order();
    changes_.clear();
    leaving_.clear();
    outgoing_.clear();
    for (unsigned int p = 0; p < points.size(); ++p)
      changes_.push_back(
        {cells[p], static_cast<unsigned int>(points.data(points.body)[p]), p});
    sort_in(points);
  }



  template class Relocation<2>;
  template class Relocation<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/transfer/relocation.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Move a point that lies beyond a periodic face to where it enters.
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



    /// Whether the centres of all these points are in the cell; false if one is
    /// no number.
    /// Cells are half open, so that a point on a face belongs to one of them.
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



  /// Throw ExcPoint if point @p p lies farther outside than the conditions on
  /// the faces allow, in cells of @p cell_size. Beside a wall its centre may: a
  /// wall stops nodes and not points, and the boundary cell goes on outside of
  /// it.
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
        // Written so that a coordinate that is not a number fails.
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



  /// The cell of a point that left @p old_cell. A step moves a point by a
  /// fraction of a cell (doc/method.md, section 8), so the neighbours come
  /// first, without a search. Beside cells of another size, beyond the mesh,
  /// and where the neighbour is not known, the lattice decides.
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



  /// The cell of a point of which nothing is known. One outside the mesh
  /// belongs to the nearest cell, if it may be there at all.
  template <int dim>
  unsigned int
  Relocation<dim>::cell_of(const Points<dim> &points,
                           const Grid<dim>   &grid,
                           const unsigned int p) const
  {
    const unsigned int c =
      grid.find_cell(load_place(points, points.position, p));
    const bool is_known = (c != numbers::invalid_unsigned_int);
    // The wall is that of the cell it belongs to now.
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



  /// Note point @p p of @p segment if it belongs to another cell now, or leaves
  /// the run.
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



  /// Look at all sorted points; whole segments first, since most of them lose
  /// none.
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



  /// Look at the points only that the gather and the splitter noted. Sorted,
  /// they meet their segments in one pass, and the changes come in the order in
  /// which a look at all points would find them: so both ways give the same
  /// order of the points.
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



  /// Children of a split, and points that were just made: all of them need a
  /// cell.
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



  /// Where it was not noted which points left their cell.
  template <int dim>
  void
  Relocation<dim>::find_all_changes(Points<dim> &points, const Grid<dim> &grid)
  {
    changes_.clear();
    leaving_.clear();
    find_sorted_changes(points, grid);
    find_appended_changes(points, grid, {});
  }



  /// Let those whose new cell is a ghost travel to its owner.
  /// A ghost's owner is a neighbour, so that no other rank need be asked.
  /// Points that arrive are appended, and sorted in with those of this rank.
  template <int dim>
  void
  Relocation<dim>::send_departed(Points<dim> &points, const Grid<dim> &grid)
  {
    outgoing_.clear();
    // All ranks are here the first time, those without neighbours, too.
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



  // Why points are kept sorted by cell: all that B-bar, scatter and gather do
  // goes cell by cell, so neighbours in memory share nodes, cells and means;
  // points in the order in which they were made would fetch the nodes anew for
  // each of them. And why not sorted anew: in a step few points change their
  // cell. So what changes is listed, sent, and merged into the order of the
  // rest (Reordering), in three stages:
  //
  // 1. which points belong to another cell now: find_...(),
  // 2. which of these belong to another rank: send_departed(),
  // 3. where each goes in memory: sort_in().
  //
  // Afterwards every point lies in its cell and on the rank that owns it,
  // points of a cell stand together, by body, and those that stayed have kept
  // their order.
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



  /// If no point moves the order stays. All ranks must call it, as a point may
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



  /// Returns whether the set of the occupied cells changed.
  /// Merge the changes into the order, and move the data. The number of points is
  /// checked in every build: a point that got lost would take its mass along,
  /// and nothing else would notice.
  template <int dim>
  bool
  Relocation<dim>::sort_in(Points<dim> &points)
  {
    departed_.clear();
    for (const auto &point : outgoing_)
      // Appended points are in no segment that they could leave.
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
    // only a few: the long lists would be a waste of memory.
    if (changes_.size() > points.size() / 8)
      {
        std::vector<CellChange>().swap(changes_);
        reordering_.clear();
      }
    return find_occupied_cells(points);
  }



  /// Segments ascend by cell, so that a cell with several bodies is met in
  /// turn. Nodes are activated anew only if this returns true.
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
    AssertDimension(cells.size(), points.size());
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

#include <talus/base/errors.h>
#include <talus/transfer/relocation.h>

#include <algorithm>
#include <cmath>
#include <tuple>

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
  } // namespace



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



  template <int dim>
  void
  Relocation<dim>::find_movers(Points<dim> &points, const Grid<dim> &grid)
  {
    const bool wraps = grid.periodicity().any();
    movers_.clear();
    for (const Segment &segment : points.segments())
      {
        const Cell<dim> &cell = grid.cells()[segment.cell];
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            bool is_inside = true;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double x = points.data(points.position, d)[p];
                is_inside &=
                  (x >= cell.lower[d]) & (x < cell.lower[d] + cell.size);
              }
            if (__builtin_expect(is_inside, 1))
              continue;
            if (wraps)
              wrap(points, grid.periodicity(), p);
            const unsigned int c = locate(points, grid, p, segment.cell);
            if (c != segment.cell)
              movers_.push_back({c, segment.body, p});
          }
      }
    for (unsigned int p = points.n_sorted(); p < points.size(); ++p)
      {
        if (wraps)
          wrap(points, grid.periodicity(), p);
        movers_.push_back(
          {cell_of(points, grid, p),
           static_cast<unsigned int>(points.data(points.body)[p]),
           p});
      }
  }



  /// Let those whose new cell is a ghost travel to its owner.
  template <int dim>
  void
  Relocation<dim>::send_movers(Points<dim> &points, const Grid<dim> &grid)
  {
    travellers_.clear();
    exchange_.connect(grid.communicator());
    if (grid.neighbor_ranks().empty())
      return;
    const auto leaves = [&](const Mover &mover) {
      return mover.cell >= grid.n_owned_cells();
    };
    for (const Mover &mover : movers_)
      if (leaves(mover))
        travellers_.push_back({mover.index, mover.cell});
    movers_.erase(std::remove_if(movers_.begin(), movers_.end(), leaves),
                  movers_.end());
    for (const auto &[index, cell] :
         exchange_.exchange(travellers_, grid, points))
      movers_.push_back(
        {cell,
         static_cast<unsigned int>(points.data(points.body)[index]),
         index});
  }



  template <int dim>
  void
  Relocation<dim>::open_segment(const unsigned int cell,
                                const unsigned int body)
  {
    if (segments_.empty() || segments_.back().cell != cell ||
        segments_.back().body != body)
      segments_.push_back({cell, body, n_merged_, n_merged_});
  }



  template <int dim>
  void
  Relocation<dim>::add_run(const unsigned int begin, const unsigned int end)
  {
    if (begin == end)
      return;
    if (!runs_.empty() && runs_.back().end == begin)
      runs_.back().end = end;
    else
      runs_.push_back({begin, end});
    n_merged_ += end - begin;
    segments_.back().end = n_merged_;
  }



  /// Add the points of an old segment except those that leave it.
  /// @param skip next entry of leaving_.
  template <int dim>
  void
  Relocation<dim>::add_staying(const Segment &segment, std::size_t &skip)
  {
    unsigned int begin = segment.begin;
    for (; skip < leaving_.size() && leaving_[skip] < segment.end; ++skip)
      {
        if (begin < leaving_[skip])
          {
            open_segment(segment.cell, segment.body);
            add_run(begin, leaving_[skip]);
          }
        begin = leaving_[skip] + 1;
      }
    if (begin < segment.end)
      {
        open_segment(segment.cell, segment.body);
        add_run(begin, segment.end);
      }
  }



  /// Merge the old order without the movers with the movers, both sorted by
  /// cell and body; among equals, those that stayed come first.
  template <int dim>
  void
  Relocation<dim>::merge(const Points<dim> &points)
  {
    leaving_.clear();
    for (const Mover &mover : movers_)
      leaving_.push_back(mover.index);
    for (const auto &traveller : travellers_)
      leaving_.push_back(traveller.index);
    std::sort(leaving_.begin(), leaving_.end());
    std::sort(movers_.begin(),
              movers_.end(),
              [](const Mover &a, const Mover &b) {
                return std::tie(a.cell, a.body, a.index) <
                       std::tie(b.cell, b.body, b.index);
              });

    runs_.clear();
    segments_.clear();
    n_merged_                     = 0;
    std::size_t skip              = 0;
    auto        mover             = movers_.begin();
    const auto  add_movers_before = [&](const auto &is_before) {
      for (; mover != movers_.end() && is_before(*mover); ++mover)
        {
          open_segment(mover->cell, mover->body);
          add_run(mover->index, mover->index + 1);
        }
    };
    for (const Segment &segment : points.segments())
      {
        add_movers_before([&](const Mover &m) {
          return std::tie(m.cell, m.body) <
                 std::tie(segment.cell, segment.body);
        });
        add_staying(segment, skip);
      }
    add_movers_before([](const Mover &) { return true; });
  }



  template <int dim>
  bool
  Relocation<dim>::update(Points<dim> &points, const Grid<dim> &grid)
  {
    find_movers(points, grid);
    send_movers(points, grid);
    if (movers_.empty() && travellers_.empty())
      return false;
    sort_in(points);
    return true;
  }



  template <int dim>
  void
  Relocation<dim>::sort_in(Points<dim> &points)
  {
    merge(points);
    AssertThrow(n_merged_ + travellers_.size() == points.size(),
                ExcMessage(text("The headcount of the points does not hold: ",
                                points.size(),
                                " before sorting, ",
                                n_merged_,
                                " after, and ",
                                travellers_.size(),
                                " went to other ranks.")));
    points.reorder(runs_, segments_);

    occupied_cells_.clear();
    for (const Segment &segment : points.segments())
      if (occupied_cells_.empty() || occupied_cells_.back() != segment.cell)
        occupied_cells_.push_back(segment.cell);
  }



  template <int dim>
  void
  Relocation<dim>::rebuild(Points<dim> &points, const Grid<dim> &grid)
  {
    points.forget_order();
    find_movers(points, grid);
    send_movers(points, grid);
    sort_in(points);
  }



  template <int dim>
  void
  Relocation<dim>::rebuild(Points<dim>                     &points,
                           const std::vector<unsigned int> &cells)
  {
    AssertDimension(cells.size(), points.size());
    points.forget_order();
    movers_.clear();
    travellers_.clear();
    for (unsigned int p = 0; p < points.size(); ++p)
      movers_.push_back(
        {cells[p], static_cast<unsigned int>(points.data(points.body)[p]), p});
    sort_in(points);
  }



  template class Relocation<2>;
  template class Relocation<3>;
} // namespace talus

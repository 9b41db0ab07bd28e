// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_splitter_h
#define talus_adaptivity_splitter_h

#include <talus/adaptivity/ledger.h>
#include <talus/adaptivity/split_statistics.h>
#include <talus/base/quantity.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/state/state.h>
#include <talus/transfer/box_shape.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <string>
#include <vector>

namespace talus
{
  /// Splits points that were stretched too far, so that the soil stays a
  /// continuum on the background grid.
  ///
  /// An axis violates when the stretch along it exceeds `Threshold` times its
  /// value at the point's creation and the point is longer than `Minimum
  /// length` cells, or when the point is longer than a cell whatever the
  /// threshold says. The children inherit the state; what is extensive is
  /// divided (see Inheritance). They tile the box of their parent, so that mass,
  /// momentum and internal force of no node change. @cite esub
  ///
  /// A convected domain is cut along its own edges, and measured along them. Its
  /// children tile it, too; nodal sums change a little, since there are more
  /// corners then, between which shape functions are interpolated.
  template <int dim>
  class Splitter : public dealii::ParameterAcceptor
  {
  public:
    Splitter();

    /// Note which points of the batch violate the criterion. They may have left
    /// the cell they are sorted into.
    void
    mark(const Points<dim> &points,
         const Batch       &batch,
         const Grid<dim>   &grid,
         BoxRule            rule);

    /// Split the points that mark() noted, once. Children may lie outside their
    /// parent's cell: they wait for Relocation::update(). The first one takes
    /// the parent's place, and is added to those that may be out of their cell;
    /// the others are appended. Returns whether any point was split. Throws
    /// ExcPoint if this rank would have too many points.
    bool
    split_marked(Points<dim>               &points,
                 BoxRule                    rule,
                 std::vector<unsigned int> &points_out_of_cell);

    /// The most points that there may be, over all ranks.
    unsigned int
    maximum_number_of_points() const
    {
      return maximum_points_;
    }

    /// Throw ExcPoint if there are more points than allowed, over all ranks.
    void
    check_total(double n_points) const;

    /// Length below which no point is split, in cells.
    double
    least_split_length() const
    {
      return enabled_ ? std::min(minimum_length_, 1.) : 1.;
    }

    /// Whether a point that is created with this @p length along an axis, in
    /// cells, is split before it is stretched by @p factor.
    bool
    would_split(const double length, const double factor) const
    {
      return factor * length > 1. || (enabled_ && factor > threshold_ &&
                                      factor * length > minimum_length_);
    }

    const SplitStatistics &
    statistics() const
    {
      return statistics_;
    }

    /// Count the points that a limit keeps from being split now, over all ranks.
    /// The points must be sorted. All numbers are 0 where splitting is switched
    /// off. Collective.
    UnsplitPoints
    count_unsplit(const Points<dim> &points,
                  const Grid<dim>   &grid,
                  BoxRule            rule) const;

    /// List what was split so far, how many boxes are clipped now for the
    /// weights, and how many points are at a limit. Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    /// The first new child gets the id @p first, the next one that plus
    /// @p stride, ...: so that ids differ over ranks.
    void
    number_from(const double first, const double stride)
    {
      next_id_   = first;
      id_stride_ = stride;
    }

    /// Continue the numbers after list_state() was loaded on @p n_ranks ranks
    /// from a run on @p n_ranks_then: on another number all ranks have the
    /// largest of the next ids, and part here.
    void
    number_on(const unsigned int rank,
              const unsigned int n_ranks,
              const unsigned int n_ranks_then)
    {
      if (n_ranks != n_ranks_then)
        next_id_ += rank;
      id_stride_ = n_ranks;
    }

    /// Add what was split so far, and the next id, to the state of the run.
    void
    list_state(StateList &list);

  private:
    /// Whether axis @p d of point(s) @p p is too long in cells of this size.
    template <typename Number>
    auto
    exceeds_threshold(const PointsView<dim, const double> &points,
                      unsigned int                         p,
                      unsigned int                         d,
                      double                               cell_size) const;
    /// False if no point of [begin, end), in cells of this size or larger ones,
    /// violates the criterion: nearly always, and known from a look at several
    /// points at a time.
    bool
    may_exceed(const Points<dim> &points,
               unsigned int       begin,
               unsigned int       end,
               double             cell_size) const;
    /// Bit d: the point is to be split along axis d. Zero: not at all.
    unsigned int
    axes_to_split(const Points<dim> &points,
                  unsigned int       p,
                  double             cell_size) const;
    /// False if a child would lie farther outside the mesh than a point may
    /// at a wall: half a cell. Such a split waits; the box is clipped and
    /// counted meanwhile.
    bool
    children_may_stay(const Points<dim> &points,
                      unsigned int       p,
                      unsigned int       axes,
                      double             cell_size,
                      const Grid<dim>   &grid,
                      BoxRule            rule) const;
    /// The same where the point's old cell is not uniform; sets the size of the
    /// cell it is in now.
    unsigned int
    axes_near_other_sizes(const Points<dim> &points,
                          const Grid<dim>   &grid,
                          unsigned int       p,
                          BoxRule            rule,
                          unsigned int       cell,
                          double            &cell_size) const;
    /// Axes along which the criterion asks for a split of point @p p of cell
    /// @p cell, whatever the limits; with `Directions = all` none or all axes.
    /// Sets the size of the cell that the point is in now, m.
    unsigned int
    required_axes(const Points<dim> &points,
                  const Grid<dim>   &grid,
                  unsigned int       p,
                  BoxRule            rule,
                  unsigned int       cell,
                  double            &cell_size) const;
    /// Whether point @p p is stretched beyond the threshold along an axis.
    bool
    is_stretched(const Points<dim> &points, unsigned int p) const;
    void
    check_budget(const Points<dim> &points, std::size_t n_points) const;
    void
    split(Points<dim> &points, BoxRule rule, unsigned int p, unsigned int axes);

    bool         enabled_            = true;
    double       threshold_          = 1.4;
    std::string  directions_         = "stretched";
    double       minimum_length_     = 0.7;
    unsigned int maximum_generation_ = 8;
    unsigned int maximum_points_     = 10000000;

    struct Violation
    {
      unsigned int point;
      unsigned int axes;
    };
    std::vector<Violation> marked_;
    double                 next_id_   = 0;
    double                 id_stride_ = 1;
    Ledger<dim>            ledger_;
    SplitStatistics        statistics_;
  };
} // namespace talus

#endif

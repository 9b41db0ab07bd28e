// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_splitter_h
#define talus_adaptivity_splitter_h

#include <talus/adaptivity/conservation_check.h>
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
  /// Number and accuracy of the splits so far, on this rank.
  struct SplitStatistics
  {
    unsigned long n_splits           = 0;
    unsigned int  largest_generation = 0;
    /// Largest relative error [-] of mass, momentum, kinetic and elastic energy
    /// and centre of mass, summed over all splits.
    double conservation_error = 0;
  };



  /// Numbers of points that are stretched too far but not split, by the limit
  /// that forbids the split. Each point counts once.
  struct UnsplitPoints
  {
    /// Points that have been split `Maximum generation` times.
    unsigned long at_generation_limit = 0;
    /// Points whose children would lie too far outside the mesh.
    unsigned long at_mesh_limit = 0;
    /// Points stretched beyond `Threshold` along an axis, but no longer than
    /// `Minimum length`. Their boxes fit into their cells.
    unsigned long at_length_limit = 0;
  };



  /// Splits points that are stretched too far, so that the soil stays a
  /// continuum on the background grid.
  ///
  /// A point is split along an edge of the cell if the stretch of the edge
  /// exceeds `Threshold` times the stretch at creation of the point and the
  /// edge is longer than `Minimum length` cells. An edge longer than a cell is
  /// split in any case. Children inherit the state of their parent; extensive
  /// quantities are divided (see Inheritance). The cells of the children tile
  /// the cell of their parent: mass, momentum and mass times position are
  /// unchanged. Nodal sums change slightly unless the edges are parallel to the
  /// axes.
  ///
  /// With `Shear = counted` a point is measured and halved along the axes of
  /// the coordinates instead of the edges. @cite esub
  template <int dim>
  class Splitter : public dealii::ParameterAcceptor
  {
  public:
    Splitter();

    /// Take over the rule for the boxes of the points. Throw ExcUser if only
    /// stretched edges are to be halved although @p shape counts shear.
    void
    prepare(const BoxShape &shape);

    bool
    is_enabled() const
    {
      return enabled_;
    }

    /// Mark the points of the batch that must be split, and the axes to split
    /// along. Points may have moved out of the cell into which they are sorted.
    /// @param points Points of this rank.
    /// @param batch Points to consider.
    /// @param grid Background grid.
    void
    mark(const Points<dim> &points, const Batch &batch, const Grid<dim> &grid);

    /// Split each point marked by mark() once. The first child replaces the
    /// parent and is added to @p points_out_of_cell; all further children are
    /// appended to the points. Children may lie outside the cell of the parent
    /// until Relocation::update(). Throws ExcPoint if this rank would have too
    /// many points.
    /// @return Whether any point was split.
    bool
    split_marked(Points<dim>               &points,
                 std::vector<unsigned int> &points_out_of_cell);

    /// Largest number of points allowed, over all ranks.
    unsigned int
    maximum_number_of_points() const
    {
      return maximum_points_;
    }

    /// Throw ExcPoint if @p n_points, the number of points on all ranks,
    /// exceeds the maximum. Otherwise limit later splits on this rank, which
    /// has @p n_own points now, to the maximum less the points of other ranks.
    void
    check_total(double n_points, double n_own);

    /// Length up to which no point is split, in cells.
    double
    min_split_length() const
    {
      return enabled_ ? std::min(minimum_length_, 1.) : 1.;
    }

    /// Return whether a point with this @p length along an axis at creation, in
    /// cells, is split before a further stretch by @p factor.
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

    /// Count the points on all ranks that currently cannot be split because of
    /// a limit. The points must be sorted. All numbers are 0 if splitting is
    /// disabled. Collective.
    UnsplitPoints
    count_unsplit(const Points<dim> &points, const Grid<dim> &grid) const;

    /// Append the number of splits so far, of boxes currently clipped for the
    /// weights and of points at a limit to @p list. Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    /// Give the ids @p first, @p first + @p stride, ... to the children created
    /// on this rank, so that ids are unique over all ranks.
    void
    number_from(const double first, const double stride)
    {
      next_id_   = first;
      id_stride_ = stride;
    }

    /// Return an id for a new point on this rank.
    double
    take_id()
    {
      const double id = next_id_;
      next_id_ += id_stride_;
      return id;
    }

    /// Set up the ids of children after list_state() has been loaded on
    /// @p n_ranks ranks from a run on @p n_ranks_then. If both numbers differ,
    /// all ranks have loaded the same, largest next id, and each adds its
    /// @p rank.
    void
    renumber_after_resume(const unsigned int rank,
                          const unsigned int n_ranks,
                          const unsigned int n_ranks_then)
    {
      if (n_ranks != n_ranks_then)
        next_id_ += rank;
      id_stride_ = n_ranks;
    }

    /// Add the statistics of splits, the conservation check and the next id to
    /// the state of the run.
    void
    list_state(StateList &list);

  private:
    /// Compare point(s) @p p with the criterion along axis @p d, in cells of
    /// size @p cell_size, m. Returns a mask: true if a split is required.
    template <typename Number>
    auto
    exceeds_threshold(const PointsView<dim, const double> &points,
                      unsigned int                         p,
                      unsigned int                         d,
                      double                               cell_size) const;
    /// Return false if no point of [@p begin, @p end) must be split in cells of
    /// size @p cell_size, m, or larger. Cheap, as several points are tested at
    /// a time.
    bool
    may_exceed(const Points<dim> &points,
               unsigned int       begin,
               unsigned int       end,
               double             cell_size) const;
    /// Return the axes to split point @p p along: bit d stands for axis d, 0
    /// for none.
    unsigned int
    axes_to_split(const Points<dim> &points,
                  unsigned int       p,
                  double             cell_size) const;
    /// Return false if the split of a point along @p axes would put a child
    /// farther outside the mesh than a point may lie at a wall: half a cell.
    /// The split is then postponed; meanwhile the box is clipped and counted.
    bool
    children_may_stay(const Points<dim> &points,
                      unsigned int       p,
                      unsigned int       axes,
                      double             cell_size,
                      const Grid<dim>   &grid) const;
    /// Axes to split point @p p along if cells of different sizes meet at
    /// @p cell, the cell into which the point is sorted. Sets @p cell_size to
    /// the size of the cell that now contains the point, m.
    unsigned int
    axes_near_other_sizes(const Points<dim> &points,
                          const Grid<dim>   &grid,
                          unsigned int       p,
                          unsigned int       cell,
                          double            &cell_size) const;
    /// Axes along which the criterion requires a split of point @p p, sorted
    /// into cell @p cell, without regard to limits; with `Directions = all` no
    /// axis or all axes. Sets @p cell_size to the size of the cell that now
    /// contains the point, m.
    unsigned int
    required_axes(const Points<dim> &points,
                  const Grid<dim>   &grid,
                  unsigned int       p,
                  unsigned int       cell,
                  double            &cell_size) const;
    /// Return whether point @p p is stretched beyond the threshold along an
    /// axis.
    bool
    is_stretched(const Points<dim> &points, unsigned int p) const;
    void
    check_budget(const Points<dim> &points, std::size_t n_points) const;
    void
    split(Points<dim> &points, unsigned int p, unsigned int axes);

    bool         enabled_            = true;
    double       threshold_          = 1.4;
    std::string  directions_         = "stretched";
    double       minimum_length_     = 0.7;
    unsigned int maximum_generation_ = 12;
    unsigned int maximum_points_     = 10000000;

    BoxRule rule_ = BoxRule::second_moments;

    struct SplitMark
    {
      unsigned int point;
      unsigned int axes;
    };
    std::vector<SplitMark> marked_;
    double                 n_on_other_ranks_ = 0; ///< in the last check_total()
    double                 next_id_          = 0;
    double                 id_stride_        = 1;
    ConservationCheck<dim> conservation_;
    SplitStatistics        statistics_;
  };
} // namespace talus

#endif

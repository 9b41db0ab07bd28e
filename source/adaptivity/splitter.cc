// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/splitter.h>
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_rule.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Splitter<dim>::Splitter()
    : ParameterAcceptor("/Splitting")
  {
    add_parameter("Enabled", enabled_, "Whether points are split.");
    add_parameter("Threshold",
                  threshold_,
                  "beta: a point is split along an edge when the stretch of "
                  "the edge exceeds this many times its stretch at creation "
                  "[-]. The paper recommends 1.4 to 1.7.",
                  this->prm,
                  Patterns::Double(1. + 1e-6));
    add_parameter("Directions",
                  directions_,
                  "'stretched': halve only the edges that are too long; 'all': "
                  "halve every edge (four children in 2-D, eight in 3-D), as "
                  "the paper does, which needs three to five times as many "
                  "points, and far more where a layer becomes thin.",
                  this->prm,
                  Patterns::Selection("all|stretched"));
    add_parameter("Minimum length",
                  minimum_length_,
                  "Length above which the threshold applies to a point, in "
                  "cells [-]; 0: the threshold always applies.",
                  this->prm,
                  Patterns::Double(0., 1.));
    add_parameter("Maximum generation",
                  maximum_generation_,
                  "Largest number of successive splits of a point [-]. Few "
                  "points reach the default, mostly spray and mud on a base "
                  "without slip; where shear is counted, choose a smaller "
                  "number. A point at the limit is not split: its box "
                  "is clipped, and soil that stretches on may tear. Points at "
                  "the limit are counted in statistics.csv and reported in "
                  "log.txt.",
                  this->prm,
                  Patterns::Integer(0));
    add_parameter("Maximum number of points",
                  maximum_points_,
                  "Largest number of points on all ranks [-]; the run stops "
                  "with an error before more points are made.",
                  this->prm,
                  Patterns::Integer(1));
  }



  // Boxes that count shear follow V, which halves only if all edges are halved.
  template <int dim>
  void
  Splitter<dim>::prepare(const BoxShape &shape)
  {
    rule_ = shape.rule;
    AssertThrow(!enabled_ || !shape.counts_shear || directions_ == "all",
                ExcUser("'Splitting/Shear = counted', the rule of the paper, "
                        "splits points along all axes, but 'Splitting/"
                        "Directions' is 'stretched'. Set 'Shear = ignored', "
                        "or 'Directions = all'."));
  }



  // The criterion of the paper, the stretch since creation, contains no length.
  // In a shear band with growing strain it requires splits without end, of
  // points that are already small. Hence it applies only to points longer than
  // a fraction of a cell. A point longer than a cell is split in any case, as
  // the weights would clip its box and the soil would tear (doc/method.md,
  // section 6).
  template <int dim>
  template <typename Number>
  TALUS_ALWAYS_INLINE auto
  Splitter<dim>::exceeds_threshold(const PointsView<dim, const double> &points,
                                   const unsigned int                   p,
                                   const unsigned int                   d,
                                   const double cell_size) const
  {
    const Number length = length_to_split<Number, dim>(points, rule_, d, p);
    const auto   at_creation =
      load<Number>(points.data(points.length_at_creation, d) + p);
    const auto is_stretched = (length > threshold_ * at_creation) &
                              (length > Number(minimum_length_ * cell_size));
    // The box of a point longer than a cell would be clipped and leave gaps.
    const auto is_too_long = length > Number((1. + 1e-9) * cell_size);
    return is_stretched | is_too_long;
  }



  // Repeats the comparison of may_exceed(), for a single point.
  template <int dim>
  unsigned int
  Splitter<dim>::axes_to_split(const Points<dim> &points,
                               const unsigned int p,
                               const double       cell_size) const
  {
    unsigned int axes = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (exceeds_threshold<double>(points.view(), p, d, cell_size))
        axes |= 1u << d;
    return axes;
  }



  // The criterion is stricter in smaller cells: if no point exceeds the
  // threshold in cells of this size, no point does in larger cells.
  template <int dim>
  bool
  Splitter<dim>::may_exceed(const Points<dim> &points,
                            const unsigned int begin,
                            const unsigned int end,
                            const double       cell_size) const
  {
    const auto columns = points.view();
    bool       found   = false;
    for_each_simd(
      begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number    = decltype(number);
        auto may_exceed = exceeds_threshold<Number>(columns, p, 0, cell_size);
        for (unsigned int d = 1; d < dim; ++d)
          may_exceed |= exceeds_threshold<Number>(columns, p, d, cell_size);
        found |=
          any(may_exceed & (load<Number>(columns.data(columns.generation) + p) <
                            Number(maximum_generation_)));
      });
    return found;
  }



  // Along the axes without a split the children lie at the position of the
  // parent, which may be outside the mesh at a wall. The parent is split
  // nevertheless.
  template <int dim>
  bool
  Splitter<dim>::children_may_stay(const Points<dim> &points,
                                   const unsigned int p,
                                   const unsigned int axes,
                                   const double       cell_size,
                                   const Grid<dim>   &grid) const
  {
    const Box<dim> &domain = grid.domain();
    Tensor<1, dim>  reach; // from the parent's to the children's centres, m
    for (unsigned int d = 0; d < dim; ++d)
      if (axes & (1u << d))
        {
          const auto edge = edge_to_split(points, rule_, d, p);
          for (unsigned int i = 0; i < dim; ++i)
            reach[i] += 0.25 * std::abs(edge[i]);
        }
    for (unsigned int d = 0; d < dim; ++d)
      if (reach[d] > 0 && !grid.periodicity().along(d))
        {
          const double x = points.data(points.position, d)[p];
          if (x - reach[d] < domain.lower[d] - 0.5 * cell_size ||
              x + reach[d] > domain.upper[d] + 0.5 * cell_size)
            return false;
        }
    return true;
  }



  // A point that has entered a smaller cell must fit into it at once. A child
  // that would lie in a smaller cell must fit into the cell along all axes, as
  // otherwise its box would be clipped and leave gaps. Each further axis moves
  // the children, hence the loop. The loop ends, as axes are only added.
  template <int dim>
  unsigned int
  Splitter<dim>::axes_near_other_sizes(const Points<dim> &points,
                                       const Grid<dim>   &grid,
                                       const unsigned int p,
                                       const unsigned int cell,
                                       double            &cell_size) const
  {
    // This rank may not know the cell.
    const auto size_at = [&](const Point<dim> &x) {
      const unsigned int c = grid.find_cell(x);
      return grid.cells()[c == numbers::invalid_unsigned_int ? cell : c].size;
    };
    const Point<dim>                x = load_place(points, points.position, p);
    Point<dim>                      length;
    std::array<Tensor<1, dim>, dim> edge;
    for (unsigned int d = 0; d < dim; ++d)
      {
        edge[d]   = edge_to_split(points, rule_, d, p);
        length[d] = edge[d].norm();
      }
    cell_size         = size_at(x);
    unsigned int axes = axes_to_split(points, p, cell_size);
    for (bool grew = (axes != 0); grew;)
      {
        grew = false;
        for (unsigned int corner = 0; corner < (1u << dim); ++corner)
          {
            Point<dim> child = x;
            for (unsigned int d = 0; d < dim; ++d)
              if (axes & (1u << d))
                child += ((corner >> d) & 1 ? 0.25 : -0.25) * edge[d];
            const double size = size_at(child);
            for (unsigned int d = 0; d < dim; ++d)
              if (!(axes & (1u << d)) && length[d] > (1. + 1e-9) * size)
                {
                  axes |= 1u << d;
                  grew = true;
                }
          }
      }
    return axes;
  }



  template <int dim>
  unsigned int
  Splitter<dim>::required_axes(const Points<dim> &points,
                               const Grid<dim>   &grid,
                               const unsigned int p,
                               const unsigned int cell,
                               double            &cell_size) const
  {
    cell_size = grid.cells()[cell].size;
    if (points.feeds(p))
      return 0;
    const unsigned int axes =
      grid.cells()[cell].uniform
        ? axes_to_split(points, p, cell_size)
        : axes_near_other_sizes(points, grid, p, cell, cell_size);
    return (axes != 0 && directions_ == "all") ? (1u << dim) - 1 : axes;
  }



  template <int dim>
  bool
  Splitter<dim>::is_stretched(const Points<dim> &points,
                              const unsigned int p) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (length_to_split<double, dim>(points.view(), rule_, d, p) >
          threshold_ * points.data(points.length_at_creation, d)[p])
        return true;
    return false;
  }



  // Called when a row of statistics is due, not in every step. Points that may
  // be split are not counted: the next step splits them.
  template <int dim>
  UnsplitPoints
  Splitter<dim>::count_unsplit(const Points<dim> &points,
                               const Grid<dim>   &grid) const
  {
    UnsplitPoints count;
    if (!enabled_)
      return count;
    points.for_each_point([&](const Segment &segment, const unsigned int p) {
      double             cell_size;
      const unsigned int axes =
        required_axes(points, grid, p, segment.cell, cell_size);
      if (axes == 0)
        count.at_length_limit += !points.feeds(p) && is_stretched(points, p);
      else if (points.data(points.generation)[p] >= maximum_generation_)
        ++count.at_generation_limit;
      else if (!children_may_stay(points, p, axes, cell_size, grid))
        ++count.at_mesh_limit;
    });
    for (unsigned long *number : {&count.at_generation_limit,
                                  &count.at_mesh_limit,
                                  &count.at_length_limit})
      *number = Utilities::MPI::sum(*number, grid.communicator());
    return count;
  }



  namespace
  {
    const std::string more_points_advice =
      ". Raise it, use larger cells, 'Splitting/Directions = stretched' and "
      "'Splitting/Merge = true', or set a 'Splitting/Maximum generation', "
      "beyond which soil that stretches on may tear.";
  }



  /// Throw ExcPoint if there would be too many points, before any child is
  /// created: otherwise memory might run out first. Splits on other ranks in
  /// the same step are not known yet.
  template <int dim>
  void
  Splitter<dim>::check_budget(const Points<dim> &points,
                              const std::size_t  n_points) const
  {
    const unsigned int first      = marked_[0].point;
    const double       n_on_ranks = n_points + n_on_other_ranks_;
    AssertThrow(
      n_on_ranks <= maximum_points_,
      ExcPoint(
        text("Splitting ",
             counted(marked_.size(), "point"),
             ", the first of them point ",
             points.data(points.id)[first],
             " at (",
             load_place(points, points.position, first),
             ") m, would make ",
             n_on_ranks,
             " points on all ranks, more than 'Splitting/Maximum number of "
             "points' = ",
             maximum_points_,
             more_points_advice)));
  }



  // The limit applies to all ranks together, but counting needs a message
  // between all ranks. The caller passes a number that is known already.
  template <int dim>
  void
  Splitter<dim>::check_total(const double n_points, const double n_own)
  {
    n_on_other_ranks_ = n_points - n_own;
    AssertThrow(n_points <= maximum_points_,
                ExcPoint(text("There are ",
                              n_points,
                              " points on all ranks, more than 'Splitting/"
                              "Maximum number of points' = ",
                              maximum_points_,
                              more_points_advice)));
  }



  // Nearly always no point of a batch must be split. A test of several points
  // at a time tells so in a few operations, for the whole batch if its cells
  // have one size. Only if the test fails, points are tested one by one; only
  // next to cells of a different size, points are located in the mesh. Marked
  // points are split later, outside of any loop over points, as appending
  // children may move all arrays.
  template <int dim>
  void
  Splitter<dim>::mark(const Points<dim> &points,
                      const Batch       &batch,
                      const Grid<dim>   &grid)
  {
    if (!enabled_)
      return;
    // Smallest cell that may contain a point of the segment: a neighbour may
    // have half the size.
    const auto min_size = [&](const Segment &segment) {
      const Cell<dim> &cell = grid.cells()[segment.cell];
      return cell.size * (cell.uniform ? 1. : 0.5);
    };
    double least = std::numeric_limits<double>::max(), most = 0;
    for (const Segment &segment : points.segments(batch))
      {
        const double size = min_size(segment);
        least             = std::min(least, size);
        most              = std::max(most, size);
      }
    if (least == most && !may_exceed(points, batch.begin, batch.end, least))
      return;
    for (const Segment &segment : points.segments(batch))
      {
        if (!may_exceed(points, segment.begin, segment.end, min_size(segment)))
          continue;
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            double             cell_size;
            const unsigned int axes =
              required_axes(points, grid, p, segment.cell, cell_size);
            // A point at the limit continues with a clipped box:
            // count_unsplit().
            if (axes != 0 &&
                points.data(points.generation)[p] < maximum_generation_ &&
                children_may_stay(points, p, axes, cell_size, grid))
              marked_.push_back({p, axes});
          }
      }
  }



  // Split each point once and not until no point exceeds the threshold:
  // children are half as long, and a child that is still too long is split in
  // the next step.
  template <int dim>
  bool
  Splitter<dim>::split_marked(Points<dim>               &points,
                              std::vector<unsigned int> &points_out_of_cell)
  {
    if (marked_.empty())
      return false;
    std::size_t n_children = 0;
    for (const SplitMark &entry : marked_)
      n_children += 1u << __builtin_popcount(entry.axes);
    check_budget(points, points.size() - marked_.size() + n_children);
    for (const SplitMark &entry : marked_)
      {
        points_out_of_cell.push_back(entry.point);
        split(points, entry.point, entry.axes);
      }
    statistics_.n_splits += marked_.size();
    statistics_.conservation_error = conservation_.relative_error();
    // The round-off of several thousand splits stays below 1e-12.
    TalusAssert(statistics_.conservation_error <= 1e-12,
                ExcMessage("Children differ from their parents by more than "
                           "round-off in mass, momentum or energy."));
    marked_.clear();
    return true;
  }



  namespace
  {
    /// Moves the children of a point from the centre of the parent to their
    /// places: by a quarter of edge_to_split() in each direction of the split.
    /// Bit i of `child` selects the side along the i-th of these edges.
    ///
    /// The initial position moves, too, as loads and initial fields are
    /// functions of it: by diag(L) A^-1 (x_d - x) with reference_lengths() L.
    /// The move is exact at the first split of a point, unless reduce_edges()
    /// has replaced an edge (doc/method.md, section 6).
    template <int dim>
    class Offset
    {
    public:
      Offset(const Points<dim> &points,
             const BoxRule      rule,
             const unsigned int p,
             const unsigned int axes)
        : axes_(axes)
      {
        const auto to_edges =
          inverse(load_matrix<dim, double>(points, points.edges, p));
        const auto L = reference_lengths(points, p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            quarter_[d] = 0.25 * edge_to_split(points, rule, d, p);
            for (unsigned int e = 0; e < dim; ++e)
              for (unsigned int i = 0; i < dim; ++i)
                material_[d][e] += L[e] * to_edges[e][i] * quarter_[d][i];
          }
      }

      void
      move(Points<dim>       &points,
           const unsigned int p,
           const unsigned int child) const
      {
        for (unsigned int d = 0, bit = 0; d < dim; ++d)
          if (axes_ & (1u << d))
            {
              const double sign = ((child >> bit++) & 1 ? 1. : -1.);
              for (unsigned int e = 0; e < dim; ++e)
                {
                  points.data(points.position, e)[p] += sign * quarter_[d][e];
                  points.data(points.initial_position, e)[p] +=
                    sign * material_[d][e];
                }
            }
      }

    private:
      unsigned int                    axes_;
      std::array<Tensor<1, dim>, dim> quarter_;  ///< m
      std::array<Tensor<1, dim>, dim> material_; ///< m
    };
  } // namespace



  /// Split point @p p along @p axes, and check conservation.
  ///
  /// The first child takes the place of the parent, so a split into n children
  /// appends n - 1 points and leaves no hole. Stress and internal variables are
  /// copied: the children are the same material in the same state. The lengths
  /// at creation become the current lengths of all edges, so that the threshold
  /// applies to the stretch after the split; otherwise a child could be split
  /// again at once. Boxes of the rule `fixed` are halved with the edges.
  template <int dim>
  void
  Splitter<dim>::split(Points<dim>       &points,
                       const unsigned int p,
                       const unsigned int axes)
  {
    conservation_.add(points, p, +1.);
    const unsigned int n_children = 1u << __builtin_popcount(axes);
    const Offset<dim>  offset(points, rule_, p, axes);

    // Prepare the common state of all children in the place of the parent.
    for (const Column &column : points.columns())
      if (column.inheritance == Inheritance::divided)
        for (unsigned int c = 0; c < column.n_components; ++c)
          points.data(column.first, c)[p] /= n_children;
    for (unsigned int d = 0; d < dim; ++d)
      if (axes & (1u << d))
        {
          for (unsigned int i = 0; i < dim; ++i)
            points.data(points.edges, dim * i + d)[p] *= 0.5;
          points.data(points.box_length, d)[p] *= 0.5;
        }
    begin_stretch(points, p, p + 1, rule_);
    const double generation = ++points.data(points.generation)[p];
    statistics_.largest_generation =
      std::max(statistics_.largest_generation,
               static_cast<unsigned int>(generation));

    // append() may move the columns: keep no pointer into them.
    const unsigned int first = points.append(n_children - 1);
    for (unsigned int i = 1; i < n_children; ++i)
      {
        points.copy(p, first + i - 1);
        points.data(points.id)[first + i - 1] = take_id();
      }
    for (unsigned int i = 0; i < n_children; ++i)
      {
        const unsigned int q = (i == 0 ? p : first + i - 1);
        offset.move(points, q, i);
        conservation_.add(points, q, -1.);
      }
  }



  // Counting clipped boxes and points at limits visits all points. Called only
  // when a row of statistics is due, not in every step.
  template <int dim>
  void
  Splitter<dim>::list_quantities(const State<dim> &state,
                                 Quantities       &list) const
  {
    const MPI_Comm communicator = state.communicator();
    const auto     add = [&list](const std::string &name, const double value) {
      list.push_back({name, "", value});
    };
    add("splits", Utilities::MPI::sum(statistics_.n_splits, communicator));
    add("largest generation",
        Utilities::MPI::max(statistics_.largest_generation, communicator));
    add("clipped boxes",
        Utilities::MPI::sum(count_clipped_boxes(state.points,
                                                state.grid,
                                                state.constants.box_shape),
                            communicator));
    const UnsplitPoints unsplit = count_unsplit(state.points, state.grid);
    add("points at generation limit", unsplit.at_generation_limit);
    add("points at mesh limit", unsplit.at_mesh_limit);
    add("points at length limit", unsplit.at_length_limit);
    list.push_back(
      {"split conservation error",
       "-",
       Utilities::MPI::max(statistics_.conservation_error, communicator)});
  }



  // The id of the next child is part of the state, as ids are unique over the
  // whole run.
  template <int dim>
  void
  Splitter<dim>::list_state(StateList &list)
  {
    list.add("next id", "-", next_id_, Reduction::maximum);
    list.add("splits", "-", statistics_.n_splits, Reduction::sum);
    list.add("largest generation",
             "-",
             statistics_.largest_generation,
             Reduction::maximum);
    list.add("split conservation error",
             "-",
             statistics_.conservation_error,
             Reduction::maximum);
    conservation_.list_state(list, "split conservation error");
  }



  template class Splitter<2>;
  template class Splitter<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_points_h
#define talus_points_points_h

#include <talus/points/points_view.h>
#include <talus/points/rows.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <string>
#include <vector>

namespace talus
{
  /// What a column becomes when its point is split.
  enum class Inheritance
  {
    /// Intensive: every child has the parent's value.
    copied,
    /// Extensive: the parent's value is shared equally by the children.
    divided
  };

  /// What the components of a column are to each other, and in which order.
  enum class ColumnKind
  {
    scalars,          ///< one number, or a list of numbers
    vector,           ///< dim components
    symmetric_tensor, ///< xx, yy, zz, xy (xz, yz): also out of the plane
    tensor,           ///< dim x dim components, row by row; 0 out of the plane
    deformation       ///< the same, but 1 out of the plane
  };

  /// A named property of the points.
  struct Column
  {
    std::string  name;
    std::string  unit; ///< "-" if there is none
    ColumnKind   kind;
    unsigned int n_components;
    Inheritance  inheritance;
    /// Index of the first component among the scalar arrays.
    unsigned int first;
  };

  /// The points of one body in one cell: [begin, end) in the sorted order.
  struct Segment
  {
    unsigned int cell;
    unsigned int body;
    unsigned int begin;
    unsigned int end;
  };

  /// Consecutive segments: what a phase of the step works on at a time.
  struct Batch
  {
    unsigned int first_segment;
    unsigned int last_segment; ///< behind the last one
    unsigned int begin;        ///< first point
    unsigned int end;
  };

  /// The material points: a structure of arrays with columns by name.
  ///
  /// Every column is stored as n_components contiguous arrays of doubles, so
  /// that a loop over points is a loop over contiguous memory; output, sorting,
  /// splitting and (later) checkpoints go over columns() and need not know what
  /// a column means. Materials add their own internal variables.
  ///
  /// Points are sorted by cell, then by body (see Segment); within a segment
  /// their order is part of the state. Points beyond n_sorted() were appended
  /// and wait for Relocation::update() to sort them in.
  ///
  /// Arrays have n_spare entries behind the last point, so that as many points
  /// as a register of any machine holds may be read at any point.
  template <int dim>
  class Points : public PointColumns<dim>
  {
  public:
    static constexpr unsigned int n_spare = 8;

    Points();

    /// Add a column, filled with zero, or return the one of that name. Throws
    /// if one with this name exists with another shape.
    unsigned int
    add_column(const std::string &name,
               const std::string &unit,
               ColumnKind         kind,
               Inheritance        inheritance);

    /// The same with this many numbers, each a scalar.
    unsigned int
    add_column(const std::string &name,
               const std::string &unit,
               unsigned int       n_scalars,
               Inheritance        inheritance);

    const std::vector<Column> &
    columns() const
    {
      return columns_;
    }

    /// First scalar array of the column called @p name; throws if there is
    /// none.
    unsigned int
    find(const std::string &name) const;

    /// Number of scalar arrays that hold the columns.
    unsigned int
    n_arrays() const
    {
      return arrays_.size();
    }

    double *
    data(const unsigned int column, const unsigned int component = 0)
    {
      return arrays_[column + component];
    }

    const double *
    data(const unsigned int column, const unsigned int component = 0) const
    {
      return arrays_[column + component];
    }

    /// What functions of one point take; valid until points are added.
    PointsView<dim>
    view()
    {
      return {{}, arrays_[0], arrays_.pitch()};
    }

    PointsView<dim, const double>
    view() const
    {
      return {{}, arrays_[0], arrays_.pitch()};
    }

    unsigned int
    size() const
    {
      return size_;
    }

    unsigned int
    n_sorted() const
    {
      return segments_.empty() ? 0 : segments_.back().end;
    }

    /// Append @p n points with all columns zero. Returns the first new index.
    unsigned int
    append(unsigned int n);

    /// Copy all columns of a point.
    void
    copy(unsigned int from, unsigned int to);

    /// Reorder in place. @p block_moves are the runs of points that keep their order
    /// but not their place: ascending in begin, and so in @p to; @p element_moves are
    /// all other points that move. Those named by neither stay where they are,
    /// or, if they went to another rank, are overwritten. @p segments describes
    /// the new order, and is exchanged for the description of the old one.
    void
    reorder(const std::vector<BlockMove>   &block_moves,
            const std::vector<ElementMove> &element_moves,
            std::vector<Segment>           &segments);

    /// Remove all points: they went elsewhere.
    void
    clear()
    {
      size_ = 0;
      segments_.clear();
    }

    /// Forget the cells: all points wait to be sorted in.
    void
    forget_order()
    {
      segments_.clear();
    }

    const std::vector<Segment> &
    segments() const
    {
      return segments_;
    }

    /// All sorted points.
    Batch
    all() const
    {
      return {0, static_cast<unsigned int>(segments_.size()), 0, n_sorted()};
    }

    /// Cell of a sorted point.
    unsigned int
    cell_of(const unsigned int p) const
    {
      const auto behind =
        std::upper_bound(segments_.begin(),
                         segments_.end(),
                         p,
                         [](const unsigned int q, const Segment &segment) {
                           return q < segment.begin;
                         });
      return (behind - 1)->cell;
    }

    /// Points of a batch, but for what is left of the last cell.
    static constexpr unsigned int batch_size = 512;

    /// Call action(batch) for batches that together hold all sorted points, in
    /// their order, and whole cells each. A batch is so small that what one phase of the step writes,
    /// the next one finds in a cache, and so large that the loops over several
    /// points at a time have few rests.
    template <typename Action>
    void
    for_each_batch(const Action &action) const
    {
      for (unsigned int s = 0; s < segments_.size();)
        {
          Batch batch = {s, s, segments_[s].begin, segments_[s].begin};
          while (s < segments_.size() &&
                 (batch.end - batch.begin < batch_size || in_same_cell(s)))
            batch.end = segments_[s++].end;
          batch.last_segment = s;
          action(batch);
        }
    }

    /// Call action(batch) for the points of each cell of a batch.
    template <typename Action>
    TALUS_ALWAYS_INLINE void
    for_each_cell(const Batch &batch, const Action &action) const
    {
      for (unsigned int s = batch.first_segment; s < batch.last_segment;)
        {
          const unsigned int first = s++;
          while (s < batch.last_segment && in_same_cell(s))
            ++s;
          action(Batch{first, s, segments_[first].begin, segments_[s - 1].end});
        }
    }

    /// Ask for the first @p n_arrays arrays of the points one batch behind
    /// [@p begin, @p end), which are about to be computed: else memory would rest
    /// while a batch is computed, and the arithmetic while it is fetched. (If it
    /// is not inlined, GCC sees that it changes nothing, and leaves it out.)
    TALUS_ALWAYS_INLINE void
    fetch_ahead(const unsigned int begin,
                const unsigned int end,
                const unsigned int n_arrays) const
    {
      constexpr int          for_reading = 0, into_second_level_cache = 2;
      constexpr unsigned int line = 64 / sizeof(double);
      for (unsigned int p = (begin + line - 1) / line * line; p < end;
           p += line)
        for (unsigned int a = 0; a < n_arrays; ++a)
          __builtin_prefetch(arrays_[a] + p + batch_size,
                             for_reading,
                             into_second_level_cache);
    }

    /// Bytes of memory held.
    std::size_t
    memory_consumption() const;

  private:
    /// Whether segment @p s lies in the cell of the one before.
    bool
    in_same_cell(const unsigned int s) const
    {
      return s > 0 && segments_[s].cell == segments_[s - 1].cell;
    }

    unsigned int
    add(const Column &column);

    void
    reserve(unsigned int n);

    unsigned int         size_     = 0;
    unsigned int         capacity_ = 0;
    std::vector<Column>  columns_;
    Rows                 arrays_;
    std::vector<Segment> segments_;
  };



  /// Read a column of vectors at point p.
  template <int dim>
  inline dealii::Tensor<1, dim>
  load_vector(const Points<dim> &points,
              const unsigned int column,
              const unsigned int p)
  {
    dealii::Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = points.data(column, d)[p];
    return v;
  }



  /// Read a column of places, m, at point p.
  template <int dim>
  inline dealii::Point<dim>
  load_place(const Points<dim> &points,
             const unsigned int column,
             const unsigned int p)
  {
    return dealii::Point<dim>(load_vector(points, column, p));
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_points_h
#define talus_points_points_h

#include <talus/points/points_view.h>
#include <talus/points/rows.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// How children inherit the value of a column when a point is split.
  enum class Inheritance
  {
    /// Intensive quantity: every child gets the value of the parent.
    copied,
    /// Extensive quantity: the value of the parent is divided equally.
    divided
  };

  /// Meaning and order of the components of a column.
  enum class ColumnKind
  {
    scalars,          ///< a number or a list of numbers
    vector,           ///< dim components
    symmetric_tensor, ///< xx, yy, zz, xy (xz, yz): also out of the plane
    tensor,           ///< dim x dim components, row by row; 0 out of the plane
    deformation       ///< as tensor, but 1 out of the plane
  };

  /// Named quantity of the points.
  struct Column
  {
    std::string  name;
    std::string  unit; ///< "-" if dimensionless
    ColumnKind   kind;
    unsigned int n_components;
    Inheritance  inheritance;
    /// Index of the first component in the scalar arrays.
    unsigned int first;
  };

  /// Points of one body in one cell: [begin, end) in the sorted order.
  struct Segment
  {
    unsigned int cell;
    unsigned int body;
    unsigned int begin;
    unsigned int end;
  };

  /// Consecutive segments, processed together by a phase of the step.
  struct Batch
  {
    unsigned int first_segment;
    unsigned int last_segment; ///< behind the last segment
    unsigned int begin;        ///< first point
    unsigned int end;
  };

  /// The material points: a structure of arrays with named columns.
  ///
  /// Every column is stored as n_components contiguous arrays of doubles, so
  /// that a loop over points is a loop over contiguous memory. Output, sorting,
  /// splitting and checkpoints loop over columns() without knowledge of the
  /// meaning of a column. Materials add columns for internal variables.
  ///
  /// Points are sorted by cell, then by body (see Segment); the order within a
  /// segment is part of the state. Points beyond n_sorted() are appended, and
  /// Relocation::update() sorts them in.
  ///
  /// Arrays have n_spare entries behind the last point, so that a whole
  /// register can be read at any point on any machine.
  template <int dim>
  class Points : public PointColumns<dim>
  {
  public:
    static constexpr unsigned int n_spare = n_spare_entries;

    Points();

    /// Add a column filled with zeros, or find the column with the same name.
    /// Throws if a column of the same name has another shape.
    ///
    /// @param unit "-" if dimensionless
    /// @param inheritance see Inheritance
    /// @return index of the first scalar array
    unsigned int
    add_column(const std::string &name,
               const std::string &unit,
               ColumnKind         kind,
               Inheritance        inheritance);

    /// Add or find a column of @p n_scalars numbers per point.
    unsigned int
    add_column(const std::string &name,
               const std::string &unit,
               unsigned int       n_scalars,
               Inheritance        inheritance);

    /// Add or find the columns of the excess pore pressure u and of the
    /// overburden, Pa, compression positive. With the columns the stress of the
    /// points is effective: nodal forces and friction see the total stress,
    /// stress - u I.
    void
    add_pore_pressure();

    bool
    have_pore_pressure() const
    {
      return pore_pressure_ != dealii::numbers::invalid_unsigned_int;
    }

    /// Column of the excess pore pressure; invalid without.
    unsigned int
    pore_pressure() const
    {
      return pore_pressure_;
    }

    /// Column of the effective stress across the layers at rest without excess
    /// pore pressure, Pa, compression positive; invalid without pore pressure.
    unsigned int
    overburden() const
    {
      return overburden_;
    }

    const std::vector<Column> &
    columns() const
    {
      return columns_;
    }

    /// Return the index of the first scalar array of the column @p name; throws
    /// if no such column exists.
    unsigned int
    find(const std::string &name) const;

    /// Number of scalar arrays of all columns.
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

    /// Owner of the memory of all arrays, for readers outside of the run, which
    /// may keep views for longer than the points exist.
    std::shared_ptr<const double>
    memory() const
    {
      return arrays_.memory();
    }

    /// View for functions of one point; valid until points or columns are
    /// added.
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

    /// Column of the mass of a feeding point per length along the normal of its
    /// face at the start, kg/m; 0 for other points. Opened by Inflow.
    unsigned int inflow_density = dealii::numbers::invalid_unsigned_int;

    /// Whether point @p p feeds an inflow: only Inflow divides it.
    bool
    feeds(const unsigned int p) const
    {
      return inflow_density != dealii::numbers::invalid_unsigned_int &&
             data(inflow_density)[p] > 0.;
    }

    unsigned int
    n_sorted() const
    {
      return segments_.empty() ? 0 : segments_.back().end;
    }

    /// Append @p n points with all columns zero. Return the first new index.
    unsigned int
    append(unsigned int n);

    /// Copy all columns of point @p from to point @p to.
    void
    copy(unsigned int from, unsigned int to);

    /// Reorder the points in place. Points in no move stay in place; points
    /// sent to another rank may be overwritten.
    ///
    /// @param block_moves ranges of points that move without changing their
    ///   order, ascending in begin and in `to`
    /// @param element_moves all other points that move
    /// @param segments the new segments; contains the old segments afterwards
    void
    reorder(const std::vector<BlockMove>   &block_moves,
            const std::vector<ElementMove> &element_moves,
            std::vector<Segment>           &segments);

    /// Remove all points.
    void
    clear()
    {
      size_ = 0;
      segments_.clear();
    }

    /// Remove all segments: all points become unsorted.
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

    /// Segments of @p batch.
    dealii::ArrayView<const Segment>
    segments(const Batch &batch) const
    {
      return {segments_.data() + batch.first_segment,
              batch.last_segment - batch.first_segment};
    }

    /// Batch of all sorted points.
    Batch
    all() const
    {
      return {0, static_cast<unsigned int>(segments_.size()), 0, n_sorted()};
    }

    /// Return the cell of a sorted point.
    unsigned int
    cell_of(const unsigned int p) const
    {
      return segment_of(p)->cell;
    }

    /// Return the first and the last point, plus one, of the cell of a sorted
    /// point.
    std::pair<unsigned int, unsigned int>
    range_of_cell(const unsigned int p) const
    {
      auto               first = segment_of(p), behind = first;
      const unsigned int cell = first->cell;
      while (behind != segments_.end() && behind->cell == cell)
        ++behind;
      while (first != segments_.begin() && (first - 1)->cell == cell)
        --first;
      return {first->begin, (behind - 1)->end};
    }

    /// Number of points in a batch, not counting the rest of the last cell.
    static constexpr unsigned int batch_size = 512;

    /// Call action(batch) for consecutive batches of whole cells that cover all
    /// sorted points. A batch is small enough that a phase of the step finds
    /// the results of the previous phase in a cache, and large enough that
    /// loops over several points at a time have few remainders.
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

    /// Call action(part) for the parts of @p batch: the longest rows of
    /// segments with the same value of key(segment).
    template <typename Key, typename Action>
    TALUS_ALWAYS_INLINE void
    for_each_part(const Batch  &batch,
                  const Key    &key,
                  const Action &action) const
    {
      for (unsigned int s = batch.first_segment; s < batch.last_segment;)
        {
          const unsigned int first = s++;
          while (s < batch.last_segment &&
                 key(segments_[s]) == key(segments_[first]))
            ++s;
          action(Batch{first, s, segments_[first].begin, segments_[s - 1].end});
        }
    }

    /// Call action(part) for the points of each cell of @p batch.
    template <typename Action>
    TALUS_ALWAYS_INLINE void
    for_each_cell(const Batch &batch, const Action &action) const
    {
      for_each_part(
        batch, [](const Segment &segment) { return segment.cell; }, action);
    }

    /// Call action(segment, p) for all sorted points p in their order.
    template <typename Action>
    TALUS_ALWAYS_INLINE void
    for_each_point(const Action &action) const
    {
      for (const Segment &segment : segments_)
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          action(segment, p);
    }

    /// Prefetch the first @p n_arrays arrays of the points one batch behind
    /// [begin, end), which are processed next: otherwise memory would be idle
    /// during computation and arithmetic during loading. (Unless inlined, GCC
    /// removes the function because it has no visible effect.)
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

    /// Memory of all points, bytes.
    std::size_t
    memory_consumption() const;

  private:
    std::vector<Segment>::const_iterator
    segment_of(const unsigned int p) const
    {
      const auto behind =
        std::upper_bound(segments_.begin(),
                         segments_.end(),
                         p,
                         [](const unsigned int q, const Segment &segment) {
                           return q < segment.begin;
                         });
      return behind - 1;
    }

    /// Whether segment @p s lies in the same cell as the previous segment.
    bool
    in_same_cell(const unsigned int s) const
    {
      return s > 0 && segments_[s].cell == segments_[s - 1].cell;
    }

    unsigned int
    add(const Column &column);

    void
    reserve(unsigned int n);

    unsigned int         size_          = 0;
    unsigned int         capacity_      = 0;
    unsigned int         pore_pressure_ = dealii::numbers::invalid_unsigned_int;
    unsigned int         overburden_    = dealii::numbers::invalid_unsigned_int;
    std::vector<Column>  columns_;
    Rows                 arrays_;
    std::vector<Segment> segments_;
  };



  /// Return the vector in column @p column at point @p p.
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



  /// Return the edges of the cell of point @p p as columns of a tensor, m.
  template <int dim>
  inline dealii::Tensor<2, dim>
  load_edges(const Points<dim> &points, const unsigned int p)
  {
    dealii::Tensor<2, dim> A;
    for (unsigned int c = 0; c < dim * dim; ++c)
      A[c / dim][c % dim] = points.data(points.edges, c)[p];
    return A;
  }



  /// Return the position in column @p column at point @p p, m.
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

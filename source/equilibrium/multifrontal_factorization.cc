// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/simd.h>
#include <talus/equilibrium/multifrontal_factorization.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Number = Simd<simd_width>;

    /// Number of columns eliminated at a time.
    constexpr unsigned int n_side_by_side = 8;

    /// Smallest multiple of n_side_by_side that is not less than @p n. All
    /// columns begin at such a multiple, so that registers are aligned.
    std::size_t
    padded(const std::size_t n)
    {
      return (n + n_side_by_side - 1) / n_side_by_side * n_side_by_side;
    }



    /// Dense matrix by columns. Only entries on and below the diagonal are used;
    /// the values of others are undefined.
    struct DenseFront
    {
      double      *entries;
      std::size_t  stride; ///< distance between columns
      unsigned int n_rows;

      double *
      column(const unsigned int j) const
      {
        return entries + stride * j;
      }
    };



    /// Subtract the contribution of the columns k in [@p begin, @p end), already
    /// eliminated, from n columns beginning at @p first: L_ik D_k U_kj from the
    /// lower triangle, with @p other for the transposed upper triangle, or the
    /// other way round. @p inverse holds 1/D_k.
    template <unsigned int n>
    TALUS_ALWAYS_INLINE void
    subtract_products(const DenseFront  &front,
                      const DenseFront  &other,
                      const unsigned int begin,
                      const unsigned int end,
                      const double      *inverse,
                      const unsigned int first)
    {
      const double *from[n_side_by_side];
      double        factor[n][n_side_by_side] = {};
      for (unsigned int k = 0; k < n_side_by_side; ++k)
        {
          from[k] = front.column(std::min(begin + k, end - 1));
          for (unsigned int j = 0; j < n && begin + k < end; ++j)
            factor[j][k] = other.column(begin + k)[first + j] * inverse[k];
        }
      double *to[n];
      for (unsigned int j = 0; j < n; ++j)
        to[j] = front.column(first + j);
      for (unsigned int i = first / simd_width * simd_width; i < front.n_rows;
           i += simd_width)
        {
          Number sum[n];
          for (unsigned int j = 0; j < n; ++j)
            sum[j] = load<Number>(to[j] + i);
#pragma GCC unroll 8
          for (unsigned int k = 0; k < n_side_by_side; ++k)
            {
              const Number entry = load<Number>(from[k] + i);
              for (unsigned int j = 0; j < n; ++j)
                sum[j] -= Number(factor[j][k]) * entry;
            }
          for (unsigned int j = 0; j < n; ++j)
            store(to[j] + i, sum[j]);
        }
    }



    /// Subtract the contribution of the columns [@p begin, @p end) from all
    /// further columns.
    void
    update_rest(const DenseFront  &front,
                const DenseFront  &other,
                const unsigned int begin,
                const unsigned int end,
                const double      *inverse)
    {
      unsigned int j = end;
      for (; j + 4 <= front.n_rows; j += 4)
        subtract_products<4>(front, other, begin, end, inverse, j);
      for (; j < front.n_rows; ++j)
        subtract_products<1>(front, other, begin, end, inverse, j);
    }



    /// Eliminate the first @p n_columns columns of the lower triangle: they
    /// become columns of L D, and the rest becomes the Schur complement; in the
    /// same way of the transposed upper triangle, unless it is the same matrix.
    /// Returns false if a pivot is zero or not a number.
    bool
    eliminate(const DenseFront  &lower,
              const DenseFront  &upper,
              const unsigned int n_columns)
    {
      const bool is_symmetric = (lower.entries == upper.entries);
      for (unsigned int begin = 0; begin < n_columns; begin += n_side_by_side)
        {
          const unsigned int end = std::min(begin + n_side_by_side, n_columns);
          double             inverse[n_side_by_side];
          for (unsigned int k = begin; k < end; ++k)
            {
              if (k > begin)
                subtract_products<1>(lower, upper, begin, k, inverse, k);
              if (k > begin && !is_symmetric)
                subtract_products<1>(upper, lower, begin, k, inverse, k);
              const double pivot = lower.column(k)[k];
              if (!(std::abs(pivot) > 0.) || !std::isfinite(pivot))
                return false;
              inverse[k - begin] = 1. / pivot;
            }
          update_rest(lower, upper, begin, end, inverse);
          if (!is_symmetric)
            update_rest(upper, lower, begin, end, inverse);
        }
      return true;
    }



    /// Sum of a_i b_i from @p begin to @p end. The order of the sum does not
    /// depend on the width of the registers.
    double
    product(const double      *a,
            const double      *b,
            unsigned int       begin,
            const unsigned int end)
    {
      alignas(64) double sum[n_side_by_side] = {};
      for (; begin < end && begin % n_side_by_side != 0; ++begin)
        sum[begin % n_side_by_side] += a[begin] * b[begin];
      Number sums[n_side_by_side / simd_width];
      for (unsigned int k = 0; k < n_side_by_side; k += simd_width)
        sums[k / simd_width] = load<Number>(sum + k);
      for (; begin + n_side_by_side <= end; begin += n_side_by_side)
        for (unsigned int k = 0; k < n_side_by_side; k += simd_width)
          sums[k / simd_width] +=
            load<Number>(a + begin + k) * load<Number>(b + begin + k);
      for (unsigned int k = 0; k < n_side_by_side; k += simd_width)
        store(sum + k, sums[k / simd_width]);
      for (; begin < end; ++begin)
        sum[begin % n_side_by_side] += a[begin] * b[begin];
      return ((sum[0] + sum[1]) + (sum[2] + sum[3])) +
             ((sum[4] + sum[5]) + (sum[6] + sum[7]));
    }
  } // namespace



  void
  MultifrontalFactorization::analyze(const Epetra_CrsMatrix &matrix,
                                     const unsigned int      n_components)
  {
    n_components_ = n_components;
    SymmetricPattern pattern;
    pattern.first.push_back(0);
    for (int row = 0; row < matrix.NumMyRows(); row += n_components)
      {
        int     n_entries, *columns;
        double *values;
        matrix.ExtractMyRowView(row, n_entries, values, columns);
        for (int k = 0; k < n_entries; k += n_components)
          pattern.neighbours.push_back(columns[k] / n_components);
        pattern.first.push_back(pattern.neighbours.size());
      }
    fronts_ = EliminationFronts(pattern);
    make_panels();
    find_blocks(matrix);
  }



  /// Place the panels one after the other, and follow the stack to find how
  /// high it grows. The rests of the children of a front lie on top of the stack
  /// and are replaced by the rest of the front.
  void
  MultifrontalFactorization::make_panels()
  {
    const unsigned int n = n_components_;
    panels_.clear();
    rest_.clear();
    n_factors_ = stack_size_ = 0;
    std::size_t top = 0, longest = 0;
    for (const auto &front : fronts_.fronts())
      {
        const std::size_t n_rows = n * front.rows.size(),
                          n_rest = n_rows - n * front.n_columns,
                          stride = padded(n_rows);
        panels_.push_back({n_factors_,
                           static_cast<unsigned int>(n_rows),
                           n * front.n_columns,
                           static_cast<unsigned int>(stride)});
        n_factors_ += stride * n * front.n_columns;
        stack_size_ = std::max(stack_size_, top + stride * n_rows);
        longest     = std::max(longest, stride);
        rest_.push_back(front.children.empty() ? top
                                               : rest_[front.children.front()]);
        top = rest_.back() + padded(n_rest) * n_rest;
      }
    halves_ = {};
    local_.resize_fast(longest);
    permuted_.resize(n * fronts_.order().size());
    row_in_front_.resize(fronts_.order().size());
  }



  namespace
  {
    /// Rows of a matrix on this rank.
    struct MatrixRows
    {
      MatrixRows(const Epetra_CrsMatrix &matrix)
      {
        const int error = matrix.ExtractCrsDataPointers(first, columns, values);
        AssertThrow(error == 0, ExcInternalError());
      }

      int    *first, *columns;
      double *values;
    };
  } // namespace



  /// Number the rows of front @p f in row_in_front_.
  void
  MultifrontalFactorization::start_front(const unsigned int f)
  {
    const auto &rows = fronts_.fronts()[f].rows;
    for (unsigned int r = 0; r < rows.size(); ++r)
      row_in_front_[rows[r]] = r;
  }



  void
  MultifrontalFactorization::find_blocks(const Epetra_CrsMatrix &matrix)
  {
    const MatrixRows   rows(matrix);
    const unsigned int n = n_components_;
    blocks_.clear();
    first_block_.assign(1, 0);
    for (unsigned int f = 0; f < panels_.size(); ++f)
      {
        start_front(f);
        const auto &front = fronts_.fronts()[f];
        for (unsigned int c = 0; c < front.n_columns; ++c)
          {
            const unsigned int node  = fronts_.order()[front.first + c];
            const int         *first = rows.columns + rows.first[n * node],
                      *end           = rows.columns + rows.first[n * node + 1];
            for (const int *column = first; column < end; column += n)
              {
                const unsigned int second = *column / n;
                const unsigned int place  = fronts_.place()[second];
                if (place < front.first + c)
                  continue;
                const int *begin = rows.columns + rows.first[n * second];
                const int *back =
                  std::find(begin,
                            begin + (rows.first[n * second + 1] -
                                     rows.first[n * second]),
                            static_cast<int>(n * node));
                blocks_.push_back({second,
                                   static_cast<unsigned int>(column - first),
                                   static_cast<unsigned int>(back - begin),
                                   n * row_in_front_[place]});
              }
            first_block_.push_back(blocks_.size());
          }
      }
  }



  /// Add the entries of the matrix on and below the diagonal in the columns that
  /// front @p f eliminates; for the second half those of the transposed matrix.
  void
  MultifrontalFactorization::add_matrix(const Epetra_CrsMatrix &matrix,
                                        const unsigned int      f,
                                        const unsigned int      half,
                                        double                 *to) const
  {
    const MatrixRows   rows(matrix);
    const unsigned int n     = n_components_;
    const auto        &front = fronts_.fronts()[f];
    for (unsigned int c = 0; c < front.n_columns; ++c)
      {
        const unsigned int place = front.first + c;
        const unsigned int node  = fronts_.order()[place];
        for (std::size_t b = first_block_[place]; b < first_block_[place + 1];
             ++b)
          {
            const Block &block = blocks_[b];
            for (unsigned int d = 0; d < n; ++d)
              for (unsigned int e = 0; e < n; ++e)
                to[panels_[f].stride * (n * c + d) + block.row + e] =
                  half == 0
                    ? rows.values[rows.first[n * block.second_node + e] +
                                  block.in_second + d]
                    : rows
                        .values[rows.first[n * node + d] + block.in_first + e];
          }
      }
  }



  /// Add the rest of front @p child on the @p stack to its parent, whose rows
  /// row_in_front_ numbers. Most rows of the child are neighbours in the parent,
  /// too.
  void
  MultifrontalFactorization::add_child(const unsigned int child,
                                       const std::size_t  stride,
                                       const double      *stack,
                                       double            *to)
  {
    const auto        &front  = fronts_.fronts()[child];
    const unsigned int n      = n_components_;
    const unsigned int n_rest = front.rows.size() - front.n_columns;
    const std::size_t  pitch  = padded(n * std::size_t(n_rest));
    ranges_.clear();
    for (unsigned int r = 0; r < n_rest; ++r)
      {
        const unsigned int row = row_in_front_[front.rows[front.n_columns + r]];
        if (r > 0 && row == ranges_.back().row + (r - ranges_.back().begin))
          ranges_.back().end = r + 1;
        else
          ranges_.push_back({r, r + 1, row});
      }
    for (std::size_t k = 0; k < ranges_.size(); ++k)
      for (unsigned int c = n * ranges_[k].begin; c < n * ranges_[k].end; ++c)
        {
          const double *source = stack + rest_[child] + pitch * c;
          double       *target =
            to + stride * (c + n * ranges_[k].row - n * ranges_[k].begin);
          for (std::size_t l = k; l < ranges_.size(); ++l)
            {
              const RowRange    &rows  = ranges_[l];
              const unsigned int shift = n * (rows.row - rows.begin);
              for (unsigned int i = std::max(c, n * rows.begin);
                   i < n * rows.end;
                   ++i)
                target[i + shift] += source[i];
            }
        }
  }



  /// Move the rest of front @p f to its place on the stack, @p to, which may
  /// overlap the front.
  void
  MultifrontalFactorization::keep_rest(const unsigned int f,
                                       const double      *front,
                                       double            *to) const
  {
    const Panel       &panel  = panels_[f];
    const unsigned int n_rest = panel.n_rows - panel.n_columns;
    const std::size_t  pitch  = padded(n_rest);
    front += (std::size_t(panel.stride) + 1) * panel.n_columns;
    for (unsigned int c = 0; c < n_rest; ++c)
      std::memmove(to + pitch * c + c,
                   front + std::size_t(panel.stride) * c + c,
                   (n_rest - c) * sizeof(double));
  }



  bool
  MultifrontalFactorization::factorize(const Epetra_CrsMatrix &matrix,
                                       const bool              is_symmetric)
  {
    is_symmetric_               = is_symmetric;
    const unsigned int n_halves = (is_symmetric ? 1 : 2);
    for (unsigned int h = 0; h < n_halves; ++h)
      {
        halves_[h].factors.resize_fast(n_factors_);
        halves_[h].stack.resize_fast(stack_size_);
      }
    std::size_t top = 0;
    for (unsigned int f = 0; f < panels_.size(); ++f)
      {
        const Panel &panel = panels_[f];
        DenseFront   fronts[2];
        start_front(f);
        for (unsigned int h = 0; h < n_halves; ++h)
          {
            double *const stack = halves_[h].stack.data();
            double *const to    = stack + top;
            std::fill_n(to, std::size_t(panel.stride) * panel.n_rows, 0.);
            add_matrix(matrix, f, h, to);
            for (const unsigned int child : fronts_.fronts()[f].children)
              add_child(child, panel.stride, stack, to);
            fronts[h] = {to, panel.stride, panel.n_rows};
          }
        if (!eliminate(fronts[0], fronts[n_halves - 1], panel.n_columns))
          return false;
        for (unsigned int h = 0; h < n_halves; ++h)
          {
            std::copy_n(fronts[h].entries,
                        std::size_t(panel.stride) * panel.n_columns,
                        halves_[h].factors.data() + panel.begin);
            keep_rest(f, fronts[h].entries, halves_[h].stack.data() + rest_[f]);
          }
        const std::size_t n_rest = panel.n_rows - panel.n_columns;
        top                      = rest_[f] + padded(n_rest) * n_rest;
      }
    return true;
  }



  /// Copy the rows of front @p f from permuted_ to local_, or back.
  void
  MultifrontalFactorization::copy_rows(const unsigned int f,
                                       const bool         to_front)
  {
    const unsigned int n    = n_components_;
    const auto        &rows = fronts_.fronts()[f].rows;
    for (unsigned int r = 0; r < rows.size(); ++r)
      {
        double *const local = local_.data() + n * r;
        double *const all   = permuted_.data() + n * rows[r];
        std::copy_n(to_front ? all : local, n, to_front ? local : all);
      }
  }



  /// Solve L D z = P x, then U P y = z.
  void
  MultifrontalFactorization::solve(double *x)
  {
    const unsigned int n     = n_components_;
    const auto        &order = fronts_.order();
    const auto column = [&](const Half &half, const Panel &panel, unsigned j) {
      return half.factors.data() + panel.begin + std::size_t(panel.stride) * j;
    };
    for (unsigned int k = 0; k < order.size(); ++k)
      std::copy_n(x + n * order[k], n, &permuted_[n * k]);
    for (unsigned int f = 0; f < panels_.size(); ++f)
      {
        copy_rows(f, true);
        for (unsigned int j = 0; j < panels_[f].n_columns; ++j)
          {
            const double *from = column(halves_[0], panels_[f], j);
            double *const to   = local_.data();
            const double  z    = to[j] / from[j];
            to[j]              = z;
            for (unsigned int i = j + 1; i < panels_[f].n_rows; ++i)
              to[i] -= from[i] * z;
          }
        copy_rows(f, false);
      }
    const Half &upper = halves_[is_symmetric_ ? 0 : 1];
    for (unsigned int f = panels_.size(); f-- > 0;)
      {
        copy_rows(f, true);
        for (unsigned int j = panels_[f].n_columns; j-- > 0;)
          local_[j] -= product(column(upper, panels_[f], j),
                               local_.data(),
                               j + 1,
                               panels_[f].n_rows) /
                       column(halves_[0], panels_[f], j)[j];
        copy_rows(f, false);
      }
    for (unsigned int k = 0; k < order.size(); ++k)
      std::copy_n(&permuted_[n * k], n, x + n * order[k]);
  }
} // namespace talus

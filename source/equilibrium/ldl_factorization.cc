// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/simd.h>
#include <talus/equilibrium/ldl_factorization.h>

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



    /// Dense symmetric matrix by columns. Only entries on and below the diagonal
    /// are used; the values of others are undefined.
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



    /// Subtract L_ik D_k L_jk of the columns k in [@p begin, @p end), already
    /// eliminated, from the n columns j beginning at @p first. @p inverse holds
    /// 1/D_k.
    template <unsigned int n>
    TALUS_ALWAYS_INLINE void
    subtract_products(const DenseFront  &front,
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
            factor[j][k] = from[k][first + j] * inverse[k];
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



    /// Eliminate the first @p n_columns columns: they become columns of L D, and
    /// the rest becomes the Schur complement. Returns false if a pivot is zero
    /// or not a number.
    bool
    eliminate(const DenseFront &front, const unsigned int n_columns)
    {
      for (unsigned int begin = 0; begin < n_columns; begin += n_side_by_side)
        {
          const unsigned int end = std::min(begin + n_side_by_side, n_columns);
          double             inverse[n_side_by_side];
          for (unsigned int k = begin; k < end; ++k)
            {
              if (k > begin)
                subtract_products<1>(front, begin, k, inverse, k);
              const double pivot = front.column(k)[k];
              if (!(std::abs(pivot) > 0.) || !std::isfinite(pivot))
                return false;
              inverse[k - begin] = 1. / pivot;
            }
          unsigned int j = end;
          for (; j + 4 <= front.n_rows; j += 4)
            subtract_products<4>(front, begin, end, inverse, j);
          for (; j < front.n_rows; ++j)
            subtract_products<1>(front, begin, end, inverse, j);
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
  LdlFactorization::analyze(const Epetra_CrsMatrix &matrix,
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
  LdlFactorization::make_panels()
  {
    const unsigned int n = n_components_;
    panels_.clear();
    rest_.clear();
    std::size_t n_factors = 0, top = 0, highest = 0, longest = 0;
    for (const auto &front : fronts_.fronts())
      {
        const std::size_t n_rows = n * front.rows.size(),
                          n_rest = n_rows - n * front.n_columns,
                          stride = padded(n_rows);
        panels_.push_back({n_factors,
                           static_cast<unsigned int>(n_rows),
                           n * front.n_columns,
                           static_cast<unsigned int>(stride)});
        n_factors += stride * n * front.n_columns;
        highest = std::max(highest, top + stride * n_rows);
        longest = std::max(longest, stride);
        rest_.push_back(front.children.empty() ? top :
                                                 rest_[front.children.front()]);
        top = rest_.back() + padded(n_rest) * n_rest;
      }
    factors_.resize_fast(n_factors);
    stack_.resize_fast(highest);
    local_.resize_fast(longest);
    permuted_.resize(n * fronts_.order().size());
    row_in_front_.resize(fronts_.order().size());
  }



  void
  LdlFactorization::find_blocks(const Epetra_CrsMatrix &matrix)
  {
    blocks_.clear();
    first_block_.assign(1, 0);
    for (const auto &front : fronts_.fronts())
      {
        for (unsigned int r = 0; r < front.rows.size(); ++r)
          row_in_front_[front.rows[r]] = r;
        for (unsigned int c = 0; c < front.n_columns; ++c)
          {
            int     n_entries, *columns;
            double *values;
            matrix.ExtractMyRowView(n_components_ *
                                      fronts_.order()[front.first + c],
                                    n_entries,
                                    values,
                                    columns);
            for (int k = 0; k < n_entries; k += n_components_)
              {
                const unsigned int place =
                  fronts_.place()[columns[k] / n_components_];
                if (place >= front.first + c)
                  blocks_.push_back({static_cast<unsigned int>(k),
                                     n_components_ * row_in_front_[place]});
              }
            first_block_.push_back(blocks_.size());
          }
      }
  }



  /// Add the columns of the matrix that front @p f eliminates. The rows of the
  /// symmetric matrix serve as columns.
  void
  LdlFactorization::add_matrix(const Epetra_CrsMatrix &matrix,
                               const unsigned int      f,
                               double                 *to) const
  {
    const auto &front = fronts_.fronts()[f];
    for (unsigned int c = 0; c < front.n_columns; ++c)
      {
        const unsigned int place = front.first + c;
        for (unsigned int d = 0; d < n_components_; ++d)
          {
            int     n_entries, *columns;
            double *values;
            matrix.ExtractMyRowView(n_components_ * fronts_.order()[place] + d,
                                    n_entries,
                                    values,
                                    columns);
            for (std::size_t b = first_block_[place];
                 b < first_block_[place + 1];
                 ++b)
              for (unsigned int e = 0; e < n_components_; ++e)
                to[blocks_[b].row + e] = values[blocks_[b].offset + e];
            to += panels_[f].stride;
          }
      }
  }



  /// Add the rest of front @p child to its parent, whose rows row_in_front_
  /// numbers. Most rows of the child are neighbours in the parent, too.
  void
  LdlFactorization::add_child(const unsigned int child,
                              const std::size_t  stride,
                              double            *to)
  {
    const auto        &front       = fronts_.fronts()[child];
    const unsigned int n           = n_components_;
    const unsigned int n_rest      = front.rows.size() - front.n_columns;
    const std::size_t  child_stride = padded(n * std::size_t(n_rest));
    const double      *from        = stack_.data() + rest_[child];
    ranges_.clear();
    for (unsigned int r = 0; r < n_rest; ++r)
      {
        const unsigned int row = row_in_front_[front.rows[front.n_columns + r]];
        if (r > 0 && row == ranges_.back().row + (r - ranges_.back().begin))
          ranges_.back().end = r + 1;
        else
          ranges_.push_back({r, r + 1, row});
      }
    for (const RowRange &columns : ranges_)
      for (unsigned int c = n * columns.begin; c < n * columns.end; ++c)
        {
          const double *source = from + child_stride * c;
          double       *target =
            to + stride * (c + n * columns.row - n * columns.begin);
          for (const RowRange *rows = &columns; rows != ranges_.data() +
                                                          ranges_.size();
               ++rows)
            {
              const unsigned int shift = n * rows->row - n * rows->begin;
              for (unsigned int i = std::max(c, n * rows->begin);
                   i < n * rows->end;
                   ++i)
                target[i + shift] += source[i];
            }
        }
  }



  /// Move the rest of front @p f to its place on the stack, which may overlap
  /// the front.
  void
  LdlFactorization::keep_rest(const unsigned int f, const double *front)
  {
    const Panel       &panel  = panels_[f];
    const unsigned int n_rest = panel.n_rows - panel.n_columns;
    const std::size_t  stride = padded(n_rest);
    double            *to     = stack_.data() + rest_[f];
    front += (std::size_t(panel.stride) + 1) * panel.n_columns;
    for (unsigned int c = 0; c < n_rest; ++c)
      std::memmove(to + stride * c + c,
                   front + std::size_t(panel.stride) * c + c,
                   (n_rest - c) * sizeof(double));
  }



  bool
  LdlFactorization::factorize(const Epetra_CrsMatrix &matrix)
  {
    double *top = stack_.data();
    for (unsigned int f = 0; f < panels_.size(); ++f)
      {
        const Panel      &panel    = panels_[f];
        const auto       &front    = fronts_.fronts()[f];
        const std::size_t n_panel  = std::size_t(panel.stride) * panel.n_columns;
        for (unsigned int r = 0; r < front.rows.size(); ++r)
          row_in_front_[front.rows[r]] = r;
        std::fill_n(top, std::size_t(panel.stride) * panel.n_rows, 0.);
        add_matrix(matrix, f, top);
        for (const unsigned int child : front.children)
          add_child(child, panel.stride, top);
        if (!eliminate({top, panel.stride, panel.n_rows}, panel.n_columns))
          return false;
        std::copy_n(top, n_panel, factors_.data() + panel.begin);
        keep_rest(f, top);
        const std::size_t n_rest = panel.n_rows - panel.n_columns;
        top = stack_.data() + rest_[f] + padded(n_rest) * n_rest;
      }
    return true;
  }



  /// L z = P x with D z in place of z, then L^T P y = z.
  void
  LdlFactorization::solve(double *x)
  {
    const unsigned int n        = n_components_;
    const auto        &order    = fronts_.order();
    const auto         exchange = [&](const unsigned int f, const auto &action) {
      const auto &rows = fronts_.fronts()[f].rows;
      for (unsigned int r = 0; r < rows.size(); ++r)
        for (unsigned int d = 0; d < n; ++d)
          action(local_[n * r + d], permuted_[n * rows[r] + d]);
    };
    const auto get = [](double &local, double &all) { local = all; };
    const auto put = [](double &local, double &all) { all = local; };
    for (unsigned int k = 0; k < order.size(); ++k)
      std::copy_n(x + n * order[k], n, &permuted_[n * k]);
    for (unsigned int f = 0; f < panels_.size(); ++f)
      {
        exchange(f, get);
        const Panel &panel = panels_[f];
        for (unsigned int j = 0; j < panel.n_columns; ++j)
          {
            const double *column =
              factors_.data() + panel.begin + std::size_t(panel.stride) * j;
            const double z = local_[j] /= column[j];
            double *const to = local_.data();
            for (unsigned int i = j + 1; i < panel.n_rows; ++i)
              to[i] -= column[i] * z;
          }
        exchange(f, put);
      }
    for (unsigned int f = panels_.size(); f-- > 0;)
      {
        exchange(f, get);
        const Panel &panel = panels_[f];
        for (unsigned int j = panel.n_columns; j-- > 0;)
          {
            const double *column =
              factors_.data() + panel.begin + std::size_t(panel.stride) * j;
            local_[j] -=
              product(column, local_.data(), j + 1, panel.n_rows) / column[j];
          }
        exchange(f, put);
      }
    for (unsigned int k = 0; k < order.size(); ++k)
      std::copy_n(&permuted_[n * k], n, x + n * order[k]);
  }
} // namespace talus

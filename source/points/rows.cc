// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/large_pages.h>
#include <talus/points/rows.h>

#include <algorithm>
#include <utility>

namespace talus
{
  namespace
  {
    /// Distance between rows, in doubles. Rows begin at different offsets in a
    /// page of 4 kB, since rows with equal offsets compete for few cache sets.
    std::size_t
    pitch_of(const std::size_t length)
    {
      constexpr std::size_t line = 64 / sizeof(double), page = 64, shift = 19;
      const std::size_t     lines = (length + line - 1) / line;
      return line * (lines + (page + shift - lines % page) % page);
    }
  } // namespace



  void
  Rows::Unmap::operator()(double *memory) const
  {
    unmap_large_pages(memory, bytes);
  }



  /// Copy the rows without the scratch memory of move().
  Rows::Rows(const Rows &other)
  {
    reshape(other.n_rows_, other.length_);
    for (unsigned int r = 0; r < n_rows_; ++r)
      std::copy_n(other[r], length_, (*this)[r]);
  }



  /// Rows are copied one by one into new memory, and each old row is returned
  /// to the system after copying. Most of the memory of a run is here: holding
  /// all rows twice, even briefly, would halve the largest run possible on a
  /// machine. The new memory is mapped first and uses no physical memory until
  /// written; if mapping fails, nothing has changed.
  void
  Rows::reshape(const unsigned int n_rows, const std::size_t length)
  {
    Rows after;
    after.n_rows_           = n_rows;
    after.length_           = length;
    after.pitch_            = pitch_of(length);
    const std::size_t bytes = after.memory_consumption();
    after.memory_.reset(static_cast<double *>(map_large_pages(bytes)),
                        Unmap{bytes});
    // Somebody outside may still read the old rows.
    const bool is_shared = memory_.use_count() > 1;
    for (unsigned int i = 0; i < std::min(n_rows, n_rows_); ++i)
      {
        std::copy_n((*this)[i], std::min(length, length_), after[i]);
        if (!is_shared)
          empty_large_pages(memory_.get(), (*this)[i + 1]);
      }
    *this = std::move(after);
  }



  namespace
  {
    /// Move ranges within a row. Ranges keep their order: moving first the
    /// ranges that go down, in ascending order, then the ranges that go up, in
    /// descending order, never overwrites a range still to be moved.
    void
    move_runs(double *row, const std::vector<BlockMove> &block_moves)
    {
      for (const BlockMove &s : block_moves)
        if (s.to < s.begin)
          std::copy(row + s.begin, row + s.end, row + s.to);
      for (auto s = block_moves.rbegin(); s != block_moves.rend(); ++s)
        if (s->to > s->begin)
          std::copy_backward(row + s->begin,
                             row + s->end,
                             row + s->to + (s->end - s->begin));
    }
  } // namespace



  /// Single entries are saved first and stored last, since ranges may overwrite
  /// their old and new positions. One row at a time, because the hardware
  /// prefetches sequential ranges; several rows at a time took longer.
  void
  Rows::move(const std::vector<BlockMove>   &block_moves,
             const std::vector<ElementMove> &element_moves)
  {
    jumping_.resize(element_moves.size());
    for (unsigned int r = 0; r < n_rows_; ++r)
      {
        double *const row = (*this)[r];
        for (std::size_t i = 0; i < element_moves.size(); ++i)
          jumping_[i] = row[element_moves[i].from];
        move_runs(row, block_moves);
        for (std::size_t i = 0; i < element_moves.size(); ++i)
          row[element_moves[i].to] = jumping_[i];
      }
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_rows_h
#define talus_points_rows_h

#include <cstddef>
#include <memory>
#include <vector>

namespace talus
{
  /// Range of entries [begin, end) moved as a whole to begin at @p to.
  struct BlockMove
  {
    unsigned int begin;
    unsigned int end;
    unsigned int to;
  };

  /// Single entry moved to another position.
  struct ElementMove
  {
    unsigned int from;
    unsigned int to;
  };

  /// Rows of doubles of equal length in one block of memory on large pages.
  class Rows
  {
  public:
    Rows() = default;
    Rows(const Rows &other);
    Rows &
    operator=(Rows &&other) = default;

    /// Resize to @p n_rows rows of at least @p length entries. Old entries
    /// within the new size are kept, new entries are zero. Only a few rows
    /// exist twice at any time. Throws std::bad_alloc if memory is
    /// insufficient, with no change.
    void
    reshape(unsigned int n_rows, std::size_t length);

    /// Move entries in every row; @p block_moves must ascend in begin and in
    /// `to`.
    void
    move(const std::vector<BlockMove>   &block_moves,
         const std::vector<ElementMove> &element_moves);

    unsigned int
    size() const
    {
      return n_rows_;
    }

    double *
    operator[](const unsigned int i)
    {
      return memory_.get() + i * pitch_;
    }

    const double *
    operator[](const unsigned int i) const
    {
      return memory_.get() + i * pitch_;
    }

    /// Number of doubles from the beginning of a row to the next.
    std::size_t
    pitch() const
    {
      return pitch_;
    }

    /// Return the memory of all rows as an owner: the memory outlives the rows
    /// as long as the owner exists, and reshape() then leaves it unchanged.
    std::shared_ptr<const double>
    memory() const
    {
      return memory_;
    }

    std::size_t
    memory_consumption() const
    {
      return n_rows_ * pitch_ * sizeof(double);
    }

  private:
    struct Unmap
    {
      std::size_t bytes;
      void
      operator()(double *memory) const;
    };

    std::shared_ptr<double> memory_;
    unsigned int            n_rows_ = 0;
    std::size_t             length_ = 0;
    std::size_t             pitch_  = 0;
    std::vector<double>     jumping_; ///< scratch of move()
  };
} // namespace talus

#endif

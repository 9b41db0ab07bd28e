// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_rows_h
#define talus_points_rows_h

#include <cstddef>
#include <memory>
#include <vector>

namespace talus
{
  /// Entries that a reordering moves as they are: [begin, end) begins at @p to.
  struct BlockMove
  {
    unsigned int begin;
    unsigned int end;
    unsigned int to;
  };

  /// A single entry that changes its place among the others.
  struct ElementMove
  {
    unsigned int from;
    unsigned int to;
  };

  /// Rows of doubles, equally long, in one piece of memory on large pages.
  class Rows
  {
  public:
    Rows() = default;
    Rows(const Rows &other);
    Rows &
    operator=(Rows &&other) = default;

    /// Make it @p n_rows rows of at least @p length entries each. What was there
    /// stays, as far as there is room; what is new is zero. Takes twice the
    /// memory of a few rows only, not of all, while it works. If there is not
    /// enough, throws std::bad_alloc and changes nothing.
    void
    reshape(unsigned int n_rows, std::size_t length);

    /// Move the same entries of every row: @p block_moves ascend in begin and in
    /// @p to.
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

    /// From the beginning of a row to the next.
    std::size_t
    pitch() const
    {
      return pitch_;
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

    std::unique_ptr<double, Unmap> memory_;
    unsigned int                   n_rows_ = 0;
    std::size_t                    length_ = 0;
    std::size_t                    pitch_  = 0;
    std::vector<double>            jumping_; ///< in move()
  };
} // namespace talus

#endif

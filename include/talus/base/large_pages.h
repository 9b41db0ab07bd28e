// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_large_pages_h
#define talus_base_large_pages_h

#include <cstddef>
#include <new>
#include <vector>

namespace talus
{
  // Memory on pages of 2 MB for data read in every step. The processor caches
  // the addresses of some thousand pages; a body of 160 000 points has several
  // times as many pages of 4 kB, and a step takes 10 % longer.

  /// Allocate zeroed memory aligned to a large page. Without large pages in the
  /// system, small pages are used. Throws std::bad_alloc.
  void *
  map_large_pages(std::size_t bytes);

  /// Free memory allocated by map_large_pages() with the same @p bytes.
  void
  unmap_large_pages(void *memory, std::size_t bytes);

  /// Return the physical pages within [begin, end), whose content is no longer
  /// needed, to the system. The addresses stay mapped.
  void
  empty_large_pages(void *begin, void *end);



  /// Allocator for containers: blocks of at least an eighth of a page on pages
  /// of 2 MB, smaller blocks from the heap.
  template <typename T>
  struct LargePageAllocator
  {
    using value_type = T;

    LargePageAllocator() = default;

    template <typename U>
    LargePageAllocator(const LargePageAllocator<U> &)
    {}

    T *
    allocate(const std::size_t n)
    {
      const std::size_t bytes = n * sizeof(T);
      return static_cast<T *>(bytes >= enough
                                ? map_large_pages(bytes)
                                : ::operator new(bytes, alignment));
    }

    void
    deallocate(T *memory, const std::size_t n)
    {
      if (n * sizeof(T) >= enough)
        unmap_large_pages(memory, n * sizeof(T));
      else
        ::operator delete(memory, alignment);
    }

    friend bool
    operator==(const LargePageAllocator &, const LargePageAllocator &)
    {
      return true;
    }

    friend bool
    operator!=(const LargePageAllocator &, const LargePageAllocator &)
    {
      return false;
    }

  private:
    static constexpr std::size_t      enough    = 1 << 18;
    static constexpr std::align_val_t alignment = std::align_val_t(64);
  };

  template <typename T>
  using LargePageVector = std::vector<T, LargePageAllocator<T>>;
} // namespace talus

#endif

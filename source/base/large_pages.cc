// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/large_pages.h>

#include <sys/mman.h>

#include <cstdint>

namespace talus
{
  namespace
  {
    // 2 MB, the large page of x86-64. With another page size the memory is
    // valid, but perhaps not on large pages.
    constexpr std::size_t page = std::size_t(1) << 21;

    /// Round @p bytes up to whole large pages.
    std::size_t
    whole_pages(const std::size_t bytes)
    {
      return (bytes + page - 1) / page * page;
    }

    /// First address from @p memory on at which a large page can begin.
    char *
    next_page(void *memory)
    {
      const auto address = reinterpret_cast<std::uintptr_t>(memory);
      return static_cast<char *>(memory) + (page - address % page) % page;
    }

    /// Request large pages, if the system supports the request; otherwise the
    /// memory remains valid on small pages.
    void
    advise([[maybe_unused]] char             *memory,
           [[maybe_unused]] const std::size_t bytes)
    {
#ifdef MADV_HUGEPAGE
      madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    }
  } // namespace



  /// mmap() and madvise() need no administrator, unlike a pool of reserved
  /// pages (MAP_HUGETLB). The system uses large pages only at multiples of
  /// their size, and mmap() aligns to 4 kB only: the mapping is one page larger
  /// than needed and is cut.
  void *
  map_large_pages(const std::size_t bytes)
  {
    // One page more than needed, for alignment; both ends are returned.
    const std::size_t size = whole_pages(bytes);
    void *const       all  = mmap(nullptr,
                           size + page,
                           PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS,
                           -1,
                           0);
    if (all == MAP_FAILED)
      throw std::bad_alloc();
    char *const       memory = next_page(all);
    const std::size_t before = memory - static_cast<char *>(all);
    if (before > 0)
      munmap(all, before);
    if (before < page)
      munmap(memory + size, page - before);
    advise(memory, size);
    return memory;
  }



  void
  unmap_large_pages(void *memory, const std::size_t bytes)
  {
    munmap(memory, whole_pages(bytes));
  }



  void
  empty_large_pages(void *begin, void *end)
  {
    // Only pages completely inside: other pages contain other data, too.
    char *const first = next_page(begin);
    char *const last  = next_page(end) - (next_page(end) == end ? 0 : page);
    if (first < last)
      madvise(first, last - first, MADV_DONTNEED);
  }
} // namespace talus

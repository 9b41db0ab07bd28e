// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/large_pages.h>

#include <sys/mman.h>

#include <cstdint>

namespace talus
{
  namespace
  {
    // 2 MB, the large page of x86-64. Where large pages have another size the
    // memory is as good, only perhaps not on such pages.
    constexpr std::size_t page = std::size_t(1) << 21;

    /// @p bytes rounded up to whole large pages.
    std::size_t
    whole_pages(const std::size_t bytes)
    {
      return (bytes + page - 1) / page * page;
    }

    /// The first address from @p memory on at which a large page can begin.
    char *
    next_page(void *memory)
    {
      const auto address = reinterpret_cast<std::uintptr_t>(memory);
      return static_cast<char *>(memory) + (page - address % page) % page;
    }

    /// What the system does not know it does not do: the memory is as good.
    void
    advise([[maybe_unused]] char             *memory,
           [[maybe_unused]] const std::size_t bytes)
    {
#ifdef MADV_HUGEPAGE
      madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    }
  } // namespace



  /// By mmap() and madvise() and not from a pool of reserved pages
  /// (MAP_HUGETLB), which an administrator would have to set up. The system
  /// only replaces small pages by a large one that begins at a multiple of its
  /// size, and mmap() knows multiples of 4 kB only: so more is mapped than is
  /// needed, and cut.
  void *
  map_large_pages(const std::size_t bytes)
  {
    // One page more than asked for, so that there is a place to begin; what is
    // before and behind goes back.
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
    // Only pages that lie within as a whole: the others hold something else,
    // too.
    char *const first = next_page(begin);
    char *const last  = next_page(end) - (next_page(end) == end ? 0 : page);
    if (first < last)
      madvise(first, last - first, MADV_DONTNEED);
  }
} // namespace talus
